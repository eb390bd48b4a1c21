// The header of a file of numpy.
#ifndef CERES_ED_IO_NPY_HEADER_H_
#define CERES_ED_IO_NPY_HEADER_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// The type and layout of the numbers of a file.
struct NpyHeader {
  // One of f, i, u, b.
  char kind = 'f';
  // The bytes of a number.
  std::size_t bytes = 0;
  bool is_big_endian = false;
  bool is_fortran = false;
  std::vector<std::size_t> shape;
  // The place in the file where the numbers begin.
  std::size_t begin = 0;
};

// Larger arrays are no input of this library.
inline constexpr std::size_t kMostNpyElements = std::size_t{1} << 38;

// Parses the header at the beginning of `bytes`, which has at least the header. Errors begin with
// `path`.
StatusOr<NpyHeader> ParseNpyHeader(const std::string& path, const std::string& bytes);

// Returns a shape as numpy writes it, such as "(40, 17)".
std::string NpyShapeText(const std::vector<std::size_t>& shape);

// Returns the header of an array in C order of the type `type`, such as "<f8".
std::string MakeNpyHeader(const char* type, const std::vector<std::size_t>& shape);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_NPY_HEADER_H_
