// Residuals kept in arrays.
//
// A ceres::CostFunction is an object on the heap with a vector of block sizes; residuals that come
// by the ten thousand, anew in every round, are kept without them. Cost functions are made of them
// where a ceres::Problem is built.
#ifndef CERES_ED_ENERGY_RESIDUAL_STORE_H_
#define CERES_ED_ENERGY_RESIDUAL_STORE_H_

#include <ceres_ed/energy/energy.h>

#include <memory>

#include <ceres/cost_function.h>

namespace ceres_ed {

// Residuals of one form, numbered in the order in which they were added. Which blocks each touches
// is known to whoever holds the store.
class ResidualStore {
 public:
  // Forms that the block solver has products of its own for.
  enum class Form { kPoint, kEdge, kRotation };

  virtual ~ResidualStore() = default;
  ResidualStore(const ResidualStore&) = delete;
  ResidualStore& operator=(const ResidualStore&) = delete;

  Form form() const { return form_; }
  int size() const { return size_; }
  // Of each, the same for all.
  int num_residuals() const { return num_residuals_; }

  // Takes all residuals out and keeps their memory.
  virtual void Clear() { size_ = 0; }

  // Residual `index`, on `blocks`, as a cost function.
  virtual std::unique_ptr<ceres::CostFunction> MakeCost(int index,
                                                        const BlockRef* blocks,
                                                        const DeformationGraph& graph) const = 0;

  // num_residuals() numbers at `state`; false where they can't be evaluated.
  virtual bool Evaluate(int index,
                        const BlockRef* blocks,
                        const DeformationGraph& graph,
                        const DeformationState& state,
                        double* residuals) const = 0;

 protected:
  ResidualStore(Form form, int num_residuals) : form_(form), num_residuals_(num_residuals) {}

  // To be called once a residual.
  void CountOne() { ++size_; }

 private:
  Form form_;
  int num_residuals_;
  int size_ = 0;
};

template <typename Store>
std::unique_ptr<ResidualStore> MakeStore() {
  return std::make_unique<Store>();
}

// The store of a type that `sink` has; null where it takes cost functions alone. Its address tells
// a factory from that of another shared object's type of the same name.
template <typename Store>
Store* FindStore(ResidualSink* sink) {
  return static_cast<Store*>(sink->FindStore(&MakeStore<Store>));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_RESIDUAL_STORE_H_
