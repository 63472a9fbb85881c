// SPDX-License-Identifier: BSD-3-Clause
// Source: the Point Cloud Library's documentation, "The PCD file format".
#include "cloud_header.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxCloudFields = 1'000;
constexpr std::uint64_t kMaxFieldValues = 100'000;

using Words = std::vector<std::string_view>;

/// Entries of a header, read line by line until DATA.
class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(std::string_view bytes) : lines_(bytes) {}

  Result<CloudHeader> read() {
    while (!has_data_) {
      const auto line = lines_.next();
      if (!line) return malformed_cloud("the header ends before DATA", "DATA", lines_.line());
      const Words words = split_words(*line);
      if (words.empty() || words.front().starts_with('#')) continue;
      HYPERMAP_TRY(take(words));
    }
    HYPERMAP_TRY(make_fields());
    HYPERMAP_TRY(check_size());
    header_.num_bytes = lines_.num_bytes();
    header_.num_lines = lines_.line();
    return std::move(header_);
  }

 private:
  Result<void> take(const Words& words) {
    const std::string_view key = words.front();
    const Words values(words.begin() + 1, words.end());
    if (key == "FIELDS") {
      names_.assign(values.begin(), values.end());
    } else if (key == "TYPE") {
      types_.assign(values.begin(), values.end());
    } else if (key == "SIZE") {
      HYPERMAP_ASSIGN_OR_RETURN(sizes_, numbers(values, "SIZE"));
    } else if (key == "COUNT") {
      HYPERMAP_ASSIGN_OR_RETURN(counts_, numbers(values, "COUNT"));
    } else if (key == "WIDTH") {
      HYPERMAP_ASSIGN_OR_RETURN(width_, numbers(values, "WIDTH"));
    } else if (key == "HEIGHT") {
      HYPERMAP_ASSIGN_OR_RETURN(height_, numbers(values, "HEIGHT"));
    } else if (key == "POINTS") {
      HYPERMAP_ASSIGN_OR_RETURN(points_, numbers(values, "POINTS"));
    } else if (key == "VERSION") {
      return check_version(values);
    } else if (key == "DATA") {
      return take_form(values);
    } else if (key != "VIEWPOINT") {
      return malformed_cloud("is no key of a PCD header", printable(key, 40), lines_.line());
    }
    return {};
  }

  [[nodiscard]] Result<std::vector<std::uint64_t>> numbers(const Words& values,
                                                           const char* key) const {
    std::vector<std::uint64_t> numbers;
    for (const std::string_view value : values) {
      const auto number = parse_unsigned(value);
      if (!number) {
        return malformed_cloud(
            "must be a whole number, is '" + printable(value, 40) + "'", key, lines_.line());
      }
      numbers.push_back(*number);
    }
    return numbers;
  }

  Result<void> check_version(const Words& values) {
    constexpr std::array<std::string_view, 4> kVersions{"0.6", ".6", "0.7", ".7"};
    for (const std::string_view known : kVersions)
      if (values.size() == 1 && values.front() == known) return {};
    return Unexpected(Error{.code = ErrorCode::kUnsupported,
                            .what = "must be 0.6 or 0.7",
                            .field = "VERSION",
                            .line = lines_.line()});
  }

  Result<void> take_form(const Words& values) {
    has_data_ = true;
    const std::string_view form = values.size() == 1 ? values.front() : std::string_view();
    if (form == "ascii") return set_form(CloudForm::kText);
    if (form == "binary") return set_form(CloudForm::kRows);
    if (form == "binary_compressed") return set_form(CloudForm::kColumns);
    return Unexpected(Error{.code = ErrorCode::kUnsupported,
                            .what = "must be ascii, binary or binary_compressed",
                            .field = "DATA",
                            .line = lines_.line()});
  }
  Result<void> set_form(CloudForm form) {
    header_.form = form;
    return {};
  }

  Result<void> make_fields() {
    const std::size_t n = names_.size();
    if (n == 0 || n > kMaxCloudFields)
      return malformed_cloud("must name 1 to 1000 fields", "FIELDS");
    if (counts_.empty()) counts_.assign(n, 1);
    if (sizes_.size() != n) return malformed_cloud("must have one a field", "SIZE");
    if (types_.size() != n) return malformed_cloud("must have one a field", "TYPE");
    if (counts_.size() != n) return malformed_cloud("must have one a field", "COUNT");
    std::size_t offset = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto type = scalar_of(types_[i], sizes_[i]);
      if (!type) return malformed_cloud("TYPE and SIZE go together as no number does", names_[i]);
      if (counts_[i] > kMaxFieldValues) return malformed_cloud("is above 100000", "COUNT");
      header_.fields.push_back(
          {.name = names_[i], .type = *type, .count = counts_[i], .offset = offset});
      offset += counts_[i] * size_of(*type);
    }
    return {};
  }

  static std::optional<CloudScalar> scalar_of(const std::string& type, std::uint64_t size) {
    const bool is_integer = type == "I" || type == "U";
    if (type == "F") {
      if (size == 4) return CloudScalar::kFloat;
      return size == 8 ? std::optional(CloudScalar::kDouble) : std::nullopt;
    }
    if (!is_integer) return std::nullopt;
    const bool is_signed = type == "I";
    switch (size) {
      case 1:
        return is_signed ? CloudScalar::kInt8 : CloudScalar::kUint8;
      case 2:
        return is_signed ? CloudScalar::kInt16 : CloudScalar::kUint16;
      case 4:
        return is_signed ? CloudScalar::kInt32 : CloudScalar::kUint32;
      case 8:
        return is_signed ? CloudScalar::kInt64 : CloudScalar::kUint64;
      default:
        return std::nullopt;
    }
  }

  /// One of WIDTH with HEIGHT, and POINTS, may be missing.
  Result<void> check_size() {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
    const bool has_sides = width_.size() == 1 && height_.size() == 1;
    if (!has_sides && points_.size() != 1)
      return malformed_cloud("must be one number, or WIDTH and HEIGHT be", "POINTS");
    if (has_sides && (width_[0] > kMax || height_[0] > kMax))
      return malformed_cloud("is above 2^32 - 1", "WIDTH");
    const std::uint64_t of_sides = has_sides ? width_[0] * height_[0] : points_[0];
    const std::uint64_t num_points = points_.size() == 1 ? points_[0] : of_sides;
    if (num_points != of_sides)
      return malformed_cloud(
          "is " + std::to_string(num_points) + ", WIDTH times HEIGHT " + std::to_string(of_sides),
          "POINTS");
    header_.num_points = num_points;
    return {};
  }

  HeaderLines lines_;
  CloudHeader header_;
  bool has_data_ = false;
  std::vector<std::string> names_;
  std::vector<std::string> types_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint64_t> counts_;
  std::vector<std::uint64_t> width_;
  std::vector<std::uint64_t> height_;
  std::vector<std::uint64_t> points_;
};

}  // namespace

Result<CloudHeader> parse_pcd_header(std::string_view bytes) {
  return PcdHeaderReader(bytes).read();
}

Result<std::string> unpacked_lzf(std::string_view packed, std::size_t num_bytes) {
  constexpr unsigned kLiteralBelow = 32;
  const auto wrong = [] { return malformed_cloud("is not what its size says", "DATA"); };
  std::string out;
  out.reserve(num_bytes);
  std::size_t at = 0;
  const auto byte_at = [&](std::size_t place) { return static_cast<unsigned char>(packed[place]); };
  while (at < packed.size()) {
    const unsigned control = byte_at(at++);
    if (control < kLiteralBelow) {
      const std::size_t length = control + 1U;
      if (length > packed.size() - at || length > num_bytes - out.size()) return wrong();
      out.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5U;
    const bool is_long = length == 7;
    if (packed.size() - at < (is_long ? 2U : 1U)) return wrong();
    if (is_long) length += byte_at(at++);
    length += 2;
    const std::size_t back = ((control & 0x1FU) << 8U) + byte_at(at++) + 1U;
    if (back > out.size() || length > num_bytes - out.size()) return wrong();
    // What is copied may overlap what it makes.
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
  }
  if (out.size() != num_bytes) return wrong();
  return out;
}

}  // namespace hypermap
