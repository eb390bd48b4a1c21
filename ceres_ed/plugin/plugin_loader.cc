#include "ceres_ed/plugin/plugin_loader.h"

#include <ceres_ed/plugin/plugin_abi.h>
#include <ceres_ed/util/text.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

using AbiFunction = const char*();
using RegisterFunction = void(EnergyRegistry*, Status*);

constexpr char kAbiName[] = CERES_ED_STRINGIFY(CERES_ED_PLUGIN_ABI_SYMBOL);
constexpr char kRegisterName[] = CERES_ED_STRINGIFY(CERES_ED_PLUGIN_REGISTER_SYMBOL);

Status Error(const std::string& path, const std::string& what) {
  return Status::Error("plugin '" + path + "': " + what);
}

template <typename Function>
Function* Find(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

// Returns "Eigen 3.3.9 (here Eigen 3.4.0), ..." with every field that differs.
std::string DescribeDifference(const std::string& theirs, const std::string& ours) {
  const std::vector<std::string_view> there = SplitLines(theirs, ';');
  const std::vector<std::string_view> here = SplitLines(ours, ';');
  if (there.size() != here.size()) return "'" + theirs + "' (here '" + ours + "')";
  std::string text;
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (there[i] == here[i]) continue;
    text +=
        (text.empty() ? "" : ", ") + std::string(there[i]) + " (here " + std::string(here[i]) + ")";
  }
  return text;
}

Status MissingSymbol(const std::string& path, const char* name) {
  return Error(
      path,
      std::string("exports no ") + name + ", expected a shared object with CERES_ED_PLUGIN(...)");
}

// Checks the versions and calls the register function of an open plugin.
Status RegisterFrom(void* library, const std::string& path, EnergyRegistry* registry) {
  const auto abi = Find<AbiFunction>(library, kAbiName);
  if (abi == nullptr) return MissingSymbol(path, kAbiName);
  if (std::strcmp(abi(), CERES_ED_PLUGIN_ABI) != 0) {
    return Error(path,
                 "was built against " + DescribeDifference(abi(), CERES_ED_PLUGIN_ABI) +
                     ", expected the versions of this program");
  }
  const auto register_energies = Find<RegisterFunction>(library, kRegisterName);
  if (register_energies == nullptr) return MissingSymbol(path, kRegisterName);
  Status status = Status::Ok();
  registry->SetOrigin("plugin '" + path + "'");
  try {
    register_energies(registry, &status);
  } catch (const std::exception& error) {
    status = Status::Error(std::string("registering its energies threw: ") + error.what());
  } catch (...) {
    status = Status::Error("registering its energies threw something that is no std::exception");
  }
  registry->SetOrigin("");
  return status.ok() ? status : Error(path, status.message());
}

}  // namespace

Status LoadPlugin(const std::string& path, EnergyRegistry* registry) {
  CHECK(registry != nullptr);
  if (!std::ifstream(path))
    return Error(path, "cannot be read: " + std::generic_category().message(errno));
  // dlopen searches for a name without a slash in the system's folders only.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    // The text is that of the calling thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
    return Error(path, std::string("cannot be loaded: ") + dlerror());
  }
  // The library is never closed, not even after an error, since some of its energies may have been
  // registered by then.
  return RegisterFrom(library, path, registry);
}

Status LoadPlugins(const std::string& paths, EnergyRegistry* registry) {
  for (const std::string_view path : SplitLines(paths, ';')) {
    if (path.empty()) continue;
    if (Status status = LoadPlugin(std::string(path), registry); !status.ok()) return status;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
