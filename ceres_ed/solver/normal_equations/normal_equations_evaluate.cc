// The part of NormalEquations that evaluates all residuals.
#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/util/describe_throw.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {

double* NormalEquations::Values(int slot, const Sums& sums) const {
  const auto num_values = static_cast<std::ptrdiff_t>(structure_->num_values());
  const std::ptrdiff_t target = slots_[slot].target;
  return target < num_values ? sums.values + target : sums.shared + (target - num_values);
}

double* NormalEquations::Gradient(int slot, const Sums& sums) const {
  const auto num_values = static_cast<std::ptrdiff_t>(structure_->num_values());
  const std::ptrdiff_t target = slots_[slot].target;
  const int block = slots_[slot].row;
  if (target < num_values) return sums.gradient + structure_->row_offset(block);
  return sums.shared + (target - num_values) + structure_->size(block) * structure_->size(block);
}

bool NormalEquations::AddTask(const Task& task,
                              const DeformationState& state,
                              const Sums& sums,
                              double* cost) const {
  for (const int i : task.rotations) {
    if (!AddRotation(rotations_[i], state, sums, cost)) return false;
  }
  for (const int i : task.edges) {
    if (!AddEdge(edges_[i], state, sums, cost)) return false;
  }
  return AddGroups(task, state, sums, cost) && AddItems(task, state, sums, cost);
}

void NormalEquations::AddShares(const Sums& sums) const {
  for (const Share& share : shares_) {
    const double* from = sums.shared + share.place;
    const int size = structure_->size(share.row) * structure_->size(share.column);
    if (sums.values != nullptr) {
      double* to = sums.values + structure_->value_offset(share.entry);
      for (int i = 0; i < size; ++i) to[i] += from[i];
    }
    if (share.row != share.column) continue;
    double* to = sums.gradient + structure_->row_offset(share.row);
    for (int i = 0; i < structure_->size(share.row); ++i) to[i] += from[size + i];
  }
}

// The tasks, and the order in which their sums are added, do not depend on the number of threads.
// The result therefore has the same bits at any number of threads.
bool NormalEquations::EvaluateTasks(const DeformationState& state,
                                    int num_threads,
                                    double* cost,
                                    std::vector<double>* values,
                                    Eigen::VectorXd* gradient) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  Sums sums;
  if (values != nullptr) {
    if (values->capacity() < structure_->num_values()) {
      values->clear();
      values->reserve(structure_->num_values());
      WishForLargePages(values->data(), structure_->num_values() * sizeof(double));
    }
    values->assign(structure_->num_values(), 0.0);
    sums.values = values->data();
    SetDualDiagonals(sums.values);
  }
  if (gradient != nullptr) {
    gradient->setZero(structure_->num_rows());
    shared_.assign(shared_size_, 0.0);
    sums.gradient = gradient->data();
    sums.shared = shared_.data();
  }
  // Functions are user code, too, and may throw.
  bool batches_valid = false;
  const std::string thrown = DescribeThrow([&] { batches_valid = batches_.Evaluate(state); });
  if (!batches_valid || !thrown.empty()) return false;
  const int num_tasks = static_cast<int>(tasks_.size());
  std::vector<double> costs(num_tasks, 0.0);
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, num_tasks, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      bool valid = false;
      // Functors are user code and may throw; ProblemBuilder::CheckResiduals() determines which one
      // threw.
      const std::string thrown =
          DescribeThrow([&] { valid = AddTask(tasks_[t], state, sums, &costs[t]); });
      if (!valid || !thrown.empty()) ok = false;
    }
  });
  if (!ok) return false;
  *cost = 0.0;
  for (const double task_cost : costs) *cost += task_cost;
  if (gradient != nullptr) AddShares(sums);
  return true;
}

bool NormalEquations::Evaluate(const DeformationState& state,
                               int num_threads,
                               double* cost,
                               std::vector<double>* values,
                               Eigen::VectorXd* gradient) const {
  return EvaluateTasks(state, num_threads, cost, values, gradient);
}

bool NormalEquations::EvaluateGradient(const DeformationState& state,
                                       int num_threads,
                                       double* cost,
                                       Eigen::VectorXd* gradient) const {
  return EvaluateTasks(state, num_threads, cost, nullptr, gradient);
}

bool NormalEquations::EvaluateCost(const DeformationState& state,
                                   int num_threads,
                                   double* cost) const {
  return EvaluateTasks(state, num_threads, cost, nullptr, nullptr);
}

}  // namespace ceres_ed
