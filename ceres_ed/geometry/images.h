// Images of a depth camera. Pixel (0, 0) is the upper left one, and integer coordinates are pixel
// centres.
#ifndef CERES_ED_GEOMETRY_IMAGES_H_
#define CERES_ED_GEOMETRY_IMAGES_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ceres_ed {

// A grid of pixels that owns its memory, stored row by row.
template <typename Pixel>
class Image {
 public:
  Image() = default;
  // width, height >= 0.
  Image(int width, int height, Pixel value = Pixel())
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  // Returns whether column u and row v are inside the image.
  bool Contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }

  // The pixel in column u and row v, which must be inside the image.
  const Pixel& operator()(int u, int v) const { return pixels_[Index(u, v)]; }
  Pixel& operator()(int u, int v) { return pixels_[Index(u, v)]; }

  // All pixels, row by row.
  const std::vector<Pixel>& pixels() const { return pixels_; }
  std::vector<Pixel>& pixels() { return pixels_; }

 private:
  std::size_t Index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> pixels_;
};

// A read-only view of pixels that somebody else owns, stored row by row without gaps. They may
// belong to an Image, or be the memory of a camera or of an array. The view must not outlive them.
template <typename Pixel>
class ImageView {
 public:
  ImageView() = default;
  // width, height >= 0.
  ImageView(const Pixel* pixels, int width, int height)
      : width_(width), height_(height), pixels_(pixels) {}
  ImageView(const Image<Pixel>& image)  // NOLINT(google-explicit-constructor)
      : ImageView(image.pixels().data(), image.width(), image.height()) {}
  // A null pointer gives an empty view.
  ImageView(const Image<Pixel>* image)  // NOLINT(google-explicit-constructor)
      : ImageView(image != nullptr ? ImageView(*image) : ImageView()) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  const Pixel* pixels() const { return pixels_; }

  // The pixel in column u and row v, which must be inside the image.
  const Pixel& operator()(int u, int v) const {
    return pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(u)];
  }

 private:
  int width_ = 0;
  int height_ = 0;
  const Pixel* pixels_ = nullptr;
};

// The depth along the optical axis in metres. It is 0 (or not a number) where none was measured.
using DepthImage = Image<float>;
using DepthView = ImageView<float>;
// Red, green and blue, each in 0 to 255.
using ColorImage = Image<std::array<std::uint8_t, 3>>;
using ColorView = ImageView<std::array<std::uint8_t, 3>>;
// Nonzero for pixels that are used.
using MaskImage = Image<std::uint8_t>;

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_IMAGES_H_
