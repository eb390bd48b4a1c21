#include "ceres_ed/io/npy_rows.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/npy_header.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

// Writes or reads all bytes, with pwrite() or pread(). Returns 0, or the system's error; a file
// that ends early is EIO.
template <typename Transfer, typename Byte>
int TransferAll(Transfer transfer, int descriptor, Byte* bytes, std::size_t size, std::size_t at) {
  while (size > 0) {
    const ssize_t done = transfer(descriptor, bytes, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return errno;
    if (done == 0) return EIO;
    bytes += done;
    at += static_cast<std::size_t>(done);
    size -= static_cast<std::size_t>(done);
  }
  return 0;
}

}  // namespace

StatusOr<std::unique_ptr<NpyRowsWriter>> NpyRowsWriter::Create(
    const std::string& path, const std::vector<std::size_t>& shape) {
  std::unique_ptr<NpyRowsWriter> writer(new NpyRowsWriter);
  writer->path_ = path;
  const std::string temporary = path + TemporaryEnding();
  writer->descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (writer->descriptor_ < 0) return WriteError(path, errno);
  writer->temporary_path_ = temporary;
  const std::string header = MakeNpyHeader("<f8", shape);
  writer->begin_ = header.size();
  writer->row_bytes_ = sizeof(double);
  for (std::size_t axis = 1; axis < shape.size(); ++axis) writer->row_bytes_ *= shape[axis];
  int error =
      TransferAll(::pwrite, writer->descriptor_, header.data(), header.size(), std::size_t{0});
  const auto size = static_cast<off_t>(writer->begin_ + shape[0] * writer->row_bytes_);
  if (error == 0) error = ::posix_fallocate(writer->descriptor_, 0, size);
  if (error != 0) return WriteError(path, error);
  return writer;
}

NpyRowsWriter::~NpyRowsWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

Status NpyRowsWriter::Write(std::size_t row, const double* values) {
  const int error = TransferAll(::pwrite,
                                descriptor_,
                                reinterpret_cast<const char*>(values),
                                row_bytes_,
                                begin_ + row * row_bytes_);
  return error == 0 ? Status::Ok() : WriteError(path_, error);
}

Status NpyRowsWriter::Commit() {
  const bool closed = ::close(descriptor_) == 0;
  descriptor_ = -1;
  if (!closed || std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    return WriteError(path_, errno);
  }
  temporary_path_.clear();
  return Status::Ok();
}

StatusOr<std::unique_ptr<NpyRowsReader>> NpyRowsReader::Open(const std::string& path) {
  std::unique_ptr<NpyRowsReader> reader(new NpyRowsReader);
  reader->path_ = path;
  reader->descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info;
  if (reader->descriptor_ < 0 || ::fstat(reader->descriptor_, &info) != 0) {
    return ReadError(path, errno);
  }
  const auto file_size = static_cast<std::size_t>(info.st_size);
  constexpr std::size_t kLongestHeader = 4096;
  std::string start(std::min(file_size, kLongestHeader), '\0');
  const int error =
      TransferAll(::pread, reader->descriptor_, start.data(), start.size(), std::size_t{0});
  if (error != 0) return ReadError(path, error);
  StatusOr<NpyHeader> header = ParseNpyHeader(path, start);
  if (!header.ok()) return header.status();
  if (header->kind != 'f' || header->bytes != sizeof(double) || header->is_big_endian ||
      header->is_fortran || header->shape.empty()) {
    return Status::Error(path + ": expected rows of float64, little endian, in C order");
  }
  reader->begin_ = header->begin;
  reader->shape_ = header->shape;
  std::size_t count = 1;
  for (const std::size_t size : reader->shape_) {
    if (size > 0 && count > kMostNpyElements / size) {
      return Status::Error(path + ": the shape is " + NpyShapeText(reader->shape_) +
                           ", expected fewer numbers");
    }
    count *= size;
  }
  reader->row_size_ = reader->shape_[0] == 0 ? 0 : count / reader->shape_[0];
  if (file_size - header->begin != count * sizeof(double)) {
    return Status::Error(path + ": " + std::to_string(file_size - header->begin) +
                         " bytes of numbers, expected " + std::to_string(count * sizeof(double)) +
                         " for the shape " + NpyShapeText(reader->shape_));
  }
  return reader;
}

NpyRowsReader::~NpyRowsReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status NpyRowsReader::Read(std::size_t row,
                           std::size_t first,
                           std::size_t count,
                           double* values) const {
  const int error = TransferAll(::pread,
                                descriptor_,
                                reinterpret_cast<char*>(values),
                                count * sizeof(double),
                                begin_ + (row * row_size_ + first) * sizeof(double));
  return error == 0 ? Status::Ok() : ReadError(path_, error);
}

}  // namespace ceres_ed
