#include "ceres_ed/io/sequence/sequence_format.h"

namespace ceres_ed {

const std::vector<SequenceFormatReader>& SequenceFormats() {
  // A TUM folder may have a camera.txt, too: it is asked for first.
  static const std::vector<SequenceFormatReader> formats = {
      {SequenceFormat::kTum, "depth.txt", "depth.txt", ListTumSequence},
      {SequenceFormat::kNative,
       "camera.txt",
       "camera.txt and depth/NNNNNN.png",
       ListNativeSequence},
      {SequenceFormat::kHamlyn,
       "intrinsics.txt",
       "intrinsics.txt and depth/ or depth01/",
       ListHamlynSequence},
  };
  return formats;
}

}  // namespace ceres_ed
