// Mistakes on the command line: one sentence with what was likely meant.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

class Mistakes : public EdFitTest {
 protected:
  Mistakes() {
    EXPECT_EQ(FitPair({"--warp=" + (dir_ / "w.json"), "--report=" + (dir_ / "r.json")}).exit_code,
              0);
  }

  // Runs a program with `arguments`, of which those that begin with '@' are files of the test, and
  // expects one line on stderr with `sentence`.
  void ExpectSentence(const std::string& program,
                      std::vector<std::string> arguments,
                      int exit_code,
                      const std::string& sentence) {
    for (std::string& argument : arguments) {
      const std::size_t at = argument.find('@');
      if (at != std::string::npos) argument.replace(at, 1, dir_.path() + "/");
    }
    const ProgramResult result = RunProgramFile(AppPath(program), arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(SplitLines(result.err).size(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(sentence));
  }
};

TEST_F(Mistakes, AnOutputAsTheThirdArgument) {
  ExpectSentence("ed_fit",
                 {"@source.ply", "@target.ply", "@c.vtp"},
                 1,
                 "did you mean --output=" + (dir_ / "c.vtp") + "?");
  ExpectSentence("ed_apply", {"@w.json", "@source.ply", "@c.vtp"}, 1, "did you mean --output=");
}

TEST_F(Mistakes, SwappedArguments) {
  ExpectSentence("ed_apply",
                 {"@source.ply", "@w.json", "-o", "@c.ply"},
                 1,
                 "w.json is a warp, which comes first: ed_apply WARP.json IN --output=OUT");
  ExpectSentence("ed_apply",
                 {"@source.ply", "@target.ply", "-o", "@c.ply"},
                 2,
                 "the warp comes first, as in ed_apply WARP.json IN");
}

TEST_F(Mistakes, AnotherFileOfOursInPlaceOfAMeshOrAWarp) {
  ExpectSentence("ed_apply",
                 {"@r.json", "@source.ply", "-o", "@c.ply"},
                 2,
                 "it is a report; a warp is what ed_fit --warp=FILE.json writes");
  ExpectSentence("ed_fit", {"@w.json", "@target.ply", "-o", "@c.ply"}, 2, "it is a warp of ed_fit");
  ExpectSentence("ed_fit", {"@source.ply", "@r.json", "-o", "@c.ply"}, 2, "it is a report");
  ExpectSentence("ed_eval", {"@r.json", "@target.ply"}, 2, "it is a report");
  ExpectSentence("ed_check", {"@w.json"}, 2, "it is a warp of ed_fit");
  WriteBytes(dir_ / "l.mrk.json", "{\"markups\": []}");
  ExpectSentence(
      "ed_fit", {"@l.mrk.json", "@target.ply", "-o", "@c.ply"}, 2, "for --source_landmarks");
  WriteBytes(dir_ / "scan.nrrd", "NRRD0004\n");
  ExpectSentence("ed_fit", {"@scan.nrrd", "@target.ply", "-o", "@c.ply"}, 2, "it is a volume");
}

TEST_F(Mistakes, AMissingFileOrFolder) {
  ExpectSentence("ed_fit",
                 {"@sourc.ply", "@target.ply", "-o", "@c.ply"},
                 2,
                 "did you mean " + (dir_ / "source.ply") + "?");
  ExpectSentence("ed_fit",
                 {"@no/source.ply", "@target.ply", "-o", "@c.ply"},
                 2,
                 "there is no folder " + (dir_ / "no"));
  ExpectSentence("ed_apply",
                 {"@warp.json", "@source.ply", "-o", "@c.ply"},
                 2,
                 "cannot read: No such file or directory");
}

TEST_F(Mistakes, AFolderInPlaceOfAFile) {
  std::filesystem::create_directories(dir_ / "pair");
  std::filesystem::rename(dir_ / "out.ply", dir_ / "pair/fitted.ply");
  ExpectSentence("ed_fit",
                 {"@pair", "@target.ply", "-o", "@c.ply"},
                 2,
                 "did you mean " + (dir_ / "pair/fitted.ply") + "?");
  ExpectSentence("ed_fit",
                 {"@source.ply", "@target.ply", "-o", "@pair"},
                 2,
                 "pair: is a folder, expected the name of a file to write, such as ");
  std::filesystem::create_directories(dir_ / "run/depth");
  ExpectSentence("ed_fit", {"@run", "@target.ply", "-o", "@c.ply"}, 2, "it looks like a sequence");
}

}  // namespace
}  // namespace ceres_ed
