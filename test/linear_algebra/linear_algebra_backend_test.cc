#include "ceres_ed/linear_algebra/linear_algebra_backend.h"

#include <string>
#include <utility>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

// If OpenBLAS was linked, it must serve CHOLMOD, whatever else Ceres has loaded.
TEST(LinearAlgebraBackend, OpenBlasServesWhereItIsLoaded) {
  if (OpenBlasThreads() < 0) GTEST_SKIP() << "OpenBLAS is not loaded";
  EXPECT_EQ(DescribeBackend().blas.substr(0, 8), "OpenBLAS");
}

// The files that Debian's alternatives lead to.
LinearAlgebraBackend WithBlas(const std::string& blas, const std::string& file) {
  LinearAlgebraBackend backend;
  backend.sparse_library = "SuiteSparse";
  backend.blas = blas;
  backend.blas_file = file;
  return backend;
}

const LinearAlgebraBackend kAtlas =
    WithBlas("libblas.so.3", "/usr/lib/x86_64-linux-gnu/atlas/libblas.so.3.10.3");
const LinearAlgebraBackend kReference =
    WithBlas("libblas.so.3", "/usr/lib/x86_64-linux-gnu/blas/libblas.so.3.11.0");
constexpr BackendUse kNoUse;
constexpr BackendUse kCeresUse{true};

TEST(BackendWarnings, NameASlowBlasWhereCholmodNeedsOne) {
  EXPECT_THAT(BackendWarnings(kAtlas, kCeresUse), ElementsAre(HasSubstr("ATLAS (/usr/lib")));
  EXPECT_THAT(
      BackendWarnings(WithBlas("libf77blas.so.3", "/usr/lib/libf77blas.so.3.10.3"), kCeresUse),
      ElementsAre(HasSubstr("ATLAS")));
  EXPECT_THAT(BackendWarnings(kReference, kCeresUse), ElementsAre(HasSubstr("the reference BLAS")));
}

TEST(BackendWarnings, AreSilentWhereTheBlockSolverWorksAlone) {
  for (LinearAlgebraBackend backend : {kAtlas, kReference}) {
    EXPECT_THAT(BackendWarnings(backend, kNoUse), IsEmpty());
    backend.sparse_library = "EigenSparse";
    EXPECT_THAT(BackendWarnings(backend, kNoUse), IsEmpty());
  }
}

TEST(BackendWarnings, AreSilentWithAFastBlas) {
  for (const auto& [blas, file] :
       {std::pair("OpenBLAS 0.3.21 NO_LAPACKE", "/usr/lib/libopenblasp-r0.3.21.so"),
        std::pair("OpenBLAS 0.3.21 NO_LAPACKE", "/usr/lib/openblas-pthread/libblas.so.3"),
        std::pair("libblas.so.3", "/usr/lib/x86_64-linux-gnu/blis-openmp/libblas.so.3"),
        std::pair("libmkl_rt.so", "/usr/lib/x86_64-linux-gnu/libmkl_rt.so")}) {
    EXPECT_THAT(BackendWarnings(WithBlas(blas, file), kCeresUse), IsEmpty()) << file;
  }
}

// In this case no BLAS is used, whichever is installed.
TEST(BackendWarnings, NameAMissingSuiteSparse) {
  LinearAlgebraBackend backend = kAtlas;
  backend.sparse_library = "EigenSparse";
  EXPECT_THAT(BackendWarnings(backend, kCeresUse), ElementsAre(HasSubstr("without SuiteSparse")));
}

TEST(ScopedSerialLinearAlgebra, HoldsBothOnOneThreadAndRestoresThem) {
  const int levels = OpenMpLevels();
  const int threads = OpenBlasThreads();
  {
    const ScopedSerialLinearAlgebra outer;
    { const ScopedSerialLinearAlgebra inner; }
    // The end of the inner guard must not end the effect of the outer one.
    EXPECT_EQ(OpenMpLevels(), levels < 0 ? -1 : 0);
    EXPECT_EQ(OpenBlasThreads(), threads < 0 ? -1 : 1);
  }
  EXPECT_EQ(OpenMpLevels(), levels);
  EXPECT_EQ(OpenBlasThreads(), threads);
}

}  // namespace
}  // namespace ceres_ed
