#include "ceres_ed/pipeline/apply/field_run.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/io/field/field_format.h>
#include <ceres_ed/io/field/rigid_file.h>
#include <ceres_ed/pipeline/apply/choose_grid.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/util/options.h>

#include <memory>
#include <vector>

namespace ceres_ed {
namespace {

// Points of the source, and where the warp moves them.
struct MovedPoints {
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
};

StatusOr<MovedPoints> MoveCloud(const Warp& warp, const PointCloud& cloud, int num_threads) {
  PointCloud moved = cloud;
  moved.normals.clear();
  if (Status status = ApplyWarp(warp, &moved, num_threads); !status.ok()) return status;
  return MovedPoints{cloud.points, std::move(moved.points)};
}

MovedPoints MoveNodesAndFinish(const SpaceWarp& warp) {
  MovedPoints points;
  const Warp& parts = warp.warp();
  points.source.assign(parts.graph.positions().begin(), parts.graph.positions().end());
  points.source.insert(points.source.end(), parts.finish.points.begin(), parts.finish.points.end());
  for (const Eigen::Vector3d& point : points.source) points.target.push_back(warp(point));
  return points;
}

// Returns the line for the header of the file.
std::string Description(const FieldSettings& settings, FieldSpace space) {
  return std::string("ceres_ed field: ") +
         (settings.inverse ? "TARGET point + vector = SOURCE point (inverse); "
                           : "SOURCE point + vector = TARGET point (forward); ") +
         (space == FieldSpace::kLps ? "LPS, mm" : "axes of SOURCE");
}

// Returns the placement in the coordinates of a file: factors * S * factors^-1. With signs of two
// axes, which are half a turn, it stays a similarity.
Similarity InFrame(const Similarity& similarity, const FileFrame& frame) {
  Similarity changed;
  const Eigen::Vector3d signs = frame.factors.cwiseQuotient(frame.factors.cwiseAbs());
  const Eigen::Matrix3d rotation =
      signs.asDiagonal() * similarity.rotation.toRotationMatrix() * signs.asDiagonal();
  changed.rotation = Eigen::Quaterniond(rotation);
  changed.scale = similarity.scale;
  changed.translation = frame.ToFile(similarity.translation);
  return changed;
}

Status WriteRigid(const FieldSettings& settings, const Warp& warp, FieldObserver* observer) {
  if (settings.rigid.empty()) return Status::Ok();
  const std::string& path = settings.rigid;
  const std::string ending = ".tfm";
  const bool is_itk = path.size() > ending.size() &&
                      path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  if (!is_itk) {
    observer->OnRigid(path + ": matrix that moves points of SOURCE to TARGET");
    return WriteMatrixFile(path, warp.target_from_source);
  }
  if (!(warp.target_from_source.scale > 0.0)) {
    return Status::Error(path + ": the placement of the warp has the scale " +
                         NumberText(warp.target_from_source.scale) +
                         " and no inverse, expected a scale > 0");
  }
  const std::string sentence = "maps points of TARGET to SOURCE, as ITK resamples; LPS, mm";
  const FileFrame frame = FrameOfFile(FieldSpace::kLps, settings.frame, settings.unit);
  observer->OnRigid(path + ": transform that " + sentence);
  return WriteItkTransformFile(path, InFrame(warp.target_from_source.Inverse(), frame), sentence);
}

// Fills the grid, and writes to `written` what is known then.
std::optional<DisplacementField> Fill(const FieldSettings& settings,
                                      const SpaceWarp& warp,
                                      const FileFrame& frame,
                                      FieldObserver* observer,
                                      WrittenField* written) {
  if (!settings.inverse) {
    return FillForwardField(warp, written->grid, frame, settings.num_threads, observer);
  }
  return FillInverseField(warp,
                          written->grid,
                          frame,
                          settings.no_inverse,
                          settings.num_threads,
                          observer,
                          &written->inverse);
}

FieldSubject SubjectOf(const FieldSettings& settings, const Warp& warp, const MovedPoints& points) {
  FieldSubject subject;
  subject.box = BoundingBox(settings.inverse ? points.target : points.source);
  subject.node_spacing = SurfaceNodeSpacing(warp.graph);
  if (settings.inverse) subject.node_spacing *= warp.target_from_source.scale;
  return subject;
}

Outcome BadWarp(const std::string& warp_path, const Status& status) {
  return Outcome::BadInput(Status::Error(warp_path + ": " + status.message()));
}

Outcome FillField(const FieldSettings& settings,
                  const FieldFormat& format,
                  const std::string& warp_path,
                  const SpaceWarp& warp,
                  const PointCloud* cloud,
                  FieldObserver* observer,
                  MadeField* made) {
  const StatusOr<MovedPoints> points = cloud == nullptr
                                           ? StatusOr<MovedPoints>(MoveNodesAndFinish(warp))
                                           : MoveCloud(warp.warp(), *cloud, settings.num_threads);
  if (!points.ok()) return BadWarp(warp_path, points.status());
  if (const auto bounds = ParseBounds(settings.bounds); !bounds.ok()) {
    return Outcome::Usage(bounds.status().message());
  }
  const FileFrame frame = FrameOfFile(format.space, settings.frame, settings.unit);
  const StatusOr<FieldGrid> grid =
      ChooseGrid(settings, format, frame, SubjectOf(settings, warp.warp(), *points));
  if (!grid.ok()) return Outcome::BadInput(grid.status());
  WrittenField& about = made->about;
  about.grid = *grid;
  about.spacing = grid->spacing.minCoeff() / frame.unit();
  about.is_lps = format.space == FieldSpace::kLps;
  about.megabytes = FieldMegabytes(format, *grid);
  observer->OnGrid(about);
  std::optional<DisplacementField> field = Fill(settings, warp, frame, observer, &about);
  if (!field.has_value())
    return Outcome::StoppedEarly("stopped: " + settings.field + " is not written");
  field->description = Description(settings, format.space);
  about.error = settings.inverse ? MeasureField(*field, frame, points->target, points->source)
                                 : MeasureField(*field, frame, points->source, points->target);
  made->field = *std::move(field);
  return Outcome::Done();
}

}  // namespace

Outcome MakeField(const FieldSettings& settings,
                  const FieldFormat& format,
                  const std::string& warp_path,
                  const Warp& warp,
                  const PointCloud* cloud,
                  FieldObserver* observer,
                  MadeField* made) {
  const auto space = SpaceWarp::Create(warp, settings.num_threads);
  if (!space.ok()) return BadWarp(warp_path, space.status());
  return FillField(settings, format, warp_path, **space, cloud, observer, made);
}

Outcome RunField(const FieldSettings& settings,
                 const std::string& warp_path,
                 const Warp& warp,
                 const PointCloud* cloud,
                 FieldObserver* observer) {
  const auto space = SpaceWarp::Create(warp, settings.num_threads);
  if (!space.ok()) return BadWarp(warp_path, space.status());
  if (!settings.rigid.empty()) {
    Status status = PrepareOutput(settings.rigid);
    if (status.ok()) status = WriteRigid(settings, warp, observer);
    if (!status.ok()) return Outcome::BadInput(status);
  }
  if (settings.field.empty()) return Outcome::Done();
  const StatusOr<const FieldFormat*> format = FieldFormatOf(settings.field);
  if (!format.ok()) return Outcome::Usage(format.status().message());
  if (Status status = PrepareOutput(settings.field); !status.ok()) {
    return Outcome::BadInput(status);
  }
  MadeField made;
  Outcome outcome = FillField(settings, **format, warp_path, **space, cloud, observer, &made);
  if (!outcome.done()) return outcome;
  if (Status status = (*format)->write(settings.field, made.field); !status.ok()) {
    return Outcome::BadInput(status);
  }
  observer->OnField(made.about);
  return Outcome::Done();
}

}  // namespace ceres_ed
