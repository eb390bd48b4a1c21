#include "ceres_ed/report/picture/png.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace ceres_ed {

bool HasPictures() { return true; }

std::string EncodePng(const ColorImage& picture) {
  std::string bytes;
  if (picture.empty()) return bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
  };
  constexpr int kChannels = 3;
  stbi_write_png_to_func(append,
                         &bytes,
                         picture.width(),
                         picture.height(),
                         kChannels,
                         picture.pixels().data(),
                         kChannels * picture.width());
  return bytes;
}

}  // namespace ceres_ed
