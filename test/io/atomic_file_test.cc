#include "ceres_ed/io/atomic_file.h"

#include "io_test_util.h"

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(AtomicFile, HoldsWhatWasWrittenAfterCommit) {
  const TemporaryDirectory directory;
  const std::string path = directory / "out.bin";
  // The contents are longer than any buffer, contain zero bytes, and are written in pieces of many
  // sizes.
  std::string expected;
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  ASSERT_TRUE(file.ok()) << file.status().message();
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string piece(i * 7, static_cast<char>(i));
    (*file)->stream() << piece << 'x';
    expected += piece + 'x';
  }
  (*file)->stream().write(expected.data(), static_cast<std::streamsize>(expected.size()));
  ASSERT_TRUE((*file)->Commit().ok());
  EXPECT_EQ(ReadBytes(path), expected + expected);
  EXPECT_EQ(directory.NumFiles(), 1u);
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndTheTemporaryGoes) {
  const TemporaryDirectory directory;
  const std::string path = directory / "out.txt";
  WriteBytes(path, "old");
  {
    StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
    ASSERT_TRUE(file.ok());
    (*file)->stream() << std::string(1 << 20, 'n') << std::flush;
    EXPECT_EQ(ReadBytes(path), "old");
    EXPECT_EQ(directory.NumFiles(), 2u);
  }
  EXPECT_EQ(ReadBytes(path), "old");
  EXPECT_EQ(directory.NumFiles(), 1u);
}

TEST(AtomicFile, ProcessKilledWhileWritingLeavesTheOldFile) {
  const TemporaryDirectory directory;
  const std::string path = directory / "out.txt";
  WriteBytes(path, "old");
  const pid_t child = fork();
  if (child == 0) {
    StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
    (*file)->stream() << std::string(1 << 20, 'n') << std::flush;
    std::raise(SIGKILL);
  }
  int outcome = 0;
  ASSERT_EQ(waitpid(child, &outcome, 0), child);
  ASSERT_TRUE(WIFSIGNALED(outcome));
  EXPECT_EQ(ReadBytes(path), "old");
  // A temporary file that was left does not prevent the next run from writing.
  EXPECT_TRUE(WriteFileAtomically(path, "new").ok());
  EXPECT_EQ(ReadBytes(path), "new");
}

TEST(AtomicFile, TwoWritersOfOneFileDoNotMix) {
  const TemporaryDirectory directory;
  const std::string path = directory / "out.txt";
  StatusOr<std::unique_ptr<AtomicFile>> a = AtomicFile::Create(path);
  StatusOr<std::unique_ptr<AtomicFile>> b = AtomicFile::Create(path);
  ASSERT_TRUE(a.ok() && b.ok());
  (*a)->stream() << "aaaa";
  (*b)->stream() << "b";
  ASSERT_TRUE((*b)->Commit().ok());
  ASSERT_TRUE((*a)->Commit().ok());
  EXPECT_EQ(ReadBytes(path), "aaaa");
  EXPECT_EQ(directory.NumFiles(), 1u);
}

TEST(AtomicFile, MissingDirectoryIsAnErrorThatNamesFileAndReason) {
  const TemporaryDirectory directory;
  const std::string path = directory / "no/such/out.txt";
  const Status status = WriteFileAtomically(path, "x");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.message(), path + ": cannot write: No such file or directory");
}

TEST(AtomicFile, DirectoryAsTargetIsAnError) {
  const TemporaryDirectory directory;
  const Status status = WriteFileAtomically(directory.path(), "x");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("Is a directory"));
}

TEST(AtomicFile, FullDiskIsAnErrorWithTheReason) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const std::size_t size : {std::size_t{1}, std::size_t{1} << 20}) {
    const Status status = WriteFileAtomically("/dev/full", std::string(size, 'x'));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.message(), "/dev/full: cannot write: No space left on device");
  }
}

TEST(AtomicFile, ContentsThatTheCallerDeclaresBadAreNotCommitted) {
  const TemporaryDirectory directory;
  const std::string path = directory / "out.txt";
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  ASSERT_TRUE(file.ok());
  (*file)->stream().setstate(std::ios::failbit);
  EXPECT_FALSE((*file)->Commit().ok());
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(AtomicFile, DeviceIsWrittenToAndStaysADevice) {
  ASSERT_TRUE(WriteFileAtomically("/dev/null", "x").ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, SymbolicLinkIsFollowed) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "real", "old");
  std::filesystem::create_symlink(directory / "real", directory / "link");
  ASSERT_TRUE(WriteFileAtomically(directory / "link", "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
  EXPECT_EQ(ReadBytes(directory / "real"), "new");
}

TEST(AtomicFile, NewFileGetsTheRightsOfTheUmask) {
  const TemporaryDirectory directory;
  const mode_t old_mask = umask(022);
  ASSERT_TRUE(WriteFileAtomically(directory / "out.txt", "x").ok());
  umask(old_mask);
  struct stat info;
  ASSERT_EQ(stat((directory / "out.txt").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0644u);
}

TEST(AtomicFile, UnwritableDirectoryAndFileAreErrors) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryDirectory directory;
  WriteBytes(directory / "kept.txt", "old");
  std::filesystem::permissions(directory / "kept.txt", std::filesystem::perms::owner_read);
  EXPECT_THAT(WriteFileAtomically(directory / "kept.txt", "x").message(),
              HasSubstr("Permission denied"));
  std::filesystem::create_directory(directory / "locked");
  std::filesystem::permissions(directory / "locked", std::filesystem::perms::owner_read);
  EXPECT_THAT(WriteFileAtomically(directory / "locked/out.txt", "x").message(),
              HasSubstr("Permission denied"));
}

// Linux gives no process a number beyond 2^22.
TEST(AtomicFile, WhatAKilledProcessOfThisMachineLeftIsRemovedAlone) {
  const TemporaryDirectory directory;
  const std::string ending = TemporaryEnding();
  const std::string host = ending.substr(0, ending.rfind('.') + 1);
  const std::string gone = std::to_string((1 << 22) + 1);
  for (const std::string& ours : {host + gone + ".0", host + gone}) {
    WriteBytes(directory / ("rows.csv" + ours), "half");
  }
  const std::vector<std::string> kept = {"rows.csv",
                                         "rows.csv" + host + std::to_string(::getppid()) + ".0",
                                         "rows.csv.tmp.another." + gone + ".0",
                                         "rows.csv" + host + gone + "a",
                                         "rows.csv.tmp.123.0"};
  for (const std::string& name : kept) WriteBytes(directory / name, "whole");
  RemoveAbandonedFiles(directory / ".");
  for (const std::string& name : kept) EXPECT_TRUE(std::filesystem::exists(directory / name));
  EXPECT_EQ(directory.NumFiles(), kept.size());
  RemoveAbandonedFiles(directory / "not there");
}

}  // namespace
}  // namespace ceres_ed
