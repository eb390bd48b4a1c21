// Arrays of numpy (.npy) that are larger than memory: written and read row by row.
#ifndef CERES_ED_IO_NPY_ROWS_H_
#define CERES_ED_IO_NPY_ROWS_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Writes an array of float64 (little endian, C order) whose rows come one after the other. The file
// has its whole length from the start, so that a full disk is known before the work, and it gets
// its name when it is complete.
class NpyRowsWriter {
 public:
  // `shape` has at least one axis; a row is what has one index along the first axis. The error
  // gives the system's reason.
  static StatusOr<std::unique_ptr<NpyRowsWriter>> Create(const std::string& path,
                                                         const std::vector<std::size_t>& shape);
  // Removes a file that is not complete.
  ~NpyRowsWriter();
  NpyRowsWriter(const NpyRowsWriter&) = delete;
  NpyRowsWriter& operator=(const NpyRowsWriter&) = delete;

  // Writes a row: as many numbers as a row has.
  Status Write(std::size_t row, const double* values);
  // Completes the file under its name.
  Status Commit();

 private:
  NpyRowsWriter() = default;

  std::string path_;
  std::string temporary_path_;
  int descriptor_ = -1;
  std::size_t begin_ = 0;
  std::size_t row_bytes_ = 0;
};

// Reads parts of the rows of an array of float64 (little endian, C order), as NpyRowsWriter and
// numpy.save write it.
class NpyRowsReader {
 public:
  // The error names the file: it can't be read, is no such array, or its size does not fit.
  static StatusOr<std::unique_ptr<NpyRowsReader>> Open(const std::string& path);
  ~NpyRowsReader();
  NpyRowsReader(const NpyRowsReader&) = delete;
  NpyRowsReader& operator=(const NpyRowsReader&) = delete;

  const std::vector<std::size_t>& shape() const { return shape_; }
  // The number of values in a row.
  std::size_t row_size() const { return row_size_; }

  // Copies `count` values of a row from number `first` on. May be called from several threads.
  Status Read(std::size_t row, std::size_t first, std::size_t count, double* values) const;

 private:
  NpyRowsReader() = default;

  std::string path_;
  int descriptor_ = -1;
  std::size_t begin_ = 0;
  std::size_t row_size_ = 0;
  std::vector<std::size_t> shape_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_NPY_ROWS_H_
