// SPDX-License-Identifier: BSD-3-Clause
#include "npy_header.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kNpySignature = "\x93NUMPY";
constexpr std::size_t kVersionAt = 6;
constexpr std::size_t kSizeAt = 8;
constexpr std::size_t kMaxDimensions = 32;

/// A literal of Python: `{'descr': '<f4', 'fortran_order': False, 'shape': (512,), }`.
class DictScanner {
 public:
  explicit DictScanner(std::string_view text) : text_(text) {}

  /// Skips blanks, then `expected`; whether it was there.
  bool skip(std::string_view expected) {
    while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\n')) {
      text_.remove_prefix(1);
    }
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }

  std::optional<std::string_view> quoted() {
    for (const std::string_view quote : {"'", "\""}) {
      if (!skip(quote)) continue;
      const std::size_t end = text_.find(quote);
      if (end == std::string_view::npos) return std::nullopt;
      const std::string_view content = text_.substr(0, end);
      text_.remove_prefix(end + 1);
      return content;
    }
    return std::nullopt;
  }

  std::optional<std::vector<std::uint64_t>> tuple() {
    if (!skip("(")) return std::nullopt;
    std::vector<std::uint64_t> numbers;
    while (!skip(")")) {
      std::uint64_t number = 0;
      const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
      if (error != std::errc() || numbers.size() >= kMaxDimensions) return std::nullopt;
      text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
      numbers.push_back(number);
      skip(",");
    }
    return numbers;
  }

  [[nodiscard]] bool at_end() {
    skip("");
    return text_.empty();
  }

 private:
  std::string_view text_;
};

struct NpyDict {
  std::optional<std::string_view> type;
  std::optional<std::vector<std::uint64_t>> shape;
};

Unexpected no_header() {
  return fail(ErrorCode::kMalformedFile, "is no header of NumPy", "header");
}

Result<NpyDict> parse_dict(std::string_view text) {
  DictScanner scanner(text);
  NpyDict dict;
  if (!scanner.skip("{")) return no_header();
  while (!scanner.skip("}")) {
    const auto key = scanner.quoted();
    if (!key || !scanner.skip(":")) return no_header();
    if (*key == "descr" && !dict.type) {
      dict.type = scanner.quoted();
      if (!dict.type) return fail(ErrorCode::kUnsupported, "must be one type of numbers", "descr");
    } else if (*key == "shape" && !dict.shape) {
      dict.shape = scanner.tuple();
      if (!dict.shape) return no_header();
    } else if (*key != "fortran_order" || !(scanner.skip("False") || scanner.skip("True"))) {
      return no_header();
    }
    scanner.skip(",");
  }
  if (!dict.type || !dict.shape || !scanner.at_end()) return no_header();
  return dict;
}

/// The dictionary's text. Errors: kUnsupported; kMalformedFile.
Result<std::string_view> dict_text(std::string_view bytes) {
  if (bytes.size() < kSizeAt + 4) return fail(ErrorCode::kMalformedFile, "is cut", "header");
  const auto version = static_cast<unsigned char>(bytes[kVersionAt]);
  if (version < 1 || version > 3) {
    return fail(ErrorCode::kUnsupported,
                "must be in 1 .. 3, is " + std::to_string(version),
                "version of NumPy's format");
  }
  const std::uint32_t number = uint32_at(bytes, kSizeAt);
  const std::size_t num_bytes = version == 1 ? number & 0xffffU : number;
  const std::size_t begin = version == 1 ? kSizeAt + 2 : kSizeAt + 4;
  if (num_bytes > bytes.size() - begin) return fail(ErrorCode::kMalformedFile, "is cut", "header");
  return bytes.substr(begin, num_bytes);
}

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t side : shape) {
    text += (text.empty() ? "" : ", ") + std::to_string(side);
  }
  return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace

bool is_npy(std::string_view bytes) {
  return bytes.starts_with(kNpySignature);
}

Result<NpyHeader> parse_npy_header(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, dict_text(bytes));
  HYPERMAP_ASSIGN_OR_RETURN(const NpyDict dict, parse_dict(text));
  if (*dict.type != "<f4" && *dict.type != "<f8") {
    return fail(ErrorCode::kUnsupported,
                "must be <f4 or <f8 (float32, float64), is " + printable(*dict.type),
                "descr");
  }
  const std::vector<std::uint64_t>& shape = *dict.shape;
  const bool is_row = shape.size() == 2 && shape.front() == 1;
  if (shape.size() != 1 && !is_row) {
    return fail(ErrorCode::kUnsupported, "must be one vector, is " + shape_text(shape), "shape");
  }
  return NpyHeader{
      .is_double = *dict.type == "<f8",
      .num_numbers = shape.back(),
      .num_header_bytes = static_cast<std::size_t>(text.data() - bytes.data()) + text.size()};
}

}  // namespace hypermap
