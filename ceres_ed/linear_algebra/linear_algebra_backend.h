// The linear algebra that Ceres finds at run time, and how to keep it on one thread.
#ifndef CERES_ED_LINEAR_ALGEBRA_LINEAR_ALGEBRA_BACKEND_H_
#define CERES_ED_LINEAR_ALGEBRA_LINEAR_ALGEBRA_BACKEND_H_

#include <string>
#include <vector>

#include <ceres/types.h>

namespace ceres_ed {

// What the running process solves with; for reports and `--version`.
struct LinearAlgebraBackend {
  // "2.1.0"
  std::string ceres_version;
  // "SuiteSparse", "EigenSparse" or "none".
  std::string sparse_library;
  // The configuration string of OpenBLAS where it serves dgemm_, else the file that does
  // ("libf77blas.so.3"), else "none".
  std::string blas;
  // That file with all links followed, empty where there is none.
  std::string blas_file;
  // What orders the matrices of the block solver (elimination_order.h): "CHOLMOD" or "Eigen".
  std::string ordering_library;
  // Vector instructions of the block solver's factorisation (front_kernels.h).
  std::string kernels;
};

// What a program asks of Ceres' libraries; the block solver brings all that it needs.
struct BackendUse {
  // SPARSE_NORMAL_CHOLESKY.
  bool ceres = false;
};

// Returns a sentence on each thing that makes `use` slow, and what to do about it: no SuiteSparse,
// or ATLAS or the reference BLAS behind it.
std::vector<std::string> BackendWarnings(const LinearAlgebraBackend& backend,
                                         const BackendUse& use);

// Returns the backend of this process, asked of the loaded libraries and not of the build.
LinearAlgebraBackend DescribeBackend();

// Returns SUITE_SPARSE where Ceres was built with it, else EIGEN_SPARSE, else NO_SPARSE.
ceres::SparseLinearAlgebraLibraryType PreferredSparseLibrary();

// Keeps CHOLMOD's OpenMP loops of the calling thread, and OpenBLAS, on one thread while it lives.
// Debian's CHOLMOD starts four OpenMP threads a supernode whatever the machine has, and on few
// cores they cost more than the factorisation itself. Ceres' own threads are not touched.
//
// Guards may nest and may live in several threads at once: the last one to go restores OpenBLAS.
// Destroy a guard in the thread that made it. Where OpenMP or OpenBLAS is not loaded there is
// nothing to do and nothing happens.
class ScopedSerialLinearAlgebra {
 public:
  ScopedSerialLinearAlgebra();
  ~ScopedSerialLinearAlgebra();
  ScopedSerialLinearAlgebra(const ScopedSerialLinearAlgebra&) = delete;
  ScopedSerialLinearAlgebra& operator=(const ScopedSerialLinearAlgebra&) = delete;

 private:
  int saved_active_levels_ = -1;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_LINEAR_ALGEBRA_BACKEND_H_
