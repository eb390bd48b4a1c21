#include "ceres_ed/io/mesh/mesh_module.h"

#include <ceres_ed/version.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include <dlfcn.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// The folder of the program or the shared library that has this code; empty where unknown.
fs::path OwnFolder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&LoadMeshModule), &info) == 0) return {};
  std::error_code error;
  // A program has no more than the name that it was called by.
  fs::path file = fs::path(info.dli_fname);
  if (!file.has_parent_path()) file = "/proc/self/exe";
  const fs::path own = fs::canonical(file, error);
  return error ? fs::path() : own.parent_path();
}

// Files to load, in order. The last has no folder: the system looks where it has its libraries.
std::vector<fs::path> Candidates(const std::string& file) {
  std::vector<fs::path> candidates;
  // Nothing here sets the environment. NOLINTNEXTLINE(concurrency-mt-unsafe)
  const char* const named = std::getenv("CERES_ED_MODULES");
  if (named != nullptr && *named != '\0') candidates.push_back(fs::path(named) / file);
  const fs::path own = OwnFolder();
  if (!own.empty()) {
    candidates.push_back(own / file);
    candidates.push_back(own / CERES_ED_LIB_FROM_BIN / file);
  }
  candidates.emplace_back(file);
  return candidates;
}

StatusOr<void*> Open(const std::string& file) {
  for (const fs::path& candidate : Candidates(file)) {
    std::error_code error;
    if (candidate.has_parent_path() && !fs::exists(candidate, error)) continue;
    void* const library = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) return library;
    // A module that is there and cannot be loaded is the error to tell.
    if (candidate.has_parent_path()) break;
  }
  // The text is that of the calling thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
  const char* const reason = dlerror();
  return Status::Error(reason != nullptr ? reason : file + ": cannot be loaded");
}

}  // namespace

StatusOr<const MeshModule*> LoadMeshModule(const std::string& file) {
  const StatusOr<void*> library = Open(file);
  if (!library.ok()) return library.status();
  const auto function = reinterpret_cast<MeshModuleFunction*>(dlsym(*library, kMeshModuleSymbol));
  if (function == nullptr) {
    return Status::Error(file + " exports no " + kMeshModuleSymbol);
  }
  const MeshModule* const module = function();
  if (module->version != std::string(CERES_ED_VERSION_STRING)) {
    return Status::Error(file + " belongs to ceres_ed " + module->version + ", expected " +
                         CERES_ED_VERSION_STRING);
  }
  return module;
}

}  // namespace ceres_ed
