// A small fit made by hand, of which everything is known.
#ifndef CERES_ED_TEST_REPORT_SMALL_FIT_H_
#define CERES_ED_TEST_REPORT_SMALL_FIT_H_

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/report/view/fit_view.h>

#include <cmath>
#include <vector>

#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>

namespace ceres_ed {

// A square of side 1 in the plane z = 0 with `side` x `side` points.
inline PointCloud SquareCloud(int side) {
  PointCloud cloud;
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      cloud.points.emplace_back(double(u) / (side - 1), double(v) / (side - 1), 0.0);
      if (u == 0 || v == 0) continue;
      const int at = v * side + u;
      cloud.triangles.push_back({at - side - 1, at - side, at});
      cloud.triangles.push_back({at - side - 1, at, at - 1});
    }
  }
  return cloud;
}

struct SmallFit {
  PointCloud source;
  PointCloud target;
  std::vector<Eigen::Vector3d> result;
  std::vector<Eigen::Vector3d> truth;
  Warp warp;
  Skinning skinning;
  std::vector<char> point_relevant;

  FitParts Parts() const {
    FitParts parts;
    parts.source = &source;
    parts.target = &target;
    parts.result = &result;
    parts.triangles = &source.triangles;
    parts.truth = &truth;
    parts.warp = &warp;
    parts.skinning = &skinning;
    parts.point_relevant = &point_relevant;
    return parts;
  }
};

// A square with five nodes that turn, stretch and move differently, a placement that turns, scales
// and moves, and a finish. The target is the result, 0.01 higher; the truth is the result, 0.02 to
// the right.
inline SmallFit MakeSmallFit() {
  SmallFit fit;
  fit.source = SquareCloud(12);
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.0, 0.0, 0.0),
                                    Eigen::Vector3d(1.0, 0.0, 0.0),
                                    Eigen::Vector3d(0.0, 1.0, 0.0),
                                    Eigen::Vector3d(1.0, 1.0, 0.0),
                                    Eigen::Vector3d(0.5, 0.5, 0.0)}) {
    fit.warp.graph.AddNode(at);
  }
  for (int j = 0; j < 4; ++j) fit.warp.graph.AddEdge({j, 4, 1.0});
  fit.warp.graph.AddEdge({4, 0, 1.0});
  fit.warp.state.Resize(5);
  for (int j = 0; j < 5; ++j) {
    const Eigen::AngleAxisd turn(0.2 * j - 0.3, Eigen::Vector3d(0.3, 1.0, 0.1 * j).normalized());
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
    stretch(0, 0) = 1.0 + 0.05 * j;
    stretch(0, 1) = stretch(1, 0) = 0.02 * j;
    MutableNodeAffine(fit.warp.state.node(j)) = turn.toRotationMatrix() * stretch;
    MutableNodeTranslation(fit.warp.state.node(j)) = Eigen::Vector3d(0.02 * j, -0.01, 0.05 * j);
  }
  fit.warp.target_from_source.scale = 1.3;
  fit.warp.target_from_source.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.2, 0.3, 1.0).normalized());
  fit.warp.target_from_source.translation = Eigen::Vector3d(0.3, -0.2, 0.5);
  fit.warp.binding.distance = DistanceRule::kEuclidean;
  fit.warp.finish.points = fit.source.points;
  for (const Eigen::Vector3d& point : fit.source.points) {
    fit.warp.finish.displacements.emplace_back(0.0, 0.0, 0.02 * std::sin(5.0 * point.x()));
  }
  const auto skinning = BindCloudToGraph(fit.source, fit.warp.graph, fit.warp.binding);
  EXPECT_TRUE(skinning.ok()) << skinning.status().message();
  fit.skinning = *skinning;
  PointCloud fitted = fit.source;
  const Status applied = ApplyWarp(fit.warp, fit.skinning, &fitted);
  EXPECT_TRUE(applied.ok()) << applied.message();
  fit.result = fitted.points;
  fit.target = fitted;
  for (Eigen::Vector3d& point : fit.target.points) point.z() += 0.01;
  fit.truth = fit.result;
  for (Eigen::Vector3d& point : fit.truth) point.x() += 0.02;
  fit.point_relevant = {1, 0, 1, 0, 1};
  return fit;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_REPORT_SMALL_FIT_H_
