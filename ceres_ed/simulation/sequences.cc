#include "ceres_ed/simulation/sequences.h"

#include <ceres_ed/simulation/rendering.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kMaxFrames = 1000000;
constexpr int kNodesInView = 300;
constexpr int kDefaultNodes = 1000;
constexpr int kMinVertices = 500;
constexpr int kDefaultVertices = 12000;
constexpr int kMaxVertices = 1000000;
constexpr int kMinPixels = 16;
constexpr int kMaxPixels = 8192;
// The share of the view's length by which the camera moves along a strip in each frame.
constexpr double kStripStep = 0.05;
constexpr double kMaxStripStep = 0.3;

// The length of the strip, in views, and the number of frames of its camera.
struct StripPlan {
  double views = 1.0;
  int frames = 1;
};

StripPlan PlanStrip(const SyntheticSequenceOptions& options) {
  if (options.nodes_hint == 0 && options.frames > 0) {
    return {1.0 + kStripStep * (options.frames - 1), options.frames};
  }
  const int nodes = options.nodes_hint == 0 ? kDefaultNodes : options.nodes_hint;
  const double views = static_cast<double>(nodes) / kNodesInView;
  const int needed = static_cast<int>(std::ceil((views - 1.0) / kStripStep - 1e-9)) + 1;
  return {views, options.frames > 0 ? options.frames : std::max(needed, 2)};
}

PinholeCamera MakeCamera(int width, int height) {
  PinholeCamera camera;
  camera.fx = camera.fy = 560.0 / 640.0 * width;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  camera.width = width;
  camera.height = height;
  return camera;
}

std::unique_ptr<SyntheticScene> MakeScene(const SyntheticSequenceOptions& options,
                                          const PinholeCamera& camera) {
  const auto frames = [&options](int usual) { return options.frames > 0 ? options.frames : usual; };
  const int vertices = options.vertices > 0 ? options.vertices : kDefaultVertices;
  if (options.kind == SyntheticSceneKind::kPlane) {
    return MakePlaneScene(vertices, frames(10), camera);
  }
  if (options.kind == SyntheticSceneKind::kStrip) {
    const StripPlan plan = PlanStrip(options);
    return MakeStripScene(
        plan.views * StripViewLength(camera), plan.frames, options.period, camera);
  }
  const auto shape = SyntheticShapeFromName(NameOf(options.kind));
  CHECK(shape.has_value()) << NameOf(options.kind);
  return MakeOrganScene(*shape, vertices, frames(60), options.period);
}

// Returns a seed for the noise of each frame; the seeds are independent of each other (the
// finalizer of SplitMix64).
std::uint64_t FrameSeed(std::uint64_t seed, int frame) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(frame) + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::string Gigabytes(double bytes) {
  std::ostringstream text;
  text << std::setprecision(2) << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

const OptionTable<SyntheticSequenceOptions>& SyntheticSequenceOptions::Rows() {
  using O = SyntheticSequenceOptions;
  static const OptionTable<O> rows({
      Row(&O::kind, "scene", "What is seen.").Group(OptionGroup::kInternal),
      Row(&O::frames,
          "frames",
          "The number of frames; automatic is 60 for an organ, 10 for plane, and as many as its "
          "length asks for with strip.")
          .In(Between(1, kMaxFrames))
          .Special(0, "automatic")
          .Main(),
      Row(&O::nodes_hint,
          "nodes_hint",
          "The length of strip in nodes: a map with 300 nodes in view ends with about as many; "
          "automatic is by --frames, or 1000.")
          .In(Between(kNodesInView, kMaxFrames))
          .Special(0, "automatic")
          .Main(),
      Row(&O::width, "width", "The columns of the pictures, which cover 59.5 degrees.")
          .In(Between(kMinPixels, kMaxPixels))
          .Unit("pixels")
          .Main(),
      Row(&O::height, "height", "The rows of the pictures.")
          .In(Between(kMinPixels, kMaxPixels))
          .Unit("pixels")
          .Main(),
      Row(&O::seed, "seed", "The seed of texture and noise.").Main(),
      Row(&O::noise,
          "noise",
          "The standard deviation of the depth where the surface faces the camera; it grows toward "
          "grazing angles, where pixels drop out.")
          .In(AtLeast(0))
          .Unit("metres")
          .Special(0, "exact to 0.1 mm")
          .Main(),
      Row(&O::disparity_noise,
          "disparity_noise",
          "Further noise, as of a stereo camera: this times z^2 / (f --baseline).")
          .In(AtLeast(0))
          .Unit("pixels"),
      Row(&O::stereo, "stereo", "Make the pictures of two cameras (left/, right/), without depth.")
          .Main(),
      Row(&O::baseline, "baseline", "The distance of the two cameras.")
          .In(AboveUpTo(0, 1))
          .Unit("metres")
          .Main(),
      Row(&O::picture_noise, "picture_noise", "The standard deviation of stereo pictures.")
          .In(Between(0, 50))
          .Unit("levels of 255"),
      Row(&O::period, "period", "The frames in which the tissue moves there and back.")
          .In(AtLeast(2))
          .Unit("frames")
          .Main(),
      Row(&O::vertices,
          "vertices",
          "The vertices of the tissue; automatic is 12000. A strip has one every 1.5 mm.")
          .In(Between(kMinVertices, kMaxVertices))
          .Special(0, "automatic")
          .Main(),
      Row(&O::truth, "truth", "Also write the truth for every vertex; poses always are.").Main(),
      Row(&O::max_truth_bytes, "max_truth_bytes", "A larger truth is thinned, or left out.")
          .In(Above(0))
          .Unit("bytes"),
  });
  return rows;
}

bool SyntheticSequenceOptions::IsValid(std::string* error) const {
  if (!Rows().Check(*this, error)) return false;
  std::ostringstream message;
  const bool is_strip = kind == SyntheticSceneKind::kStrip;
  if (!is_strip && nodes_hint != 0) {
    message << "nodes_hint is " << nodes_hint << ", but the size of " << NameOf(kind)
            << " is fixed, expected 0 (it is for strip only)";
  } else if (is_strip && vertices != 0) {
    message << "vertices is " << vertices << ", but a strip has one every 1.5 mm, expected 0";
  } else if (is_strip) {
    const StripPlan plan = PlanStrip(*this);
    const int fewest = static_cast<int>(std::ceil((plan.views - 1.0) / kMaxStripStep - 1e-9)) + 1;
    if (plan.frames < fewest) {
      message << "frames is " << plan.frames << " for nodes_hint " << nodes_hint << ", expected "
              << fewest << " or more: the camera would leave out tissue between frames";
    }
  }
  *error = message.str();
  return error->empty();
}

SyntheticSequence::SyntheticSequence(const SyntheticSequenceOptions& options)
    : options_(options), texture_(options.seed) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
  camera_ = MakeCamera(options.width, options.height);
  scene_ = MakeScene(options, camera_);
  if (options.truth) MakeTruth();
}

void SyntheticSequence::MakeTruth() {
  const double bytes_per_vertex = 3.0 * sizeof(float) * scene_->num_frames();
  const int full = scene_->MaxVertices();
  const double affordable = options_.max_truth_bytes / bytes_per_vertex;
  if (affordable < scene_->MinVertices()) {
    truth_note_ = "the truth of every vertex is left out: it would take " +
                  Gigabytes(scene_->MinVertices() * bytes_per_vertex) + " or more, expected " +
                  Gigabytes(options_.max_truth_bytes) + " at most";
    return;
  }
  const int vertices = static_cast<int>(std::min<double>(full, affordable));
  truth_mesh_ = scene_->RestMesh(vertices);
  if (vertices < full) {
    truth_note_ = "the truth is thinned to " + std::to_string(truth_mesh_.size()) +
                  " vertices: all " + std::to_string(full) + " would take " +
                  Gigabytes(full * bytes_per_vertex);
  }
}

std::vector<Eigen::Vector3d> SyntheticSequence::TruthPoints(int frame) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(truth_mesh_.size());
  for (const Eigen::Vector3d& rest : truth_mesh_.points) {
    points.push_back(scene_->Deform(frame, rest));
  }
  return points;
}

std::optional<StereoRig> SyntheticSequence::rig() const {
  if (!options_.stereo) return std::nullopt;
  StereoRig rig;
  rig.left.pinhole = rig.right.pinhole = camera_;
  rig.right_from_left.translation = {-options_.baseline, 0.0, 0.0};
  return rig;
}

// `deformed` are the points of `patch` in the world frame.
RenderedView SyntheticSequence::RenderView(const PointCloud& patch,
                                           const std::vector<Eigen::Vector3d>& deformed,
                                           const CameraPose& world_from_camera,
                                           bool with_color) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(deformed.size());
  for (const Eigen::Vector3d& point : deformed) {
    points.push_back(world_from_camera.ApplyInverse(point));
  }
  RenderedView view;
  view.raster = RasterizeMesh(points, patch.triangles, camera_);
  view.normals = AreaWeightedNormals(points, patch.triangles);
  view.cosines = IncidenceCosines(view.raster, patch.triangles, view.normals, camera_);
  if (with_color) {
    view.color =
        ShadeTissue(view.raster, patch.triangles, patch.points, view.cosines, camera_, texture_);
  }
  return view;
}

SyntheticFrame SyntheticSequence::Render(int frame, bool with_color) const {
  CHECK(frame >= 0 && frame < num_frames()) << "frame " << frame;
  SyntheticFrame result;
  result.world_from_camera = scene_->WorldFromCamera(frame);
  result.mask = scene_->Mask(frame);
  const PointCloud patch = scene_->RestPatch(frame);
  std::vector<Eigen::Vector3d> deformed;
  deformed.reserve(patch.size());
  for (const Eigen::Vector3d& rest : patch.points) deformed.push_back(scene_->Deform(frame, rest));
  RenderedView left =
      RenderView(patch, deformed, result.world_from_camera, with_color || options_.stereo);
  const DepthNoise noise{options_.noise,
                         options_.disparity_noise / (camera_.fx * options_.baseline)};
  const std::uint64_t seed = FrameSeed(options_.seed, frame);
  if (options_.stereo) {
    CameraPose right_pose = result.world_from_camera;
    right_pose.translation += right_pose.rotation * Eigen::Vector3d(options_.baseline, 0.0, 0.0);
    RenderedView right = RenderView(patch, deformed, right_pose, true);
    const Eigen::Vector3d lamp(0.5 * options_.baseline, 0.0, 0.0);
    AddHighlights(patch.triangles, camera_, lamp, &left);
    AddHighlights(patch.triangles, camera_, -lamp, &right);
    AddPictureNoise(options_.picture_noise, seed, &left.color);
    AddPictureNoise(options_.picture_noise, seed + 1, &right.color);
    result.right = std::move(right.color);
  }
  result.color = std::move(left.color);
  result.depth = std::move(left.raster.depth);
  if (!options_.stereo) AddDepthNoise(noise, seed, left.cosines, &result.depth);
  for (std::size_t k = 0; k < result.mask.pixels().size(); ++k) {
    if (result.mask.pixels()[k] == 0) result.depth.pixels()[k] = 0.0F;
  }
  return result;
}

}  // namespace ceres_ed
