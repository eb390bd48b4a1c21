#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/io/sequence/mask_meaning.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <sstream>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

const SequenceFormatReader* FindFormat(SequenceFormat format) {
  for (const SequenceFormatReader& reader : kSequenceFormats) {
    if (reader.format == format) return &reader;
  }
  return nullptr;
}

// Returns the error "DIRECTORY: PROBLEM, expected ..." with what each format requires.
Status UnknownLayout(const std::string& directory, const std::string& problem) {
  std::string message = directory + ": " + problem + ", expected";
  const char* separator = " ";
  std::string data_sets;
  for (const SequenceFormatReader& reader : kSequenceFormats) {
    if (reader.needs[0] == '\0') {
      data_sets += (data_sets.empty() ? "" : ", ") + NameOf(reader.format);
      continue;
    }
    message += separator + std::string(reader.needs) + " (" + NameOf(reader.format) + ")";
    separator = ", or ";
  }
  message += ", or the files of a data set: " + data_sets;
  return Status::Error(message);
}

StatusOr<const SequenceFormatReader*> GuessFormat(const std::string& directory) {
  for (const SequenceFormatReader& reader : kSequenceFormats) {
    if (reader.recognizes(directory)) return &reader;
  }
  return UnknownLayout(directory,
                       IsEmptyFolder(directory) ? "the folder is empty"
                                                : "no layout of a depth sequence that is known");
}

// Keeps only the frames that the options select.
Status SelectFrames(const std::string& directory,
                    const SequenceOptions& options,
                    std::vector<SequenceEntry>* entries) {
  const int end = entries->back().number;
  if (options.first > end) {
    return Status::Error(directory + ": first is " + std::to_string(options.first) +
                         ", expected at most " + std::to_string(end) + ", the last frame there is");
  }
  const auto is_left_out = [&options](const SequenceEntry& entry) {
    return entry.number < options.first || (options.last >= 0 && entry.number > options.last);
  };
  const int begin = entries->front().number;
  entries->erase(std::remove_if(entries->begin(), entries->end(), is_left_out), entries->end());
  if (!entries->empty()) return Status::Ok();
  return Status::Error(directory + ": no frame from first = " + std::to_string(options.first) +
                       " to last = " + std::to_string(options.last) + ", expected some of the " +
                       "frames there are, " + std::to_string(begin) + " to " + std::to_string(end));
}

// Returns a sentence about gaps in the numbers, or an empty string. The smallest difference of two
// numbers does not count as a gap, since frames may be numbered in steps of ten.
std::string GapWarning(const std::vector<SequenceEntry>& entries) {
  int stride = entries.back().number - entries.front().number;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    stride = std::min(stride, entries[i].number - entries[i - 1].number);
  }
  int num_gaps = 0;
  std::string first_gap;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].number - entries[i - 1].number == stride) continue;
    ++num_gaps;
    if (num_gaps > 1) continue;
    first_gap = "frame " + std::to_string(entries[i - 1].number) + " is followed by " +
                std::to_string(entries[i].number);
  }
  if (num_gaps == 0) return "";
  const std::string count = num_gaps == 1 ? "1 gap" : std::to_string(num_gaps) + " gaps";
  return count + " in the frame numbers: " + first_gap +
         (num_gaps == 1 ? "" : " (the first of them)");
}

// Returns a sentence about the frames that lack something, or an empty string.
std::string LackWarning(const std::vector<SequenceEntry>& entries,
                        const char* what,
                        const std::function<bool(const SequenceEntry&)>& lacks) {
  constexpr std::size_t kMaxNamed = 5;
  std::size_t count = 0;
  std::string numbers;
  for (const SequenceEntry& entry : entries) {
    if (!lacks(entry)) continue;
    ++count;
    if (count <= kMaxNamed) numbers += (count == 1 ? "" : ", ") + std::to_string(entry.number);
  }
  if (count == 0) return "";
  return std::to_string(count) + " of " + std::to_string(entries.size()) + " frames without " +
         what + ": " + numbers + (count > kMaxNamed ? " ..." : "");
}

void AddWarnings(SequenceListing* listing) {
  const std::vector<SequenceEntry>& entries = listing->entries;
  std::vector<std::string> sentences = {GapWarning(entries)};
  if (listing->has_color) {
    sentences.push_back(LackWarning(
        entries, "colour", [](const SequenceEntry& entry) { return entry.color.empty(); }));
  }
  if (listing->has_masks) {
    sentences.push_back(LackWarning(entries,
                                    "a mask (all of their depth counts)",
                                    [](const SequenceEntry& entry) { return entry.mask.empty(); }));
  }
  if (listing->has_poses) {
    sentences.push_back(LackWarning(entries, "a given pose", [](const SequenceEntry& entry) {
      return !entry.world_from_camera.has_value();
    }));
  }
  for (std::string& sentence : sentences) {
    if (!sentence.empty()) listing->warnings.push_back(std::move(sentence));
  }
}

// Leaves in the listing either the images of depth or the rig.
Status ChooseDepth(const std::string& directory, DepthFrom from, SequenceListing* listing) {
  const bool has_images = !listing->entries.front().depth.empty();
  const bool has_stereo = listing->rig.has_value();
  if (!has_images && !has_stereo) {
    return Status::Error(directory +
                         ": no depth, expected images of depth, or pictures of two cameras and "
                         "their calibration");
  }
  const bool is_missing =
      from == DepthFrom::kStereo ? !has_stereo : from == DepthFrom::kImages && !has_images;
  if (is_missing) {
    return Status::Error(
        directory + ": depth_from is " + NameOf(from) + ", expected " +
        NameOf(has_images ? DepthFrom::kImages : DepthFrom::kStereo) + ": the sequence has " +
        (has_images ? "no calibrated pictures of two cameras" : "no images of depth"));
  }
  if (has_images && has_stereo && from == DepthFrom::kAuto) {
    listing->warnings.push_back(directory +
                                ": has both images of depth and the pictures of two cameras; the "
                                "images are used (depth_from=stereo takes the pictures)");
  }
  if (from == DepthFrom::kStereo || !has_images) {
    listing->camera.camera = listing->rig->left.pinhole;
    for (SequenceEntry& entry : listing->entries) entry.depth = {};
  } else {
    listing->rig.reset();
    for (SequenceEntry& entry : listing->entries) entry.right = {};
  }
  return Status::Ok();
}

// Keeps every step-th entry, beginning with the first one.
void Thin(int step, std::vector<SequenceEntry>* entries) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries->size(); i += static_cast<std::size_t>(step)) {
    if (i != kept) (*entries)[kept] = std::move((*entries)[i]);
    ++kept;
  }
  entries->resize(kept);
}

std::string Describe(const SequenceFormatReader& reader,
                     bool is_guessed,
                     const SequenceListing& listing) {
  std::ostringstream text;
  text << NameOf(reader.format);
  if (is_guessed) text << " (guessed: there is " << reader.sign << ")";
  const std::size_t num_frames = listing.entries.size();
  text << ", " << num_frames << (num_frames == 1 ? " frame: " : " frames: ")
       << listing.entries.front().number;
  if (num_frames > 1) text << " to " << listing.entries.back().number;
  text << ", " << listing.camera.camera.width << " x " << listing.camera.camera.height
       << " pixels, ";
  if (listing.rig.has_value()) {
    text << "stereo with a baseline of " << 1e3 * listing.rig->right_from_left.translation.norm()
         << " mm, " << (listing.is_rectified ? "rectified, " : "not rectified, ");
  } else {
    text << listing.camera.depth_units_per_metre << " depth units per metre, ";
  }
  text << (listing.has_color ? "" : "no ") << "colour, " << (listing.has_masks ? "" : "no ")
       << "masks, " << (listing.has_poses ? "" : "no ") << "poses";
  return text.str();
}

}  // namespace

const OptionTable<SequenceOptions>& SequenceOptions::Rows() {
  using O = SequenceOptions;
  static const OptionTable<O> rows({
      Row(&O::format, "format", "The layout of files.").Main(),
      Row(&O::first, "first", "The number of the first frame.").In(AtLeast(0)).Main(),
      Row(&O::last, "last", "The number of the last frame.")
          .In(AtLeast(-1))
          .Special(-1, "end")
          .OnResume(ResumeRule::kFree)
          .Main(),
      Row(&O::step, "step", "Every n-th frame is taken.").In(AtLeast(1)).Main(),
      Row(&O::depth_from,
          "depth_from",
          "Where depth comes from if a sequence has both images of depth and stereo pictures."),
      Row(&O::color, "color", "Read the colour pictures where there are some."),
      Row(&O::masks, "masks", "Leave out the pixels that the masks leave out."),
      Row(&O::mask_means, "mask_means", "What white pixels of a mask are; tools are left out."),
      Row(&O::depth_units_per_metre,
          "depth_units_per_metre",
          "The depth in the pictures divided by this is in metres.")
          .In(AtLeast(0))
          .Special(0, "automatic"),
  });
  return rows;
}

bool SequenceOptions::IsValid(std::string* error) const {
  if (!Rows().Check(*this, error)) return false;
  if (last < 0 || last >= first) return true;
  *error = "last is " + std::to_string(last) + ", expected at least first, which is " +
           std::to_string(first);
  return false;
}

StatusOr<std::unique_ptr<DepthSequence>> OpenSequence(const std::string& directory,
                                                      const SequenceOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error(error);
  if (!IsFolder(directory)) {
    return Status::Error(directory + ": " + (IsFile(directory) ? "is a file" : "no such folder") +
                         ", expected the folder of a depth sequence");
  }
  const bool is_guessed = options.format == SequenceFormat::kAuto;
  const StatusOr<const SequenceFormatReader*> reader =
      is_guessed ? GuessFormat(directory) : FindFormat(options.format);
  if (!reader.ok()) return reader.status();
  CHECK(*reader != nullptr) << "no reader of format " << static_cast<int>(options.format);
  StatusOr<SequenceListing> listing = (*reader)->list(directory);
  if (!listing.ok()) return listing.status();

  Status selected = SelectFrames(directory, options, &listing->entries);
  if (!selected.ok()) return selected;
  if (options.depth_units_per_metre > 0.0) {
    listing->camera.depth_units_per_metre = options.depth_units_per_metre;
  }
  Status depth = ChooseDepth(directory, options.depth_from, &*listing);
  if (!depth.ok()) return depth;
  if (!options.color && !listing->rig.has_value()) {
    listing->has_color = false;
    for (SequenceEntry& entry : listing->entries) entry.color = {};
  }
  if (!options.masks) {
    listing->has_masks = false;
    for (SequenceEntry& entry : listing->entries) entry.mask = {};
  }
  Status meaning = DecideMasks(options.mask_means, &*listing);
  if (!meaning.ok()) return meaning;
  if (!listing->entries.front().depth.empty()) {
    std::string sentence = ShortDepthWarning(listing->entries.front().depth.path,
                                             listing->camera.depth_units_per_metre);
    if (!sentence.empty()) listing->warnings.push_back(std::move(sentence));
  }
  AddWarnings(&*listing);
  Thin(options.step, &listing->entries);
  std::string description = Describe(**reader, is_guessed, *listing);
  return std::make_unique<DepthSequence>(std::move(*listing), std::move(description));
}

}  // namespace ceres_ed
