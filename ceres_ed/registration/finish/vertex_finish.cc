#include "ceres_ed/registration/finish/vertex_finish.h"

#include <ceres_ed/geometry/noise_estimate.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/registration/finish/finish_matching.h>
#include <ceres_ed/registration/finish/finish_system.h>
#include <ceres_ed/registration/finish/fold_guard.h>
#include <ceres_ed/registration/finish/own_energies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The smoothing per ratio of noise to signal.
constexpr double kSmoothingPerNoise = 3.0;
// The number of edges of an inner vertex of a regular mesh, which converts the smoothing to edges.
constexpr double kUsualDegree = 6.0;
// Weights of constraints. All pairs of one vertex together have a weight of about 1 at most.
constexpr double kLandmarkWeight = 1e3;
constexpr double kFixedWeight = 1e6;

// Roughness, in edges of the source, up to which it counts as shape; more than this is noise of the
// source.
constexpr double kShapeRoughness = 0.06;
// A factor on the variance of the shape's roughness, because a part of a shape may be rougher than
// the whole.
constexpr double kRoughnessMargin = 1.5;

// One finish: the data that its rounds share.
class Finisher {
 public:
  Finisher(const FinishInput& input, const FinishOptions& options)
      : input_(input),
        options_(options),
        mesh_(BuildWeldedMesh(input.source->cloud(), input.source->topology())),
        start_(AtVertices(*input.points)),
        normals_(AtVertices(*input.normals)),
        points_(start_),
        displacements_(Eigen::MatrixXd::Zero(mesh_.num_vertices(), 3)) {}

  FinishResult Run();

 private:
  std::vector<Eigen::Vector3d> AtVertices(const std::vector<Eigen::Vector3d>& values) const;
  // Returns the smoothing that the noise requires.
  double Smoothing(const FinishMatcher& matcher) const;
  void PrepareSmoothness();
  // Sets the weights of the system to those of `pairs`. Returns false if this was stopped.
  bool SetUp(const std::vector<FinishPair>& pairs);
  // Returns whether the finish was stopped, now or before.
  bool Stopped() {
    stopped_ = stopped_ || (input_.should_stop && input_.should_stop());
    return stopped_;
  }
  void Report(int round, double part) const {
    if (input_.on_progress) input_.on_progress((round + part) / options_.rounds);
  }
  // Returns half the gradient of the objective.
  Eigen::MatrixXd Gradient(const std::vector<FinishPair>& pairs) const;
  // Returns false if this was stopped.
  bool Step(const std::vector<FinishPair>& pairs);
  void Conclude(const std::vector<FinishPair>& pairs);

  const FinishInput& input_;
  const FinishOptions& options_;
  const WeldedMesh mesh_;
  const std::vector<Eigen::Vector3d> start_;
  const std::vector<Eigen::Vector3d> normals_;
  std::vector<Eigen::Vector3d> points_;
  Eigen::MatrixXd displacements_;
  // lambda B, and the system with it.
  SparseCholesky::Matrix smoothness_;
  std::unique_ptr<FinishSystem> system_;
  std::unique_ptr<OwnEnergies> own_;
  // The diagonal of the system that is not smoothness.
  Eigen::VectorXd weights_;
  double epsilon_ = 0.0;
  bool stopped_ = false;
  FinishResult result_;
};

std::vector<Eigen::Vector3d> Finisher::AtVertices(
    const std::vector<Eigen::Vector3d>& values) const {
  CHECK_EQ(values.size(), mesh_.vertex_of_point.size());
  std::vector<Eigen::Vector3d> picked;
  picked.reserve(mesh_.point_of_vertex.size());
  for (const int point : mesh_.point_of_vertex) picked.push_back(values[point]);
  return picked;
}

double Finisher::Smoothing(const FinishMatcher& matcher) const {
  if (input_.noise <= 0.0) return options_.smoothing;
  const double signal_squared =
      std::pow(matcher.robust_plane_distance(), 2) - input_.noise * input_.noise;
  if (signal_squared <= 0.0) return std::numeric_limits<double>::infinity();
  return std::max(options_.smoothing,
                  kSmoothingPerNoise * input_.noise / std::sqrt(signal_squared));
}

void Finisher::PrepareSmoothness() {
  const double lambda = std::pow(result_.smoothing, 4) / kUsualDegree;
  epsilon_ = std::pow(result_.smoothing / options_.fade, 4);
  smoothness_ = SquaredLaplacian(mesh_);
  smoothness_ *= lambda;
  if (Stopped()) return;
  system_ = std::make_unique<FinishSystem>(smoothness_, [this] { return Stopped(); });
}

bool Finisher::SetUp(const std::vector<FinishPair>& pairs) {
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(mesh_.num_vertices(), epsilon_);
  // For a blend b, |sum_i b_i x_i|^2 <= sum_i b_i |x_i|^2; the diagonal matrix therefore majorises.
  for (const FinishPair& pair : pairs) {
    for (int k = 0; k < 3; ++k) weights[pair.vertices[k]] += pair.weight * pair.blend[k];
  }
  for (const Correspondence& landmark : input_.landmarks) {
    weights[mesh_.vertex_of_point[landmark.point]] += kLandmarkWeight;
  }
  for (const Correspondence& fixed : input_.fixed) {
    weights[mesh_.vertex_of_point[fixed.point]] += kFixedWeight;
  }
  weights_ = std::move(weights);
  // With energies of the user, each step sets the system up anew.
  return own_ != nullptr || system_->SetWeights(weights_);
}

Eigen::MatrixXd Finisher::Gradient(const std::vector<FinishPair>& pairs) const {
  Eigen::MatrixXd gradient = epsilon_ * displacements_;
  gradient += smoothness_.selfadjointView<Eigen::Lower>() * displacements_;
  const double share = options_.point_to_point_share;
  for (const FinishPair& pair : pairs) {
    Eigen::Vector3d gap = -pair.target;
    for (int k = 0; k < 3; ++k) gap += pair.blend[k] * points_[pair.vertices[k]];
    const Eigen::Vector3d pull =
        pair.weight * ((1.0 - share) * pair.normal.dot(gap) * pair.normal + share * gap);
    for (int k = 0; k < 3; ++k) gradient.row(pair.vertices[k]) += pair.blend[k] * pull;
  }
  for (const Correspondence& landmark : input_.landmarks) {
    const int v = mesh_.vertex_of_point[landmark.point];
    gradient.row(v) += kLandmarkWeight * (points_[v] - landmark.target);
  }
  return gradient;
}

bool Finisher::Step(const std::vector<FinishPair>& pairs) {
  Eigen::MatrixXd gradient = Gradient(pairs);
  if (own_ != nullptr && !system_->SetWeights(weights_ + own_->Add(points_, &gradient))) {
    return false;
  }
  Eigen::MatrixXd step;
  if (!system_->Solve(gradient, &step)) return false;
  displacements_ -= step;
  for (const Correspondence& fixed : input_.fixed) {
    displacements_.row(mesh_.vertex_of_point[fixed.point]).setZero();
  }
  for (int v = 0; v < mesh_.num_vertices(); ++v) {
    points_[v] = start_[v] + displacements_.row(v).transpose();
  }
  return true;
}

void Finisher::Conclude(const std::vector<FinishPair>& pairs) {
  DampFolds(mesh_, start_, normals_, &points_);
  result_.moved = true;
  result_.pairs = static_cast<int>(pairs.size());
  double sum_plane = 0.0;
  double sum_point = 0.0;
  for (const FinishPair& pair : pairs) {
    Eigen::Vector3d gap = -pair.target;
    for (int k = 0; k < 3; ++k) gap += pair.blend[k] * points_[pair.vertices[k]];
    sum_plane += std::pow(pair.normal.dot(gap), 2);
    sum_point += gap.squaredNorm();
  }
  if (pairs.empty()) return;
  result_.rms_plane = std::sqrt(sum_plane / result_.pairs);
  result_.rms_point = std::sqrt(sum_point / result_.pairs);
}

FinishResult Finisher::Run() {
  result_.points = *input_.points;
  FinishMatcher matcher(*input_.source, mesh_, normals_, *input_.target, input_.matching);
  for (int round = 0; round < options_.rounds; ++round) {
    const std::vector<FinishPair> pairs =
        matcher.Match(points_, options_.loss_width, [this] { return Stopped(); });
    if (stopped_) return std::move(result_);
    if (round == 0) {
      result_.smoothing = Smoothing(matcher);
      if (pairs.empty() || result_.smoothing > options_.max_smoothing) return std::move(result_);
      if (Stopped()) return std::move(result_);
      PrepareSmoothness();
      if (input_.fit != nullptr) own_ = OwnEnergies::Create(*input_.fit, mesh_);
    }
    Report(round, 0.3);
    if (Stopped() || !SetUp(pairs)) return std::move(result_);
    Report(round, 0.6);
    // What the last step of all moves may meet an energy of the user for the first time.
    const bool is_last = round + 1 == options_.rounds;
    const int steps = options_.steps + (is_last && own_ != nullptr ? 1 : 0);
    for (int step = 0; step < steps; ++step) {
      if (!Step(pairs)) return std::move(result_);
      Report(round, 0.6 + 0.4 * (step + 1) / steps);
    }
    if (Stopped()) return std::move(result_);
    if (is_last) Conclude(pairs);
  }
  for (std::size_t p = 0; p < result_.points.size(); ++p) {
    result_.points[p] = points_[mesh_.vertex_of_point[p]];
  }
  return std::move(result_);
}

}  // namespace

double FinishNoise(const Surface& source, const Surface& target) {
  const double of_source = EstimateNoise(source.cloud().points, source.topology());
  const double of_target = EstimateNoise(target.cloud().points, target.topology());
  const double shape = std::min(of_source, kShapeRoughness * MeanEdgeLength(source.topology()));
  return std::sqrt(std::max(0.0, of_target * of_target - kRoughnessMargin * shape * shape));
}

FinishResult FinishVertices(const FinishInput& input, const FinishOptions& options) {
  return Finisher(input, options).Run();
}

}  // namespace ceres_ed
