// Which colour of a mask is tissue.
#ifndef CERES_ED_IO_SEQUENCE_MASK_MEANING_H_
#define CERES_ED_IO_SEQUENCE_MASK_MEANING_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// Sets listing->mask_meaning to what `means` says; with kAuto it stays as the layout has it. If the
// layout does not say, masks whose white pixels are more than half of the picture are masks of
// tissue, and a warning says what was assumed. Another warning says so if the masks leave little of
// the picture, as those of the other colour would. The first, the middle and the last mask decide.
Status DecideMasks(MaskMeans means, SequenceListing* listing);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_MASK_MEANING_H_
