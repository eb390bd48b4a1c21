// The layouts of sequences. To add one, write a file whose name ends in _format with its two
// functions, and add a value to SequenceFormat, and here two declarations and a row of the table.
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
  // The files by which the layout is recognised, for the user: "there is <sign>".
  const char* sign = "";
  // The files that the layout needs, for the message when no layout is recognised.
  const char* needs = "";
  // Returns whether a folder has this layout. It reads no picture, and must not take a folder of
  // another layout for its own; the first layout in the table that recognises a folder is taken.
  bool (*recognizes)(const std::string& directory) = nullptr;
  // Returns every frame of the folder, with ascending numbers and at least one, or an error.
  StatusOr<SequenceListing> (*list)(const std::string& directory) = nullptr;
};

// Each pair is in a file of its own. depth_sequence.h describes the layouts.
bool IsNativeStereoSequence(const std::string& directory);
StatusOr<SequenceListing> ListNativeStereoSequence(const std::string& directory);
bool IsScikitSurgerySequence(const std::string& directory);
StatusOr<SequenceListing> ListScikitSurgerySequence(const std::string& directory);
bool IsNativeSequence(const std::string& directory);
StatusOr<SequenceListing> ListNativeSequence(const std::string& directory);
bool IsTumSequence(const std::string& directory);
StatusOr<SequenceListing> ListTumSequence(const std::string& directory);
bool IsHamlynSequence(const std::string& directory);
StatusOr<SequenceListing> ListHamlynSequence(const std::string& directory);

// The layouts in the order in which they are tried on a folder. A TUM folder may also have a
// camera.txt, so it comes before the native layout, and so may a folder of native stereo.
inline constexpr SequenceFormatReader kSequenceFormats[] = {
    {SequenceFormat::kTum, "depth.txt", "depth.txt", IsTumSequence, ListTumSequence},
    {SequenceFormat::kNativeStereo,
     "stereo.txt",
     "stereo.txt, left/NNNNNN.png and right/NNNNNN.png",
     IsNativeStereoSequence,
     ListNativeStereoSequence},
    {SequenceFormat::kScikitSurgery,
     "calib.left.intrinsic.txt",
     "calib.left.intrinsic.txt, calib.right.intrinsic.txt, calib.l2r.txt, left/ and right/",
     IsScikitSurgerySequence,
     ListScikitSurgerySequence},
    {SequenceFormat::kNative,
     "camera.txt",
     "camera.txt and depth/NNNNNN.png",
     IsNativeSequence,
     ListNativeSequence},
    {SequenceFormat::kHamlyn,
     "intrinsics.txt",
     "intrinsics.txt and depth/ or depth01/",
     IsHamlynSequence,
     ListHamlynSequence}};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_
