// Binds the options of a tracker, which have the names of the flags of ed_slam.
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/slam/slam.h>

namespace ceres_ed::python {

void BindTrackerOptions(py::module_& module) {
  const OptionsClass<SlamOptions> options(
      module, "TrackerOptions", R"(The options of a tracker. Lengths are in metres.

Each option is an attribute, and a keyword of this class and of Tracker. It has the name of the
flag of ed_slam.)");
}

}  // namespace ceres_ed::python
