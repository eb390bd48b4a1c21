#include "ceres_ed/registration/evidence/measure_evidence.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A sheet of 1.4 x 1 with a grid of `columns` x `rows` quads, those with column < `kept`, and what
// `place` makes of its points.
PointCloud Sheet(int columns,
                 int rows,
                 int kept,
                 const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place) {
  PointCloud cloud;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= kept; ++column) {
      cloud.points.push_back(place({1.4 * column / columns, double(row) / rows, 0.0}));
    }
  }
  const int stride = kept + 1;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < kept; ++column) {
      const int at = row * stride + column;
      cloud.triangles.push_back({at, at + 1, at + stride});
      cloud.triangles.push_back({at + 1, at + stride + 1, at + stride});
    }
  }
  return cloud;
}

// A sheet with a hill and a valley, so that nothing slides.
Eigen::Vector3d Hilly(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), 0.25 * std::sin(4.0 * p.x()) * std::cos(3.0 * p.y())};
}

FitEvidence EvidenceOf(const PointCloud& source, const PointCloud& target) {
  const StatusOr<FitResult> fit = Fit(source, target);
  EXPECT_TRUE(fit.ok()) << fit.status().message();
  return fit.ok() ? fit->evidence : FitEvidence();
}

TEST(MeasureEvidence, OfEqualSurfacesIsWithoutAFault) {
  const FitEvidence evidence = EvidenceOf(Sheet(40, 30, 40, Hilly), Sheet(34, 26, 34, Hilly));
  EXPECT_TRUE(evidence.measured);
  EXPECT_GT(evidence.source.matched, 0.99);
  EXPECT_GT(evidence.target.matched, 0.99);
  EXPECT_EQ(evidence.source.Unmatched(), 0.0);
  EXPECT_LT(evidence.residual, 1e-3);
  EXPECT_LT(evidence.edge_stretch, 0.2);
  EXPECT_LT(evidence.bend, 5e-3);
  EXPECT_EQ(evidence.folded, 0.0);
}

TEST(MeasureEvidence, CountsWhatThePartialTargetDoesNotShowAsUnseen) {
  const FitEvidence evidence = EvidenceOf(Sheet(40, 30, 40, Hilly), Sheet(40, 26, 20, Hilly));
  EXPECT_NEAR(evidence.source.unseen, 0.5, 0.05);
  EXPECT_LT(evidence.source.Unmatched(), 0.02);
  EXPECT_GT(evidence.target.matched, 0.98);
}

TEST(MeasureEvidence, FindsWhatOneSurfaceHasAndTheOtherOneLacks) {
  // A spike of a fifth of the sheet that no smooth source reaches with an open fit that may not
  // move: the graph is too stiff.
  PointCloud target = Sheet(40, 30, 40, [](const Eigen::Vector3d& p) {
    Eigen::Vector3d q = Hilly(p);
    if (p.x() < 0.28) q.z() += 0.5;
    return q;
  });
  FitInput input;
  input.source = Sheet(40, 30, 40, Hilly);
  input.target = target;
  FitOptions options;
  options.finish = false;
  options.weights.rotation = 1e6;
  options.weights.regularization = 1e6;
  const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(fit.ok());
  EXPECT_GT(fit->evidence.target.missed, 0.1);
}

TEST(MeasureEvidence, ReliefTellsAPlaneFromABodyWithEdges) {
  const auto flat = [](const Eigen::Vector3d& p) { return p; };
  const FitEvidence plane = EvidenceOf(Sheet(40, 30, 40, flat), Sheet(34, 26, 34, flat));
  EXPECT_LT(plane.relief, 1e-6);
  EXPECT_LT(plane.rigid_curvature, 1e-3);
  const FitEvidence hilly = EvidenceOf(Sheet(40, 30, 40, Hilly), Sheet(34, 26, 34, Hilly));
  EXPECT_GT(hilly.relief, 0.01);
  EXPECT_GT(hilly.rigid_curvature, 0.005);
}

TEST(MeasureEvidence, DoesNotDependOnTheUnit) {
  const auto scaled = [](double scale) {
    return [scale](const Eigen::Vector3d& p) { return Eigen::Vector3d(scale * Hilly(p)); };
  };
  const FitEvidence one = EvidenceOf(Sheet(40, 30, 40, Hilly), Sheet(34, 26, 30, scaled(1.0)));
  const FitEvidence other =
      EvidenceOf(Sheet(40, 30, 40, scaled(1024.0)), Sheet(34, 26, 30, scaled(1024.0)));
  EXPECT_NEAR(one.source.matched, other.source.matched, 1e-6);
  EXPECT_NEAR(one.residual, other.residual, 1e-9);
  EXPECT_NEAR(one.edge_stretch, other.edge_stretch, 1e-9);
  EXPECT_NEAR(one.relief, other.relief, 1e-9);
}

}  // namespace
}  // namespace ceres_ed
