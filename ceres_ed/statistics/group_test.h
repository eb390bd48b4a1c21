// Whether groups of shapes differ, vertex by vertex.
#ifndef CERES_ED_STATISTICS_GROUP_TEST_H_
#define CERES_ED_STATISTICS_GROUP_TEST_H_

#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/status.h>

#include <cstdint>
#include <vector>

namespace ceres_ed {

struct GroupTestOptions {
  int permutations = 1000;
  std::uint64_t seed = 1;
};

// One value for each vertex.
struct GroupTest {
  // The largest distance of the means of two groups, in the unit of the table.
  std::vector<double> difference;
  // F = (B / (G - 1)) / (W / (N - G)): the spread between the groups against that within them, sums
  // of squared distances.
  std::vector<double> statistic;
  // The probability of such an F if the groups do not matter: the share of random assignments of
  // the shapes to the groups with at least that F, (1 + number) / (1 + permutations).
  std::vector<double> p;
  // The probability that any vertex has such an F: the share of assignments whose largest F of all
  // vertices is at least that (Westfall and Young 1993; Nichols and Holmes 2002). Where it is below
  // 0.05, the whole map has an error of the first kind with 5 %.
  std::vector<double> p_corrected;
};

// Tests whether the shapes of `table` differ by group. groups[i] in [0, G) is the group of shape i,
// G >= 2, and each group has at least one shape. There must be more shapes than groups: otherwise
// the error says so. Other errors are those of the table.
StatusOr<GroupTest> TestGroups(const ShapeTable& table,
                               const std::vector<int>& groups,
                               const GroupTestOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_GROUP_TEST_H_
