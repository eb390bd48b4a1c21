// The functions that a shared object exports to add energies to a program (`--plugin=LIB.so`).
//
//   ceres_ed::Status RegisterMine(ceres_ed::EnergyRegistry* registry) {
//     return registry->Register(MyInfo(), MakeMyTerm);
//   }
//   CERES_ED_PLUGIN(RegisterMine)
//
// Build it with ceres_ed_add_plugin(NAME SOURCE ...), which find_package(ceres_ed) provides.
#ifndef CERES_ED_PLUGIN_PLUGIN_ABI_H_
#define CERES_ED_PLUGIN_PLUGIN_ABI_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/util/status.h>
#include <ceres_ed/version.h>

#include <Eigen/Core>
#include <ceres/version.h>

#define CERES_ED_STRINGIFY_EXPANDED(x) #x
#define CERES_ED_STRINGIFY(x) CERES_ED_STRINGIFY_EXPANDED(x)

// Everything in which two binaries must agree to exchange C++ objects: fields "name value"
// separated by ";". It is a literal and not a function, since the dynamic linker may give a plugin
// the program's copy of an inline function. The check would then compare the program with itself.
// clang-format off
#define CERES_ED_PLUGIN_ABI                                                     \
  "ceres_ed " CERES_ED_VERSION_STRING                                           \
  ";Ceres " CERES_VERSION_STRING                                                \
  ";Eigen " CERES_ED_STRINGIFY(EIGEN_WORLD_VERSION)                             \
      "." CERES_ED_STRINGIFY(EIGEN_MAJOR_VERSION)                               \
      "." CERES_ED_STRINGIFY(EIGEN_MINOR_VERSION)                               \
  ";EIGEN_MAX_ALIGN_BYTES " CERES_ED_STRINGIFY(EIGEN_MAX_ALIGN_BYTES)           \
  ";pointer_bytes " CERES_ED_STRINGIFY(__SIZEOF_POINTER__)
// clang-format on

// The names of the two exported functions. Their C++ types are `const char*()` and
// `void(ceres_ed::EnergyRegistry*, ceres_ed::Status*)`.
#define CERES_ED_PLUGIN_ABI_SYMBOL ceres_ed_plugin_abi
#define CERES_ED_PLUGIN_REGISTER_SYMBOL ceres_ed_plugin_register

// Defines both functions. `register_function` is a Status(EnergyRegistry*). Use it once in a shared
// object, in a .cc file, outside of any namespace.
#define CERES_ED_PLUGIN(register_function)                                                     \
  extern "C" __attribute__((visibility("default"))) const char* CERES_ED_PLUGIN_ABI_SYMBOL() { \
    return CERES_ED_PLUGIN_ABI;                                                                \
  }                                                                                            \
  extern "C" __attribute__((visibility("default"))) void CERES_ED_PLUGIN_REGISTER_SYMBOL(      \
      ceres_ed::EnergyRegistry* registry, ceres_ed::Status* status) {                          \
    *status = register_function(registry);                                                     \
  }

#endif  // CERES_ED_PLUGIN_PLUGIN_ABI_H_
