// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 6> kKindNames{
    "null", "a boolean", "a number", "a string", "an array", "an object"};

std::string_view name_of(JsonKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

/// Piece of the text arena.
struct Slice {
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
};

struct Value {
  JsonKind kind = JsonKind::kNull;
  bool truth = false;
  std::uint32_t line = 0;
  std::uint32_t parent = 0;
  Slice key;
  Slice text;      ///< Of strings, decoded, and of numbers, as written.
  Slice children;  ///< Positions in `values`.
};

}  // namespace

struct JsonNode::Tree {
  std::string name;
  std::string arena;
  std::vector<Value> values;  ///< Children of one value lie together; the root is the last.

  [[nodiscard]] std::string_view view(Slice slice) const {
    return std::string_view(arena).substr(slice.offset, slice.size);
  }
};

/// Recursive descent; the nesting limit bounds the stack.
class JsonParser {
 public:
  JsonParser(std::string_view text, JsonNode::Tree& tree, const JsonLimits& limits, int first_line)
      : text_(text), tree_(tree), limits_(limits), line_(static_cast<std::uint32_t>(first_line)) {}

  Result<void> parse_document() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ += 3;
    HYPERMAP_ASSIGN_OR_RETURN(const Value root, parse_value());
    skip_blanks();
    if (at_ != text_.size()) return unexpected("the end of the document");
    static_cast<void>(settle(root));
    return {};
  }

 private:
  /// Where we are, for error messages: a key, or a position when the key is empty.
  struct Step {
    Slice key;
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

  Result<Value> parse_value() {
    skip_blanks();
    if (++num_values_ > limits_.max_values) {
      return error(ErrorCode::kLimit,
                   "at most " + std::to_string(limits_.max_values) + " values are read");
    }
    Value value;
    value.line = line_;
    if (next_is('{')) return parse_container(value, JsonKind::kObject);
    if (next_is('[')) return parse_container(value, JsonKind::kArray);
    if (next_is('"')) return parse_string_value(value);
    if (next_is('-') || (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9')) {
      return parse_number(value);
    }
    return parse_literal(value);
  }

  Result<Value> parse_literal(Value value) {
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

  Result<Value> parse_number(Value value) {
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

  Result<Value> parse_string_value(Value value) {
    HYPERMAP_ASSIGN_OR_RETURN(value.text, parse_string());
    value.kind = JsonKind::kString;
    return value;
  }

  /// Requires: at an opening quote. Appends to the arena.
  Result<Slice> parse_string() {
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
    return Slice{static_cast<std::uint32_t>(first),
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

  Result<Value> parse_container(Value value, JsonKind kind) {
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
      HYPERMAP_ASSIGN_OR_RETURN(Value item, parse_value());
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

  Slice keep(std::string_view text) {
    const auto offset = static_cast<std::uint32_t>(tree_.arena.size());
    tree_.arena.append(text);
    return {offset, static_cast<std::uint32_t>(text.size())};
  }

  /// Gives a value its final position and tells its children about it.
  std::uint32_t settle(const Value& value) {
    const auto index = static_cast<std::uint32_t>(tree_.values.size());
    tree_.values.push_back(value);
    for (std::uint32_t i = 0; i < value.children.size; ++i) {
      tree_.values[value.children.offset + i].parent = index;
    }
    return index;
  }

  Slice settle_children(std::size_t first_pending) {
    const auto offset = static_cast<std::uint32_t>(tree_.values.size());
    for (std::size_t i = first_pending; i < pending_.size(); ++i) settle(pending_[i]);
    pending_.resize(first_pending);
    return {offset, static_cast<std::uint32_t>(tree_.values.size()) - offset};
  }

  [[nodiscard]] Result<void> check_keys(const Value& object) const {
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
  JsonNode::Tree& tree_;
  const JsonLimits& limits_;
  std::uint32_t line_;
  std::size_t at_ = 0;
  std::size_t num_values_ = 0;
  std::vector<Step> steps_;
  std::vector<Value> pending_;  ///< Values whose container is still open.
};

JsonKind JsonNode::kind() const {
  return tree_->values[index_].kind;
}

std::size_t JsonNode::size() const {
  return tree_->values[index_].children.size;
}

JsonNode JsonNode::at(std::size_t index) const {
  assert(index < size());
  return {tree_, tree_->values[index_].children.offset + static_cast<std::uint32_t>(index)};
}

std::string_view JsonNode::key() const {
  return tree_->view(tree_->values[index_].key);
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (!is(JsonKind::kObject)) return std::nullopt;
  for (std::size_t i = 0; i < size(); ++i) {
    if (at(i).key() == key) return at(i);
  }
  return std::nullopt;
}

Result<JsonNode> JsonNode::require(std::string_view key) const {
  HYPERMAP_TRY(expect(JsonKind::kObject));
  if (const auto member = find(key)) return *member;
  return error(ErrorCode::kMalformedFile, "missing key \"" + std::string(key) + "\"");
}

Result<void> JsonNode::expect(JsonKind kind) const {
  if (is(kind)) return {};
  return error(
      ErrorCode::kMalformedFile,
      "is " + std::string(name_of(this->kind())) + ", expected " + std::string(name_of(kind)));
}

std::string_view JsonNode::number_text() const {
  return is(JsonKind::kNumber) ? tree_->view(tree_->values[index_].text) : std::string_view{};
}

Result<double> JsonNode::number() const {
  HYPERMAP_TRY(expect(JsonKind::kNumber));
  const std::string_view text = number_text();
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Result<std::int64_t> JsonNode::integer(std::int64_t low, std::int64_t high) const {
  HYPERMAP_TRY(expect(JsonKind::kNumber));
  const std::string_view text = number_text();
  std::int64_t value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size() || value < low || value > high) {
    return error(ErrorCode::kMalformedFile,
                 "must be an integer in " + std::to_string(low) + " .. " + std::to_string(high) +
                     ", is " + printable(text));
  }
  return value;
}

Result<std::string_view> JsonNode::string() const {
  HYPERMAP_TRY(expect(JsonKind::kString));
  return tree_->view(tree_->values[index_].text);
}

Result<bool> JsonNode::boolean() const {
  HYPERMAP_TRY(expect(JsonKind::kBoolean));
  return tree_->values[index_].truth;
}

std::string JsonNode::path() const {
  const std::uint32_t root = static_cast<std::uint32_t>(tree_->values.size() - 1);
  std::string out;
  for (std::uint32_t i = index_; i != root;) {
    const Value& value = tree_->values[i];
    const Value& parent = tree_->values[value.parent];
    const std::string step = parent.kind == JsonKind::kArray
                                 ? "[" + std::to_string(i - parent.children.offset) + "]"
                                 : "." + std::string(tree_->view(value.key));
    out.insert(0, step);
    i = value.parent;
  }
  return "$" + out;
}

int JsonNode::line() const {
  return static_cast<int>(tree_->values[index_].line);
}

Unexpected JsonNode::error(ErrorCode code, std::string what) const {
  return Unexpected(Error{
      .code = code, .what = std::move(what), .file = tree_->name, .field = path(), .line = line()});
}

JsonDocument::JsonDocument(std::unique_ptr<JsonNode::Tree> tree) : tree_(std::move(tree)) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

Result<JsonDocument> JsonDocument::parse(std::string_view text,
                                         std::string name,
                                         const JsonLimits& limits,
                                         int first_line) {
  if (text.size() > limits.max_bytes) {
    return Unexpected(Error{.code = ErrorCode::kLimit,
                            .what = "a JSON document of at most " +
                                    std::to_string(limits.max_bytes) + " bytes is read, has " +
                                    std::to_string(text.size()),
                            .file = std::move(name),
                            .line = first_line});
  }
  auto tree = std::make_unique<JsonNode::Tree>();
  tree->name = std::move(name);
  HYPERMAP_TRY(JsonParser(text, *tree, limits, first_line).parse_document());
  return JsonDocument(std::move(tree));
}

JsonNode JsonDocument::root() const {
  return {tree_.get(), static_cast<std::uint32_t>(tree_->values.size() - 1)};
}

std::string json_quoted(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7F) {
      out += {'\\', 'u', '0', '0', kHex[byte >> 4U], kHex[byte & 0xFU]};
    } else {
      out.push_back(c);
    }
  }
  return out + '"';
}

std::string json_number(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace hypermap
