// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The plainest form of YAML, as programs write long lists: maps of bare words and numbers.
#pragma once

#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <optional>
#include <string_view>

namespace hypermap {

/// The tree of a document that is nothing but lines "- key: value" and "  key: value", whose keys
/// are identifiers and whose values are letters, digits, single blanks and `_ . , ( ) + - /`, or
/// `~`. None for any other text, also where a limit is crossed: YAML's own parser decides then.
///
/// What is returned is what that parser gives, lines included (a test, and the fuzz target `yaml`).
/// Measured: docs/RESULTS.md, "Large layers".
[[nodiscard]] std::optional<ValueTree> flat_records(std::string_view bytes,
                                                    const YamlLimits& limits);

}  // namespace hypermap
