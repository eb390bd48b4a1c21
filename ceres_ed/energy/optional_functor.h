// Functors that are optional.
#ifndef CERES_ED_ENERGY_OPTIONAL_FUNCTOR_H_
#define CERES_ED_ENERGY_OPTIONAL_FUNCTOR_H_

#include <optional>
#include <utility>

namespace ceres_ed {

// Calls visit(functor) if there is a functor. A function that makes functors may return an
// std::optional to leave some out.
template <typename Functor, typename Visit>
void VisitFunctor(Functor functor, const Visit& visit) {
  visit(std::move(functor));
}
template <typename Functor, typename Visit>
void VisitFunctor(std::optional<Functor> functor, const Visit& visit) {
  if (functor.has_value()) visit(*std::move(functor));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_OPTIONAL_FUNCTOR_H_
