// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_tree_builder.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr const char* kCoreTag = "tag:yaml.org,2002:";

struct TreeSize {
  std::size_t nodes = 1;
  std::size_t bytes = 0;
  int depth = 0;  ///< Of lists and maps within each other; 0 of a scalar.
};

TreeSize size_of(const ValueTree& tree) {  // NOLINT(misc-no-recursion): depth is bounded
  TreeSize size{.bytes = tree.text.size()};
  const auto add = [&](const ValueTree& child) {
    const TreeSize part = size_of(child);
    size.nodes += part.nodes;
    size.bytes += part.bytes;
    size.depth = std::max(size.depth, part.depth);
  };
  for (const ValueTree& item : tree.items) add(item);
  for (const auto& [key, value] : tree.entries) {
    size.bytes += key.size();
    add(value);
  }
  if (tree.kind == ValueKind::kList || tree.kind == ValueKind::kMap) ++size.depth;
  return size;
}

/// The text with U+0085 and U+00A0 where yaml-cpp has but a byte for their escapes `\N` and `\_`.
std::string whole_utf8(std::string_view text) {
  std::string out;
  for (std::size_t bad = first_bad_utf8(text); bad < text.size(); bad = first_bad_utf8(text)) {
    out.append(text.substr(0, bad)).append(1, '\xC2').append(1, text[bad]);
    text.remove_prefix(bad + 1);
  }
  return out.append(text);
}

/// What YAML takes for nothing when it stands bare.
bool is_null_word(std::string_view text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

int line_of(const YAML::Mark& mark) {
  return mark.line + 1;
}

}  // namespace

std::size_t num_flow_marks(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == '{'; }));
}

void YamlTreeBuilder::count_flow_items(std::size_t count) {
  flow_items_ahead_ += count;
  if (flow_items_ahead_ > limits_.max_flow_items) {
    refuse(ErrorCode::kLimit,
           "more than " + std::to_string(limits_.max_flow_items) + " items in one flow collection",
           0);
  }
}

ValueTree YamlTreeBuilder::take() {
  if (!root_) refuse(ErrorCode::kMalformedFile, "holds no value, expected a YAML document", 0);
  return *std::exchange(root_, std::nullopt);
}

void YamlTreeBuilder::OnDocumentStart(const YAML::Mark& mark) {
  if (++num_documents_ > 1) {
    refuse(ErrorCode::kMalformedFile, "a second document starts, expected one", line_of(mark));
  }
}

void YamlTreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  if (expects_key()) refuse(ErrorCode::kMalformedFile, "a key is empty", line_of(mark));
  // yaml-cpp marks a missing value where the next token stands; the key's line is of more use.
  const bool has_key = !open_.empty() && open_.back().pending_key;
  const int line = has_key ? open_.back().key_line : line_of(mark);
  count_nodes(1, line);
  place({.line = line}, anchor);
}

void YamlTreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const int line = line_of(mark);
  if (expects_key()) refuse(ErrorCode::kUnsupported, "an alias as key is not read", line);
  const auto found = anchored_.find(anchor);
  if (found == anchored_.end()) {
    refuse(ErrorCode::kMalformedFile, "an alias stands within the value that it names", line);
  }
  charge_copy(found->second, line);
  const TreeSize size = size_of(found->second);
  check_depth(open_.size() + static_cast<std::size_t>(size.depth), line);
  count_nodes(size.nodes, line);
  ValueTree copy = found->second;
  copy.line = line;
  place(std::move(copy), 0);
}

void YamlTreeBuilder::OnScalar(const YAML::Mark& mark,
                               const std::string& tag,
                               YAML::anchor_t anchor,
                               const std::string& value) {
  const int line = line_of(mark);
  const bool bare = tag == "?" || tag.empty();
  const bool is_text = tag == "!" || tag == std::string(kCoreTag) + "str";
  if (!is_text) check_tag(tag, "str int float bool null", line);
  check_text(value, line);
  if (expects_key()) return take_key(whole_utf8(value), bare, line);
  count_nodes(1, line);
  if (!is_text && is_null_word(value)) return place({.line = line}, anchor);
  place({.kind = ValueKind::kScalar,
         .text = whole_utf8(value),
         .quoted = is_text && reads_as_no_text(value),
         .line = line},
        anchor);
}

void YamlTreeBuilder::OnSequenceStart(const YAML::Mark& mark,
                                      const std::string& tag,
                                      YAML::anchor_t anchor,
                                      YAML::EmitterStyle::value /*style*/) {
  check_tag(tag, "seq", line_of(mark));
  open(ValueKind::kList, anchor, line_of(mark));
}

void YamlTreeBuilder::OnMapStart(const YAML::Mark& mark,
                                 const std::string& tag,
                                 YAML::anchor_t anchor,
                                 YAML::EmitterStyle::value /*style*/) {
  check_tag(tag, "map", line_of(mark));
  open(ValueKind::kMap, anchor, line_of(mark));
}

void YamlTreeBuilder::refuse(ErrorCode code, std::string what, int line) const {
  throw YamlRefusal{{.code = code, .what = std::move(what), .field = path(), .line = line}};
}

std::string YamlTreeBuilder::path() const {
  std::string out;
  for (const Frame& frame : open_) {
    if (frame.value.kind == ValueKind::kList) {
      out += "[" + std::to_string(frame.value.items.size()) + "]";
    } else if (frame.pending_key) {
      out += (out.empty() ? "" : ".") + *frame.pending_key;
    }
  }
  return out;
}

bool YamlTreeBuilder::expects_key() const {
  return !open_.empty() && open_.back().value.kind == ValueKind::kMap && !open_.back().pending_key;
}

void YamlTreeBuilder::check_tag(const std::string& tag, const char* allowed, int line) const {
  if (tag.empty() || tag == "?" || tag == "!") return;
  const std::string prefix = kCoreTag;
  const std::string padded = std::string(" ") + allowed + " ";
  const bool known = tag.starts_with(prefix) &&
                     padded.find(" " + tag.substr(prefix.size()) + " ") != std::string::npos;
  if (!known) refuse(ErrorCode::kUnsupported, "the tag " + printable(tag) + " is not read", line);
}

void YamlTreeBuilder::count_nodes(std::size_t count, int line) {
  flow_items_ahead_ = 0;
  num_nodes_ += count;
  if (num_nodes_ > limits_.max_nodes) {
    refuse(ErrorCode::kLimit, "more than " + std::to_string(limits_.max_nodes) + " values", line);
  }
}

void YamlTreeBuilder::check_text(const std::string& text, int line) const {
  if (num_flow_marks(text) <= limits_.max_flow_items) return;
  refuse(ErrorCode::kLimit,
         "more than " + std::to_string(limits_.max_flow_items) + " commas and brackets in one text",
         line);
}

void YamlTreeBuilder::check_depth(std::size_t depth, int line) const {
  if (depth <= static_cast<std::size_t>(limits_.max_depth)) return;
  refuse(ErrorCode::kLimit,
         "nested deeper than " + std::to_string(limits_.max_depth) + " levels",
         line);
}

void YamlTreeBuilder::charge_copy(const ValueTree& tree, int line) {
  const TreeSize size = size_of(tree);
  copied_nodes_ += size.nodes;
  copied_bytes_ += size.bytes;
  if (copied_nodes_ > limits_.max_alias_nodes || copied_bytes_ > limits_.max_alias_bytes) {
    refuse(ErrorCode::kLimit,
           "anchors and aliases copy more than " + std::to_string(limits_.max_alias_nodes) +
               " values or " + std::to_string(limits_.max_alias_bytes) + " bytes",
           line);
  }
}

void YamlTreeBuilder::take_key(const std::string& text, bool bare, int line) {
  if (bare && text == "<<") refuse(ErrorCode::kUnsupported, "merge keys are not read", line);
  Frame& map = open_.back();
  if (!map.keys.insert(text).second) {
    refuse(ErrorCode::kMalformedFile, "the key " + printable(text) + " stands twice", line);
  }
  if (map.keys.size() > limits_.max_map_keys) {
    refuse(ErrorCode::kLimit,
           "more than " + std::to_string(limits_.max_map_keys) + " keys in one map",
           line);
  }
  flow_items_ahead_ = 0;
  map.pending_key = text;
  map.key_line = line;
}

void YamlTreeBuilder::open(ValueKind kind, YAML::anchor_t anchor, int line) {
  if (expects_key()) {
    refuse(ErrorCode::kUnsupported, "a list or map as key is not read, expected text", line);
  }
  check_depth(open_.size() + 1, line);
  count_nodes(1, line);
  open_.push_back({.value = {.kind = kind, .line = line}, .anchor = anchor});
}

void YamlTreeBuilder::close() {
  Frame frame = std::move(open_.back());
  open_.pop_back();
  place(std::move(frame.value), frame.anchor);
}

void YamlTreeBuilder::place(ValueTree value, YAML::anchor_t anchor) {
  if (anchor != 0) {
    charge_copy(value, value.line);
    anchored_[anchor] = value;
  }
  if (open_.empty()) {
    root_ = std::move(value);
    return;
  }
  Frame& parent = open_.back();
  if (parent.value.kind == ValueKind::kList) {
    parent.value.items.push_back(std::move(value));
  } else {
    parent.value.entries.emplace_back(std::move(*parent.pending_key), std::move(value));
    parent.pending_key.reset();
  }
}

}  // namespace hypermap
