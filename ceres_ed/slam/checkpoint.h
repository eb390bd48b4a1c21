// The state of a run as bytes, from which the run goes on as if it had never stopped.
//
// A class whose state outlives a frame has `void Exchange(CheckpointArchive* archive)`: one list of
// its members, which saves them or loads them, so that the two can't drift apart. A new member that
// the next frame depends on needs its line there, and a new kCheckpointVersion.
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

// Of what Exchange() lists; others are refused.
inline constexpr int kCheckpointVersion = 3;

// Named values on their way to the bytes or back. Loading never crashes: what is missing or of
// another size leaves its target as it is and makes status() an error.
class CheckpointArchive {
 public:
  virtual ~CheckpointArchive() = default;

  // Whether values go to the bytes; else they come from there.
  virtual bool saving() const = 0;
  // Names up to the matching Leave() are `group`'s own.
  virtual void Enter(const std::string& group) = 0;
  virtual void Leave() = 0;

  // A list of numbers or bytes. Loading gives it the size that was saved.
  virtual void Array(const std::string& name, std::vector<double>* values) = 0;
  virtual void Array(const std::string& name, std::vector<int>* values) = 0;
  virtual void Array(const std::string& name, std::vector<std::uint8_t>* values) = 0;
  virtual void Text(const std::string& name, std::string* text) = 0;

  void Value(const std::string& name, double* value) { Fixed<double>(name, value, 1); }
  void Value(const std::string& name, int* value) { Fixed<int>(name, value, 1); }
  void Value(const std::string& name, Eigen::Vector3d* value) {
    Fixed<double>(name, value->data(), 3);
  }
  void Value(const std::string& name, Eigen::Quaterniond* value) {
    Fixed<double>(name, value->coeffs().data(), 4);
  }

  // One member of every row; `rows` has its final size already. `member(row)` is a reference to a
  // double, an int, or a fixed-size vector or array of numbers or bytes.
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

  // Rows as they lie in memory, which must have no gaps: for many that have a compact form already.
  // Loading gives them the number that was saved.
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

  // Ok, or what is wrong with the bytes; the first thing counts.
  const Status& status() const { return status_; }

 protected:
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
  template <typename T, int kRows>
  struct Span<Eigen::Matrix<T, kRows, 1>> {
    using Scalar = T;
    static constexpr std::size_t kSize = kRows;
    static T* Data(Eigen::Matrix<T, kRows, 1>* value) { return value->data(); }
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

// Collects what is exchanged, as the bytes that it becomes: a large map is there but once more.
class CheckpointWriter : public CheckpointArchive {
 public:
  CheckpointWriter();

  // Returns the bytes: CBOR, with a version and a checksum. Every group must have been left. Only
  // once.
  std::string Finish();

  bool saving() const override { return true; }
  void Enter(const std::string& group) override;
  void Leave() override;
  void Array(const std::string& name, std::vector<double>* values) override;
  void Array(const std::string& name, std::vector<int>* values) override;
  void Array(const std::string& name, std::vector<std::uint8_t>* values) override;
  void Text(const std::string& name, std::string* text) override;

 private:
  std::string bytes_;
  // Where the payload starts.
  std::size_t payload_at_ = 0;
  int depth_ = 0;
};

// Hands out what a CheckpointWriter has collected.
class CheckpointReader : public CheckpointArchive {
 public:
  // Error: no checkpoint, damaged, of another version. The sentence has no file name.
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
