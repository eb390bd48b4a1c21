#include "ceres_ed/io/picture_header.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>

namespace ceres_ed {
namespace {

struct PromisedSize {
  double width = 0.0;
  double height = 0.0;
  // The smallest number of bits of the file that a pixel can take.
  double least_bits = 0.0;
};

// Deflate makes at most 1032 bytes of one (RFC 1951: 258 bytes of two bits).
constexpr double kDeflateRatio = 1032.0;
// A coded block of a JPEG has 64 pixels and at least one bit. The other components may be coarser
// than this one, or it than them, by up to four in each direction.
constexpr double kLeastJpegBits = 1.0 / (64.0 * 16.0);
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

// Reads whole numbers of a file; 0 beyond its end.
class Numbers {
 public:
  Numbers(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  std::size_t At(std::size_t begin, std::size_t size) const {
    if (begin > bytes_.size() || bytes_.size() - begin < size) return 0;
    std::size_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = begin + (big_endian_ ? i : size - 1 - i);
      number = number << 8U | static_cast<std::uint8_t>(bytes_[at]);
    }
    return number;
  }

 private:
  const std::string_view bytes_;
  const bool big_endian_;
};

// Of the chunk IHDR, which must be the first: length, name, width, height, bits, kind of colour.
std::optional<PromisedSize> SizeOfPng(std::string_view bytes) {
  const Numbers numbers(bytes, true);
  PromisedSize size;
  size.width = static_cast<double>(numbers.At(16, 4));
  size.height = static_cast<double>(numbers.At(20, 4));
  size.least_bits =
      static_cast<double>(std::max<std::size_t>(numbers.At(24, 1), 1)) / kDeflateRatio;
  return size;
}

// Of the segment SOF: bits, height, width. Ahead of it are others: a marker and the length of what
// follows.
std::optional<PromisedSize> SizeOfJpeg(std::string_view bytes) {
  const Numbers numbers(bytes, true);
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    if (numbers.At(at, 1) != 0xff) {
      // Decoders skip what is no marker.
      ++at;
      continue;
    }
    const std::size_t marker = numbers.At(at + 1, 1);
    const bool has_length =
        marker != 0xff && marker != 0x00 && marker != 0x01 && !(marker >= 0xd0 && marker <= 0xd8);
    if (!has_length) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      return PromisedSize{static_cast<double>(numbers.At(at + 7, 2)),
                          static_cast<double>(numbers.At(at + 5, 2)),
                          kLeastJpegBits};
    }
    at += 2 + std::max<std::size_t>(numbers.At(at + 2, 2), 2);
  }
  return std::nullopt;
}

// Of the first folder of tags: number, type, count and value, of which these are width and height
// of the picture and of its tiles. Compressed strips may be shorter by any factor.
std::optional<PromisedSize> SizeOfTiff(std::string_view bytes) {
  const Numbers numbers(bytes, bytes[0] == 'M');
  constexpr std::size_t kShort = 3;
  const std::size_t folder = numbers.At(4, 4);
  const std::size_t count = numbers.At(folder, 2);
  PromisedSize size;
  for (std::size_t i = 0; i < count && folder + 12 * i < bytes.size(); ++i) {
    const std::size_t entry = folder + 2 + 12 * i;
    const std::size_t tag = numbers.At(entry, 2);
    const auto value =
        static_cast<double>(numbers.At(entry + 8, numbers.At(entry + 2, 2) == kShort ? 2 : 4));
    if (tag == 256 || tag == 322) size.width = std::max(size.width, value);
    if (tag == 257 || tag == 323) size.height = std::max(size.height, value);
  }
  return size;
}

bool BeginsWith(std::string_view bytes, std::string_view start) {
  return bytes.substr(0, start.size()) == start;
}

std::string SizeText(const PromisedSize& size) {
  std::ostringstream text;
  text.precision(17);
  text << size.width << " x " << size.height;
  return text.str();
}

}  // namespace

Status CheckPictureHeader(const std::string& path, std::string_view bytes) {
  const bool is_tiff = BeginsWith(bytes, {"II*\0", 4}) || BeginsWith(bytes, {"MM\0*", 4});
  std::optional<PromisedSize> size;
  if (BeginsWith(bytes, kPngSignature)) {
    size = SizeOfPng(bytes);
  } else if (BeginsWith(bytes, "\xff\xd8\xff")) {
    size = SizeOfJpeg(bytes);
  } else if (is_tiff) {
    size = SizeOfTiff(bytes);
  } else {
    return Status::Error(path + ": no picture that can be read, expected a PNG, JPEG or TIFF");
  }
  if (!size.has_value()) return Status::Ok();
  const double pixels = size->width * size->height;
  if (pixels > kMostPixels) {
    return Status::Error(path + ": its header promises " + SizeText(*size) +
                         " pixels, expected at most 8192 x 8192 of them");
  }
  constexpr double kBits = 8.0;
  if (pixels * size->least_bits > kBits * static_cast<double>(bytes.size())) {
    return Status::Error(path + ": its header promises " + SizeText(*size) + " pixels, which " +
                         std::to_string(bytes.size()) +
                         " bytes cannot hold: it is damaged, or was not written whole");
  }
  return Status::Ok();
}

}  // namespace ceres_ed
