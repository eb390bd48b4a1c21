// Small depth sequences in a temporary folder.
#ifndef CERES_ED_TEST_IO_SEQUENCE_TEST_UTIL_H_
#define CERES_ED_TEST_IO_SEQUENCE_TEST_UTIL_H_

#include "ceres_ed/io/sequence/depth_sequence.h"
#include "io_test_util.h"

#include <ceres_ed/io/image_io.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {

// Writes images of 4 x 3 pixels, unless a test asks for another size, and creates the folders.
class SequenceFolder {
 public:
  std::string path() const { return directory_.path(); }
  std::string operator/(const std::string& name) const { return directory_ / name; }

  void Text(const std::string& name, const std::string& contents) {
    WriteBytes(MakePath(name), contents);
  }
  // Every pixel is `units`.
  void Depth(const std::string& name, int units = 1000, int width = 4, int height = 3) {
    const DepthImage depth(width, height, static_cast<float>(units));
    EXPECT_TRUE(WriteDepthImage(MakePath(name), depth, 1.0).ok()) << name;
  }
  void Color(const std::string& name, std::uint8_t red = 200, int width = 4, int height = 3) {
    const ColorImage color(width, height, {red, 20, 3});
    EXPECT_TRUE(WriteColorImage(MakePath(name), color).ok()) << name;
  }

 private:
  std::string MakePath(const std::string& name) {
    const std::filesystem::path path = directory_ / name;
    std::filesystem::create_directories(path.parent_path());
    return path.string();
  }

  TemporaryDirectory directory_;
};

inline std::vector<int> FrameNumbers(const DepthSequence& sequence) {
  std::vector<int> numbers;
  for (int i = 0; i < sequence.num_frames(); ++i) numbers.push_back(sequence.frame_number(i));
  return numbers;
}

// Returns the error of OpenSequence() with the path of the folder replaced by DIR.
inline std::string OpenError(const SequenceFolder& folder, const SequenceOptions& options = {}) {
  const auto sequence = OpenSequence(folder.path(), options);
  if (sequence.ok()) return "no error";
  std::string message = sequence.status().message();
  for (std::size_t at = message.find(folder.path()); at != std::string::npos;
       at = message.find(folder.path())) {
    message.replace(at, folder.path().size(), "DIR");
  }
  return message;
}

// Returns the warnings with the path of the folder replaced by DIR.
inline std::vector<std::string> Warnings(const SequenceFolder& folder,
                                         const DepthSequence& sequence) {
  std::vector<std::string> warnings = sequence.warnings();
  for (std::string& warning : warnings) {
    const std::size_t at = warning.find(folder.path());
    if (at != std::string::npos) warning.replace(at, folder.path().size(), "DIR");
  }
  return warnings;
}

inline constexpr char kNativeCamera[] = "5 6 1.5 1 4 3 10000\n";

// A native sequence with depth images of the given numbers. Every pixel is 1000 + number.
class NativeSequenceTest : public ::testing::Test {
 protected:
  void Make(const std::vector<std::string>& names) {
    folder_.Text("camera.txt", kNativeCamera);
    for (const std::string& name : names) {
      folder_.Depth("depth/" + name + ".png", 1000 + std::stoi(name));
    }
  }
  std::unique_ptr<DepthSequence> Open(const SequenceOptions& options = {}) {
    StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(folder_.path(), options);
    if (!sequence.ok()) {
      ADD_FAILURE() << sequence.status().message();
      return nullptr;
    }
    return std::move(*sequence);
  }
  std::vector<int> Numbers(int first, int last, int step) {
    SequenceOptions options;
    options.first = first;
    options.last = last;
    options.step = step;
    const auto sequence = Open(options);
    return sequence == nullptr ? std::vector<int>() : FrameNumbers(*sequence);
  }

  SequenceFolder folder_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_IO_SEQUENCE_TEST_UTIL_H_
