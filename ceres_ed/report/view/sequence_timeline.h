// The timeline of the tracking of a sequence.
#ifndef CERES_ED_REPORT_VIEW_SEQUENCE_TIMELINE_H_
#define CERES_ED_REPORT_VIEW_SEQUENCE_TIMELINE_H_

#include <ceres_ed/report/view/sequence_view.h>
#include <ceres_ed/report/view/timeline.h>

#include <vector>

namespace ceres_ed {

// Returns the frames of the run with their cameras and words, the pictures of its moments, and the
// tracks. The marks in the pictures are the points of the tracks or, without any, some of the map's
// points `ids` in the frames that see them.
Timeline MakeTimeline(const SequenceParts& parts, const std::vector<int>& ids);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_SEQUENCE_TIMELINE_H_
