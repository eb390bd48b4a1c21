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
  // The files that the layout needs, for the message when no layout is recognised. Empty for a data
  // set, which is named only: nobody arranges files of his own like that.
  const char* needs = "";
  // Returns whether a folder has this layout. It looks at names and small files (and at one
  // picture, if only that tells), and must not take a folder of another layout for its own; the
  // first layout in the table that recognises a folder is taken.
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
bool IsStereoVideo(const std::string& directory);
StatusOr<SequenceListing> ListStereoVideo(const std::string& directory);
bool IsStereoMis(const std::string& directory);
StatusOr<SequenceListing> ListStereoMis(const std::string& directory);
bool IsScared(const std::string& directory);
StatusOr<SequenceListing> ListScared(const std::string& directory);
bool IsDeform3dgs(const std::string& directory);
StatusOr<SequenceListing> ListDeform3dgs(const std::string& directory);
bool IsEndoNerf(const std::string& directory);
StatusOr<SequenceListing> ListEndoNerf(const std::string& directory);
bool IsD4d(const std::string& directory);
StatusOr<SequenceListing> ListD4d(const std::string& directory);
bool IsServCt(const std::string& directory);
StatusOr<SequenceListing> ListServCt(const std::string& directory);
bool IsSurgT(const std::string& directory);
StatusOr<SequenceListing> ListSurgT(const std::string& directory);
bool IsStir(const std::string& directory);
StatusOr<SequenceListing> ListStir(const std::string& directory);
bool IsHamlynStereo(const std::string& directory);
StatusOr<SequenceListing> ListHamlynStereo(const std::string& directory);
bool IsC3vd(const std::string& directory);
StatusOr<SequenceListing> ListC3vd(const std::string& directory);
bool IsDeepDeform(const std::string& directory);
StatusOr<SequenceListing> ListDeepDeform(const std::string& directory);
bool IsSuper(const std::string& directory);
StatusOr<SequenceListing> ListSuper(const std::string& directory);
bool IsSevenScenes(const std::string& directory);
StatusOr<SequenceListing> ListSevenScenes(const std::string& directory);

// The layouts in the order in which they are tried on a folder. A TUM folder may also have a
// camera.txt, so it comes before the native layout, and so may a folder of native stereo. The data
// sets that have a file of a name of their own come before the layouts that share one.
inline constexpr SequenceFormatReader kSequenceFormats[] = {
    {SequenceFormat::kTum, "depth.txt", "depth.txt", IsTumSequence, ListTumSequence},
    {SequenceFormat::kStereoVideo,
     "stereo.txt or calibration.yaml, and a video",
     "stereo.txt or calibration.yaml beside one or two videos",
     IsStereoVideo,
     ListStereoVideo},
    {SequenceFormat::kStereoMis, "StereoCalibration.ini", "", IsStereoMis, ListStereoMis},
    {SequenceFormat::kScared, "endoscope_calibration.yaml", "", IsScared, ListScared},
    {SequenceFormat::kDeform3dgs,
     "poses_bounds.npy with cy and cx",
     "",
     IsDeform3dgs,
     ListDeform3dgs},
    {SequenceFormat::kEndoNerf, "poses_bounds.npy", "", IsEndoNerf, ListEndoNerf},
    {SequenceFormat::kD4d, "left_images_rect/", "", IsD4d, ListD4d},
    {SequenceFormat::kServCt, "Left_rectified/", "", IsServCt, ListServCt},
    {SequenceFormat::kSurgT, "info.yaml", "", IsSurgT, ListSurgT},
    {SequenceFormat::kStir, "calib.json", "", IsStir, ListStir},
    {SequenceFormat::kHamlynStereo, "settings.yaml", "", IsHamlynStereo, ListHamlynStereo},
    {SequenceFormat::kC3vd, "NNNN_depth.tiff", "", IsC3vd, ListC3vd},
    {SequenceFormat::kDeepDeform,
     "intrinsics.txt of 4 x 4 numbers",
     "",
     IsDeepDeform,
     ListDeepDeform},
    {SequenceFormat::kSuper, "rgb/NNNNNN-left.png", "", IsSuper, ListSuper},
    {SequenceFormat::kSevenScenes, "frame-NNNNNN.depth.png", "", IsSevenScenes, ListSevenScenes},
    {SequenceFormat::kNativeStereo,
     "stereo.txt",
     "stereo.txt, left/NNNNNN.png and right/NNNNNN.png",
     IsNativeStereoSequence,
     ListNativeStereoSequence},
    {SequenceFormat::kScikitSurgery,
     "calib.left.intrinsic.txt",
     "",
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
