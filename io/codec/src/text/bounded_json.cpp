// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"

#include "json_parser.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 6> kKindNames{
    "null", "a boolean", "a number", "a string", "an array", "an object"};

std::string_view name_of(JsonKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

}  // namespace

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
    const JsonValue& value = tree_->values[i];
    const JsonValue& parent = tree_->values[value.parent];
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
  HYPERMAP_TRY(JsonParser::parse(text, *tree, limits, first_line));
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

namespace {

template <class Number>
std::string shortest_text(Number value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace

std::string json_number(double value) {
  return shortest_text(value);
}
std::string json_single(float value) {
  return shortest_text(value);
}

}  // namespace hypermap
