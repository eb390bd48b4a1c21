// The layouts of depth sequences. To add one, write a file whose name ends in _format with its
// function, and add a value to SequenceFormat, and here a declaration and a row of the table.
#ifndef CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_
#define CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// A layout.
struct SequenceFormatReader {
  SequenceFormat format = SequenceFormat::kAuto;
  // The file by which the layout is recognised.
  const char* mark = "";
  // The files that the layout needs, for the message when no layout is recognised.
  const char* needs = "";
  // Returns every frame of the folder, with ascending numbers and at least one, or an error.
  StatusOr<SequenceListing> (*list)(const std::string& directory) = nullptr;
};

// Each is in a file of its own. depth_sequence.h describes the layouts.
StatusOr<SequenceListing> ListNativeSequence(const std::string& directory);
StatusOr<SequenceListing> ListTumSequence(const std::string& directory);
StatusOr<SequenceListing> ListHamlynSequence(const std::string& directory);

// The layouts in the order in which they are tried on a folder. A TUM folder may also have a
// camera.txt, so it comes before the native layout.
inline constexpr SequenceFormatReader kSequenceFormats[] = {
    {SequenceFormat::kTum, "depth.txt", "depth.txt", ListTumSequence},
    {SequenceFormat::kNative, "camera.txt", "camera.txt and depth/NNNNNN.png", ListNativeSequence},
    {SequenceFormat::kHamlyn,
     "intrinsics.txt",
     "intrinsics.txt and depth/ or depth01/",
     ListHamlynSequence}};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_
