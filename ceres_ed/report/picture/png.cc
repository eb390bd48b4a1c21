#include "ceres_ed/report/picture/png.h"

#include <ceres_ed/report/picture/jpeg.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace ceres_ed {

bool HasPictures() { return true; }

namespace {

constexpr int kChannels = 3;

void Append(void* to, void* data, int size) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
}

}  // namespace

std::string EncodePng(const ColorImage& picture) {
  std::string bytes;
  if (picture.empty()) return bytes;
  stbi_write_png_to_func(Append,
                         &bytes,
                         picture.width(),
                         picture.height(),
                         kChannels,
                         picture.pixels().data(),
                         kChannels * picture.width());
  return bytes;
}

std::string EncodeJpeg(const ColorImage& picture) {
  constexpr int kQuality = 75;
  std::string bytes;
  if (picture.empty()) return bytes;
  stbi_write_jpg_to_func(Append,
                         &bytes,
                         picture.width(),
                         picture.height(),
                         kChannels,
                         picture.pixels().data(),
                         kQuality);
  return bytes;
}

}  // namespace ceres_ed
