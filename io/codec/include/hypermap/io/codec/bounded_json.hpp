// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// JSON that others wrote, read strictly and within bounds.
///
/// Source: RFC 8259. Stricter: a key occurs once, text is valid UTF-8 without lone surrogates,
/// numbers fit a double. A byte order mark before the document is skipped.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap {

struct JsonLimits {
  std::size_t max_bytes = std::size_t{16} << 20U;
  std::size_t max_depth = 64;
  std::size_t max_values = 4'000'000;  ///< Bounds memory: 40 bytes a value.
};

enum class JsonKind : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };

/// A value of a document: a view, cheap to copy, valid as long as its document.
///
/// The typed readers fail with kMalformedFile and name document, line and path.
class JsonNode {
 public:
  [[nodiscard]] JsonKind kind() const;
  [[nodiscard]] bool is(JsonKind kind) const { return this->kind() == kind; }

  /// Number of elements or members; 0 for scalars.
  [[nodiscard]] std::size_t size() const;
  /// Element or member, in the order of the text. Requires: index < size().
  [[nodiscard]] JsonNode at(std::size_t index) const;
  /// Key of a member; empty for elements and the root.
  [[nodiscard]] std::string_view key() const;
  /// Member `key`; none when absent or when this is no object. Cost: O(size()).
  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;

  [[nodiscard]] Result<JsonNode> require(std::string_view key) const;
  [[nodiscard]] Result<double> number() const;
  /// A number written without fraction and exponent, within `low` .. `high`.
  [[nodiscard]] Result<std::int64_t> integer(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] Result<std::string_view> string() const;
  [[nodiscard]] Result<bool> boolean() const;
  [[nodiscard]] Result<void> expect(JsonKind kind) const;
  /// The number as it was written.
  [[nodiscard]] std::string_view number_text() const;

  /// "$.detections[0].score"
  [[nodiscard]] std::string path() const;
  [[nodiscard]] int line() const;
  /// An error about this value, document and line filled in.
  [[nodiscard]] Unexpected error(ErrorCode code, std::string what) const;

 private:
  friend class JsonDocument;
  struct Tree;
  friend class JsonParser;
  JsonNode(const Tree* tree, std::uint32_t index) : tree_(tree), index_(index) {}

  const Tree* tree_;
  std::uint32_t index_;
};

/// A parsed text. Movable; nodes stay valid.
class JsonDocument {
 public:
  /// `name` stands in errors; `first_line` is the line at which `text` begins in its file.
  ///
  /// Errors: kMalformedFile with line and path; kLimit naming the limit.
  /// Cost: O(text), memory bounded by `limits`.
  [[nodiscard]] static Result<JsonDocument> parse(std::string_view text,
                                                  std::string name,
                                                  const JsonLimits& limits = {},
                                                  int first_line = 1);
  JsonDocument(JsonDocument&&) noexcept;
  JsonDocument& operator=(JsonDocument&&) noexcept;
  ~JsonDocument();

  [[nodiscard]] JsonNode root() const;

 private:
  explicit JsonDocument(std::unique_ptr<JsonNode::Tree> tree);
  std::unique_ptr<JsonNode::Tree> tree_;
};

/// `text` as a JSON string, quotes included. Requires: valid UTF-8.
[[nodiscard]] std::string json_quoted(std::string_view text);

/// Shortest text that reads back as the same number. Requires: finite.
[[nodiscard]] std::string json_number(double value);
/// Shortest text that reads back as the same number of single precision. Requires: finite.
[[nodiscard]] std::string json_single(float value);

}  // namespace hypermap
