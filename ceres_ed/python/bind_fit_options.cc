// Binds the options of a fit, which have the names of the flags of ed_fit.
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/registration/fit.h>

namespace ceres_ed::python {

void BindFitOptions(py::module_& module) {
  const OptionsClass<FitOptions> options(module, "FitOptions", R"(The options of a fit.

Each option is an attribute, and a keyword of this class and of fit(). It has the name of the
flag of ed_fit.)");
}

}  // namespace ceres_ed::python
