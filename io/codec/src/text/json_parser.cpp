// SPDX-License-Identifier: BSD-3-Clause
#include "json_parser.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Recursive descent; the nesting limit bounds the stack.
class Descent {
 public:
  Descent(std::string_view text, JsonParser::Tree& tree, const JsonLimits& limits, int first_line)
      : text_(text), tree_(tree), limits_(limits), line_(static_cast<std::uint32_t>(first_line)) {}

  Result<void> parse_document() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ += 3;
    HYPERMAP_ASSIGN_OR_RETURN(const JsonValue root, parse_value());
    skip_blanks();
    if (at_ != text_.size()) return unexpected("the end of the document");
    static_cast<void>(settle(root));
    return {};
  }

 private:
  /// Where we are, for error messages: a key, or a position when the key is empty.
  struct Step {
    JsonSlice key;
    std::size_t index = 0;
    bool is_index = false;
  };

  [[nodiscard]] std::string path() const {
    std::string out = "$";
    for (const Step& step : steps_) {
      out += step.is_index ? "[" + std::to_string(step.index) + "]"
                           : "." + std::string(tree_.view(step.key));
    }
    return out;
  }

  [[nodiscard]] Unexpected error(ErrorCode code, std::string what) const {
    return Unexpected(Error{.code = code,
                            .what = std::move(what),
                            .file = tree_.name,
                            .field = path(),
                            .line = static_cast<int>(line_)});
  }

  [[nodiscard]] Unexpected unexpected(std::string_view expected) const {
    const std::string found =
        at_ < text_.size() ? "'" + printable(text_.substr(at_, 1)) + "'" : "the end of the text";
    return error(ErrorCode::kMalformedFile,
                 "found " + found + ", expected " + std::string(expected));
  }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return;
    }
  }

  [[nodiscard]] bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }

  bool take(char c) {
    if (!next_is(c)) return false;
    ++at_;
    return true;
  }

  Result<JsonValue> parse_value() {
    skip_blanks();
    if (++num_values_ > limits_.max_values) {
      return error(ErrorCode::kLimit,
                   "at most " + std::to_string(limits_.max_values) + " values are read");
    }
    JsonValue value;
    value.line = line_;
    if (next_is('{')) return parse_container(value, JsonKind::kObject);
    if (next_is('[')) return parse_container(value, JsonKind::kArray);
    if (next_is('"')) return parse_string_value(value);
    if (next_is('-') || (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9')) {
      return parse_number(value);
    }
    return parse_literal(value);
  }

  Result<JsonValue> parse_literal(JsonValue value) {
    constexpr std::array<std::string_view, 3> kLiterals{"null", "true", "false"};
    for (const std::string_view literal : kLiterals) {
      if (!text_.substr(at_).starts_with(literal)) continue;
      at_ += literal.size();
      value.kind = literal == "null" ? JsonKind::kNull : JsonKind::kBoolean;
      value.truth = literal == "true";
      return value;
    }
    return unexpected("a value");
  }

  bool take_digits() {
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
    return at_ > first;
  }

  Result<JsonValue> parse_number(JsonValue value) {
    const std::size_t first = at_;
    take('-');
    if (!take('0') && !take_digits()) return unexpected("a digit");
    if (take('.') && !take_digits()) return unexpected("a digit");
    if (take('e') || take('E')) {
      if (!take('+')) take('-');
      if (!take_digits()) return unexpected("a digit");
    }
    const std::string_view written = text_.substr(first, at_ - first);
    double number = 0.0;
    if (std::from_chars(written.data(), written.data() + written.size(), number).ec !=
        std::errc{}) {
      return error(ErrorCode::kMalformedFile,
                   "must be a number that fits a double, is " + printable(written));
    }
    value.kind = JsonKind::kNumber;
    value.text = keep(written);
    return value;
  }

  Result<JsonValue> parse_string_value(JsonValue value) {
    HYPERMAP_ASSIGN_OR_RETURN(value.text, parse_string());
    value.kind = JsonKind::kString;
    return value;
  }

  /// Requires: at an opening quote. Appends to the arena.
  Result<JsonSlice> parse_string() {
    ++at_;
    const std::size_t first = tree_.arena.size();
    while (!take('"')) {
      if (at_ >= text_.size()) return unexpected("a closing quote");
      if (text_[at_] == '\\') {
        HYPERMAP_TRY(parse_escape());
        continue;
      }
      const std::size_t length = utf8_length(text_, at_);
      if (length == 0) return error(ErrorCode::kMalformedFile, "must be UTF-8, has " + byte_here());
      if (static_cast<unsigned char>(text_[at_]) < 0x20) {
        return error(ErrorCode::kMalformedFile,
                     "must escape control characters, has " + byte_here());
      }
      tree_.arena.append(text_.substr(at_, length));
      at_ += length;
    }
    return JsonSlice{static_cast<std::uint32_t>(first),
                     static_cast<std::uint32_t>(tree_.arena.size() - first)};
  }

  [[nodiscard]] std::string byte_here() const { return printable(text_.substr(at_, 1)); }

  Result<void> parse_escape() {
    ++at_;
    constexpr std::string_view kLetters = "\"\\/bfnrt";
    constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
    if (take('u')) return parse_unicode_escape();
    const std::size_t which = at_ < text_.size() ? kLetters.find(text_[at_]) : kLetters.npos;
    if (which == kLetters.npos) return unexpected("an escape letter");
    tree_.arena.push_back(kMeanings[which]);
    ++at_;
    return {};
  }

  Result<std::uint32_t> parse_hex4() {
    const std::string_view digits = text_.substr(at_, 4);
    std::uint32_t code = 0;
    const auto [end, ec] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() < 4 || ec != std::errc{} || end != digits.data() + 4) {
      return unexpected("four hexadecimal digits");
    }
    at_ += 4;
    return code;
  }

  Result<void> parse_unicode_escape() {
    HYPERMAP_ASSIGN_OR_RETURN(std::uint32_t code, parse_hex4());
    const bool is_high = code >= 0xD800 && code < 0xDC00;
    if (is_high && text_.substr(at_).starts_with("\\u")) {
      at_ += 2;
      HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t low, parse_hex4());
      if (low < 0xDC00 || low > 0xDFFF) return lone_surrogate();
      code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
    } else if (code >= 0xD800 && code < 0xE000) {
      return lone_surrogate();
    }
    append_utf8(tree_.arena, code);
    return {};
  }

  [[nodiscard]] Unexpected lone_surrogate() const {
    return error(ErrorCode::kMalformedFile, "must be UTF-8, has a surrogate without its partner");
  }

  Result<JsonValue> parse_container(JsonValue value, JsonKind kind) {
    if (steps_.size() >= limits_.max_depth) {
      return error(ErrorCode::kLimit,
                   "nesting too deep, at most " + std::to_string(limits_.max_depth) + " levels");
    }
    ++at_;
    value.kind = kind;
    const char closing = kind == JsonKind::kObject ? '}' : ']';
    const std::size_t first_pending = pending_.size();
    skip_blanks();
    if (!take(closing)) HYPERMAP_TRY(parse_items(kind, closing, first_pending));
    value.children = settle_children(first_pending);
    if (kind == JsonKind::kObject) HYPERMAP_TRY(check_keys(value));
    return value;
  }

  Result<void> parse_items(JsonKind kind, char closing, std::size_t first_pending) {
    steps_.push_back({.key = {}, .index = 0, .is_index = kind == JsonKind::kArray});
    do {
      steps_.back().index = pending_.size() - first_pending;
      if (kind == JsonKind::kObject) HYPERMAP_TRY(parse_key());
      HYPERMAP_ASSIGN_OR_RETURN(JsonValue item, parse_value());
      item.key = steps_.back().key;
      pending_.push_back(item);
      skip_blanks();
    } while (take(','));
    steps_.pop_back();
    if (!take(closing)) return unexpected(closing == '}' ? "',' or '}'" : "',' or ']'");
    return {};
  }

  Result<void> parse_key() {
    skip_blanks();
    if (!next_is('"')) return unexpected("a key in quotes");
    HYPERMAP_ASSIGN_OR_RETURN(steps_.back().key, parse_string());
    skip_blanks();
    if (!take(':')) return unexpected("':'");
    return {};
  }

  JsonSlice keep(std::string_view text) {
    const auto offset = static_cast<std::uint32_t>(tree_.arena.size());
    tree_.arena.append(text);
    return {offset, static_cast<std::uint32_t>(text.size())};
  }

  /// Gives a value its final position and tells its children about it.
  std::uint32_t settle(const JsonValue& value) {
    const auto index = static_cast<std::uint32_t>(tree_.values.size());
    tree_.values.push_back(value);
    for (std::uint32_t i = 0; i < value.children.size; ++i) {
      tree_.values[value.children.offset + i].parent = index;
    }
    return index;
  }

  JsonSlice settle_children(std::size_t first_pending) {
    const auto offset = static_cast<std::uint32_t>(tree_.values.size());
    for (std::size_t i = first_pending; i < pending_.size(); ++i) settle(pending_[i]);
    pending_.resize(first_pending);
    return {offset, static_cast<std::uint32_t>(tree_.values.size()) - offset};
  }

  [[nodiscard]] Result<void> check_keys(const JsonValue& object) const {
    std::vector<std::string_view> keys;
    for (std::uint32_t i = 0; i < object.children.size; ++i) {
      keys.push_back(tree_.view(tree_.values[object.children.offset + i].key));
    }
    std::sort(keys.begin(), keys.end());
    const auto twice = std::adjacent_find(keys.begin(), keys.end());
    if (twice == keys.end()) return {};
    return error(ErrorCode::kMalformedFile, "duplicate key \"" + printable(*twice) + "\"");
  }

  std::string_view text_;
  JsonParser::Tree& tree_;
  const JsonLimits& limits_;
  std::uint32_t line_;
  std::size_t at_ = 0;
  std::size_t num_values_ = 0;
  std::vector<Step> steps_;
  std::vector<JsonValue> pending_;  ///< Values whose container is still open.
};

}  // namespace

Result<void> JsonParser::parse(std::string_view text,
                               Tree& tree,
                               const JsonLimits& limits,
                               int first_line) {
  return Descent(text, tree, limits, first_line).parse_document();
}

}  // namespace hypermap
