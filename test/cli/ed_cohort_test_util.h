// Small cohorts for the tests of ed_cohort, and what has been written of them.
#ifndef CERES_ED_TEST_CLI_ED_COHORT_TEST_UTIL_H_
#define CERES_ED_TEST_CLI_ED_COHORT_TEST_UTIL_H_

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {

// A ring, and rings that are bent, each with another mesh.
class EdCohortTest : public ::testing::Test {
 protected:
  static constexpr int kShapes = 4;

  EdCohortTest() {
    WriteBytes(dir_ / "template.ply", RingPly(RingOptions()));
    std::string table = "name,path,group\n";
    for (int i = 0; i < kShapes; ++i) {
      RingOptions ring;
      ring.bent = true;
      ring.columns = 25 + i;
      ring.phase = 0.3;
      ring.scale = 1.0 + 0.02 * i;
      const std::string name = "ring_" + std::to_string(i);
      WriteBytes(dir_ / (name + ".ply"), RingPly(ring));
      table += name + "," + name + ".ply," + (i % 2 == 0 ? "even" : "odd") + "\n";
    }
    WriteBytes(dir_ / "shapes.csv", table);
  }

  ProgramResult Cohort(const std::vector<std::string>& arguments,
                       const RunOptions& options = {}) const {
    return RunProgramFile(AppPath("ed_cohort"), arguments, options);
  }

  // Fits the template to the shapes, into the folder `output`.
  ProgramResult Fit(const std::string& output,
                    const std::vector<std::string>& flags = {},
                    const RunOptions& options = {}) const {
    std::vector<std::string> arguments = {dir_ / "template.ply",
                                          "--manifest=" + (dir_ / "shapes.csv"),
                                          "--output=" + (dir_ / output)};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return Cohort(arguments, options);
  }

  bool Exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  nlohmann::json Json(const std::string& name) const {
    return nlohmann::json::parse(ReadBytes(dir_ / name), nullptr, false);
  }

  // Returns all files of a folder with their contents, but for the pages and the reports, and
  // without the times of records and of the summary.
  std::map<std::string, std::string> Results(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dir_ / folder)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name == "report.json") continue;
      if (entry.path().extension() == ".html") continue;
      std::string bytes = ReadBytes(entry.path().string());
      if (name == "record.json") {
        nlohmann::json record = nlohmann::json::parse(bytes);
        record.erase("seconds");
        bytes = record.dump();
      }
      if (name == "summary.csv") {
        std::string rows;
        for (const std::string& line : SplitLines(bytes))
          rows += line.substr(0, line.rfind(',')) + "\n";
        bytes = rows;
      }
      files[entry.path().lexically_relative(dir_ / folder).string()] = bytes;
    }
    return files;
  }

  void ExpectSameResults(const std::string& one, const std::string& other) const {
    const auto a = Results(one);
    const auto b = Results(other);
    for (const auto& [name, bytes] : a) {
      ASSERT_EQ(b.count(name), 1u) << name;
      EXPECT_TRUE(b.at(name) == bytes) << name << " differs";
    }
    EXPECT_EQ(a.size(), b.size());
  }

  TemporaryDirectory dir_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_CLI_ED_COHORT_TEST_UTIL_H_
