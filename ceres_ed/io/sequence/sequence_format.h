// The layouts of depth sequences. A new one is a file with its functions, a value of SequenceFormat
// and a line in the table of sequence_format.cc.
#ifndef CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_
#define CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A layout.
struct SequenceFormatReader {
  SequenceFormat format = SequenceFormat::kAuto;
  // The file that gives the layout away when it is to be guessed.
  const char* mark = "";
  // What the layout can't do without, for the message when none is recognised.
  const char* needs = "";
  // Returns every frame of the folder, with ascending numbers, at least one, or an error.
  StatusOr<SequenceListing> (*list)(const std::string& directory) = nullptr;
};

// Returns the layouts in the order in which they are tried on a folder.
const std::vector<SequenceFormatReader>& SequenceFormats();

// Each in a file of its own; the layouts are told in depth_sequence.h.
StatusOr<SequenceListing> ListNativeSequence(const std::string& directory);
StatusOr<SequenceListing> ListTumSequence(const std::string& directory);
StatusOr<SequenceListing> ListHamlynSequence(const std::string& directory);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_FORMAT_H_
