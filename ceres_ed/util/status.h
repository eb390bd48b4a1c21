// The outcome of an operation that can fail on bad input.
#ifndef CERES_ED_UTIL_STATUS_H_
#define CERES_ED_UTIL_STATUS_H_

#include <optional>
#include <string>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {

// Success, or an error with one sentence that names what was bad (file, place, value) and what was
// expected. A mistake of the programmer is not a Status but a failed CHECK.
class [[nodiscard]] Status {
 public:
  // Returns success.
  static Status Ok() { return Status(); }
  // Returns an error with a sentence, which must not be empty.
  static Status Error(std::string message) {
    Status status;
    status.message_ = std::move(message);
    CHECK(!status.message_->empty()) << "an error needs a message";
    return status;
  }

  bool ok() const { return !message_.has_value(); }
  // The sentence of the error; empty if ok().
  std::string message() const { return message_.value_or(""); }

 private:
  std::optional<std::string> message_;
};

// A value, or the Status that says why there is no value.
template <typename T>
class [[nodiscard]] StatusOr {
 public:
  // A value, which means success, or an error.
  StatusOr(T value) : value_(std::move(value)) {}         // NOLINT(google-explicit-constructor)
  StatusOr(Status status) : status_(std::move(status)) {  // NOLINT(google-explicit-constructor)
    CHECK(!status_.ok()) << "an ok status must come with a value";
  }

  bool ok() const { return status_.ok(); }
  const Status& status() const { return status_; }

  // Returns the value. Fails a CHECK if !ok().
  const T& operator*() const& {
    CHECK(ok()) << status_.message();
    return *value_;
  }
  T& operator*() & {
    CHECK(ok()) << status_.message();
    return *value_;
  }
  T&& operator*() && {
    CHECK(ok()) << status_.message();
    return *std::move(value_);
  }
  const T* operator->() const { return &**this; }
  T* operator->() { return &**this; }

 private:
  Status status_ = Status::Ok();
  std::optional<T> value_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_STATUS_H_
