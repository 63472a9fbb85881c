// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// YAML from untrusted sources: read within limits, accessed by key and type, with errors that name
/// file, line and field.
///
/// Scope: one document a file, UTF-8 (a byte order mark is skipped; UTF-16 is refused), line ends
/// LF or CRLF, keys are scalars, no key twice in a map, no merge keys, no tags but those of the
/// core schema. Aliases are copied, within a limit. Nothing depends on the locale.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct YamlLimits {
  std::size_t max_bytes = std::size_t{16} << 20U;       ///< Of the file.
  int max_depth = 64;                                   ///< Of nested lists and maps.
  std::size_t max_nodes = 1'000'000;                    ///< Of all values, copies of aliases too.
  std::size_t max_map_keys = 65'536;                    ///< Of one map.
  std::size_t max_alias_nodes = 10'000;                 ///< Values that anchors and aliases copy.
  std::size_t max_alias_bytes = std::size_t{1} << 20U;  ///< Text that anchors and aliases copy.
  std::size_t max_flow_items = 250'000;                 ///< Within one outermost [] or {}.
};

/// A place in a document: a value and the way to it ("layers[1].file").
///
/// A view: valid as long as its YamlDocument. Errors carry file, entry, line and field.
class YamlNode {
 public:
  YamlNode(const ValueTree& value, std::string path, const SourceName& source)
      : value_(&value), path_(std::move(path)), source_(&source) {}

  [[nodiscard]] const ValueTree& value() const noexcept { return *value_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] int line() const noexcept { return value_->line; }
  [[nodiscard]] bool is_null() const noexcept { return value_->kind == ValueKind::kNull; }
  [[nodiscard]] bool is_scalar() const noexcept { return value_->kind == ValueKind::kScalar; }
  [[nodiscard]] bool is_list() const noexcept { return value_->kind == ValueKind::kList; }
  [[nodiscard]] bool is_map() const noexcept { return value_->kind == ValueKind::kMap; }

  /// The value of `key`; none when the key is absent or this is no map.
  [[nodiscard]] std::optional<YamlNode> find(std::string_view key) const;
  /// The value of a required key. Errors: kMalformedFile when this is no map or the key is missing.
  [[nodiscard]] Result<YamlNode> at(std::string_view key) const;
  /// Errors: kMalformedFile when this is no list.
  [[nodiscard]] Result<std::vector<YamlNode>> as_list() const;
  /// Pairs of a map in the order of the document. Errors: kMalformedFile when this is no map.
  [[nodiscard]] Result<std::vector<std::pair<std::string, YamlNode>>> as_map() const;

  /// A scalar's text. Errors: kMalformedFile when this is a list, a map or null.
  [[nodiscard]] Result<std::string> as_string() const;
  /// A finite number within [min, max], decimal point, optional exponent. `.nan`, `.inf`, `1_000`,
  /// `1:30`, `0,05`, hexadecimal, and what overflows are refused.
  /// Errors: kMalformedFile.
  [[nodiscard]] Result<double> as_double(double min, double max) const;
  [[nodiscard]] Result<double> as_double() const;
  /// A decimal integer within [min, max]; `010` (octal elsewhere), `1e3` and `1.0` are refused.
  /// Errors: kMalformedFile.
  [[nodiscard]] Result<std::int64_t> as_int(std::int64_t min, std::int64_t max) const;
  /// true/false, yes/no, on/off in lower case, capitalised or upper case; in no other spelling, and
  /// not in quotes. Errors: kMalformedFile.
  [[nodiscard]] Result<bool> as_bool() const;
  /// A list of exactly `count` numbers. Errors: kMalformedFile.
  [[nodiscard]] Result<std::vector<double>> as_doubles(std::size_t count) const;

  /// An error about this value, with file, entry, line and field filled in.
  [[nodiscard]] Error error(std::string what, ErrorCode code = ErrorCode::kMalformedFile) const;
  /// Whether all keys of this map are in `known`. Errors: kMalformedFile when this is no map;
  /// `code` for the first that is not, with the nearest known one.
  [[nodiscard]] Result<void> refuse_other_keys(std::span<const std::string_view> known,
                                               ErrorCode code = ErrorCode::kNotFound) const;
  /// A finding for each key of this map that is not in `known`, naming the nearest known key.
  /// Boundary: not a map gives none.
  [[nodiscard]] std::vector<Finding> unknown_keys(std::span<const std::string_view> known) const;

 private:
  const ValueTree* value_;
  std::string path_;
  const SourceName* source_;
};

/// A document that was read whole, and where from.
struct YamlDocument {
  SourceName source;
  ValueTree value;

  /// Requires: the document outlives the node and stays where it is.
  [[nodiscard]] YamlNode root() const { return {value, "", source}; }
};

/// Errors: kMalformedFile with the line for anything that the scope above leaves out, for bytes
/// that are no UTF-8 or NUL, for a file without a value (empty, only comments); kLimit, named.
/// Cost: linear; the limits are watched while parsing, so a refusal needs no more than they allow.
[[nodiscard]] Result<YamlDocument> parse_yaml(std::string_view bytes,
                                              const SourceName& source,
                                              const YamlLimits& limits = {});
/// A file on disk. Errors: those of parse_yaml and kIo.
[[nodiscard]] Result<YamlDocument> read_yaml(const std::filesystem::path& path,
                                             const YamlLimits& limits = {});

enum class YamlStyle {
  kBlock,  ///< A line for each key and item; lists of scalars in one line.
  kFlow,   ///< All in one line.
};

/// The tree as YAML, the same bytes for the same tree: two blanks of indent, keys in the given
/// order, text quoted where it would otherwise read as something else (active text, numbers,
/// booleans), so that parse_yaml gives an equal tree. Requires: a tree within YamlLimits, as
/// parse_yaml gives it.
[[nodiscard]] std::string write_yaml(const ValueTree& tree, YamlStyle style = YamlStyle::kBlock);

/// `text` as it stands in YAML: bare where that is safe, else in double quotes with escapes.
[[nodiscard]] std::string yaml_scalar(std::string_view text);

}  // namespace hypermap
