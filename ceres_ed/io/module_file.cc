#include "ceres_ed/io/module_file.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include <dlfcn.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// Returns the folder of the program or shared library that contains this code; empty if unknown.
fs::path OwnFolder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&OpenModule), &info) == 0) return {};
  std::error_code error;
  // For a program, only the name by which it was called is known.
  fs::path file = fs::path(info.dli_fname);
  if (!file.has_parent_path()) file = "/proc/self/exe";
  const fs::path own = fs::canonical(file, error);
  return error ? fs::path() : own.parent_path();
}

// Returns the files to try, in order. The last one has no folder, so that the system searches its
// own folders of libraries.
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
    // If a module exists and can't be loaded, this is the error to report.
    if (candidate.has_parent_path()) break;
  }
  // The text is that of the calling thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
  const char* const reason = dlerror();
  return Status::Error(reason != nullptr ? reason : file + ": cannot be loaded");
}

}  // namespace

StatusOr<void*> OpenModule(const std::string& file, const char* symbol) {
  const StatusOr<void*> library = Open(file);
  if (!library.ok()) return library.status();
  void* const function = dlsym(*library, symbol);
  if (function == nullptr) return Status::Error(file + " exports no " + symbol);
  return function;
}

}  // namespace ceres_ed
