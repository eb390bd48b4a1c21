// The rows of frames.csv for the frames of a tracker.
#ifndef CERES_ED_PIPELINE_SLAM_FRAME_RECORDS_H_
#define CERES_ED_PIPELINE_SLAM_FRAME_RECORDS_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Returns the row of a frame that `slam` has processed. t_total, t_load and t_write remain 0.
FrameRecord MakeFrameRecord(const FrameReport& report, const DeformableSlam& slam);

// Returns whether a frame has this status.
bool Is(const FrameRecord& record, FrameStatus status);

// Returns whether camera and tissue are known in the frame.
bool HasPose(const FrameRecord& record);

// Returns the number of frames with this status.
int CountFrames(const std::vector<FrameRecord>& records, FrameStatus status);

// Returns the values of a column in the frames whose camera is known.
std::vector<double> ColumnOf(const std::vector<FrameRecord>& records, const std::string& column);

// Saves the rows, or loads them.
void ExchangeRecords(std::vector<FrameRecord>* records, CheckpointArchive* archive);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_FRAME_RECORDS_H_
