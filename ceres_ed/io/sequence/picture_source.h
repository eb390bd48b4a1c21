// Where the picture of a frame is: a file, or a part of a file.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_SOURCE_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_SOURCE_H_

#include <string>

namespace ceres_ed {

// The part of a picture of a file that counts. Stereo recordings often have both pictures in one:
// left above right, side by side, or row by row in turn.
enum class PicturePart { kWhole, kTop, kBottom, kLeft, kRight, kEvenRows, kOddRows };

// One picture. A half has half of the rows or of the columns of the file, and is not resized.
struct PictureSource {
  // The file; empty if there is no picture.
  std::string path;
  // The number of the frame in a video, 0 for the first one; -1 for a file of one picture.
  int video_frame = -1;
  PicturePart part = PicturePart::kWhole;

  bool empty() const { return path.empty(); }
};

// What a pixel of a mask that is not zero means: tissue, which is used, or a tool, which is left
// out. Some layouts say neither.
enum class MaskMeaning { kUsed, kLeftOut, kUnknown };

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_SOURCE_H_
