// How NormalEquations goes through its residuals.
#include <ceres_ed/solver/normal_equations.h>
#include <ceres_ed/util/parallel.h>

#include <atomic>
#include <cstddef>

#include <glog/logging.h>

namespace ceres_ed {

bool NormalEquations::EvaluateSerial(const DeformationState& state,
                                     double* cost,
                                     std::vector<double>* values,
                                     Eigen::VectorXd* gradient) const {
  Scratch scratch(*this);
  double* linearization = gradient != nullptr ? scratch.linearization.data() : nullptr;
  double* sums = values != nullptr ? values->data() : nullptr;
  const BlockRange all{0, structure_->num_blocks()};
  for (const Item& item : items_) {
    double item_cost = 0.0;
    if (!EvaluateItem(item, state, linearization, &scratch, &item_cost)) return false;
    *cost += item_cost;
    if (gradient != nullptr) Accumulate(item, linearization, all, sums, gradient->data());
  }
  return true;
}

// All residuals first, then the sums, each block by one thread in the order of the residuals: the
// same bits as EvaluateSerial at any number of threads.
bool NormalEquations::EvaluateParallel(const DeformationState& state,
                                       int num_threads,
                                       double* cost,
                                       std::vector<double>* values,
                                       Eigen::VectorXd* gradient) const {
  const int num_items = static_cast<int>(items_.size());
  std::vector<std::size_t> offsets(num_items + 1, 0);
  for (int i = 0; i < num_items && gradient != nullptr; ++i) {
    offsets[i + 1] = offsets[i] + items_[i].LinearizationSize();
  }
  std::vector<double> linearizations(offsets.back());
  std::vector<double> costs(num_items);
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, num_items, [&](int begin, int end) {
    Scratch scratch(*this);
    for (int i = begin; i < end; ++i) {
      double* linearization = gradient != nullptr ? &linearizations[offsets[i]] : nullptr;
      if (!EvaluateItem(items_[i], state, linearization, &scratch, &costs[i])) {
        ok = false;
        return;
      }
    }
  });
  if (!ok) return false;
  for (const double item_cost : costs) *cost += item_cost;
  if (gradient == nullptr) return true;
  double* sums = values != nullptr ? values->data() : nullptr;
  ParallelFor(num_threads, structure_->num_blocks(), [&](int begin, int end) {
    for (int i = 0; i < num_items; ++i) {
      Accumulate(items_[i], &linearizations[offsets[i]], {begin, end}, sums, gradient->data());
    }
  });
  return true;
}

bool NormalEquations::Evaluate(const DeformationState& state,
                               int num_threads,
                               double* cost,
                               std::vector<double>* values,
                               Eigen::VectorXd* gradient) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  *cost = 0.0;
  values->assign(structure_->num_values(), 0.0);
  gradient->setZero(structure_->num_rows());
  return num_threads > 1 ? EvaluateParallel(state, num_threads, cost, values, gradient)
                         : EvaluateSerial(state, cost, values, gradient);
}

bool NormalEquations::EvaluateGradient(const DeformationState& state,
                                       int num_threads,
                                       double* cost,
                                       Eigen::VectorXd* gradient) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  *cost = 0.0;
  gradient->setZero(structure_->num_rows());
  return num_threads > 1 ? EvaluateParallel(state, num_threads, cost, nullptr, gradient)
                         : EvaluateSerial(state, cost, nullptr, gradient);
}

bool NormalEquations::EvaluateCost(const DeformationState& state,
                                   int num_threads,
                                   double* cost) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  *cost = 0.0;
  return num_threads > 1 ? EvaluateParallel(state, num_threads, cost, nullptr, nullptr)
                         : EvaluateSerial(state, cost, nullptr, nullptr);
}

}  // namespace ceres_ed
