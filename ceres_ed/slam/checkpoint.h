// The state of a run as bytes, from which the run continues as if it had never stopped.
//
// A class whose state is kept from frame to frame has a function `void Exchange(CheckpointArchive*
// archive)`. It lists the members once, and the same list saves and loads them, so that the two
// cannot differ. If a new member affects later frames, add it to this list and increase
// kCheckpointVersion.
#ifndef CERES_ED_SLAM_CHECKPOINT_H_
#define CERES_ED_SLAM_CHECKPOINT_H_

#include <ceres_ed/util/chunked_rows.h>
#include <ceres_ed/util/status.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The version of the lists in Exchange(). Checkpoints of other versions are refused.
inline constexpr int kCheckpointVersion = 7;

// Saves or loads named values. Loading never crashes: if a value is missing or has another size,
// its variable does not change and status() becomes an error.
class CheckpointArchive {
 public:
  virtual ~CheckpointArchive() = default;

  // Returns true if values are saved, and false if they are loaded.
  virtual bool saving() const = 0;
  // The names up to the matching Leave() belong to `group`.
  virtual void Enter(const std::string& group) = 0;
  virtual void Leave() = 0;

  // Exchange a list of numbers or bytes, or a text. Loading resizes a list to the size that was
  // saved.
  virtual void Array(const std::string& name, std::vector<double>* values) = 0;
  virtual void Array(const std::string& name, std::vector<int>* values) = 0;
  virtual void Array(const std::string& name, std::vector<std::uint8_t>* values) = 0;
  virtual void Text(const std::string& name, std::string* text) = 0;

  // Exchange a single value.
  void Value(const std::string& name, double* value) { Fixed<double>(name, value, 1); }
  void Value(const std::string& name, int* value) { Fixed<int>(name, value, 1); }
  void Value(const std::string& name, Eigen::Vector3d* value) {
    Fixed<double>(name, value->data(), 3);
  }
  void Value(const std::string& name, Eigen::Quaterniond* value) {
    Fixed<double>(name, value->coeffs().data(), 4);
  }

  // Exchanges one member of every row; `rows` must already have its final size. `member(row)` must
  // return a reference to a double, an int, or a fixed-size vector or array of numbers or bytes.
  template <typename Row, typename Member>
  void Column(const std::string& name, std::vector<Row>* rows, Member member) {
    using Field = Span<std::remove_reference_t<std::invoke_result_t<Member, Row&>>>;
    std::vector<typename Field::Scalar> flat;
    if (saving()) {
      for (Row& row : *rows) {
        const auto* values = Field::Data(&member(row));
        flat.insert(flat.end(), values, values + Field::kSize);
      }
    }
    Array(name, &flat);
    if (saving() || !CheckSize(name, flat.size(), rows->size() * Field::kSize)) return;
    const auto* values = flat.data();
    for (Row& row : *rows) {
      std::copy_n(values, Field::kSize, Field::Data(&member(row)));
      values += Field::kSize;
    }
  }

  // Exchange rows as they lie in memory, which must have no padding. They are meant for many rows
  // that already have a compact form. Loading sets the number of rows to the number that was saved.
  template <typename T>
  void Rows(const std::string& name, std::vector<T>* rows) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::uint8_t> bytes;
    if (saving()) {
      bytes.resize(rows->size() * sizeof(T));
      if (!bytes.empty()) std::memcpy(bytes.data(), rows->data(), bytes.size());
    }
    Array(name, &bytes);
    if (saving() || !CheckWhole(name, bytes.size(), sizeof(T))) return;
    rows->resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(rows->data(), bytes.data(), bytes.size());
  }
  template <typename T>
  void Rows(const std::string& name, ChunkedRows<T>* rows) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t size = static_cast<std::size_t>(rows->width()) * sizeof(T);
    std::vector<std::uint8_t> bytes;
    if (saving()) {
      bytes.resize(rows->size() * size);
      for (std::size_t r = 0; r < rows->size(); ++r) {
        std::memcpy(&bytes[r * size], (*rows)[r], size);
      }
    }
    Array(name, &bytes);
    if (saving() || !CheckWhole(name, bytes.size(), size)) return;
    rows->Resize(bytes.size() / size);
    for (std::size_t r = 0; r < rows->size(); ++r) std::memcpy((*rows)[r], &bytes[r * size], size);
  }

  // Returns ok, or the first error that was found.
  const Status& status() const { return status_; }
  // Notes that a value that was loaded makes no sense. The message names it, and what was expected.
  void Fail(const std::string& message) {
    if (status_.ok()) status_ = Status::Error(message);
  }

 private:
  // How a member lies in memory.
  template <typename T>
  struct Span {
    using Scalar = T;
    static constexpr std::size_t kSize = 1;
    static T* Data(T* value) { return value; }
  };
  template <typename T, int kRows, int kColumns>
  struct Span<Eigen::Matrix<T, kRows, kColumns>> {
    using Scalar = T;
    static constexpr std::size_t kSize = kRows * kColumns;
    static T* Data(Eigen::Matrix<T, kRows, kColumns>* value) { return value->data(); }
  };
  template <typename T, std::size_t kCount>
  struct Span<T[kCount]> {
    using Scalar = T;
    static constexpr std::size_t kSize = kCount;
    static T* Data(T (*values)[kCount]) { return *values; }
  };
  template <typename T, std::size_t kCount>
  struct Span<std::array<T, kCount>> {
    using Scalar = T;
    static constexpr std::size_t kSize = kCount;
    static T* Data(std::array<T, kCount>* value) { return value->data(); }
  };

  bool CheckSize(const std::string& name, std::size_t size, std::size_t expected) {
    if (size == expected) return true;
    Fail(name + " has " + std::to_string(size) + " numbers, expected " + std::to_string(expected));
    return false;
  }

  bool CheckWhole(const std::string& name, std::size_t bytes, std::size_t row) {
    if (bytes % row == 0) return true;
    Fail(name + " has " + std::to_string(bytes) + " bytes, expected a multiple of " +
         std::to_string(row));
    return false;
  }

  template <typename T>
  void Fixed(const std::string& name, T* values, std::size_t count) {
    std::vector<T> flat(values, values + count);
    Array(name, &flat);
    if (!saving() && CheckSize(name, flat.size(), count)) {
      std::copy(flat.begin(), flat.end(), values);
    }
  }

  Status status_ = Status::Ok();
};

// Collects the values as bytes. A large map is therefore in memory only twice.
class CheckpointWriter : public CheckpointArchive {
 public:
  CheckpointWriter();

  // Returns the bytes in the format CBOR, with a version and a checksum. Every group must have been
  // left. Call it only once.
  std::string TakeBytes();

  bool saving() const override { return true; }
  void Enter(const std::string& group) override;
  void Leave() override;
  void Array(const std::string& name, std::vector<double>* values) override;
  void Array(const std::string& name, std::vector<int>* values) override;
  void Array(const std::string& name, std::vector<std::uint8_t>* values) override;
  void Text(const std::string& name, std::string* text) override;

 private:
  std::string bytes_;
  // The position at which the payload starts.
  std::size_t payload_at_ = 0;
  int depth_ = 0;
};

// Returns the values that a CheckpointWriter has collected.
class CheckpointReader : public CheckpointArchive {
 public:
  // Opens a checkpoint. It is an error if the bytes are not a checkpoint, are damaged, or have
  // another version. The message has no file name.
  static StatusOr<std::unique_ptr<CheckpointReader>> Open(std::string_view bytes);
  ~CheckpointReader() override;

  bool saving() const override { return false; }
  void Enter(const std::string& group) override;
  void Leave() override;
  void Array(const std::string& name, std::vector<double>* values) override;
  void Array(const std::string& name, std::vector<int>* values) override;
  void Array(const std::string& name, std::vector<std::uint8_t>* values) override;
  void Text(const std::string& name, std::string* text) override;

 private:
  struct Impl;
  CheckpointReader();
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_CHECKPOINT_H_
