// The examples of cohorts on engines, as far as these are installed.
#include <gmock/gmock.h>
#include <test/cli/ed_cohort_test_util.h>

namespace ceres_ed {
namespace {

class CohortExamplesTest : public EdCohortTest {
 protected:
  static std::string Example(const std::string& name) {
    return std::string(CERES_ED_SOURCE_DIR) + "/apps/examples/06_cohort/" + name;
  }

  // Runs a command of the shell in the folder of the test, with the programs of this build.
  ProgramResult Shell(const std::string& command) const {
    const std::string apps = std::filesystem::path(AppPath("ed_cohort")).parent_path().string();
    RunOptions options;
    options.working_directory = dir_.path();
    return RunProgramFile("/bin/sh", {"-c", "PATH=" + apps + ":$PATH; " + command}, options);
  }

  bool IsInstalled(const std::string& program) const {
    return Shell("command -v " + program).exit_code == 0;
  }

  void ExpectResultsOfOneRun(const std::string& output) const {
    ASSERT_EQ(Fit("whole").exit_code, 0);
    for (const char* const name :
         {"correspondences.npy", "mean.ply", "scores.csv", "summary.csv"}) {
      EXPECT_TRUE(Results("whole")[name] == Results(output)[name]) << name;
    }
  }
};

TEST_F(CohortExamplesTest, SnakemakeRunsShardsAndCollectsThem) {
  if (!IsInstalled("snakemake")) GTEST_SKIP() << "there is no snakemake";
  const ProgramResult result = Shell("HOME=$PWD snakemake --snakefile '" + Example("Snakefile") +
                                     "' --cores 2 --config template=template.ply "
                                     "manifest=shapes.csv output=out shards=2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ExpectResultsOfOneRun("out");
}

TEST_F(CohortExamplesTest, ParallelRunsShardsAndCollectsThem) {
  if (!IsInstalled("parallel")) GTEST_SKIP() << "there is no GNU parallel";
  const ProgramResult result =
      Shell("HOME=$PWD '" + Example("parallel_cohort.sh") + "' template.ply shapes.csv out 3");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ExpectResultsOfOneRun("out");
}

// sbatch is stood in for by a shell that runs the script at once, for every number of the array.
TEST_F(CohortExamplesTest, TheJobArrayRunsShardsAndCollectsThem) {
  WriteBytes(dir_ / "sbatch",
             "#!/bin/sh\n"
             "for argument; do case \"$argument\" in\n"
             "  --array=1-*) last=${argument#--array=1-} ;;\n"
             "  --wrap=*) wrap=${argument#--wrap=} ;;\n"
             "esac; done\n"
             "if [ -n \"$wrap\" ]; then sh -c \"$wrap\" >wrap.log; exit; fi\n"
             "cat >job.sh\n"
             "for i in $(seq $last); do SLURM_ARRAY_TASK_ID=$i sh job.sh >array.log; done\n"
             "echo 17\n");
  const ProgramResult result =
      Shell("chmod +x sbatch; PATH=$PWD:$PATH; '" + Example("slurm_cohort.sh") +
            "' template.ply shapes.csv out 3");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ExpectResultsOfOneRun("out");
}

}  // namespace
}  // namespace ceres_ed
