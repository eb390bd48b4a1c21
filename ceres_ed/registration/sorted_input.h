// The clouds of a fit in an order that suits the memory.
#ifndef CERES_ED_REGISTRATION_SORTED_INPUT_H_
#define CERES_ED_REGISTRATION_SORTED_INPUT_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/registration/fit_types.h>

#include <vector>

namespace ceres_ed {

// Returns whether a fit takes the points of a cloud in their SpatialOrder(): a fit of a million
// points in random order takes more than twice as long as one of the same points along a curve. It
// does so with all large clouds, so that the order of a file does not matter to the result. An
// additional energy may know points by their indices; then the order stays.
bool IsSorted(const PointCloud& cloud, const FitOptions& options);

// The input of a fit, with those clouds sorted that IsSorted() names.
class SortedInput {
 public:
  SortedInput(const FitInput& input, const FitOptions& options);

  const FitInput& input() const { return input_; }

  // Brings all that `result` has by points of the source into the order of the given source.
  void PutBack(FitResult* result) const;

 private:
  FitInput input_;
  // The index in the given source of each point of the sorted one; empty if it is not sorted.
  std::vector<int> order_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_SORTED_INPUT_H_
