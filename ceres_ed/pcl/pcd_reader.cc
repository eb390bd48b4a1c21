#include "ceres_ed/pcl/pcd_reader.h"

#include <ceres_ed/io/mesh/ply_ascii.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/pcl/cloud_document.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <pcl/io/lzf.h>

namespace ceres_ed {
namespace {

using Field = pcl::PCLPointField;

struct TypeName {
  const char* type;
  double size;
  std::uint8_t pcl;
};
constexpr TypeName kTypes[] = {
    {"I", 1, Field::INT8},
    {"U", 1, Field::UINT8},
    {"I", 2, Field::INT16},
    {"U", 2, Field::UINT16},
    {"I", 4, Field::INT32},
    {"U", 4, Field::UINT32},
    {"F", 4, Field::FLOAT32},
    {"F", 8, Field::FLOAT64},
};

// Nobody's point has more numbers in a field.
constexpr double kMaxCount = 1 << 20;
constexpr double kMaxPointSize = 1 << 30;

std::vector<std::string> SplitWords(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

class PcdReader {
 public:
  explicit PcdReader(const std::string& path) : path_(path) {}

  StatusOr<PcdCloud> Read() {
    const StatusOr<std::string> text = ReadWholeFile(path_);
    if (!text.ok()) return text.status();
    rest_ = *text;
    Status status = ReadHeader();
    if (status.ok()) status = MakeFields();
    if (status.ok()) status = SetSize();
    if (status.ok()) status = ReadBody();
    if (!status.ok()) return status;
    return std::move(result_);
  }

 private:
  Status ReadHeader() {
    while (data_.empty()) {
      const std::size_t end = rest_.find('\n');
      if (end == std::string_view::npos) return Error("not a PCD file: it has no line 'DATA'");
      const std::vector<std::string> words = SplitWords(rest_.substr(0, end));
      rest_.remove_prefix(end + 1);
      ++line_;
      if (words.empty() || words[0][0] == '#') continue;
      Status status = ReadLine(words);
      if (!status.ok()) return status;
    }
    return Status::Ok();
  }

  Status ReadLine(const std::vector<std::string>& words) {
    const std::string& keyword = words[0];
    const std::vector<std::string> values(words.begin() + 1, words.end());
    if (keyword == "FIELDS" || keyword == "COLUMNS") {
      names_ = values;
    } else if (keyword == "TYPE") {
      types_ = values;
    } else if (keyword == "SIZE") {
      return ReadNumbers(words, &sizes_);
    } else if (keyword == "COUNT") {
      return ReadNumbers(words, &counts_);
    } else if (keyword == "WIDTH") {
      return ReadNumber(words, &width_);
    } else if (keyword == "HEIGHT") {
      return ReadNumber(words, &height_);
    } else if (keyword == "POINTS") {
      return ReadNumber(words, &points_);
    } else if (keyword == "VIEWPOINT") {
      return ReadViewpoint(words);
    } else if (keyword == "DATA") {
      data_ = values.empty() ? "nothing" : values[0];
    }
    return Status::Ok();
  }

  Status ReadNumbers(const std::vector<std::string>& words, std::vector<double>* numbers) const {
    numbers->clear();
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::optional<double> number = ParseDouble(words[i]);
      const bool usable = number.has_value() && *number >= 0.0 && *number <= 4294967295.0 &&
                          *number == std::floor(*number);
      if (!usable) {
        return LineError(words[0] + " has " + Quoted(words[i]) +
                         ", expected a whole number of at least 0");
      }
      numbers->push_back(*number);
    }
    return Status::Ok();
  }

  Status ReadNumber(const std::vector<std::string>& words, std::optional<double>* number) const {
    std::vector<double> numbers;
    Status status = ReadNumbers(words, &numbers);
    if (!status.ok()) return status;
    if (numbers.size() != 1) return LineError("expected '" + words[0] + " NUMBER'");
    *number = numbers[0];
    return Status::Ok();
  }

  // x y z, qw qx qy qz.
  Status ReadViewpoint(const std::vector<std::string>& words) {
    float numbers[7];
    for (std::size_t i = 0; i < 7; ++i) {
      const std::optional<double> number =
          words.size() == 8 ? ParseDouble(words[i + 1]) : std::nullopt;
      if (!number.has_value()) return LineError("expected 'VIEWPOINT' and 7 numbers");
      numbers[i] = static_cast<float>(*number);
    }
    result_.origin = Eigen::Vector4f(numbers[0], numbers[1], numbers[2], 0.0F);
    result_.orientation = Eigen::Quaternionf(numbers[3], numbers[4], numbers[5], numbers[6]);
    return Status::Ok();
  }

  Status MakeFields() {
    if (counts_.empty()) counts_.assign(names_.size(), 1.0);
    if (names_.empty() || sizes_.size() != names_.size() || types_.size() != names_.size() ||
        counts_.size() != names_.size()) {
      return Error("the header needs FIELDS, and as many words in SIZE, TYPE and COUNT");
    }
    double point_size = 0.0;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const TypeName* type = nullptr;
      for (const TypeName& candidate : kTypes) {
        if (types_[i] == candidate.type && sizes_[i] == candidate.size) type = &candidate;
      }
      if (type == nullptr || counts_[i] > kMaxCount) {
        return Error("field " + Quoted(names_[i]) + " has a type that cannot be used, expected " +
                     "I or U of 1, 2 or 4 bytes, or F of 4 or 8, at most 1048576 in a point");
      }
      Field field;
      field.name = names_[i];
      field.offset = static_cast<std::uint32_t>(point_size);
      field.datatype = type->pcl;
      field.count = static_cast<std::uint32_t>(std::max(counts_[i], 1.0));
      point_size += type->size * field.count;
      if (point_size > kMaxPointSize) return Error("a point of more than 1073741824 bytes");
      result_.cloud.fields.push_back(std::move(field));
    }
    result_.cloud.point_step = static_cast<std::uint32_t>(point_size);
    return Status::Ok();
  }

  Status SetSize() {
    const double height = height_.value_or(1.0);
    const double width = width_.value_or(points_.value_or(0.0));
    if (points_.has_value() && *points_ != width * height) {
      return Error("WIDTH times HEIGHT is not POINTS in the header");
    }
    constexpr auto kLargest = static_cast<double>(std::numeric_limits<std::int32_t>::max());
    if (width * height > kLargest) return Truncated(width * height);
    result_.cloud.width = static_cast<std::uint32_t>(width);
    result_.cloud.height = static_cast<std::uint32_t>(height);
    result_.cloud.row_step = result_.cloud.width * result_.cloud.point_step;
    return Status::Ok();
  }

  Status ReadBody() {
    if (data_ == "ascii") return ReadAscii();
    if (data_ == "binary") return ReadBinary();
    if (data_ == "binary_compressed") return ReadCompressed();
    return LineError("DATA is " + Quoted(data_) + ", expected ascii, binary or binary_compressed");
  }

  std::size_t NumPoints() const { return std::size_t{result_.cloud.width} * result_.cloud.height; }
  std::size_t NumBytes() const { return NumPoints() * result_.cloud.point_step; }

  Status ReadBinary() {
    if (rest_.size() < NumBytes()) return Truncated(static_cast<double>(NumPoints()));
    result_.cloud.data.assign(rest_.begin(), rest_.begin() + std::ptrdiff_t(NumBytes()));
    return Status::Ok();
  }

  // The sizes before and after, and the values of one field after those of another.
  Status ReadCompressed() {
    // LZF makes at most 264 bytes of three.
    constexpr std::size_t kMaxCompression = 100;
    std::uint32_t sizes[2];
    if (rest_.size() < sizeof(sizes)) return Truncated(static_cast<double>(NumPoints()));
    std::memcpy(sizes, rest_.data(), sizeof(sizes));
    rest_.remove_prefix(sizeof(sizes));
    if (rest_.size() < sizes[0] || NumBytes() / kMaxCompression > rest_.size()) {
      return Truncated(static_cast<double>(NumPoints()));
    }
    if (sizes[1] != NumBytes()) {
      return Error("the compressed data has " + std::to_string(sizes[1]) + " bytes, expected " +
                   std::to_string(NumBytes()));
    }
    if (NumBytes() == 0) return Status::Ok();
    std::vector<char> plain(NumBytes());
    if (pcl::lzfDecompress(rest_.data(), sizes[0], plain.data(), sizes[1]) != sizes[1]) {
      return Error("the compressed data is damaged");
    }
    result_.cloud.data.resize(NumBytes());
    const char* from = plain.data();
    for (std::size_t i = 0; i < result_.cloud.fields.size(); ++i) {
      const Field& field = result_.cloud.fields[i];
      const std::size_t size = static_cast<std::size_t>(sizes_[i]) * field.count;
      std::uint8_t* to = result_.cloud.data.data() + field.offset;
      for (std::size_t p = 0; p < NumPoints(); ++p, from += size, to += result_.cloud.point_step) {
        std::memcpy(to, from, size);
      }
    }
    return Status::Ok();
  }

  Status ReadAscii() {
    double values = 0.0;
    for (const Field& field : result_.cloud.fields) values += field.count;
    // A digit and what separates it from the next.
    if (2.0 * values * static_cast<double>(NumPoints()) - 1.0 > static_cast<double>(rest_.size())) {
      return Truncated(static_cast<double>(NumPoints()));
    }
    ++line_;
    result_.cloud.data.resize(NumBytes());
    std::uint8_t* bytes = result_.cloud.data.data();
    for (std::size_t point = 0; point < NumPoints(); ++point) {
      for (const Field& field : result_.cloud.fields) {
        const PlyType type = *PlyTypeOf(field.datatype);
        for (std::uint32_t i = 0; i < field.count; ++i, bytes += PlyTypeSize(type)) {
          const std::string_view word = NextWord();
          if (word.empty()) return Truncated(static_cast<double>(NumPoints()));
          const std::optional<double> value = ParsePlyNumber(word, type);
          if (!value.has_value()) {
            return LineError("field " + Quoted(field.name) + " is " + Quoted(word) +
                             ", expected a number that fits its type");
          }
          StoreNumber(type, *value, bytes);
        }
      }
    }
    return Status::Ok();
  }

  // The next word of an ascii body; empty at its end. Counts lines.
  std::string_view NextWord() {
    std::size_t begin = 0;
    for (; begin < rest_.size() && static_cast<unsigned char>(rest_[begin]) <= ' '; ++begin) {
      if (rest_[begin] == '\n') ++line_;
    }
    std::size_t end = begin;
    while (end < rest_.size() && static_cast<unsigned char>(rest_[end]) > ' ') ++end;
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
  }

  Status Truncated(double points) const {
    std::ostringstream text;
    text.precision(17);
    text << "truncated: the header promises " << points << " points of " << result_.cloud.point_step
         << " bytes, and the file has too few behind its header";
    return Error(text.str());
  }

  Status Error(const std::string& what) const { return Status::Error(path_ + ": " + what); }
  Status LineError(const std::string& what) const {
    return Error("line " + std::to_string(line_) + ": " + what);
  }

  const std::string& path_;
  std::string_view rest_;
  // The line of the header, or of the last word of an ascii body.
  int line_ = 0;
  std::vector<std::string> names_;
  std::vector<std::string> types_;
  std::vector<double> sizes_;
  std::vector<double> counts_;
  std::optional<double> width_;
  std::optional<double> height_;
  std::optional<double> points_;
  std::string data_;
  PcdCloud result_;
};

}  // namespace

StatusOr<PcdCloud> ReadPcdCloud(const std::string& path) { return PcdReader(path).Read(); }

}  // namespace ceres_ed
