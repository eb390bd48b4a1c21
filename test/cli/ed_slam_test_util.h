// Small sequences for the tests of ed_slam, and what its outputs say.
#ifndef CERES_ED_TEST_CLI_ED_SLAM_TEST_UTIL_H_
#define CERES_ED_TEST_CLI_ED_SLAM_TEST_UTIL_H_

#include <ceres_ed/io/cloud_io.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>
#include <test/slam/bumpy_sequence.h>

namespace ceres_ed {

// Rows of a CSV file by the names of its columns.
inline std::vector<std::map<std::string, std::string>> ReadCsv(const std::string& path) {
  std::vector<std::map<std::string, std::string>> rows;
  const std::vector<std::string> lines = SplitLines(ReadBytes(path));
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    // The last field of a row may be empty.
    if (!line.empty() && line.back() == ',') fields.emplace_back();
    return fields;
  };
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> names = split(lines[0]);
    const std::vector<std::string> fields = split(lines[i]);
    EXPECT_EQ(fields.size(), names.size()) << lines[i];
    rows.emplace_back();
    for (std::size_t k = 0; k < std::min(names.size(), fields.size()); ++k) {
      rows.back()[names[k]] = fields[k];
    }
  }
  return rows;
}

// A folder with a sequence, seq, and what ed_slam makes of it, out.
class EdSlamTest : public ::testing::Test {
 protected:
  std::string Sequence() const { return dir_ / "seq"; }

  ProgramResult Run(const std::string& output,
                    const std::vector<std::string>& flags = {},
                    const RunOptions& options = {}) const {
    std::vector<std::string> arguments = {
        Sequence(), "--output=" + (dir_ / output), "--nodes_in_view=40"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_slam"), arguments, options);
  }

  std::vector<std::map<std::string, std::string>> Frames(const std::string& output = "out") const {
    return ReadCsv(dir_ / (output + "/frames.csv"));
  }

  std::vector<std::string> Statuses(const std::string& output = "out") const {
    std::vector<std::string> statuses;
    for (auto& row : Frames(output)) statuses.push_back(row["status"]);
    return statuses;
  }

  nlohmann::json Report(const std::string& output = "out") const {
    return nlohmann::json::parse(std::ifstream(dir_ / (output + "/report.json")));
  }

  LoadedCloud Load(const std::string& name) const {
    StatusOr<LoadedCloud> loaded = LoadCloud(dir_ / name);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return loaded.ok() ? *std::move(loaded) : LoadedCloud();
  }

  bool Exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  // Everything in a result but clocks: the files' names and bytes, frames.csv without its times,
  // neither report.json nor the checkpoint.
  std::map<std::string, std::string> Contents(const std::string& output) const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dir_ / output)) {
      const std::string name = std::filesystem::relative(entry.path(), dir_ / output).string();
      if (!entry.is_regular_file() || name == "report.json" || name == "checkpoint.cbor") continue;
      contents[name] = name == "frames.csv" ? "" : ReadBytes(entry.path().string());
    }
    for (const auto& row : Frames(output)) {
      for (const auto& [column, value] : row) {
        if (column.rfind("t_", 0) != 0) contents["frames.csv"] += column + "=" + value + " ";
      }
    }
    return contents;
  }

  void ExpectSameContents(const std::string& one, const std::string& other) const {
    const auto a = Contents(one);
    const auto b = Contents(other);
    EXPECT_GE(a.size(), 5u);
    for (const auto& [name, bytes] : a) {
      ASSERT_EQ(b.count(name), 1u) << name;
      // Not EXPECT_EQ, which would print them.
      EXPECT_TRUE(bytes == b.at(name)) << name;
    }
    EXPECT_EQ(a.size(), b.size());
  }

  TemporaryDirectory dir_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_CLI_ED_SLAM_TEST_UTIL_H_
