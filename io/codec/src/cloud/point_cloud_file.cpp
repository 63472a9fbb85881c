// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/point_cloud_file.hpp"

#include "cloud_header.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <utility>

namespace hypermap {
namespace {

/// LZF makes of three bytes 264 at most.
constexpr std::uint64_t kMaxLzfRatio = 88;

template <class T>
double number_of_bytes(const char* bytes, bool is_swapped) {
  std::array<char, sizeof(T)> raw{};
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (is_swapped) std::reverse(raw.begin(), raw.end());
  T value{};
  std::memcpy(&value, raw.data(), sizeof(T));
  return static_cast<double>(value);
}

double number_at(const char* bytes, CloudScalar type, bool is_big_endian) {
  const bool is_swapped = is_big_endian != (std::endian::native == std::endian::big);
  switch (type) {
    case CloudScalar::kInt8:
      return number_of_bytes<std::int8_t>(bytes, false);
    case CloudScalar::kInt16:
      return number_of_bytes<std::int16_t>(bytes, is_swapped);
    case CloudScalar::kInt32:
      return number_of_bytes<std::int32_t>(bytes, is_swapped);
    case CloudScalar::kInt64:
      return number_of_bytes<std::int64_t>(bytes, is_swapped);
    case CloudScalar::kUint8:
      return number_of_bytes<std::uint8_t>(bytes, false);
    case CloudScalar::kUint16:
      return number_of_bytes<std::uint16_t>(bytes, is_swapped);
    case CloudScalar::kUint32:
      return number_of_bytes<std::uint32_t>(bytes, is_swapped);
    case CloudScalar::kUint64:
      return number_of_bytes<std::uint64_t>(bytes, is_swapped);
    case CloudScalar::kFloat:
      return number_of_bytes<float>(bytes, is_swapped);
    case CloudScalar::kDouble:
      break;
  }
  return number_of_bytes<double>(bytes, is_swapped);
}

/// A field's name as fields are compared: without CloudCompare's prefix, in lower case.
std::string plain_field_name(std::string_view name) {
  constexpr std::string_view kPrefix = "scalar_";
  std::string lower(name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.starts_with(kPrefix) ? lower.substr(kPrefix.size()) : lower;
}

/// Which of the header's fields are wanted: x, y, z and the label, if there is one.
struct WantedFields {
  std::array<std::size_t, 3> place{};
  std::optional<std::size_t> label;
};

Result<WantedFields> wanted_fields(const CloudHeader& header) {
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const CloudField& field = header.fields[i];
      if (field.count == 1 && plain_field_name(field.name) == name) return i;
    }
    return std::nullopt;
  };
  WantedFields wanted;
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const auto found = find(kAxes[axis]);
    if (!found) return malformed_cloud("the cloud has no such field", kAxes[axis]);
    wanted.place[axis] = *found;
  }
  for (const char* name : {"label", "class", "classification"}) {
    if (!wanted.label) wanted.label = find(name);
  }
  return wanted;
}

/// Puts points together, value by value.
class CloudBuilder {
 public:
  CloudBuilder(const CloudHeader& header, const WantedFields& wanted, const CloudLimits& limits)
      : wanted_(wanted), limits_(limits) {
    cloud_.names = header.names;
    cloud_.points.reserve(header.num_points);
    if (wanted.label) cloud_.labels.reserve(header.num_points);
  }

  /// `value(field)` is the number of the point there.
  template <class Value>
  Result<void> add(const Value& value, int line) {
    Eigen::Vector3d point;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      point[axis] = value(wanted_.place[static_cast<std::size_t>(axis)]);
    if (!point.allFinite()) {
      ++cloud_.num_unmeasured;
      return {};
    }
    if (point.cwiseAbs().maxCoeff() > limits_.max_coordinate) {
      return malformed_cloud("a coordinate is beyond " + number_text(limits_.max_coordinate),
                             "point " + std::to_string(num_points()),
                             line);
    }
    if (wanted_.label) {
      HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t label, label_of(value(*wanted_.label), line));
      cloud_.labels.push_back(label);
    }
    cloud_.points.push_back(point.cast<float>());
    return {};
  }

  LabelledPoints take() { return std::move(cloud_); }

 private:
  [[nodiscard]] std::size_t num_points() const {
    return cloud_.points.size() + cloud_.num_unmeasured;
  }
  [[nodiscard]] Result<std::int64_t> label_of(double value, int line) const {
    constexpr double kMaxLabel = 9e15;  // whole numbers up to here are exact
    if (std::isnan(value)) return LabelledPoints::kNoLabel;
    if (std::abs(value) <= kMaxLabel && value == std::floor(value))
      return static_cast<std::int64_t>(value);
    return malformed_cloud("must be a whole number, is " + number_text(value),
                           "label of point " + std::to_string(num_points()),
                           line);
  }

  WantedFields wanted_;
  CloudLimits limits_;
  LabelledPoints cloud_;
};

Unexpected too_few_data(const CloudHeader& header) {
  return malformed_cloud("has too few bytes for " + std::to_string(header.num_points) + " points",
                         "data");
}

Result<LabelledPoints> read_text_points(const CloudHeader& header,
                                        std::string_view data,
                                        CloudBuilder builder) {
  std::size_t num_values = 0;
  for (const CloudField& field : header.fields) num_values += field.count;
  if (data.size() / (2 * num_values) + 1 < header.num_points) return too_few_data(header);
  std::vector<std::size_t> first_word;  // of each field
  std::size_t next = 0;
  for (const CloudField& field : header.fields) {
    first_word.push_back(next);
    next += field.count;
  }
  int line_number = header.num_lines;
  std::size_t skipped = 0;
  std::size_t read = 0;
  while (read < header.num_points && !data.empty()) {
    const std::size_t end = std::min(data.find('\n'), data.size());
    const std::vector<std::string_view> words = split_words(data.substr(0, end));
    data.remove_prefix(std::min(end + 1, data.size()));
    ++line_number;
    if (words.empty()) continue;
    if (skipped++ < header.num_lines_before) continue;
    if (words.size() != num_values) {
      return malformed_cloud(
          "has " + std::to_string(words.size()) + " values, expected " + std::to_string(num_values),
          "point " + std::to_string(read),
          line_number);
    }
    std::optional<std::size_t> bad;
    const auto value = [&](std::size_t field) {
      const auto number = parse_double(words[first_word[field]]);
      if (!number) bad = first_word[field];
      return number.value_or(0.0);
    };
    const auto added = builder.add(value, line_number);
    if (bad) {
      return malformed_cloud("is no number: '" + printable(words[*bad], 40) + "'",
                             "point " + std::to_string(read),
                             line_number);
    }
    HYPERMAP_TRY(added);
    ++read;
  }
  if (read < header.num_points) return too_few_data(header);
  return builder.take();
}

/// `place(field, point)` is where the bytes of a value begin.
template <class Place>
Result<LabelledPoints> read_binary_points(const CloudHeader& header,
                                          const Place& place,
                                          CloudBuilder builder) {
  for (std::size_t point = 0; point < header.num_points; ++point) {
    const auto value = [&](std::size_t index) {
      const CloudField& field = header.fields[index];
      return number_at(place(field, point), field.type, header.is_big_endian);
    };
    HYPERMAP_TRY(builder.add(value, 0));
  }
  return builder.take();
}

/// The columns of a compressed file, behind the sizes of what is packed and of what it was.
Result<std::string> unpacked_columns(const CloudHeader& header, std::string_view data) {
  constexpr std::size_t kSizes = 8;
  if (data.size() < kSizes) return too_few_data(header);
  const auto size_at = [&](std::size_t at) {
    return static_cast<std::size_t>(number_at(data.data() + at, CloudScalar::kUint32, false));
  };
  const std::size_t packed = size_at(0);
  const std::size_t whole = size_at(4);
  if (packed > data.size() - kSizes) return too_few_data(header);
  if (whole != header.num_points * header.row_bytes() || whole > kMaxLzfRatio * packed)
    return malformed_cloud("unpacks to another size than that of its points", "DATA");
  return unpacked_lzf(data.substr(kSizes, packed), whole);
}

Result<LabelledPoints> read_points(const CloudHeader& header,
                                   std::string_view data,
                                   const CloudLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const WantedFields wanted, wanted_fields(header));
  const std::size_t row_bytes = header.row_bytes();
  if (header.form == CloudForm::kText) {
    if (data.size() / 6 + 1 < header.num_points) return too_few_data(header);
    return read_text_points(header, data, CloudBuilder(header, wanted, limits));
  }
  if (header.form == CloudForm::kColumns) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string columns, unpacked_columns(header, data));
    const auto place = [&](const CloudField& field, std::size_t point) {
      return columns.data() + field.offset * header.num_points +
             point * field.count * size_of(field.type);
    };
    return read_binary_points(header, place, CloudBuilder(header, wanted, limits));
  }
  if (data.size() < header.bytes_before ||
      (data.size() - header.bytes_before) / row_bytes < header.num_points)
    return too_few_data(header);
  const auto place = [&](const CloudField& field, std::size_t point) {
    return data.data() + header.bytes_before + point * row_bytes + field.offset;
  };
  return read_binary_points(header, place, CloudBuilder(header, wanted, limits));
}

Result<CloudHeader> parse_cloud_header(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n")) return parse_ply_header(bytes);
  if (bytes.starts_with("# .PCD") || bytes.starts_with("VERSION")) return parse_pcd_header(bytes);
  return Unexpected(Error{.code = ErrorCode::kUnsupported, .what = "is neither PCD nor PLY"});
}

Result<LabelledPoints> parse_cloud(std::string_view bytes, const CloudLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const CloudHeader header, parse_cloud_header(bytes));
  if (header.num_points > limits.max_points) {
    return fail(ErrorCode::kLimit,
                "has " + std::to_string(header.num_points) + " points, the limit is " +
                    std::to_string(limits.max_points),
                "points");
  }
  if (header.num_points > limits.max_bytes / std::max<std::size_t>(header.row_bytes(), 1)) {
    return fail(ErrorCode::kLimit,
                "has more than " + std::to_string(limits.max_bytes) + " bytes when unpacked",
                "points");
  }
  return read_points(header, bytes.substr(header.num_bytes), limits);
}

}  // namespace

Result<LabelledPoints> parse_point_cloud(std::string_view bytes,
                                         const SourceName& source,
                                         const CloudLimits& limits) {
  auto cloud = parse_cloud(bytes, limits);
  if (!cloud) return Unexpected(with_source(std::move(cloud).error(), source));
  return cloud;
}

Result<LabelledPoints> read_point_cloud(const std::filesystem::path& path,
                                        const CloudLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, limits.max_bytes));
  return parse_point_cloud(bytes, {.file = path.string()}, limits);
}

}  // namespace hypermap
