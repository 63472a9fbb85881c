// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Builds a ValueTree from yaml-cpp's events and refuses what exceeds the limits while it grows.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Thrown through yaml-cpp by the builder; never leaves bounded_yaml.cpp.
struct YamlRefusal {
  Error error;
};

/// How often a text opens or separates flow items, or would if it stood bare.
[[nodiscard]] std::size_t num_flow_marks(std::string_view text);

class YamlTreeBuilder : public YAML::EventHandler {
 public:
  explicit YamlTreeBuilder(const YamlLimits& limits) : limits_(limits) {}

  /// Notes that the parser has read so many openings and separators of flow items ahead.
  void count_flow_items(std::size_t count);
  /// The document's value. Throws YamlRefusal when there is none.
  [[nodiscard]] ValueTree take();

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark,
                const std::string& tag,
                YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark,
                       const std::string& tag,
                       YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark,
                  const std::string& tag,
                  YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  /// A list or map that is still open.
  struct Frame {
    ValueTree value;
    YAML::anchor_t anchor = 0;
    std::set<std::string> keys = {};
    std::optional<std::string> pending_key = {};
    int key_line = 0;
  };

  [[noreturn]] void refuse(ErrorCode code, std::string what, int line) const;
  [[nodiscard]] std::string path() const;
  [[nodiscard]] bool expects_key() const;
  void check_tag(const std::string& tag, const char* allowed, int line) const;
  void count_nodes(std::size_t count, int line);
  /// Escaped marks count, too: they are written as they are.
  void check_text(const std::string& text, int line) const;
  void check_depth(std::size_t depth, int line) const;
  void charge_copy(const ValueTree& tree, int line);
  void take_key(const std::string& text, bool bare, int line);
  void open(ValueKind kind, YAML::anchor_t anchor, int line);
  void close();
  void place(ValueTree value, YAML::anchor_t anchor);

  YamlLimits limits_;
  std::vector<Frame> open_;
  std::map<YAML::anchor_t, ValueTree> anchored_;
  std::optional<ValueTree> root_;
  int num_documents_ = 0;
  std::size_t num_nodes_ = 0;
  std::size_t copied_nodes_ = 0;
  std::size_t copied_bytes_ = 0;
  std::size_t flow_items_ahead_ = 0;
};

}  // namespace hypermap
