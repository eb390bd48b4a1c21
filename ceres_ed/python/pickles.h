// Pickles: objects as bytes, for processes and copies.
#ifndef CERES_ED_PYTHON_PICKLES_H_
#define CERES_ED_PYTHON_PICKLES_H_

#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/python/graphs.h>
#include <ceres_ed/python/landmarks.h>
#include <ceres_ed/python/surfaces.h>

#include <memory>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Returns the object as bytes, from which Unpickle() makes an equal one, with the same bits. The
// types are those below.
template <typename T>
pybind11::bytes Pickle(const T& object);

// Raises a ValueError for bytes of another version of the library, and for damaged ones.
template <typename T>
std::unique_ptr<T> Unpickle(const pybind11::bytes& bytes);

// Lets objects of a class be pickled and copied (copy.copy and copy.deepcopy use pickles).
template <typename Class>
void AddPickle(Class* bound) {
  using T = typename Class::type;
  bound->def(pybind11::pickle(&Pickle<T>, &Unpickle<T>));
}

extern template pybind11::bytes Pickle(const Cloud&);
extern template pybind11::bytes Pickle(const EnergySpec&);
extern template pybind11::bytes Pickle(const FittedSurface&);
extern template pybind11::bytes Pickle(const Graph&);
extern template pybind11::bytes Pickle(const Landmarks&);
extern template pybind11::bytes Pickle(const Warp&);
extern template std::unique_ptr<Cloud> Unpickle(const pybind11::bytes&);
extern template std::unique_ptr<EnergySpec> Unpickle(const pybind11::bytes&);
extern template std::unique_ptr<FittedSurface> Unpickle(const pybind11::bytes&);
extern template std::unique_ptr<Graph> Unpickle(const pybind11::bytes&);
extern template std::unique_ptr<Landmarks> Unpickle(const pybind11::bytes&);
extern template std::unique_ptr<Warp> Unpickle(const pybind11::bytes&);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_PICKLES_H_
