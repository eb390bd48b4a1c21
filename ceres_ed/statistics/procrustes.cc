#include "ceres_ed/statistics/procrustes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

using Points = Eigen::Matrix3Xd;

// The mean stands still when it moves by less than this share of its size.
constexpr double kTolerance = 1e-11;
constexpr int kMaxRounds = 100;

Eigen::Map<const Points> AsPoints(const Eigen::VectorXd& shape) {
  return {shape.data(), 3, shape.size() / 3};
}

// Returns the rotation that takes `from` to `to` best; both are centred.
Eigen::Matrix3d BestRotation(const Points& from, const Points& to) {
  return Eigen::umeyama(from, to, /*with_scaling=*/false).topLeftCorner<3, 3>();
}

// Computes the alignment; see AlignShapes().
class Aligner {
 public:
  Aligner(const ShapeTable& table, Alignment alignment) : table_(table), alignment_(alignment) {}

  Status Run();
  AlignedShapes InFrame(const Eigen::VectorXd& frame) const;

 private:
  // Reads row `i` into shape_: centred, and of unit size unless the size is kept. Stores its
  // centroid and its size.
  Status ReadCentred(int i);
  // Rotates all shapes to mean_ and returns their mean.
  StatusOr<Points> Pass();

  const ShapeTable& table_;
  const Alignment alignment_;
  Eigen::VectorXd row_;
  Points shape_;
  Points mean_;
  int rounds_ = 0;
  std::vector<Eigen::Vector3d> centroids_;
  std::vector<double> sizes_;
  std::vector<Eigen::Matrix3d> rotations_;
};

Status Aligner::ReadCentred(int i) {
  Status status = table_.Read(i, 0, table_.num_values(), row_.data());
  if (!status.ok()) return status;
  shape_ = AsPoints(row_);
  centroids_[i] = shape_.rowwise().mean();
  shape_.colwise() -= centroids_[i];
  sizes_[i] = shape_.norm();
  if (!std::isfinite(sizes_[i]) || !(sizes_[i] > 0.0)) {
    return Status::Error("shape " + std::to_string(i) +
                         ": its vertices are one point, or not finite; expected a surface");
  }
  if (alignment_ == Alignment::kSimilarity) shape_ /= sizes_[i];
  return Status::Ok();
}

StatusOr<Points> Aligner::Pass() {
  Points sum = Points::Zero(3, table_.num_vertices());
  for (int i = 0; i < table_.num_shapes(); ++i) {
    if (Status status = ReadCentred(i); !status.ok()) return status;
    rotations_[i] = BestRotation(shape_, mean_);
    sum += rotations_[i] * shape_;
  }
  sum /= table_.num_shapes();
  if (alignment_ == Alignment::kSimilarity && sum.norm() > 0.0) sum /= sum.norm();
  ++rounds_;
  return sum;
}

Status Aligner::Run() {
  row_.resize(table_.num_values());
  centroids_.resize(table_.num_shapes());
  sizes_.resize(table_.num_shapes());
  rotations_.resize(table_.num_shapes());
  if (Status status = ReadCentred(0); !status.ok()) return status;
  mean_ = shape_;
  double change = 1.0;
  while (change > kTolerance && rounds_ < kMaxRounds) {
    StatusOr<Points> next = Pass();
    if (!next.ok()) return next.status();
    change = (*next - mean_).norm() / std::max(mean_.norm(), 1e-300);
    mean_ = *std::move(next);
  }
  return Status::Ok();
}

AlignedShapes Aligner::InFrame(const Eigen::VectorXd& frame) const {
  double mean_size = 0.0;
  for (const double size : sizes_) mean_size += size / static_cast<double>(sizes_.size());
  const Points to = AsPoints(frame);
  const Eigen::Vector3d centre = to.rowwise().mean();
  const Eigen::Matrix3d turn = BestRotation(mean_, to.colwise() - centre);
  AlignedShapes aligned;
  aligned.rounds = rounds_;
  for (int i = 0; i < table_.num_shapes(); ++i) {
    Similarity transform;
    if (alignment_ == Alignment::kSimilarity) transform.scale = mean_size / sizes_[i];
    transform.rotation = Eigen::Quaterniond(turn * rotations_[i]).normalized();
    transform.translation = centre - transform.scale * (transform.rotation * centroids_[i]);
    aligned.transforms.push_back(transform);
  }
  return aligned;
}

}  // namespace

StatusOr<AlignedShapes> AlignShapes(const ShapeTable& table,
                                    Alignment alignment,
                                    const Eigen::VectorXd& frame) {
  if (alignment == Alignment::kNone || table.num_shapes() == 0) {
    return AlignedShapes{std::vector<Similarity>(table.num_shapes()), 0};
  }
  Aligner aligner(table, alignment);
  if (Status status = aligner.Run(); !status.ok()) return status;
  return aligner.InFrame(frame);
}

Eigen::VectorXd TransformShape(const Similarity& transform, const Eigen::VectorXd& shape) {
  const Points moved =
      (transform.scale * (transform.rotation.toRotationMatrix() * AsPoints(shape))).colwise() +
      transform.translation;
  return Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
}

}  // namespace ceres_ed
