#include "ceres_ed/simulation/sequences.h"

#include <ceres_ed/simulation/rendering.h>

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
// Of the view's length that the camera moves along a strip in a frame.
constexpr double kStripStep = 0.05;
constexpr double kMaxStripStep = 0.3;

// How long the strip is, in views, and how many frames its camera takes.
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
  const auto shape = SyntheticShapeFromName(SyntheticSceneName(options.kind));
  CHECK(shape.has_value()) << SyntheticSceneName(options.kind);
  return MakeOrganScene(*shape, vertices, frames(60), options.period);
}

// Numbers for the noise of each frame that have nothing in common (the finalizer of SplitMix64).
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

const std::vector<SyntheticSceneKind>& AllSyntheticSceneKinds() {
  static const std::vector<SyntheticSceneKind> kinds = {SyntheticSceneKind::kStrip,
                                                        SyntheticSceneKind::kHeart,
                                                        SyntheticSceneKind::kKidney,
                                                        SyntheticSceneKind::kStomach,
                                                        SyntheticSceneKind::kPlane};
  return kinds;
}

const char* SyntheticSceneName(SyntheticSceneKind kind) {
  switch (kind) {
    case SyntheticSceneKind::kStrip:
      return "strip";
    case SyntheticSceneKind::kHeart:
      return "heart";
    case SyntheticSceneKind::kKidney:
      return "kidney";
    case SyntheticSceneKind::kStomach:
      return "stomach";
    case SyntheticSceneKind::kPlane:
      return "plane";
  }
  LOG(FATAL) << "scene " << static_cast<int>(kind);
  return "";
}

std::optional<SyntheticSceneKind> SyntheticSceneFromName(const std::string& name) {
  for (const SyntheticSceneKind kind : AllSyntheticSceneKinds()) {
    if (name == SyntheticSceneName(kind)) return kind;
  }
  return std::nullopt;
}

bool SyntheticSequenceOptions::IsValid(std::string* error) const {
  std::ostringstream message;
  const bool is_strip = kind == SyntheticSceneKind::kStrip;
  if (frames < 0 || frames > kMaxFrames) {
    message << "frames is " << frames << ", expected 1 to " << kMaxFrames
            << " (0: the scene's usual number)";
  } else if (!is_strip && nodes_hint != 0) {
    message << "nodes_hint is " << nodes_hint << ", but " << SyntheticSceneName(kind)
            << " has a length of its own, expected it with strip only";
  } else if (nodes_hint != 0 && (nodes_hint < kNodesInView || nodes_hint > kMaxFrames)) {
    message << "nodes_hint is " << nodes_hint << ", expected " << kNodesInView << " (one view) to "
            << kMaxFrames;
  } else if (is_strip && vertices != 0) {
    message << "vertices is " << vertices << ", but a strip has one every 1.5 mm, expected 0";
  } else if (vertices != 0 && (vertices < kMinVertices || vertices > kMaxVertices)) {
    message << "vertices is " << vertices << ", expected " << kMinVertices << " to "
            << kMaxVertices;
  } else if (std::min(width, height) < 16 || std::max(width, height) > 8192) {
    message << "the picture is " << width << " x " << height << ", expected 16 to 8192 pixels";
  } else if (!std::isfinite(noise) || noise < 0.0) {
    message << "noise is " << noise << ", expected metres >= 0";
  } else if (!std::isfinite(period) || period < 2.0) {
    message << "period is " << period << ", expected frames >= 2";
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

SyntheticFrame SyntheticSequence::Render(int frame, bool with_color) const {
  CHECK(frame >= 0 && frame < num_frames()) << "frame " << frame;
  SyntheticFrame result;
  result.world_from_camera = scene_->WorldFromCamera(frame);
  result.mask = scene_->Mask(frame);
  const PointCloud patch = scene_->RestPatch(frame);
  std::vector<Eigen::Vector3d> points;
  points.reserve(patch.size());
  for (const Eigen::Vector3d& rest : patch.points) {
    points.push_back(result.world_from_camera.ApplyInverse(scene_->Deform(frame, rest)));
  }
  SyntheticRaster raster = RasterizeMesh(points, patch.triangles, camera_);
  const Image<float> cosines = IncidenceCosines(
      raster, patch.triangles, AreaWeightedNormals(points, patch.triangles), camera_);
  if (with_color) {
    result.color = ShadeTissue(raster, patch.triangles, patch.points, cosines, camera_, texture_);
  }
  result.depth = std::move(raster.depth);
  AddDepthNoise(options_.noise, FrameSeed(options_.seed, frame), cosines, &result.depth);
  for (std::size_t k = 0; k < result.mask.pixels().size(); ++k) {
    if (result.mask.pixels()[k] == 0) result.depth.pixels()[k] = 0.0F;
  }
  return result;
}

}  // namespace ceres_ed
