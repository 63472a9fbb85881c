// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The files of one layer, wherever they lie: what a type of layer loads from and saves to.
///
/// A layer has a stem; a member is named by what follows the stem: "" is the stem itself, ".yaml"
/// the member `<stem>.yaml`. Of a grid the suffix comes before its two extensions.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <string>
#include <string_view>

namespace hypermap {

/// Reads members of one layer. Each can be read once.
///
/// Errors, of all: kMalformedFile when the member is not there or breaks its format, kLimit, kIo;
/// file, member, field and line are filled in. What a loader itself finds wrong it returns with the
/// field alone: the archive names the member that was read last.
class LayerReader {
 public:
  virtual ~LayerReader() = default;

  /// Of the members, as the archive says; 1 to that of the registered type.
  [[nodiscard]] virtual int version() const = 0;
  [[nodiscard]] virtual Result<std::string> bytes(std::string_view suffix) = 0;
  [[nodiscard]] virtual Result<ValueTree> yaml(std::string_view suffix) = 0;
  /// `<stem><suffix>.yaml` and the image that it names.
  [[nodiscard]] virtual Result<OccupancyLayer> grid(std::string_view suffix) = 0;
  /// A list of named shapes.
  [[nodiscard]] virtual Result<SemanticLayer> shapes(std::string_view suffix) = 0;

 protected:
  LayerReader() = default;
  LayerReader(const LayerReader&) = default;
  LayerReader& operator=(const LayerReader&) = default;
};

/// Takes members of one layer.
///
/// Errors, of all: kInvalidArgument when the member exists already or cannot be expressed.
class LayerWriter {
 public:
  virtual ~LayerWriter() = default;

  [[nodiscard]] virtual Result<void> bytes(std::string_view suffix, std::string bytes) = 0;
  [[nodiscard]] virtual Result<void> yaml(std::string_view suffix, const ValueTree& tree) = 0;
  [[nodiscard]] virtual Result<void> grid(std::string_view suffix, const OccupancyLayer& grid) = 0;
  [[nodiscard]] virtual Result<void> shapes(std::string_view suffix,
                                            const SemanticLayer& shapes) = 0;

 protected:
  LayerWriter() = default;
  LayerWriter(const LayerWriter&) = default;
  LayerWriter& operator=(const LayerWriter&) = default;
};

}  // namespace hypermap
