// SPDX-License-Identifier: BSD-3-Clause
#include "pgm_header.hpp"

#include <charconv>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxPgmCommentBytes = 65'536;

bool is_pgm_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

Unexpected malformed_header(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

Result<int> header_number(PgmText& text, const char* field, int max) {
  if (!text.skip_blanks()) return malformed_header("a comment never ends", field);
  const std::string_view at = text.rest();
  if (const auto number = text.number(max); number && *number > 0) return *number;
  return malformed_header(
      "is " + printable_token(at) + ", expected a number from 1 to " + std::to_string(max), field);
}

}  // namespace

bool PgmText::skip_blanks() {
  while (!rest_.empty() && (is_pgm_blank(rest_.front()) || rest_.front() == '#')) {
    if (rest_.front() != '#') {
      rest_.remove_prefix(1);
      continue;
    }
    const std::size_t end = rest_.find('\n');
    comment_bytes_ += end;
    if (end == std::string_view::npos || comment_bytes_ > kMaxPgmCommentBytes) return false;
    rest_.remove_prefix(end);
  }
  return true;
}

std::optional<int> PgmText::number(int max) {
  int value = 0;
  const auto end = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  const auto used = static_cast<std::size_t>(end.ptr - rest_.data());
  const bool ends = used == rest_.size() || is_pgm_blank(rest_[used]) || rest_[used] == '#';
  if (end.ec != std::errc() || !ends || value < 0 || value > max) return std::nullopt;
  rest_.remove_prefix(used);
  return value;
}

bool PgmText::skip_one_blank() {
  if (rest_.empty() || !is_pgm_blank(rest_.front())) return false;
  rest_.remove_prefix(1);
  return true;
}

Result<PgmHeader> read_pgm_header(std::string_view bytes) {
  const bool is_text = bytes.starts_with("P2");
  if (!is_text && !bytes.starts_with("P5")) return malformed_header("expected P2 or P5", "magic");
  if (bytes.size() < 3 || !(is_pgm_blank(bytes[2]) || bytes[2] == '#')) {
    return malformed_header("the header ends after the magic number", "header");
  }
  PgmText text(bytes.substr(2));
  constexpr int kMaxNumber = 2'147'483'647;
  PgmHeader header{.is_text = is_text};
  HYPERMAP_ASSIGN_OR_RETURN(header.width_px, header_number(text, "width", kMaxNumber));
  HYPERMAP_ASSIGN_OR_RETURN(header.height_px, header_number(text, "height", kMaxNumber));
  HYPERMAP_ASSIGN_OR_RETURN(header.max_value, header_number(text, "maxval", 65'535));
  if (!is_text && !text.skip_one_blank()) return malformed_header("no raster follows", "maxval");
  header.raster = text.rest();
  return header;
}

std::string printable_token(std::string_view text) {
  return "'" + printable(text.substr(0, 20)) + "'";
}

}  // namespace hypermap
