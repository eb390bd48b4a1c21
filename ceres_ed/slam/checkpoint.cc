#include "ceres_ed/slam/checkpoint.h"

#include <cstring>
#include <utility>

#include <glog/logging.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::json;

constexpr char kFormat[] = "ceres_ed checkpoint";

// FNV-1a: what damage does to a file, it sees.
std::uint64_t Checksum(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

template <typename T>
json Pack(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return json::binary(std::move(bytes));
}

}  // namespace

// Groups that have been entered, the outermost first.
struct CheckpointWriter::Impl {
  std::vector<std::pair<std::string, json>> groups{{"", json::object()}};

  json& group() { return groups.back().second; }
};

CheckpointWriter::CheckpointWriter() : impl_(new Impl) {}
CheckpointWriter::~CheckpointWriter() = default;

std::string CheckpointWriter::Finish() const {
  CHECK_EQ(impl_->groups.size(), 1u) << "a group was not left";
  std::vector<std::uint8_t> payload = json::to_cbor(impl_->groups[0].second);
  // Numbers stand in the machine's own order of bytes; its probe tells another machine's from them.
  json file = {{"format", kFormat},
               {"version", kCheckpointVersion},
               {"probe", Pack(std::vector<double>{1.0})},
               {"checksum", Checksum(payload)}};
  file["payload"] = json::binary(std::move(payload));
  std::string bytes;
  json::to_cbor(file, bytes);
  return bytes;
}

void CheckpointWriter::Enter(const std::string& group) {
  impl_->groups.emplace_back(group, json::object());
}

void CheckpointWriter::Leave() {
  CHECK_GE(impl_->groups.size(), 2u);
  auto [name, group] = std::move(impl_->groups.back());
  impl_->groups.pop_back();
  impl_->group()[name] = std::move(group);
}

void CheckpointWriter::Array(const std::string& name, std::vector<double>* values) {
  impl_->group()[name] = Pack(*values);
}

void CheckpointWriter::Array(const std::string& name, std::vector<int>* values) {
  impl_->group()[name] = Pack(*values);
}

void CheckpointWriter::Array(const std::string& name, std::vector<std::uint8_t>* values) {
  impl_->group()[name] = Pack(*values);
}

void CheckpointWriter::Text(const std::string& name, std::string* text) {
  // Paths need not be UTF-8, which CBOR asks of its texts.
  impl_->group()[name] = Pack(std::vector<std::uint8_t>(text->begin(), text->end()));
}

struct CheckpointReader::Impl {
  json root;
  std::vector<const json*> groups;

  // The bytes of that name in the present group, or null.
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
  const json file = json::from_cbor(bytes, /*strict=*/true, /*allow_exceptions=*/false);
  if (!file.is_object() || file.value("format", json()) != kFormat) {
    return Status::Error("is no checkpoint, expected one that a run has left");
  }
  if (file.value("version", json()) != kCheckpointVersion) {
    return Status::Error("is of checkpoint version " + file.value("version", json()).dump() +
                         ", expected " + std::to_string(kCheckpointVersion));
  }
  if (file.value("probe", json()) != Pack(std::vector<double>{1.0})) {
    return Status::Error("is from another kind of machine, expected one with this order of bytes");
  }
  const json payload = file.value("payload", json());
  if (!payload.is_binary() || file.value("checksum", json()) != Checksum(payload.get_binary())) {
    return Status::Error("is damaged, expected the checksum that it was written with");
  }
  std::unique_ptr<CheckpointReader> reader(new CheckpointReader);
  reader->impl_->root = json::from_cbor(payload.get_binary(), true, false);
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
