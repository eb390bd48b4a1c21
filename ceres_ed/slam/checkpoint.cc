#include "ceres_ed/slam/checkpoint.h"

#include <cstring>
#include <utility>

#include <glog/logging.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::json;

constexpr char kFormat[] = "ceres_ed checkpoint";
constexpr double kProbe = 1.0;

// The parts of CBOR (RFC 8949) that a checkpoint uses.
constexpr char kOpenMap = '\xbf';
constexpr char kCloseMap = '\xff';
constexpr unsigned char kText = 0x60;
constexpr unsigned char kBytes = 0x40;
constexpr unsigned char kUnsigned = 0x00;
// Is added to a type if eight bytes follow, the most significant first.
constexpr unsigned char kEightBytes = 27;

// FNV-1a, which detects damage of a file.
std::uint64_t Checksum(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t hash = 14695981039346656037ull;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211ull;
  return hash;
}

void PutNumber(std::uint64_t number, std::size_t at, std::string* bytes) {
  for (std::size_t i = 0; i < 8; ++i) {
    (*bytes)[at + i] = static_cast<char>(number >> (8 * (7 - i)) & 0xff);
  }
}

// Appends a number, or the length of the data that follow.
void AppendHead(unsigned char type, std::uint64_t number, std::string* bytes) {
  bytes->push_back(static_cast<char>(type + kEightBytes));
  bytes->append(8, '\0');
  PutNumber(number, bytes->size() - 8, bytes);
}

void AppendText(const std::string& text, std::string* bytes) {
  AppendHead(kText, text.size(), bytes);
  *bytes += text;
}

template <typename T>
void AppendArray(const std::string& name, const std::vector<T>& values, std::string* bytes) {
  AppendText(name, bytes);
  const std::size_t size = values.size() * sizeof(T);
  AppendHead(kBytes, size, bytes);
  if (size > 0) bytes->append(reinterpret_cast<const char*>(values.data()), size);
}

// Returns everything before the payload; the last eight bytes are the length of the payload.
std::string FileHead(std::uint64_t length) {
  std::string bytes(1, kOpenMap);
  AppendText("format", &bytes);
  AppendText(kFormat, &bytes);
  AppendText("version", &bytes);
  AppendHead(kUnsigned, kCheckpointVersion, &bytes);
  // Numbers have the byte order of the machine; the probe detects a machine with another order.
  AppendArray("probe", std::vector<double>{kProbe}, &bytes);
  AppendText("payload", &bytes);
  AppendHead(kBytes, length, &bytes);
  return bytes;
}

// Returns everything after the payload.
std::string FileTail(std::string_view payload) {
  std::string bytes;
  AppendText("checksum", &bytes);
  AppendHead(kUnsigned, Checksum(payload.data(), payload.size()), &bytes);
  bytes.push_back(kCloseMap);
  return bytes;
}

// Accepts CBOR whose lists are no longer than the file and whose depth is that of checkpoints: the
// library throws at other lengths whatever it is told, and calls itself for each level.
class BoundedCbor : public nlohmann::json_sax<json> {
 public:
  explicit BoundedCbor(std::size_t size) : size_(size) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t length) override { return Enter(length); }
  bool start_array(std::size_t length) override { return Enter(length); }
  bool end_object() override { return --depth_ >= 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  bool Enter(std::size_t length) {
    constexpr int kMaxDepth = 32;
    constexpr auto kUnknownLength = static_cast<std::size_t>(-1);
    return (length == kUnknownLength || length <= size_) && ++depth_ <= kMaxDepth;
  }

  std::size_t size_;
  int depth_ = 0;
};

// Returns the value of CBOR, discarded if it is none.
json ParseCbor(std::string_view bytes) {
  BoundedCbor bounded(bytes.size());
  if (!json::sax_parse(bytes, &bounded, json::input_format_t::cbor)) {
    return json(json::value_t::discarded);
  }
  return json::from_cbor(bytes, /*strict=*/true, /*allow_exceptions=*/false);
}

// Returns the payload of a file in the form that CheckpointWriter produces, or nothing if the file
// is incomplete.
std::string_view PayloadOf(std::string_view file) {
  const std::size_t around = FileHead(0).size() + FileTail({}).size();
  if (file.size() < around) return {};
  const std::string head = FileHead(file.size() - around);
  if (file.substr(0, head.size()) != head) return {};
  const std::string_view payload = file.substr(head.size(), file.size() - around);
  return file.substr(head.size() + payload.size()) == FileTail(payload) ? payload
                                                                        : std::string_view();
}

// Returns the reason why PayloadOf() does not accept a file.
Status WhatIsWrong(std::string_view bytes) {
  const json file = ParseCbor(bytes);
  if (!file.is_object() || file.value("format", json()) != kFormat) {
    return Status::Error("is no checkpoint, expected one that a run has left");
  }
  if (file.value("version", json()) != kCheckpointVersion) {
    return Status::Error(
        "is of checkpoint version " +
        file.value("version", json()).dump(-1, ' ', false, json::error_handler_t::replace) +
        ", expected " + std::to_string(kCheckpointVersion));
  }
  std::vector<std::uint8_t> probe(sizeof(kProbe));
  std::memcpy(probe.data(), &kProbe, sizeof(kProbe));
  if (file.value("probe", json()) != json::binary(std::move(probe))) {
    return Status::Error("is from another kind of machine, expected one with this order of bytes");
  }
  return Status::Error("is damaged, expected the checksum that it was written with");
}

}  // namespace

CheckpointWriter::CheckpointWriter() : bytes_(FileHead(0)), payload_at_(bytes_.size()) {
  bytes_.push_back(kOpenMap);
}

std::string CheckpointWriter::TakeBytes() {
  CHECK_EQ(depth_, 0) << "a group was not left, or the bytes are gone";
  --depth_;
  bytes_.push_back(kCloseMap);
  const std::size_t length = bytes_.size() - payload_at_;
  PutNumber(length, payload_at_ - 8, &bytes_);
  bytes_ += FileTail(std::string_view(bytes_).substr(payload_at_));
  return std::move(bytes_);
}

void CheckpointWriter::Enter(const std::string& group) {
  ++depth_;
  AppendText(group, &bytes_);
  bytes_.push_back(kOpenMap);
}

void CheckpointWriter::Leave() {
  CHECK_GE(depth_, 1);
  --depth_;
  bytes_.push_back(kCloseMap);
}

void CheckpointWriter::Array(const std::string& name, std::vector<double>* values) {
  AppendArray(name, *values, &bytes_);
}

void CheckpointWriter::Array(const std::string& name, std::vector<int>* values) {
  AppendArray(name, *values, &bytes_);
}

void CheckpointWriter::Array(const std::string& name, std::vector<std::uint8_t>* values) {
  AppendArray(name, *values, &bytes_);
}

void CheckpointWriter::Text(const std::string& name, std::string* text) {
  // Paths may not be valid UTF-8, which CBOR requires for texts.
  AppendArray(name, std::vector<std::uint8_t>(text->begin(), text->end()), &bytes_);
}

struct CheckpointReader::Impl {
  json root;
  std::vector<const json*> groups;

  // Returns the bytes with that name in the present group, or null.
  const std::vector<std::uint8_t>* Find(const std::string& name) const {
    const json* group = groups.back();
    if (group == nullptr) return nullptr;
    const auto found = group->find(name);
    return found != group->end() && found->is_binary() ? &found->get_binary() : nullptr;
  }

  template <typename T>
  bool Unpack(const std::string& name, std::vector<T>* values) const {
    const std::vector<std::uint8_t>* bytes = Find(name);
    if (bytes == nullptr || bytes->size() % sizeof(T) != 0) return false;
    values->resize(bytes->size() / sizeof(T));
    if (!values->empty()) std::memcpy(values->data(), bytes->data(), bytes->size());
    return true;
  }
};

CheckpointReader::CheckpointReader() : impl_(new Impl) {}
CheckpointReader::~CheckpointReader() = default;

StatusOr<std::unique_ptr<CheckpointReader>> CheckpointReader::Open(std::string_view bytes) {
  const std::string_view payload = PayloadOf(bytes);
  if (payload.empty()) return WhatIsWrong(bytes);
  std::unique_ptr<CheckpointReader> reader(new CheckpointReader);
  reader->impl_->root = ParseCbor(payload);
  if (!reader->impl_->root.is_object()) return Status::Error("has no contents, expected a state");
  reader->impl_->groups = {&reader->impl_->root};
  return StatusOr<std::unique_ptr<CheckpointReader>>(std::move(reader));
}

void CheckpointReader::Enter(const std::string& group) {
  const json* parent = impl_->groups.back();
  const bool there = parent != nullptr && parent->contains(group) && (*parent)[group].is_object();
  if (!there) Fail("has no group " + group);
  impl_->groups.push_back(there ? &(*parent)[group] : nullptr);
}

void CheckpointReader::Leave() {
  CHECK_GE(impl_->groups.size(), 2u);
  impl_->groups.pop_back();
}

void CheckpointReader::Array(const std::string& name, std::vector<double>* values) {
  if (!impl_->Unpack(name, values)) Fail("has no numbers " + name);
}

void CheckpointReader::Array(const std::string& name, std::vector<int>* values) {
  if (!impl_->Unpack(name, values)) Fail("has no numbers " + name);
}

void CheckpointReader::Array(const std::string& name, std::vector<std::uint8_t>* values) {
  if (!impl_->Unpack(name, values)) Fail("has no bytes " + name);
}

void CheckpointReader::Text(const std::string& name, std::string* text) {
  std::vector<std::uint8_t> bytes;
  if (!impl_->Unpack(name, &bytes)) return Fail("has no text " + name);
  text->assign(bytes.begin(), bytes.end());
}

}  // namespace ceres_ed
