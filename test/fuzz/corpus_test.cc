// Replays the corpus of the fuzzer: seeds, and what once crashed a reader.
#include "fuzzed_readers.h"

#include <ceres_ed/io/text.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

std::string FolderOf(const FuzzedReader& reader) {
  return std::string(CERES_ED_SOURCE_DIR) + "/test/fuzz/corpus/" + reader.name;
}

std::vector<std::string> FilesOf(const FuzzedReader& reader) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(FolderOf(reader), error)) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Corpus : public ::testing::TestWithParam<FuzzedReader> {};

TEST_P(Corpus, IsReadOrRefusedWithASentence) {
  const std::vector<std::string> files = FilesOf(GetParam());
  ASSERT_FALSE(files.empty()) << "no seeds in " << FolderOf(GetParam());
  for (const std::string& file : files) {
    const StatusOr<std::string> bytes = ReadWholeFile(file);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    EXPECT_EQ(FaultOfBytes(GetParam(), *bytes), "") << file;
  }
}

// Every cut of a seed is what a full disk or a broken download leaves.
TEST_P(Corpus, CutAnywhereIsReadOrRefusedWithASentence) {
  for (const std::string& file : FilesOf(GetParam())) {
    const StatusOr<std::string> bytes = ReadWholeFile(file);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const std::size_t step = 1 + bytes->size() / 100;
    for (std::size_t size = 0; size < bytes->size(); size += step) {
      EXPECT_EQ(FaultOfBytes(GetParam(), bytes->substr(0, size)), "") << file << " cut at " << size;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers,
                         Corpus,
                         ::testing::ValuesIn(FuzzedReaders()),
                         [](const auto& info) { return std::string(info.param.name); });

// A folder without a reader would never be replayed.
TEST(CorpusFolders, AllBelongToAReader) {
  const std::string root = std::string(CERES_ED_SOURCE_DIR) + "/test/fuzz/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    EXPECT_NE(FindFuzzedReader(entry.path().filename().string()), nullptr) << entry.path();
  }
}

}  // namespace
}  // namespace ceres_ed
