// Describes the linear algebra that Ceres finds at run time, and keeps it on one thread.
#ifndef CERES_ED_LINEAR_ALGEBRA_LINEAR_ALGEBRA_BACKEND_H_
#define CERES_ED_LINEAR_ALGEBRA_LINEAR_ALGEBRA_BACKEND_H_

#include <string>
#include <vector>

#include <ceres/types.h>

namespace ceres_ed {

// The libraries that the running process solves with, for reports and `--version`.
struct LinearAlgebraBackend {
  // The version of Ceres, for example "2.1.0".
  std::string ceres_version;
  // "SuiteSparse", "EigenSparse" or "none".
  std::string sparse_library;
  // The configuration string of OpenBLAS if OpenBLAS provides dgemm_, else the name of the file
  // that provides it ("libf77blas.so.3"), else "none".
  std::string blas;
  // The path of that file after all links have been followed; empty if there is none.
  std::string blas_file;
  // The library that orders the matrices of the block solver (elimination_order.h): "CHOLMOD" or
  // "Eigen".
  std::string ordering_library;
  // The vector instructions that the block solver's factorisation uses (front_kernels.h).
  std::string kernels;
};

// What a program needs from the libraries of Ceres. The block solver needs nothing from them.
struct BackendUse {
  // Whether the program solves with SPARSE_NORMAL_CHOLESKY of Ceres.
  bool ceres = false;
};

// Returns one sentence for each property of `backend` that makes `use` slow, with advice: Ceres has
// no SuiteSparse, or SuiteSparse uses ATLAS or the reference BLAS.
std::vector<std::string> BackendWarnings(const LinearAlgebraBackend& backend,
                                         const BackendUse& use);

// Returns the backend of this process. It examines the libraries that are loaded, not the options
// of the build.
LinearAlgebraBackend DescribeBackend();

// Returns SUITE_SPARSE if Ceres was built with it, else EIGEN_SPARSE, else NO_SPARSE.
ceres::SparseLinearAlgebraLibraryType PreferredSparseLibrary();

// While an object of this class exists, OpenBLAS and the OpenMP loops of CHOLMOD in the calling
// thread run on one thread. Debian's CHOLMOD starts four OpenMP threads for each supernode on any
// machine, and on few cores these threads cost more time than the factorisation itself. The threads
// of Ceres itself are not changed.
//
// Guards may be nested and may exist in several threads at once; the last guard to be destroyed
// restores OpenBLAS. Destroy a guard in the thread that created it. If OpenMP or OpenBLAS is not
// loaded, the guard does nothing.
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
