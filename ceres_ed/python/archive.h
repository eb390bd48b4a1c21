// Writes values to bytes and reads them back, with the same bits. It serves pickles, which are read
// by the same version of the library.
#ifndef CERES_ED_PYTHON_ARCHIVE_H_
#define CERES_ED_PYTHON_ARCHIVE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed::python {

// The types whose bytes are copied.
template <typename T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Appends values to bytes. A struct has a function Fields(archive, value) that passes each of its
// members to the archive; the same function serves both archives.
class ArchiveWriter {
 public:
  static constexpr bool kReads = false;

  template <typename... T>
  void operator()(const T&... values) {
    (Put(values), ...);
  }
  void Raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  void Put(const T& value) {
    if constexpr (kIsPlain<T>) {
      Raw(&value, sizeof(T));
    } else {
      Fields(*this, value);
    }
  }

  std::string bytes_;
};

// Reads the values in the order in which they were written. Throws std::invalid_argument if the
// bytes end too early or a number is out of range.
class ArchiveReader {
 public:
  static constexpr bool kReads = true;

  explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}

  template <typename... T>
  void operator()(T&... values) {
    (Get(values), ...);
  }
  void Raw(void* data, std::size_t size) {
    Require(size <= rest_.size());
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  // Reads the number of entries that follow, each of which takes at least a byte.
  std::size_t Count() {
    std::uint64_t count = 0;
    Raw(&count, sizeof(count));
    Require(count <= rest_.size());
    return static_cast<std::size_t>(count);
  }
  static void Require(bool is_so) {
    if (!is_so) throw std::invalid_argument("the pickle is damaged");
  }
  bool empty() const { return rest_.empty(); }

 private:
  template <typename T>
  void Get(T& value) {
    if constexpr (kIsPlain<T>) {
      Raw(&value, sizeof(T));
    } else {
      Fields(*this, value);
    }
  }

  std::string_view rest_;
};

// Writes the number of entries of a container, or reads it and gives the container that size.
template <typename Archive, typename Container>
void CountOf(Archive& archive, Container& container) {
  if constexpr (Archive::kReads) {
    container.resize(archive.Count());
  } else {
    archive(static_cast<std::uint64_t>(container.size()));
  }
}

template <typename T, std::size_t kSize>
void Fields(ArchiveWriter& archive, const std::array<T, kSize>& values) {
  for (const T& value : values) archive(value);
}
template <typename T, std::size_t kSize>
void Fields(ArchiveReader& archive, std::array<T, kSize>& values) {
  for (T& value : values) archive(value);
}

inline void Fields(ArchiveWriter& archive, const std::string& text) {
  CountOf(archive, text);
  archive.Raw(text.data(), text.size());
}
inline void Fields(ArchiveReader& archive, std::string& text) {
  CountOf(archive, text);
  archive.Raw(text.data(), text.size());
}

// Vectors of numbers are written in one piece.
template <typename T>
void Fields(ArchiveWriter& archive, const std::vector<T>& values) {
  CountOf(archive, values);
  if constexpr (kIsPlain<T>) {
    archive.Raw(values.data(), values.size() * sizeof(T));
  } else {
    for (const T& value : values) archive(value);
  }
}
template <typename T>
void Fields(ArchiveReader& archive, std::vector<T>& values) {
  CountOf(archive, values);
  if constexpr (kIsPlain<T>) {
    archive.Raw(values.data(), values.size() * sizeof(T));
  } else {
    for (T& value : values) archive(value);
  }
}

template <typename Key, typename T>
void Fields(ArchiveWriter& archive, const std::map<Key, T>& entries) {
  CountOf(archive, entries);
  for (const auto& [key, value] : entries) archive(key, value);
}
template <typename Key, typename T>
void Fields(ArchiveReader& archive, std::map<Key, T>& entries) {
  for (std::size_t count = archive.Count(); count > 0; --count) {
    Key key;
    archive(key);
    archive(entries[key]);
  }
}

// Matrices of a fixed size.
template <typename Archive, typename Scalar, int kRows, int kColumns, int kOptions>
void Fields(Archive& archive, Eigen::Matrix<Scalar, kRows, kColumns, kOptions>& matrix) {
  archive.Raw(matrix.data(), sizeof(Scalar) * kRows * kColumns);
}
template <typename Archive, typename Scalar, int kRows, int kColumns, int kOptions>
void Fields(Archive& archive, const Eigen::Matrix<Scalar, kRows, kColumns, kOptions>& matrix) {
  archive.Raw(matrix.data(), sizeof(Scalar) * kRows * kColumns);
}
inline void Fields(ArchiveWriter& archive, const Eigen::Quaterniond& rotation) {
  archive(rotation.coeffs());
}
inline void Fields(ArchiveReader& archive, Eigen::Quaterniond& rotation) {
  archive(rotation.coeffs());
}

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_ARCHIVE_H_
