// Pictures of a depth camera. Pixel (0, 0) is the upper left one, and integers are pixel centres.
#ifndef CERES_ED_GEOMETRY_IMAGES_H_
#define CERES_ED_GEOMETRY_IMAGES_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ceres_ed {

// A grid of pixels, row by row.
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
  bool Contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }

  // Column u, row v; both inside.
  const Pixel& operator()(int u, int v) const { return pixels_[Index(u, v)]; }
  Pixel& operator()(int u, int v) { return pixels_[Index(u, v)]; }

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

// A look at pixels that belong to somebody else, row by row without gaps: an Image, or what a
// camera or an array has in memory. Good for as long as they are.
template <typename Pixel>
class ImageView {
 public:
  ImageView() = default;
  // width, height >= 0.
  ImageView(const Pixel* pixels, int width, int height)
      : width_(width), height_(height), pixels_(pixels) {}
  ImageView(const Image<Pixel>& image)  // NOLINT(google-explicit-constructor)
      : ImageView(image.pixels().data(), image.width(), image.height()) {}
  // Null: empty.
  ImageView(const Image<Pixel>* image)  // NOLINT(google-explicit-constructor)
      : ImageView(image != nullptr ? ImageView(*image) : ImageView()) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  const Pixel* pixels() const { return pixels_; }

  // Column u, row v; both inside.
  const Pixel& operator()(int u, int v) const {
    return pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(u)];
  }

 private:
  int width_ = 0;
  int height_ = 0;
  const Pixel* pixels_ = nullptr;
};

// Depth along the optical axis, metres; 0 (or what is no number) where none was measured.
using DepthImage = Image<float>;
using DepthView = ImageView<float>;
// Red, green, blue.
using ColorImage = Image<std::array<std::uint8_t, 3>>;
using ColorView = ImageView<std::array<std::uint8_t, 3>>;
// Nonzero where a pixel counts.
using MaskImage = Image<std::uint8_t>;

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_IMAGES_H_
