// The inverse fields of fits of the pairs in data/.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/apply/field_run.h>
#include <ceres_ed/registration/fit.h>

#include <string>

#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

PointCloud Load(const std::string& path) {
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  EXPECT_TRUE(loaded.ok()) << loaded.status().message();
  return loaded->cloud;
}

class Listener : public FieldObserver {
 public:
  void OnField(const WrittenField& written) override { written_ = written; }
  const WrittenField& written() const { return written_; }

 private:
  WrittenField written_;
};

TEST(InverseField, LeavesLittleResidualOnEachShippedPair) {
  const TemporaryDirectory directory;
  FieldSettings settings;
  settings.inverse = true;
  settings.field = directory / "inverse.mha";
  for (const std::string name :
       {"plane_bumps", "dolphin_bend", "heart_partial", "kidney_partial", "stomach_partial"}) {
    const std::string folder = CERES_ED_SOURCE_DIR "/data/" + name;
    const PointCloud source = Load(folder + "/source.ply");
    const StatusOr<FitResult> fit = Fit(source, Load(folder + "/target.ply"));
    ASSERT_TRUE(fit.ok()) << fit.status().message();
    Listener listener;
    const Outcome outcome = RunField(settings, name, fit->warp, &source, &listener);
    ASSERT_TRUE(outcome.done()) << outcome.message;
    const WrittenField& written = listener.written();
    EXPECT_LE(written.inverse.mean_residual, 0.05) << name;
    // What has no inverse lies away from the surface.
    EXPECT_EQ(written.error.num_points, source.size()) << name;
    EXPECT_LE(written.error.mean, 0.1) << name;
  }
}

}  // namespace
}  // namespace ceres_ed
