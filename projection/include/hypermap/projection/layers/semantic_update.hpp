// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Changes to a semantic layer that are made together or not at all.
///
/// Source: [hypermap] 3.3.4 (SemanticMapUpdate).
#pragma once

#include "hypermap/projection/layers/semantic_layer.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// What changes of one object; all else of it stays.
struct SemanticModification {
  std::uint64_t id = 0;
  std::optional<std::string> name = {};
  std::optional<std::vector<Polygon>> parts = {};
  std::string shape_text = {};  ///< Of `parts`, as in SemanticObject.
  std::optional<std::vector<std::string>> tags = {};
  std::optional<std::vector<double>> confidence = {};
  ValueTree extra = {};  ///< Further keys, as a map: each takes the place of the old one, if any.
  friend bool operator==(const SemanticModification&, const SemanticModification&) = default;
};

/// The object after the modification.
/// Deviation: the source's messages bear whole objects; here one that only gets another name need
/// not repeat its shape.
[[nodiscard]] SemanticObject modified(SemanticObject object,
                                      const SemanticModification& modification);

/// What becomes of a layer. An id stands in it once at most, so nothing depends on an order.
struct SemanticUpdate {
  std::vector<SemanticObject> to_add = {};  ///< With ids that no object of the layer bears.
  /// Further ones, which get the ids behind all that the layer and `to_add` have; theirs do not
  /// count.
  std::vector<SemanticObject> to_number = {};
  std::uint64_t least_new_id = 0;  ///< Of `to_number`: lower ones stand for something else.
  std::vector<SemanticModification> to_modify = {};
  std::vector<std::uint64_t> to_delete = {};
  friend bool operator==(const SemanticUpdate&, const SemanticUpdate&) = default;
};

/// What an update did.
struct SemanticUpdateReport {
  std::vector<std::uint64_t> added =
      {};  ///< Ids: of `to_add`, then of `to_number`, in their order.
  std::size_t num_modified = 0;
  std::size_t num_deleted = 0;
  friend bool operator==(const SemanticUpdateReport&, const SemanticUpdateReport&) = default;
};

}  // namespace hypermap
