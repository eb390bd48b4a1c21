// Reads and writes arrays of numpy (.npy).
#ifndef CERES_ED_IO_NPY_FILE_H_
#define CERES_ED_IO_NPY_FILE_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// An array of numbers.
struct NpyArray {
  // The number of elements along each axis; empty for a single number.
  std::vector<std::size_t> shape;
  // The elements in C order: the last axis changes fastest. Whole numbers are converted; every
  // float32 and every integer up to 2^53 keeps its value.
  std::vector<double> values;

  // Returns a text such as "(40, 17)".
  std::string ShapeText() const;
};

// Reads an array of floats (32 or 64 bits), of signed or unsigned integers (8 to 64 bits), or of
// bools. The byte order and the order of axes in the file are respected. Errors name the file: it
// can't be read, has another type, or its size does not fit its header.
StatusOr<NpyArray> ReadNpyFile(const std::string& path);

// Write an array of float64 (or of float32) in little endian and C order. The number of values
// must be the product of the shape.
Status WriteNpyFile(const std::string& path, const NpyArray& array);
Status WriteNpyFileAsFloat(const std::string& path, const NpyArray& array);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_NPY_FILE_H_
