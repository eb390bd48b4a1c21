#include "ceres_ed/io/sequence/mask_meaning.h"

#include <ceres_ed/io/sequence/picture_reader.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Returns the share of white pixels in the first, the middle and the last mask together; -1 if none
// can be read.
double WhiteShare(const std::vector<SequenceEntry>& entries) {
  std::vector<const SequenceEntry*> with_mask;
  for (const SequenceEntry& entry : entries) {
    if (!entry.mask.empty()) with_mask.push_back(&entry);
  }
  if (with_mask.empty()) return -1.0;
  std::size_t white = 0;
  std::size_t all = 0;
  for (const std::size_t i : std::set<std::size_t>{0, with_mask.size() / 2, with_mask.size() - 1}) {
    const StatusOr<MaskImage> mask = ReadMask(with_mask[i]->mask, MaskMeaning::kUsed);
    if (!mask.ok()) continue;
    all += mask->pixels().size();
    white += static_cast<std::size_t>(std::count_if(
        mask->pixels().begin(), mask->pixels().end(), [](auto pixel) { return pixel != 0; }));
  }
  return all == 0 ? -1.0 : static_cast<double>(white) / static_cast<double>(all);
}

std::string Percent(double share) {
  std::ostringstream text;
  text.precision(3);
  text << 100.0 * share << " %";
  return text.str();
}

}  // namespace

Status DecideMasks(MaskMeans means, SequenceListing* listing) {
  if (means != MaskMeans::kAuto) {
    listing->mask_meaning = means == MaskMeans::kTool ? MaskMeaning::kLeftOut : MaskMeaning::kUsed;
  }
  if (!listing->has_masks) return Status::Ok();
  const double white = WhiteShare(listing->entries);
  if (listing->mask_meaning == MaskMeaning::kUnknown) {
    const bool is_tissue = white > 0.5;
    listing->mask_meaning = is_tissue ? MaskMeaning::kUsed : MaskMeaning::kLeftOut;
    listing->warnings.push_back("masks: " + Percent(std::max(0.0, white)) +
                                " of the picture are white, so white is taken as " +
                                (is_tissue ? "tissue" : "the tool") +
                                " (mask_means=tool or mask_means=tissue says which)");
  }
  constexpr double kLittle = 0.2;
  const bool takes_white = listing->mask_meaning == MaskMeaning::kUsed;
  const double used = takes_white ? white : 1.0 - white;
  if (white >= 0.0 && used < kLittle) {
    listing->warnings.push_back("masks: they leave " + Percent(used) + " of the picture, as " +
                                (takes_white ? "white is taken as tissue; if it is the tool, "
                                               "mask_means=tool leaves it out"
                                             : "white is taken as the tool; if it is the tissue, "
                                               "mask_means=tissue keeps it"));
  }
  return Status::Ok();
}

}  // namespace ceres_ed
