#include "ceres_ed/linear_algebra/linear_algebra_backend.h"

#include <ceres_ed/linear_algebra/front_kernels.h>

#include <climits>
#include <cstdlib>
#include <mutex>
#include <string>

#include <ceres/version.h>
#include <dlfcn.h>
#include <link.h>

#ifdef CERES_ED_HAVE_OPENBLAS
extern "C" char* openblas_get_config();
#endif

namespace ceres_ed {
namespace {

// Returns a function of a library that may or may not be loaded, or null if it is not. Searching at
// run time keeps OpenMP and OpenBLAS optional.
template <typename Function>
Function* FindLoaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

#ifdef CERES_ED_HAVE_OPENBLAS
// A linker with --as-needed would drop a library to which nothing refers, and CHOLMOD would then
// use ATLAS.
[[gnu::used]] char* (*const kKeepOpenBlasLinked)() = &openblas_get_config;
#endif

// An address, and the path of the shared object that contains it.
struct ObjectSearch {
  ElfW(Addr) address = 0;
  std::string file;
};

int FindObject(dl_phdr_info* object, std::size_t /*size*/, void* data) {
  auto* search = static_cast<ObjectSearch*>(data);
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    const ElfW(Addr) begin = object->dlpi_addr + segment.p_vaddr;
    if (segment.p_type != PT_LOAD || search->address < begin) continue;
    if (search->address - begin >= segment.p_memsz) continue;
    search->file = object->dlpi_name;
    return 1;
  }
  return 0;
}

// Returns the path of the shared object that contains `address`, or an empty string if there is
// none. dladdr() would also look for the symbol, among all of a large library, which takes longer
// than the rest of --version; it knows the name of the program itself.
std::string FileOf(const void* address) {
  if (address == nullptr) return "";
  ObjectSearch search;
  search.address = reinterpret_cast<ElfW(Addr)>(address);
  if (dl_iterate_phdr(&FindObject, &search) != 0 && !search.file.empty()) return search.file;
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return "";
  return info.dli_fname;
}

// dlsym() searches in the same global order in which dgemm_ was bound for CHOLMOD, so both find the
// same function.
std::string BlasFile() { return FileOf(dlsym(RTLD_DEFAULT, "dgemm_")); }

std::string DescribeBlas() {
  const std::string file = BlasFile();
  if (file.empty()) return "none";
  const auto config = FindLoaded<char*()>("openblas_get_config");
  if (FileOf(reinterpret_cast<const void*>(config)) == file) return config();
  return file.substr(file.find_last_of('/') + 1);
}

// Debian's alternatives system gives every BLAS the same name; the end of the chain of links shows
// which BLAS it is.
std::string FollowLinks(const std::string& file) {
  char path[PATH_MAX];
  return realpath(file.c_str(), path) != nullptr ? path : file;
}

// Returns "ATLAS" or "the reference BLAS", or an empty string for any other BLAS.
std::string SlowBlas(const LinearAlgebraBackend& backend) {
  const std::string& file = backend.blas_file;
  const auto has = [&file](const char* part) { return file.find(part) != std::string::npos; };
  if (has("atlas") || has("f77blas")) return "ATLAS";
  // OpenBLAS can also have this file name; its configuration string identifies it.
  const bool is_openblas = has("openblas") || backend.blas.rfind("OpenBLAS", 0) == 0;
  const bool is_other = has("/blis") || has("mkl");
  return has("/libblas.so") && !is_openblas && !is_other ? "the reference BLAS" : "";
}

// The thread count of OpenBLAS belongs to the process, so the guards of all threads share one
// counter.
class OpenBlasThreads {
 public:
  static OpenBlasThreads& Get() {
    static OpenBlasThreads threads;
    return threads;
  }

  void EnterSerial() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (guards_++ > 0 || set_ == nullptr || get_ == nullptr) return;
    saved_ = get_();
    set_(1);
  }

  void LeaveSerial() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--guards_ > 0 || set_ == nullptr || get_ == nullptr) return;
    set_(saved_);
  }

 private:
  int (*const get_)() = FindLoaded<int()>("openblas_get_num_threads");
  void (*const set_)(int) = FindLoaded<void(int)>("openblas_set_num_threads");
  std::mutex mutex_;
  int guards_ = 0;
  int saved_ = 1;
};

}  // namespace

LinearAlgebraBackend DescribeBackend() {
  LinearAlgebraBackend backend;
  backend.ceres_version = CERES_VERSION_STRING;
  switch (PreferredSparseLibrary()) {
    case ceres::SUITE_SPARSE:
      backend.sparse_library = "SuiteSparse";
      break;
    case ceres::EIGEN_SPARSE:
      backend.sparse_library = "EigenSparse";
      break;
    default:
      backend.sparse_library = "none";
  }
  backend.blas = DescribeBlas();
  backend.blas_file = FollowLinks(BlasFile());
#ifdef CERES_ED_HAVE_CHOLMOD
  backend.ordering_library = "CHOLMOD";
#else
  backend.ordering_library = "Eigen";
#endif
  backend.kernels = FrontKernelName();
  return backend;
}

std::vector<std::string> BackendWarnings(const LinearAlgebraBackend& backend,
                                         const BackendUse& use) {
  const bool ceres_asks_blas = use.ceres && backend.sparse_library == "SuiteSparse";
  std::vector<std::string> warnings;
  if (use.ceres && !ceres_asks_blas) {
    warnings.push_back("Ceres was built without SuiteSparse and factorises slowly: use the block " +
                       std::string("solver, or a Ceres with SuiteSparse"));
  }
  const std::string slow = SlowBlas(backend);
  if (!slow.empty() && ceres_asks_blas) {
    warnings.push_back(slow + " (" + backend.blas_file + ") serves CHOLMOD, slower than OpenBLAS " +
                       "would: install libopenblas-dev and build again");
  }
  return warnings;
}

ceres::SparseLinearAlgebraLibraryType PreferredSparseLibrary() {
  for (const auto type : {ceres::SUITE_SPARSE, ceres::EIGEN_SPARSE}) {
    if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(type)) return type;
  }
  return ceres::NO_SPARSE;
}

ScopedSerialLinearAlgebra::ScopedSerialLinearAlgebra() {
  OpenBlasThreads::Get().EnterSerial();
  // CHOLMOD requests a fixed number of threads in the pragma itself, which omp_set_num_threads()
  // does not override. If no active level is allowed, every parallel region runs on the calling
  // thread.
  const auto get = FindLoaded<int()>("omp_get_max_active_levels");
  const auto set = FindLoaded<void(int)>("omp_set_max_active_levels");
  if (get == nullptr || set == nullptr) return;
  saved_active_levels_ = get();
  set(0);
}

ScopedSerialLinearAlgebra::~ScopedSerialLinearAlgebra() {
  if (saved_active_levels_ >= 0) {
    FindLoaded<void(int)>("omp_set_max_active_levels")(saved_active_levels_);
  }
  OpenBlasThreads::Get().LeaveSerial();
}

}  // namespace ceres_ed
