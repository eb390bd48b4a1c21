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

// How a file stores depth. Whatever it is, metres = stored number / units per metre.
enum class DepthEncoding {
  // A PNG (or another picture) with 8 or 16 bits, 0 = none.
  kPicture,
  // A TIFF with one channel of 16 bits or of floats, or with the three channels X Y Z of floats.
  // Numbers that are not finite, and 0, mean none.
  kTiff,
  // A .npy array of numbers, rows x columns. Numbers that are not finite, and 0, mean none.
  kNumpy,
};

// What a pixel of a mask that is not zero means.
enum class MaskMeaning { kUsed, kLeftOut };

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_SOURCE_H_
