// Residuals stored in arrays.
//
// A ceres::CostFunction is an object on the heap with a vector of block sizes. Residuals that are
// created by the ten thousand in every round are stored without such objects. They are turned into
// cost functions only if a ceres::Problem is built.
#ifndef CERES_ED_ENERGY_RESIDUAL_STORE_H_
#define CERES_ED_ENERGY_RESIDUAL_STORE_H_

#include <ceres_ed/energy/energy.h>

#include <memory>

#include <ceres/cost_function.h>

namespace ceres_ed {

// Residuals of one form, numbered in the order in which they were added. The blocks that each of
// them uses are known to the owner of the store.
class ResidualStore {
 public:
  // The forms for which the block solver has its own products.
  enum class Form { kPoint, kEdge, kRotation };

  virtual ~ResidualStore() = default;
  ResidualStore(const ResidualStore&) = delete;
  ResidualStore& operator=(const ResidualStore&) = delete;

  Form form() const { return form_; }
  int size() const { return size_; }
  // The number of values of each residual; it is the same for all.
  int num_residuals() const { return num_residuals_; }

  // Removes all residuals but keeps their memory.
  virtual void Clear() { size_ = 0; }

  // Returns residual `index`, on `blocks`, as a cost function.
  virtual std::unique_ptr<ceres::CostFunction> MakeCost(int index,
                                                        const BlockRef* blocks,
                                                        const DeformationGraph& graph) const = 0;

  // Writes num_residuals() numbers: the residual `index` at `state`. Returns false if it can't be
  // evaluated.
  virtual bool Evaluate(int index,
                        const BlockRef* blocks,
                        const DeformationGraph& graph,
                        const DeformationState& state,
                        double* residuals) const = 0;

 protected:
  ResidualStore(Form form, int num_residuals) : form_(form), num_residuals_(num_residuals) {}

  // For a store whose residuals get their number of values later than the store is made.
  void SetNumResiduals(int num_residuals) { num_residuals_ = num_residuals; }

  // Must be called once for each residual that is added.
  void CountOne() { ++size_; }

 private:
  Form form_;
  int num_residuals_;
  int size_ = 0;
};

// Returns a new store of the given type.
template <typename Store>
std::unique_ptr<ResidualStore> MakeStore() {
  return std::make_unique<Store>();
}

// Returns the store of the given type in `sink`, or null if the sink takes only cost functions. The
// type is identified by the address of MakeStore<Store>, which differs between shared objects even
// if they have types of the same name.
template <typename Store>
Store* FindStore(ResidualSink* sink) {
  return static_cast<Store*>(sink->FindStore(&MakeStore<Store>));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_RESIDUAL_STORE_H_
