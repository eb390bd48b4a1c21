#include "ceres_ed/pipeline/cohort/shape_statistics.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/npy_rows.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/statistics/group_test.h>
#include <ceres_ed/statistics/model_quality.h>
#include <ceres_ed/statistics/procrustes.h>
#include <ceres_ed/statistics/shape_model.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

// Components beyond these have no pictures.
constexpr int kShownComponents = 5;
// How many standard deviations a shown component is away from the mean.
constexpr double kShownDeviations = 2.0;

// The rows of a file as shapes.
class ShapesInFile : public ShapeTable {
 public:
  explicit ShapesInFile(std::unique_ptr<NpyRowsReader> reader) : reader_(std::move(reader)) {}

  int num_shapes() const override { return static_cast<int>(reader_->shape()[0]); }
  int num_vertices() const override { return static_cast<int>(reader_->row_size() / 3); }
  Status Read(int shape, int first, int count, double* values) const override {
    return reader_->Read(shape, first, count, values);
  }

 private:
  std::unique_ptr<NpyRowsReader> reader_;
};

StatusOr<std::unique_ptr<ShapesInFile>> OpenShapes(const std::string& path) {
  StatusOr<std::unique_ptr<NpyRowsReader>> reader = NpyRowsReader::Open(path);
  if (!reader.ok()) return reader.status();
  return std::make_unique<ShapesInFile>(*std::move(reader));
}

Eigen::VectorXd Flat(const std::vector<Eigen::Vector3d>& points) {
  Eigen::VectorXd flat(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) {
    flat.segment<3>(3 * static_cast<Eigen::Index>(v)) = points[v];
  }
  return flat;
}

std::vector<Eigen::Vector3d> Points(const Eigen::VectorXd& flat) {
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Index v = 0; v + 2 < flat.size(); v += 3) points.emplace_back(flat.segment<3>(v));
  return points;
}

ordered_json Numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

// Computes and writes; see ComputeShapeStatistics().
class Statistics {
 public:
  Statistics(const std::string& output,
             const ModelSettings& settings,
             const PointCloud& source,
             CollectedMembers* all)
      : output_(output), settings_(settings), source_(source), all_(*all) {}

  // The steps, in this order.
  Status CollectPoints();
  Status Align();
  Status FitModel();
  Status MeasureQuality();
  Status CompareGroups();
  Status WriteStatistics();

  bool IsEmpty() const { return rows_.empty(); }
  ShapeStatistics Take() { return std::move(result_); }

 private:
  std::string File(const std::string& name) const { return output_ + "/" + name; }
  // Opens the points of a member that may take part; null, with a message of the member, if they
  // cannot be used.
  std::unique_ptr<NpyRowsReader> OpenMember(CollectedMember* member) const;
  PointCloud CloudAt(const Eigen::VectorXd& shape) const;
  Status WriteMean();
  Status WriteComponents();
  Status WriteScores() const;

  const std::string output_;
  const ModelSettings& settings_;
  const PointCloud& source_;
  CollectedMembers& all_;
  // The members that take part, by their number.
  std::vector<int> rows_;
  std::unique_ptr<ShapesInFile> table_;
  ShapeModel model_;
  ordered_json report_;
  ShapeStatistics result_;
};

std::unique_ptr<NpyRowsReader> Statistics::OpenMember(CollectedMember* member) const {
  MemberRecord& record = member->record;
  if (record.state != MemberState::kDone || record.grade > settings_.worst) return nullptr;
  StatusOr<std::unique_ptr<NpyRowsReader>> reader =
      NpyRowsReader::Open(member->folder + "/points.npy");
  if (!reader.ok()) {
    record.message = reader.status().message();
    return nullptr;
  }
  const std::vector<std::size_t> expected = {source_.size(), 3};
  if ((*reader)->shape() != expected) {
    record.message = member->folder + "/points.npy: expected the " +
                     std::to_string(source_.size()) + " points of the template";
    return nullptr;
  }
  return *std::move(reader);
}

Status Statistics::CollectPoints() {
  for (std::size_t i = 0; i < all_.members.size(); ++i) {
    CollectedMember& member = all_.members[i];
    member.in_model = OpenMember(&member) != nullptr;
    if (member.in_model) rows_.push_back(static_cast<int>(i));
  }
  if (rows_.empty()) return Status::Ok();
  std::string names = "row,name,group\n";
  auto writer =
      NpyRowsWriter::Create(File("correspondences.npy"), {rows_.size(), source_.size(), 3});
  if (!writer.ok()) return writer.status();
  std::vector<double> values(3 * source_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    CollectedMember& member = all_.members[rows_[row]];
    const std::unique_ptr<NpyRowsReader> reader = OpenMember(&member);
    if (reader == nullptr) return Status::Error(member.record.message);
    Status status = reader->Read(0, 0, values.size(), values.data());
    if (status.ok()) status = (*writer)->Write(row, values.data());
    if (!status.ok()) return status;
    names += std::to_string(row) + "," + member.member.name + "," + member.member.group + "\n";
  }
  if (Status status = (*writer)->Commit(); !status.ok()) return status;
  return WriteFileAtomically(File("rows.csv"), names);
}

Status Statistics::Align() {
  auto in_place = OpenShapes(File("correspondences.npy"));
  if (!in_place.ok()) return in_place.status();
  const StatusOr<AlignedShapes> aligned =
      AlignShapes(**in_place, settings_.align, Flat(source_.points));
  if (!aligned.ok()) return Status::Error(output_ + ": " + aligned.status().message());
  report_["align"] = NameOf(settings_.align);
  report_["align_rounds"] = aligned->rounds;
  auto writer = NpyRowsWriter::Create(File("aligned.npy"), {rows_.size(), source_.size(), 3});
  if (!writer.ok()) return writer.status();
  Eigen::VectorXd shape((*in_place)->num_values());
  for (int row = 0; row < (*in_place)->num_shapes(); ++row) {
    Status status = (*in_place)->Read(row, 0, (*in_place)->num_values(), shape.data());
    if (!status.ok()) return status;
    const Eigen::VectorXd moved = TransformShape(aligned->transforms[row], shape);
    status = (*writer)->Write(row, moved.data());
    if (!status.ok()) return status;
  }
  if (Status status = (*writer)->Commit(); !status.ok()) return status;
  auto table = OpenShapes(File("aligned.npy"));
  if (!table.ok()) return table.status();
  table_ = *std::move(table);
  return Status::Ok();
}

PointCloud Statistics::CloudAt(const Eigen::VectorXd& shape) const {
  PointCloud cloud;
  cloud.points = Points(shape);
  cloud.triangles = source_.triangles;
  return cloud;
}

Status Statistics::WriteMean() {
  result_.mean = CloudAt(model_.mean);
  const double squares = (model_.mean - Flat(source_.points)).squaredNorm();
  result_.change = std::sqrt(squares / static_cast<double>(source_.size())) /
                   std::max(Diagonal(source_.points), 1e-300);
  CloudWriteOptions options;
  options.double_precision = true;
  std::vector<double> deviations;
  for (const double variance : model_.vertex_variances) deviations.push_back(std::sqrt(variance));
  options.columns.push_back(MakePlyScalar("std_dev", PlyType::kFloat64, std::move(deviations)));
  return WriteCloud(File("mean.ply"), result_.mean, options);
}

Status Statistics::WriteComponents() {
  const auto count = static_cast<std::size_t>(model_.components.cols());
  auto writer = NpyRowsWriter::Create(File("components.npy"), {count, source_.size(), 3});
  if (!writer.ok()) return writer.status();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::VectorXd component = model_.components.col(static_cast<Eigen::Index>(k));
    if (Status status = (*writer)->Write(k, component.data()); !status.ok()) return status;
    if (k >= kShownComponents) continue;
    const Eigen::VectorXd step =
        kShownDeviations * std::sqrt(model_.variances[static_cast<Eigen::Index>(k)]) * component;
    for (const double sign : {1.0, -1.0}) {
      char name[64];
      std::snprintf(
          name, sizeof(name), "component_%02zu_%s.ply", k + 1, sign > 0.0 ? "plus" : "minus");
      Status status = WriteCloud(File(name), CloudAt(model_.mean + sign * step));
      if (!status.ok()) return status;
    }
  }
  return (*writer)->Commit();
}

Status Statistics::WriteScores() const {
  std::string table = "name,group";
  for (Eigen::Index k = 0; k < model_.scores.cols(); ++k) {
    table += ",component_" + std::to_string(k + 1);
  }
  table += "\n";
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const CohortMember& member = all_.members[rows_[row]].member;
    table += member.name + "," + member.group;
    for (Eigen::Index k = 0; k < model_.scores.cols(); ++k) {
      table += "," + NumberText(model_.scores(static_cast<Eigen::Index>(row), k));
    }
    table += "\n";
  }
  return WriteFileAtomically(File("scores.csv"), table);
}

Status Statistics::FitModel() {
  StatusOr<ShapeModel> model = FitShapeModel(*table_, settings_.components);
  if (!model.ok()) return model.status();
  model_ = *std::move(model);
  report_["components"] = {{"variances", Numbers(model_.variances)},
                           {"explained", Numbers(model_.ExplainedShares())},
                           {"total_variance", model_.total_variance}};
  Status status = WriteMean();
  if (status.ok()) status = WriteComponents();
  if (status.ok()) status = WriteScores();
  report_["change"] = result_.change;
  return status;
}

Status Statistics::MeasureQuality() {
  ModelQualityOptions options;
  options.max_components = settings_.components;
  const StatusOr<ModelQuality> quality = MeasureModelQuality(*table_, options);
  if (!quality.ok()) return quality.status();
  report_["quality"] = {{"shapes", quality->shapes},
                        {"generalization", quality->generalization},
                        {"generalization_error", quality->generalization_error},
                        {"specificity", quality->specificity}};
  return Status::Ok();
}

Status Statistics::CompareGroups() {
  std::map<std::string, int> numbers;
  bool has_all = true;
  for (const int row : rows_) {
    const std::string& group = all_.members[row].member.group;
    has_all = has_all && !group.empty();
    numbers.emplace(group, 0);
  }
  if (numbers.size() < 2) return Status::Ok();
  if (!has_all) {
    result_.notes.emplace_back("groups are not compared: some shapes have none");
    return Status::Ok();
  }
  int next = 0;
  ordered_json groups = ordered_json::object();
  for (auto& [name, number] : numbers) {
    number = next++;
    groups[name] = 0;
  }
  std::vector<int> of_shapes;
  for (const int row : rows_) {
    const std::string& group = all_.members[row].member.group;
    of_shapes.push_back(numbers[group]);
    groups[group] = groups[group].get<int>() + 1;
  }
  GroupTestOptions options;
  options.permutations = settings_.permutations;
  StatusOr<GroupTest> test = TestGroups(*table_, of_shapes, options);
  if (!test.ok()) {
    result_.notes.push_back("groups are not compared: " + test.status().message());
    return Status::Ok();
  }
  const auto below = [](const std::vector<double>& p) {
    return std::count_if(p.begin(), p.end(), [](double value) { return value <= 0.05; });
  };
  report_["groups"] = {
      {"shapes", groups},
      {"permutations", settings_.permutations},
      {"least_p_corrected", *std::min_element(test->p_corrected.begin(), test->p_corrected.end())},
      {"vertices_below_0.05", below(test->p)},
      {"vertices_below_0.05_corrected", below(test->p_corrected)},
      {"largest_difference", *std::max_element(test->difference.begin(), test->difference.end())}};
  CloudWriteOptions write;
  const auto add = [&write](const char* name, std::vector<double> values) {
    write.columns.push_back(MakePlyScalar(name, PlyType::kFloat32, std::move(values)));
  };
  add("difference", std::move(test->difference));
  add("statistic", std::move(test->statistic));
  add("p", std::move(test->p));
  add("p_corrected", std::move(test->p_corrected));
  return WriteCloud(File("groups.ply"), result_.mean, write);
}

Status Statistics::WriteStatistics() {
  result_.report = {{"program", "ed_cohort"},
                    {"shapes", rows_.size()},
                    {"vertices", source_.size()},
                    {"worst", NameOf(settings_.worst)}};
  for (const auto& [name, value] : report_.items()) result_.report[name] = value;
  result_.report["rounds"] = all_.index.rounds;
  return WriteReport(File("statistics.json"), result_.report);
}

}  // namespace

StatusOr<PointCloud> ReadCohortTemplate(const std::string& folder) {
  StatusOr<LoadedCloud> loaded = LoadCloud(folder + "/template.ply");
  if (!loaded.ok()) return loaded.status();
  return std::move(loaded->cloud);
}

StatusOr<ShapeStatistics> ComputeShapeStatistics(const std::string& output,
                                                 const ModelSettings& settings,
                                                 const PointCloud& source,
                                                 CollectedMembers* all) {
  Statistics statistics(output, settings, source, all);
  Status status = statistics.CollectPoints();
  if (!status.ok()) return status;
  if (statistics.IsEmpty()) return statistics.Take();
  for (Status (Statistics::*const step)() : {&Statistics::Align,
                                             &Statistics::FitModel,
                                             &Statistics::MeasureQuality,
                                             &Statistics::CompareGroups,
                                             &Statistics::WriteStatistics}) {
    status = (statistics.*step)();
    if (!status.ok()) return status;
  }
  return statistics.Take();
}

}  // namespace ceres_ed
