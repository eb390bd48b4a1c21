// What ed_fit refuses, with which exit code and in which words.
#include <fstream>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class EdFitBadInputTest : public EdFitTest {
 protected:
  // Expects `code`, one line on stderr with every one of `words`, and no output.
  void ExpectRefusal(const ProgramResult& result,
                     int code,
                     const std::vector<std::string>& words) const {
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.out, "");
    ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("ed_fit: "));
    for (const std::string& word : words) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(Exists("out.ply"));
  }

  void ExpectBadSource(const std::string& bytes, const std::vector<std::string>& words) const {
    const std::string path = dir_ / "bad.ply";
    WriteBytes(path, bytes);
    std::vector<std::string> all = words;
    all.push_back(path);
    const std::string output = "--output=" + (dir_ / "out.ply");
    ExpectRefusal(RunProgramFile(AppPath("ed_fit"), {path, dir_ / "target.ply", output}), 2, all);
    ExpectRefusal(RunProgramFile(AppPath("ed_fit"), {dir_ / "source.ply", path, output}), 2, all);
  }
};

TEST_F(EdFitBadInputTest, BadFlagsAreUsageErrors) {
  const std::vector<std::vector<std::string>> bad = {
      {"--mode=fast", "--mode=fast", "batch or two_level or marginal"},
      {"--boundary=tear", "--boundary=tear", "keep or cut"},
      {"--loss=l1", "--loss", "l1", "welsch"},
      {"--rings=-1", "rings", "-1"},
      {"--neighbors=0", "neighbors", "0"},
      {"--neighbors=9", "neighbors", "9"},
      {"--max_samples=9", "max_samples", "9"},
      {"--threads=-1", "threads", "-1", "0 = auto"},
      {"--w_rot=-1", "--w_rot=-1", ">= 0"},
      {"--w_reg=inf", "--w_reg=inf", "finite"},
      {"--w_data=nan", "--w_data=nan", "number"},
      {"--node_spacing=-0.1", "--node_spacing=-0.1", ">= 0"},
      {"--max_distance=-1", "--max_distance=-1", "0 = unlimited"},
      {"--max_angle_deg=0", "max_angle_deg", "0"},
      {"--max_angle_deg=181", "max_angle_deg", "181"},
      {"--time_limit_s=-1", "--time_limit_s=-1", "0 = none"},
      {"--energy=no_such", "--energy", "no_such", "point_to_plane"},
      {"--energy=rotation:no_such=1", "--energy", "rotation", "no_such"},
      {"--energy=rotation:weight=x", "--energy", "rotation", "weight", "number"},
      {"--rings=two", "--rings=two", "integer"},
      {"--no_such_flag=1", "no_such_flag"},
      {"--output=", "--output", "required"}};
  for (const std::vector<std::string>& flag_and_words : bad) {
    const std::vector<std::string> words(flag_and_words.begin() + 1, flag_and_words.end());
    ExpectRefusal(FitPair({flag_and_words[0]}), 1, words);
  }
}

TEST_F(EdFitBadInputTest, SomethingToFitToIsNeeded) {
  const ProgramResult result =
      RunProgramFile(AppPath("ed_fit"), {dir_ / "source.ply", "--output=" + (dir_ / "out.ply")});
  ExpectRefusal(result, 1, {"TARGET", "--landmarks"});
}

TEST_F(EdFitBadInputTest, TwoOutputsNeedTwoNames) {
  ExpectRefusal(FitPair({"--graph=" + (dir_ / "out.ply")}), 1, {dir_ / "out.ply", "two outputs"});
}

TEST_F(EdFitBadInputTest, OutputsAreCheckedBeforeTheWork) {
  // A file is where a folder is needed.
  const std::string path = dir_ / "source.ply/file";
  for (const char* flag : {"warp", "graph", "report", "output"}) {
    ExpectRefusal(FitPair({std::string("--") + flag + "=" + path}), 2, {path, "cannot be made"});
  }
  ExpectRefusal(FitPair({"--output=" + dir_.path()}), 2, {dir_.path()});
  EXPECT_EQ(dir_.NumFiles(), 2u);
}

TEST_F(EdFitBadInputTest, FilesThatAreNoCloudsAreNamed) {
  const std::string missing = dir_ / "missing.ply";
  const std::string output = "--output=" + (dir_ / "out.ply");
  ExpectRefusal(
      RunProgramFile(AppPath("ed_fit"), {missing, dir_ / "target.ply", output}), 2, {missing});
  ExpectRefusal(RunProgramFile(AppPath("ed_fit"), {dir_.path(), dir_ / "target.ply", output}),
                2,
                {dir_.path()});
  const std::string ring = RingPly({});
  ExpectBadSource("", {});
  ExpectBadSource("solid cube\n", {"not a PLY"});
  ExpectBadSource(ring.substr(0, ring.size() / 2), {"truncated"});
  ExpectBadSource(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
      "property float x\nproperty float y\nproperty float z\nend_header\nabcd",
      {"truncated", "4000000000"});
  ExpectBadSource(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "end_header\n0 0\n",
      {"x y z"});
  ExpectBadSource(AsciiMesh({}, {}), {"no vertices"});
  ExpectBadSource(AsciiMesh({"0 0 0", "1 0 0", "0 1 0", "0 0 1"}, {"3 0 1 4"}),
                  {"face 0", "vertex 4"});
  ExpectBadSource(AsciiMesh({"0 0 0", "1 0 0", "0 1 x", "0 0 1"}, {}), {"line", "'x'"});
}

TEST_F(EdFitBadInputTest, CloudsThatAreNoUseAreNamed) {
  ExpectBadSource(AsciiMesh({"0 0 0", "1 0 0", "0 1 0"}, {}), {"3", "at least 4"});
  ExpectBadSource(AsciiMesh(std::vector<std::string>(5, "1 2 3"), {}), {"coincide"});
  RingOptions holes;
  holes.is_nan = [](int) { return true; };
  ExpectBadSource(RingPly(holes), {"finite coordinates", "288"});
  RingOptions millimetres;
  millimetres.scale = 1000.0;
  ExpectBadSource(RingPly(millimetres), {"sizes", "units"});
}

TEST_F(EdFitBadInputTest, PointListsAreCheckedLineByLine) {
  const std::vector<std::vector<std::string>> landmarks = {
      {"0,1,2,3\n288,0,0,0\n", "line 2", "288"},
      {"0,1,2\n", "line 1"},
      {"0,1,2,nan\n", "line 1"},
      {"-1,0,0,0\n", "line 1", "-1"},
      {"", "no landmarks"},
      {"a,b,c,d\n1,2\n", "line"},
      {"0,1,2,3\n0,1,2,4\n", "line 2", "vertex 0"}};
  const std::string path = dir_ / "list";
  for (const std::vector<std::string>& text_and_words : landmarks) {
    WriteBytes(path, text_and_words[0]);
    std::vector<std::string> words(text_and_words.begin() + 1, text_and_words.end());
    words.push_back(path);
    ExpectRefusal(FitPair({"--landmarks=" + path}), 2, words);
  }
  WriteBytes(path, "1 2\n3 x\n");
  ExpectRefusal(FitPair({"--fixed=" + path}), 2, {path, "line 2", "'x'"});
  WriteBytes(path, "288\n");
  ExpectRefusal(FitPair({"--fixed=" + path}), 2, {path, "line 1", "288"});
  ExpectRefusal(FitPair({"--fixed=" + (dir_ / "missing")}), 2, {dir_ / "missing"});
  ExpectRefusal(FitPair({"--landmarks=" + (dir_ / "missing")}), 2, {dir_ / "missing"});
}

TEST_F(EdFitBadInputTest, ListsMayNotNameVerticesThatAreNotFinite) {
  RingOptions hole;
  hole.is_nan = [](int i) { return i == 77; };
  WritePair(hole, {});
  const std::string path = dir_ / "list";
  WriteBytes(path, "77,0,0,0\n");
  ExpectRefusal(FitPair({"--landmarks=" + path}), 2, {path, "vertex 77", "source.ply", "finite"});
  WriteBytes(path, "76 77\n");
  ExpectRefusal(FitPair({"--fixed=" + path}), 2, {path, "vertex 77", "source.ply", "finite"});
}

TEST_F(EdFitBadInputTest, PluginsThatCannotBeLoadedAreNamed) {
  ExpectRefusal(FitPair({"--plugin=" + (dir_ / "none.so")}), 2, {dir_ / "none.so"});
  ExpectRefusal(FitPair({"--plugin=" + (dir_ / "source.ply")}), 2, {dir_ / "source.ply"});
}

TEST_F(EdFitBadInputTest, AFailedSolveWritesOnlyItsReport) {
  const ProgramResult result = FitPair({std::string("--plugin=") + CERES_ED_FAULTY_PLUGIN,
                                        "--energy=fails",
                                        "--warp=" + (dir_ / "warp.json"),
                                        "--graph=" + (dir_ / "graph.ply"),
                                        "--report=" + (dir_ / "report.json")});
  ExpectRefusal(result, 3, {});
  EXPECT_FALSE(Exists("warp.json"));
  EXPECT_FALSE(Exists("graph.ply"));
  ASSERT_TRUE(Exists("report.json"));
  EXPECT_EQ(Report()["status"], "failed");
  EXPECT_FALSE(std::string(Report()["message"]).empty());
  EXPECT_TRUE(Report()["energy"]["final"].is_null());
}

}  // namespace
}  // namespace ceres_ed
