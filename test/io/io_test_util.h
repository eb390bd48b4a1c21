// Files for the tests of the io layer, made without the code of that layer.
#ifndef CERES_ED_TEST_IO_IO_TEST_UTIL_H_
#define CERES_ED_TEST_IO_IO_TEST_UTIL_H_

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stdlib.h>

namespace ceres_ed {

// A temporary directory for each test, which is deleted afterwards.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "ceres_ed_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "no temporary directory " << name;
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  std::size_t NumFiles() const {
    const std::filesystem::directory_iterator begin(path_), end;
    return static_cast<std::size_t>(std::distance(begin, end));
  }

 private:
  std::filesystem::path path_;
};

inline void WriteBytes(const std::string& path, const std::string& bytes) {
  // Some file systems flush to disk when a file is overwritten, which is slow in a loop.
  std::filesystem::remove(path);
  std::ofstream file(path, std::ios::binary);
  file << bytes;
}

inline std::string ReadBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

inline std::string WithCrLf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

enum class Encoding { kAscii, kLittle, kBig };

inline const char* FormatWord(Encoding encoding) {
  switch (encoding) {
    case Encoding::kAscii:
      return "ascii";
    case Encoding::kLittle:
      return "binary_little_endian";
    case Encoding::kBig:
      return "binary_big_endian";
  }
  return "";
}

// Makes the rows of a PLY body in one of the three encodings. The machine must be little-endian.
class BodyMaker {
 public:
  explicit BodyMaker(Encoding encoding) : encoding_(encoding) {}

  template <typename T>
  BodyMaker& Put(T value) {
    if (encoding_ == Encoding::kAscii) {
      std::ostringstream text;
      text.precision(17);
      text << +value;
      const bool starts_line = body_.empty() || body_.back() == '\n';
      body_ += (starts_line ? "" : " ") + text.str();
    } else {
      char bytes[sizeof(T)];
      std::memcpy(bytes, &value, sizeof(T));
      if (encoding_ == Encoding::kBig) std::reverse(bytes, bytes + sizeof(T));
      body_.append(bytes, sizeof(T));
    }
    return *this;
  }
  BodyMaker& EndRow() {
    if (encoding_ == Encoding::kAscii) body_ += '\n';
    return *this;
  }
  const std::string& body() const { return body_; }

 private:
  Encoding encoding_;
  std::string body_;
};

// Returns a file with everything that a writer may produce: properties of each type, a quad, a
// pentagon, an unknown element, comments, obj_info. It has five vertices (i, 0.5 i, -i) and three
// faces.
inline std::string RichPly(Encoding encoding, bool crlf) {
  std::string header = std::string("ply\nformat ") + FormatWord(encoding) +
                       " 1.0\ncomment first  with  blanks \nobj_info scanner 7\ncomment\n"
                       "element vertex 5\nproperty float x\nproperty double y\nproperty float32 z\n"
                       "property uchar red\nproperty int8 tiny\nproperty short s\n"
                       "property uint16 us\nproperty int label\nproperty uint id\n"
                       "property float64 quality\n"
                       "element camera 2\nproperty list ushort float rays\nproperty double f\n"
                       "element face 3\nproperty list uchar int vertex_indices\n"
                       "property uchar flag\nelement nothing 0\nend_header\n";
  BodyMaker body(encoding);
  for (int i = 0; i < 5; ++i) {
    body.Put<float>(static_cast<float>(i)).Put<double>(0.5 * i).Put<float>(static_cast<float>(-i));
    body.Put<unsigned char>(static_cast<unsigned char>(200 + i)).Put<signed char>(-128);
    body.Put<short>(-32768).Put<unsigned short>(65535).Put<int>(-2147483647 - 1);
    body.Put<unsigned int>(4294967295u).Put<double>(1.0 / (3.0 + i)).EndRow();
  }
  body.Put<unsigned short>(2).Put<float>(0.1f).Put<float>(1e-30f).Put<double>(1e300).EndRow();
  body.Put<unsigned short>(0).Put<double>(-0.25).EndRow();
  const std::vector<std::vector<int>> faces = {{0, 1, 2, 3}, {0, 1, 2, 3, 4}, {4, 3, 2}};
  for (const std::vector<int>& face : faces) {
    body.Put<unsigned char>(static_cast<unsigned char>(face.size()));
    for (const int corner : face) body.Put<int>(corner);
    body.Put<unsigned char>(9).EndRow();
  }
  if (!crlf) return header + body.body();
  return WithCrLf(header) + (encoding == Encoding::kAscii ? WithCrLf(body.body()) : body.body());
}

// Returns an ascii mesh with the rows `vertex_rows` and `face_rows`.
inline std::string AsciiMesh(const std::vector<std::string>& vertex_rows,
                             const std::vector<std::string>& face_rows) {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << vertex_rows.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << face_rows.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const std::string& row : vertex_rows) text << row << '\n';
  for (const std::string& row : face_rows) text << row << '\n';
  return text.str();
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_IO_IO_TEST_UTIL_H_
