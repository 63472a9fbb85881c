// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One object of a semantic YAML file, read key by key: what layers and their updates share.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/codec/wkt.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"

#include <cstddef>
#include <vector>

namespace hypermap {

/// What was mended in shapes, counted.
struct ShapeRepairs {
  std::size_t unclosed_rings = 0;
  std::size_t wound_rings = 0;
  std::size_t spiked_rings = 0;
  std::size_t missing_commas = 0;

  ShapeRepairs& operator+=(const ShapeRepairs& more);
  friend bool operator==(const ShapeRepairs&, const ShapeRepairs&) = default;
};

/// An object whose id is not settled yet.
struct SemanticEntry {
  SemanticObject object;
  bool has_id = false;
  ShapeRepairs repairs = {};
};

/// What a file says of an object that is there.
struct ModificationEntry {
  SemanticModification modification;
  ShapeRepairs repairs = {};
};

/// Errors: those of parse_semantic_layer for an entry.
[[nodiscard]] Result<SemanticEntry> parse_semantic_entry(const YamlNode& node,
                                                         const WktLimits& limits,
                                                         const LoadBudget& budget);
/// Only `id` is required; a key that says null takes away tags and confidence.
/// Errors: those of parse_semantic_entry.
[[nodiscard]] Result<ModificationEntry> parse_modification_entry(const YamlNode& node,
                                                                 const WktLimits& limits,
                                                                 const LoadBudget& budget);

/// "[3].shape" becomes "[3] (chair).shape", so that a person finds the entry.
[[nodiscard]] Error with_object_name(Error error, const YamlNode& node);
/// Keys of an entry that no reader here knows, which are kept.
[[nodiscard]] std::vector<Finding> unknown_object_keys(const YamlNode& node);
[[nodiscard]] std::vector<Finding> repair_findings(const ShapeRepairs& repairs,
                                                   const SourceName& source);

}  // namespace hypermap
