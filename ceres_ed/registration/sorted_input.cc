#include "ceres_ed/registration/sorted_input.h"

#include <ceres_ed/geometry/spatial_order.h>

#include <utility>

namespace ceres_ed {
namespace {

// Below this number of points a fit stays in the caches of processors, or nearly so.
constexpr std::size_t kLarge = 100000;

// Returns rows in the order of the given source: row i goes to place order[i].
template <typename Row>
std::vector<Row> PutBackRows(const std::vector<Row>& rows, const std::vector<int>& order) {
  if (rows.size() != order.size()) return rows;
  std::vector<Row> given(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    given[static_cast<std::size_t>(order[i])] = rows[i];
  }
  return given;
}

}  // namespace

bool IsSorted(const PointCloud& cloud, const FitOptions& options) {
  return cloud.size() >= kLarge && options.extra_energies.empty();
}

SortedInput::SortedInput(const FitInput& input, const FitOptions& options) {
  input_.landmarks = input.landmarks;
  input_.fixed_points = input.fixed_points;
  if (IsSorted(input.source, options)) {
    order_ = SpatialOrder(input.source.points);
    input_.source = Reordered(input.source, order_);
    const std::vector<int> place = InverseOrder(order_);
    for (Landmark& landmark : input_.landmarks) {
      landmark.point = place[static_cast<std::size_t>(landmark.point)];
    }
    for (int& point : input_.fixed_points) point = place[static_cast<std::size_t>(point)];
  } else {
    input_.source = input.source;
  }
  input_.target = IsSorted(input.target, options)
                      ? Reordered(input.target, SpatialOrder(input.target.points))
                      : input.target;
}

void SortedInput::PutBack(FitResult* result) const {
  if (order_.empty()) return;
  result->points = PutBackRows(result->points, order_);
  result->normals = PutBackRows(result->normals, order_);
  result->uncertainty.covariances = PutBackRows(result->uncertainty.covariances, order_);
  if (result->skinning.size() == order_.size()) {
    const std::vector<int> place = InverseOrder(order_);
    Skinning skinning(result->skinning.stride());
    for (const int i : place) {
      const Binding binding = result->skinning[static_cast<std::size_t>(i)];
      skinning.Add(binding.nodes, binding.weights, binding.size);
    }
    result->skinning = std::move(skinning);
  }
  for (Correspondence& match : result->matches.correspondences) {
    match.point = order_[static_cast<std::size_t>(match.point)];
  }
}

}  // namespace ceres_ed
