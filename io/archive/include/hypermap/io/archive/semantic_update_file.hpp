// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Changes to a semantic layer as a file: what a person or another program wants of it.
///
/// Source: [hypermap] 3.3.4 (SemanticMapUpdate), with objects as its files have them (3.3.5).
/// A map of three lists, each of which may be missing: `add` (objects as in semantic_yaml.hpp,
/// those without an id get new ones), `modify` (`id` and the keys that change; `tags: ~` takes them
/// away), `delete` (ids).
#pragma once

#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"

#include <filesystem>
#include <string_view>

namespace hypermap {

/// What the file says; whether it fits a layer is that layer's business (SemanticLayer::apply).
/// Findings: as parse_semantic_layer. Errors: those of parse_yaml; kMalformedFile, kUnsupported or
/// kLimit naming list, entry, field and line: another key than those three, none of them, or what
/// parse_semantic_layer refuses of an object; those of LoadBudget. `skip_bad` does not hold here:
/// an update is whole.
[[nodiscard]] Result<Loaded<SemanticUpdate>> parse_semantic_update(
    std::string_view yaml,
    const SourceName& source,
    const SemanticReadOptions& options = {},
    const LoadBudget& budget = LoadBudget(BudgetLimits()));
/// A file on disk. Errors: those above and kIo.
[[nodiscard]] Result<Loaded<SemanticUpdate>> read_semantic_update(
    const std::filesystem::path& path,
    const SemanticReadOptions& options = {},
    const LoadBudget& budget = LoadBudget(BudgetLimits()));

}  // namespace hypermap
