#include "ceres_ed/pipeline/cohort/content_key.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace ceres_ed {

namespace fs = std::filesystem;

void ContentKey::AddBytes(std::string_view bytes) {
  for (const char byte : bytes) {
    hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  }
}

void ContentKey::AddText(std::string_view text) {
  // The length keeps "a", "bc" apart from "ab", "c".
  AddBytes(std::to_string(text.size()) + ":");
  AddBytes(text);
}

void ContentKey::AddOneFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  AddBytes(file ? "file " : "none ");
  constexpr std::size_t kPiece = 1 << 20;
  std::vector<char> piece(kPiece);
  std::size_t size = 0;
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    AddBytes({piece.data(), count});
    size += count;
  }
  AddText(std::to_string(size));
}

void ContentKey::AddFile(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    AddOneFile(path);
    return;
  }
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(path, error);
       !error && entry != fs::recursive_directory_iterator();
       entry.increment(error)) {
    if (entry->is_regular_file(error)) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    AddText(file.lexically_relative(path).string());
    AddOneFile(file.string());
  }
}

std::string ContentKey::Text() const {
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash_));
  return text;
}

}  // namespace ceres_ed
