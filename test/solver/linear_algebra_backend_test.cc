#include "ceres_ed/solver/linear_algebra_backend.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

int OpenMpLevels() {
  const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
  return get == nullptr ? -1 : get();
}

int OpenBlasThreads() {
  const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  return get == nullptr ? -1 : get();
}

TEST(LinearAlgebraBackend, NamesALibraryThatCeresHas) {
  const LinearAlgebraBackend backend = DescribeBackend();
  EXPECT_EQ(backend.ceres_version.substr(0, 2), "2.");
  EXPECT_TRUE(ceres::IsSparseLinearAlgebraLibraryTypeAvailable(PreferredSparseLibrary()));
  EXPECT_EQ(backend.sparse_library == "SuiteSparse",
            ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE));
}

// Where OpenBLAS was linked it must serve CHOLMOD, whatever else Ceres has loaded.
TEST(LinearAlgebraBackend, OpenBlasServesWhereItIsLoaded) {
  if (OpenBlasThreads() < 0) GTEST_SKIP() << "OpenBLAS is not loaded";
  EXPECT_EQ(DescribeBackend().blas.substr(0, 8), "OpenBLAS");
}

TEST(ScopedSerialLinearAlgebra, HoldsBothOnOneThreadAndRestoresThem) {
  const int levels = OpenMpLevels();
  const int threads = OpenBlasThreads();
  {
    const ScopedSerialLinearAlgebra outer;
    { const ScopedSerialLinearAlgebra inner; }
    // The end of the inner guard must not end the outer one.
    EXPECT_EQ(OpenMpLevels(), levels < 0 ? -1 : 0);
    EXPECT_EQ(OpenBlasThreads(), threads < 0 ? -1 : 1);
  }
  EXPECT_EQ(OpenMpLevels(), levels);
  EXPECT_EQ(OpenBlasThreads(), threads);
}

}  // namespace
}  // namespace ceres_ed
