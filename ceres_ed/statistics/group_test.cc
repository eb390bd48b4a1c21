#include "ceres_ed/statistics/group_test.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ceres_ed {
namespace {

// So many assignments are multiplied with a block at once.
constexpr int kBatch = 64;

// A statistic must exceed another one by more than rounding to count as larger.
constexpr double kRounding = 1e-9;

using Labels = std::vector<std::uint8_t>;

// Shuffles (Fisher and Yates); std::shuffle is not the same on every platform.
void Shuffle(Random* random, Labels* labels) {
  for (std::size_t i = labels->size(); i > 1; --i) {
    const auto j =
        std::min(i - 1, static_cast<std::size_t>(random->Uniform() * static_cast<double>(i)));
    std::swap((*labels)[i - 1], (*labels)[j]);
  }
}

// Counts, for each vertex, how often an assignment is as good as the true one.
class Counter {
 public:
  Counter(const std::vector<int>& groups, const GroupTestOptions& options)
      : num_groups_(1 + *std::max_element(groups.begin(), groups.end())),
        num_shapes_(static_cast<int>(groups.size())) {
    Labels labels(groups.begin(), groups.end());
    sizes_.assign(num_groups_, 0.0);
    for (const int group : groups) sizes_[group] += 1.0;
    // Assignment 0 is the true one.
    assignments_.push_back(labels);
    Random random(options.seed);
    for (int p = 0; p < options.permutations; ++p) {
      Shuffle(&random, &labels);
      assignments_.push_back(labels);
    }
    largest_.assign(assignments_.size(), 0.0);
  }

  // Takes a block of whole columns, centred.
  void Take(const ShapesInMemory::Matrix& block, GroupTest* test);
  void Correct(GroupTest* test) const;

 private:
  // Returns the indicators of all groups but the last one, of the assignments [begin, end).
  Eigen::MatrixXd Indicators(int begin, int end) const;
  // Returns F of each vertex of a block from the sums of all groups but the last.
  Eigen::VectorXd Statistics(const Eigen::MatrixXd& sums, const Eigen::VectorXd& totals) const;

  const int num_groups_;
  const int num_shapes_;
  std::vector<double> sizes_;
  std::vector<Labels> assignments_;
  // The largest F of all vertices, for each assignment.
  std::vector<double> largest_;
};

Eigen::MatrixXd Counter::Indicators(int begin, int end) const {
  const int rows = num_groups_ - 1;
  Eigen::MatrixXd indicators = Eigen::MatrixXd::Zero((end - begin) * rows, num_shapes_);
  for (int a = begin; a < end; ++a) {
    for (int i = 0; i < num_shapes_; ++i) {
      const int group = assignments_[a][i];
      if (group < rows) indicators((a - begin) * rows + group, i) = 1.0;
    }
  }
  return indicators;
}

Eigen::VectorXd Counter::Statistics(const Eigen::MatrixXd& sums,
                                    const Eigen::VectorXd& totals) const {
  Eigen::VectorXd statistics(totals.size());
  const double between_degrees = num_groups_ - 1;
  const double within_degrees = num_shapes_ - num_groups_;
  for (Eigen::Index v = 0; v < totals.size(); ++v) {
    double between = 0.0;
    Eigen::RowVector3d last = Eigen::RowVector3d::Zero();
    for (int g = 0; g + 1 < num_groups_; ++g) {
      const Eigen::RowVector3d sum = sums.block<1, 3>(g, 3 * v);
      between += sum.squaredNorm() / sizes_[g];
      // The data are centred: the sums of all groups cancel.
      last -= sum;
    }
    between += last.squaredNorm() / sizes_[num_groups_ - 1];
    const double within = std::max(totals[v] - between, 1e-12 * totals[v]);
    statistics[v] = within > 0.0 ? (between / between_degrees) / (within / within_degrees) : 0.0;
  }
  return statistics;
}

void Counter::Take(const ShapesInMemory::Matrix& block, GroupTest* test) {
  const Eigen::Index vertices = block.cols() / 3;
  Eigen::VectorXd totals(vertices);
  for (Eigen::Index v = 0; v < vertices; ++v) {
    totals[v] = block.middleCols<3>(3 * v).squaredNorm();
  }
  Eigen::VectorXd observed;
  std::vector<int> as_large(vertices, 0);
  const int rows = num_groups_ - 1;
  const auto count = static_cast<int>(assignments_.size());
  for (int begin = 0; begin < count; begin += kBatch) {
    const int end = std::min(count, begin + kBatch);
    const Eigen::MatrixXd sums = Indicators(begin, end) * block;
    for (int a = begin; a < end; ++a) {
      const Eigen::VectorXd statistics =
          Statistics(sums.middleRows((a - begin) * rows, rows), totals);
      largest_[a] = std::max(largest_[a], statistics.maxCoeff());
      if (a == 0) observed = statistics;
      for (Eigen::Index v = 0; a > 0 && v < vertices; ++v) {
        if (statistics[v] >= observed[v] * (1.0 - kRounding)) ++as_large[v];
      }
    }
    if (begin > 0) continue;
    for (Eigen::Index v = 0; v < vertices; ++v) {
      Eigen::MatrixXd means(num_groups_, 3);
      means.topRows(rows) = sums.block(0, 3 * v, rows, 3);
      means.row(rows) = -means.topRows(rows).colwise().sum();
      for (int g = 0; g < num_groups_; ++g) means.row(g) /= sizes_[g];
      double difference = 0.0;
      for (int g = 1; g < num_groups_; ++g) {
        for (int h = 0; h < g; ++h) {
          difference = std::max(difference, (means.row(g) - means.row(h)).norm());
        }
      }
      test->difference.push_back(difference);
      test->statistic.push_back(observed[v]);
    }
  }
  for (const int number : as_large) test->p.push_back((1.0 + number) / count);
}

void Counter::Correct(GroupTest* test) const {
  std::vector<double> sorted(largest_.begin() + 1, largest_.end());
  std::sort(sorted.begin(), sorted.end());
  for (const double statistic : test->statistic) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), statistic * (1.0 - kRounding));
    test->p_corrected.push_back((1.0 + static_cast<double>(sorted.end() - at)) /
                                (1.0 + static_cast<double>(sorted.size())));
  }
}

}  // namespace

StatusOr<GroupTest> TestGroups(const ShapeTable& table,
                               const std::vector<int>& groups,
                               const GroupTestOptions& options) {
  constexpr int kMostGroups = 255;
  if (groups.empty() || static_cast<int>(groups.size()) != table.num_shapes()) {
    return Status::Error("there are " + std::to_string(groups.size()) + " groups of shapes for " +
                         std::to_string(table.num_shapes()) + " shapes, expected one for each");
  }
  const int count = 1 + *std::max_element(groups.begin(), groups.end());
  if (count < 2 || count > kMostGroups || count >= table.num_shapes()) {
    return Status::Error("there are " + std::to_string(count) + " groups of " +
                         std::to_string(table.num_shapes()) +
                         " shapes, expected 2 to 255 groups and fewer than shapes");
  }
  const StatusOr<Eigen::VectorXd> mean = MeanShape(table);
  if (!mean.ok()) return mean.status();
  GroupTest test;
  Counter counter(groups, options);
  Status status = ForEachColumnBlock(table, [&](int first, ShapesInMemory::Matrix* block) {
    block->rowwise() -= mean->segment(first, block->cols()).transpose();
    counter.Take(*block, &test);
    return Status::Ok();
  });
  if (!status.ok()) return status;
  counter.Correct(&test);
  return test;
}

}  // namespace ceres_ed
