// SPDX-License-Identifier: BSD-3-Clause
// Source: G. Turk, "The PLY Polygon File Format".
#include "cloud_header.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxPlyFields = 1'000;
constexpr std::size_t kMaxPlyNames = 100'000;
constexpr std::size_t kMaxPlyCount = std::size_t{1} << 40U;

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<CloudField> fields = {};
  bool has_lists = false;

  [[nodiscard]] std::size_t row_bytes() const {
    return fields.empty() ? 0 : fields.back().offset + size_of(fields.back().type);
  }
};

std::optional<CloudScalar> ply_scalar(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, CloudScalar>, 16> kTypes{
      {{"char", CloudScalar::kInt8},
       {"int8", CloudScalar::kInt8},
       {"uchar", CloudScalar::kUint8},
       {"uint8", CloudScalar::kUint8},
       {"short", CloudScalar::kInt16},
       {"int16", CloudScalar::kInt16},
       {"ushort", CloudScalar::kUint16},
       {"uint16", CloudScalar::kUint16},
       {"int", CloudScalar::kInt32},
       {"int32", CloudScalar::kInt32},
       {"uint", CloudScalar::kUint32},
       {"uint32", CloudScalar::kUint32},
       {"float", CloudScalar::kFloat},
       {"float32", CloudScalar::kFloat},
       {"double", CloudScalar::kDouble},
       {"float64", CloudScalar::kDouble}}};
  const auto found = std::find_if(
      kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.first == name; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

/// The header line by line, then what of it the element `vertex` is.
class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(std::string_view bytes) : lines_(bytes) {}

  Result<CloudHeader> read() {
    (void)lines_.next();  // ply
    while (!is_done_) {
      const auto line = lines_.next();
      if (!line)
        return malformed_cloud("the header ends before end_header", "end_header", lines_.line());
      HYPERMAP_TRY(take(*line));
    }
    if (!has_format_) return malformed_cloud("is missing", "format");
    HYPERMAP_TRY(take_vertices());
    header_.num_bytes = lines_.num_bytes();
    header_.num_lines = lines_.line();
    return std::move(header_);
  }

 private:
  Result<void> take(std::string_view line) {
    const std::vector<std::string_view> words = split_words(line);
    if (words.empty() || words[0] == "obj_info") return {};
    if (words[0] == "comment") return take_comment(line, words);
    if (words[0] == "format") return take_format(words);
    if (words[0] == "element") return take_element(words);
    if (words[0] == "property") return take_property(words);
    is_done_ = words[0] == "end_header";
    if (is_done_) return {};
    return malformed_cloud("is no key of a PLY header", printable(words[0], 40), lines_.line());
  }

  /// "comment label 3 dining table"; any other comment says nothing.
  Result<void> take_comment(std::string_view line, const std::vector<std::string_view>& words) {
    if (words.size() < 4 || words[1] != "label") return {};
    std::int64_t label = 0;
    const auto [end, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), label);
    if (error != std::errc() || end != words[2].data() + words[2].size()) return {};
    if (header_.names.size() >= kMaxPlyNames) return {};
    const auto from = static_cast<std::size_t>(words[3].data() - line.data());
    header_.names[label] = std::string(trimmed(line.substr(from)));
    return {};
  }

  Result<void> take_format(const std::vector<std::string_view>& words) {
    has_format_ = true;
    const std::string_view form = words.size() == 3 ? words[1] : std::string_view();
    header_.form = form == "ascii" ? CloudForm::kText : CloudForm::kRows;
    header_.is_big_endian = form == "binary_big_endian";
    const bool is_known =
        form == "ascii" || form == "binary_little_endian" || header_.is_big_endian;
    if (is_known && words[2] == "1.0") return {};
    return Unexpected(
        Error{.code = ErrorCode::kUnsupported,
              .what = "must be ascii, binary_little_endian or binary_big_endian, version 1.0",
              .field = "format",
              .line = lines_.line()});
  }

  Result<void> take_element(const std::vector<std::string_view>& words) {
    const auto count = words.size() == 3 ? parse_unsigned(words[2]) : std::nullopt;
    if (!count || *count > kMaxPlyCount || elements_.size() >= kMaxPlyFields) {
      return malformed_cloud("must be a name and a count", "element", lines_.line());
    }
    elements_.push_back({.name = std::string(words[1]), .count = *count});
    return {};
  }

  Result<void> take_property(const std::vector<std::string_view>& words) {
    if (elements_.empty() || elements_.back().fields.size() >= kMaxPlyFields)
      return malformed_cloud("must be one of 1000 of an element", "property", lines_.line());
    PlyElement& element = elements_.back();
    if (words.size() == 5 && words[1] == "list") {
      element.has_lists = true;
      return {};
    }
    const auto type = words.size() == 3 ? ply_scalar(words[1]) : std::nullopt;
    if (!type) return malformed_cloud("must be a type and a name", "property", lines_.line());
    element.fields.push_back(
        {.name = std::string(words[2]), .type = *type, .offset = element.row_bytes()});
    return {};
  }

  Result<void> take_vertices() {
    for (const PlyElement& element : elements_) {
      if (element.has_lists && header_.form == CloudForm::kRows)
        return malformed_cloud("has lists before the end of the vertices", element.name);
      if (element.name == "vertex") {
        if (element.has_lists) return malformed_cloud("has lists", element.name);
        header_.fields = element.fields;
        header_.num_points = element.count;
        return {};
      }
      header_.num_lines_before += element.count;
      header_.bytes_before += element.count * element.row_bytes();
    }
    return malformed_cloud("is missing", "vertex");
  }

  HeaderLines lines_;
  CloudHeader header_;
  bool has_format_ = false;
  bool is_done_ = false;
  std::vector<PlyElement> elements_;
};

}  // namespace

Result<CloudHeader> parse_ply_header(std::string_view bytes) {
  return PlyHeaderReader(bytes).read();
}

}  // namespace hypermap
