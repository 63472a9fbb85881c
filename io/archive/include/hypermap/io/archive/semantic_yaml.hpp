// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Semantic layers as files: a YAML list of named shapes.
///
/// Source: [hypermap] 3.3.5 (semantic files). An entry has `name` and `shape` (WKT), and may have
/// `tags`, `confidence` (a number, or one for each tag), `id`, and unknown keys, which
/// are kept.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/io/codec/wkt.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// Of a file of objects: as many as a layer holds, with a few corners each.
inline constexpr YamlLimits kSemanticYamlLimits{.max_bytes = std::size_t{1} << 30U,
                                                .max_nodes = 8'000'000};

struct SemanticReadOptions {
  YamlLimits yaml = kSemanticYamlLimits;
  WktLimits wkt = {};
  /// Leave out entries that are wrong, each an error among the findings, instead of refusing the
  /// file.
  bool skip_bad = false;
};

/// Entries without an id get the smallest free ones in file order, from 0 on. Findings: rings that
/// were closed or stood for their winding fill (counted), unknown keys. Errors: those of
/// parse_yaml; kMalformedFile, kUnsupported or kLimit naming the entry by index and name, the
/// field, the line, and in a shape the column; those of LoadBudget. Nothing is half loaded.
/// Unless a load gives its own `budget`, a layer has one by itself.
[[nodiscard]] Result<Loaded<SemanticLayer>> parse_semantic_layer(
    std::string_view yaml,
    const SourceName& source,
    const SemanticReadOptions& options = {},
    const LoadBudget& budget = LoadBudget(BudgetLimits()));
/// A file on disk. Errors: those above and kIo.
[[nodiscard]] Result<Loaded<SemanticLayer>> read_semantic_layer(
    const std::filesystem::path& path,
    const SemanticReadOptions& options = {},
    const LoadBudget& budget = LoadBudget(BudgetLimits()));

/// The layer as YAML in the order of ids, the same bytes for the same layer; a shape that nobody
/// edited stands as its file wrote it. Ids are written when they are not 0, 1, 2, ... Reading it
/// gives an equal layer.
[[nodiscard]] std::string write_semantic_layer(const SemanticLayer& layer);

}  // namespace hypermap
