#include "ceres_ed/io/sequence/picture_reader.h"

#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/video/video_file.h>

#include <string>
#include <utility>

namespace ceres_ed {
namespace {

// The rows and columns of a part: `step` is the distance of its rows in the file.
struct PartOfPicture {
  int u = 0;
  int v = 0;
  int width = 0;
  int height = 0;
  int step = 1;
};

PartOfPicture PartOf(PicturePart part, int width, int height) {
  switch (part) {
    case PicturePart::kWhole:
      return {0, 0, width, height, 1};
    case PicturePart::kTop:
      return {0, 0, width, height / 2, 1};
    case PicturePart::kBottom:
      return {0, height / 2, width, height / 2, 1};
    case PicturePart::kLeft:
      return {0, 0, width / 2, height, 1};
    case PicturePart::kRight:
      return {width / 2, 0, width / 2, height, 1};
    case PicturePart::kEvenRows:
      return {0, 0, width, height / 2, 2};
    case PicturePart::kOddRows:
      return {0, 1, width, height / 2, 2};
  }
  return {0, 0, width, height, 1};
}

// Returns the part of the picture that counts. It is an error if two halves are not of one size.
template <typename Pixel>
StatusOr<Image<Pixel>> Cut(const PictureSource& source, StatusOr<Image<Pixel>> read) {
  if (!read.ok() || source.part == PicturePart::kWhole) return read;
  const PartOfPicture part = PartOf(source.part, read->width(), read->height());
  const bool by_columns = source.part == PicturePart::kLeft || source.part == PicturePart::kRight;
  const int size = by_columns ? read->width() : read->height();
  if (size % 2 != 0) {
    return Status::Error(source.path + ": " + std::to_string(size) +
                         (by_columns ? " columns" : " rows") +
                         ", expected an even number: it holds a left and a right picture");
  }
  Image<Pixel> cut(part.width, part.height);
  for (int v = 0; v < part.height; ++v) {
    for (int u = 0; u < part.width; ++u) cut(u, v) = (*read)(part.u + u, part.v + part.step * v);
  }
  return cut;
}

// Returns all of the picture that a source is a part of.
StatusOr<ColorImage> ReadWhole(const PictureSource& source) {
  return source.video_frame >= 0 ? ReadVideoFrame(source.path, source.video_frame)
                                 : ReadColorImage(source.path);
}

}  // namespace

StatusOr<ColorImage> ReadColor(const PictureSource& source) {
  return Cut(source, ReadWhole(source));
}

StatusOr<MaskImage> ReadMask(const PictureSource& source, MaskMeaning meaning) {
  StatusOr<MaskImage> mask = Cut(source, ReadMaskImage(source.path));
  if (mask.ok() && meaning == MaskMeaning::kLeftOut) {
    for (auto& pixel : mask->pixels()) pixel = pixel == 0 ? 1 : 0;
  }
  return mask;
}

StatusOr<DepthImage> ReadDepth(const PictureSource& source,
                               double units_per_metre,
                               int* saturated) {
  return Cut(source, ReadDepthImage(source.path, units_per_metre, saturated));
}

}  // namespace ceres_ed
