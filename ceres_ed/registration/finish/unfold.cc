#include "ceres_ed/registration/finish/unfold.h"

#include <ceres_ed/linear_algebra/sparse_cholesky.h>
#include <ceres_ed/registration/finish/folded_faces.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The numbers of rings around a fold that are tried, one after the other.
constexpr int kRings[] = {1, 2, 3, 4, 5};
// The weights of the attraction of a vertex to the target, relative to its edges. Without the
// target, folds open more easily.
constexpr double kPulls[] = {0.5, 0.1, 0.0};
// The largest patch with attraction; larger ones are not worth their time.
constexpr int kMaxPulledRings = 4;
// Vertices that were farther from the target than this are not attracted; in edges.
constexpr double kMaxDistance = 1.0;
// The smallest cosine between the normal that the vertex should have and the target's normal.
constexpr double kMinCosine = 0.3;
constexpr int kIterations = 10;
// The number of rounds: remaining folds are treated again from their new positions.
constexpr int kRounds = 3;
// The weight that holds a vertex at its present position, relative to its edges. It determines the
// position of a patch that is a whole component.
constexpr double kHold = 1e-6;

using Points = std::vector<Eigen::Vector3d>;

// One unfolding: the data that its patches share.
class Unfolder {
 public:
  Unfolder(const UnfoldInput& input, Points* points)
      : mesh_(*input.mesh),
        rest_(*input.rest),
        target_(input.target),
        should_stop_(input.should_stop),
        finder_(mesh_, rest_),
        is_held_(rest_.size(), 0),
        index_(rest_.size(), -1),
        on_target_(rest_.size(), -1),
        points_(*points) {
    for (const int v : input.held) is_held_[v] = 1;
  }

  UnfoldResult Run();

 private:
  struct Best {
    // The change of the number of folded faces, <= 0.
    int change = 0;
    std::vector<int> vertices;
    Points points;
  };
  // Relaxes the patch, stores the best result and restores the patch. Returns the number of folds
  // after the last attempt.
  int TryPatch(double pull, Best* best);
  // Unfolds one group. Returns the change of the number of folded faces, <= 0.
  int UnfoldGroup(const std::vector<int>& faces);

  // The functions below treat one patch: its vertices and the data of a solve.
  void SetPatch(const std::vector<int>& vertices);
  void FindPulled(const Points& start);
  void Factorize(double pull);
  void SpreadRotations();
  void FindRotations();
  // Returns the point that attracts vertex `i` of the patch.
  Eigen::Vector3d Pull(int i);
  void SolvePoints(const Points& start, double pull);
  void Relax(const Points& start, double pull, bool spread);

  const WeldedMesh& mesh_;
  const Points& rest_;
  // Null if nothing attracts the vertices.
  const Surface* target_;
  const std::function<bool()>& should_stop_;
  FoldFinder finder_;
  Points rest_normals_;
  double max_distance_ = 0.0;
  std::vector<char> is_held_;
  // The place of each vertex in the patch, where free vertices come first, then their neighbours;
  // -1 for others.
  std::vector<int> index_;
  std::vector<int> patch_;
  int num_free_ = 0;
  std::vector<char> is_pulled_;
  // The last place on the target that was closest to a vertex (SurfaceHit::place); -1 if it is not
  // known.
  std::vector<int> on_target_;
  std::vector<Eigen::Matrix3d> rotations_;
  std::unique_ptr<SparseCholesky> factor_;
  Points& points_;
};

void Unfolder::SetPatch(const std::vector<int>& vertices) {
  for (const int v : patch_) index_[v] = -1;
  patch_.clear();
  const auto add = [this](int v) {
    if (index_[v] < 0) {
      index_[v] = static_cast<int>(patch_.size());
      patch_.push_back(v);
    }
  };
  for (const int v : vertices) {
    if (is_held_[v] == 0) add(v);
  }
  num_free_ = static_cast<int>(patch_.size());
  for (int i = 0; i < num_free_; ++i) finder_.ForNeighbors(patch_[i], add);
  rotations_.resize(patch_.size());
}

void Unfolder::FindPulled(const Points& start) {
  is_pulled_.assign(num_free_, 0);
  if (target_ == nullptr) return;
  for (int i = 0; i < num_free_; ++i) {
    int& on_target = on_target_[patch_[i]];
    const SurfaceHit hit = target_->index().Closest(start[i], max_distance_, on_target);
    is_pulled_[i] = hit.squared_distance < max_distance_ * max_distance_ ? 1 : 0;
    if (hit.found()) on_target = hit.place();
  }
}

void Unfolder::Factorize(double pull) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < num_free_; ++i) {
    double degree = 0.0;
    finder_.ForNeighbors(patch_[i], [&](int to) {
      degree += 1.0;
      const int j = index_[to];
      if (j > i && j < num_free_) entries.emplace_back(j, i, -1.0);
    });
    entries.emplace_back(i, i, (1.0 + kHold + pull * is_pulled_[i]) * degree);
  }
  SparseCholesky::Matrix matrix(num_free_, num_free_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_ = std::make_unique<SparseCholesky>(matrix);
  CHECK(factor_->Factorize(matrix)) << "the Laplacian of a graph and a positive diagonal";
}

void Unfolder::FindRotations() {
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    rotations_[i] = finder_.Rotation(patch_[i], points_);
  }
}

void Unfolder::SpreadRotations() {
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(num_free_, 9);
  for (int i = 0; i < num_free_; ++i) {
    double degree = 0.0;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    finder_.ForNeighbors(patch_[i], [&](int to) {
      degree += 1.0;
      if (index_[to] >= num_free_) sum += rotations_[index_[to]];
    });
    sum += kHold * degree * rotations_[i];
    rhs.row(i) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(sum.data());
  }
  const Eigen::MatrixXd spread = factor_->Solve(rhs);
  for (int i = 0; i < num_free_; ++i) {
    const Eigen::Matrix<double, 1, 9> row = spread.row(i);
    rotations_[i] = NearestRotation(Eigen::Map<const Eigen::Matrix3d>(row.data()));
  }
}

Eigen::Vector3d Unfolder::Pull(int i) {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const int v = patch_[i];
  const SurfaceHit hit = target_->index().Closest(points_[v], kAnywhere, on_target_[v]);
  on_target_[v] = hit.place();
  const bool is_alike = (rotations_[i] * rest_normals_[v]).dot(target_->NormalAt(hit)) > kMinCosine;
  return is_alike ? hit.position : points_[v];
}

void Unfolder::SolvePoints(const Points& start, double pull) {
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(num_free_, 3);
  for (int i = 0; i < num_free_; ++i) {
    const int v = patch_[i];
    double degree = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    finder_.ForNeighbors(v, [&](int to) {
      const int j = index_[to];
      degree += 1.0;
      sum += 0.5 * ((rotations_[i] + rotations_[j]) * (rest_[v] - rest_[to]));
      if (j >= num_free_) sum += points_[to];
    });
    if (pull > 0.0 && is_pulled_[i] != 0) sum += pull * degree * Pull(i);
    rhs.row(i) = sum + kHold * degree * start[i];
  }
  const Eigen::MatrixXd solved = factor_->Solve(rhs);
  for (int i = 0; i < num_free_; ++i) points_[patch_[i]] = solved.row(i);
}

// Alternates between the rotations and the positions (Sorkine and Alexa 2007).
void Unfolder::Relax(const Points& start, double pull, bool spread) {
  for (int i = 0; i < num_free_; ++i) points_[patch_[i]] = start[i];
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    FindRotations();
    if (spread && iteration == 0) SpreadRotations();
    SolvePoints(start, pull);
  }
}

int Unfolder::TryPatch(double pull, Best* best) {
  // A vertex that moves changes the rotations of its neighbours.
  const std::vector<int> around = finder_.FacesAround(patch_);
  const int before = static_cast<int>(finder_.Find(around, points_).size());
  Points start;
  for (int i = 0; i < num_free_; ++i) start.push_back(points_[patch_[i]]);
  FindPulled(start);
  Factorize(pull);
  int left = before;
  for (const bool spread : {false, true}) {
    Relax(start, pull, spread);
    left = static_cast<int>(finder_.Find(around, points_).size());
    if (left - before < best->change) {
      best->change = left - before;
      best->vertices.assign(patch_.begin(), patch_.begin() + num_free_);
      best->points.clear();
      for (const int v : best->vertices) best->points.push_back(points_[v]);
    }
    if (left == 0) break;
  }
  for (int i = 0; i < num_free_; ++i) points_[patch_[i]] = start[i];
  return left;
}

int Unfolder::UnfoldGroup(const std::vector<int>& faces) {
  Best best;
  const auto try_all = [&] {
    for (const double pull : kPulls) {
      if (pull > 0.0 && target_ == nullptr) continue;
      for (const int rings : kRings) {
        if (pull > 0.0 && rings > kMaxPulledRings) continue;
        SetPatch(finder_.Grow(faces, rings));
        if (num_free_ > 0 && TryPatch(pull, &best) == 0) return;
      }
    }
  };
  try_all();
  for (std::size_t i = 0; i < best.vertices.size(); ++i) {
    points_[best.vertices[i]] = best.points[i];
  }
  return best.change;
}

UnfoldResult Unfolder::Run() {
  UnfoldResult result;
  std::vector<int> folded = finder_.FindAll(points_);
  result.before = static_cast<int>(folded.size());
  result.after = result.before;
  if (folded.empty()) return result;
  rest_normals_ = WeldedNormals(mesh_, rest_);
  double edges = 0.0;
  for (const auto& [a, b] : mesh_.edges) edges += (rest_[a] - rest_[b]).norm();
  max_distance_ = kMaxDistance * edges / static_cast<double>(mesh_.edges.size());
  for (int round = 0; round < kRounds; ++round) {
    int change = 0;
    for (const std::vector<int>& group : finder_.Groups(folded, kRings[0])) {
      if (should_stop_ && should_stop_()) break;
      change += UnfoldGroup(group);
    }
    result.after += change;
    if (change == 0 || result.after == 0) break;
    folded = finder_.FindAll(points_);
  }
  return result;
}

}  // namespace

UnfoldResult UnfoldFaces(const UnfoldInput& input, std::vector<Eigen::Vector3d>* points) {
  CHECK_EQ(static_cast<int>(input.rest->size()), input.mesh->num_vertices());
  CHECK_EQ(points->size(), input.rest->size());
  return Unfolder(input, points).Run();
}

}  // namespace ceres_ed
