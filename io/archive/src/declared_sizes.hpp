// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What images and octrees say of their own size, before any of them is decoded.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/projection/layers/layer_registry.hpp"

namespace hypermap {

/// Whether the grids and octrees that `config` names stay within `limits` by their headers, so that
/// the refusal of many large ones costs nothing. What cannot be found or understood counts as
/// nothing: reading it will say what is wrong.
///
/// Errors: kLimit naming the member that crosses the limit. Cost: some kilobytes of each member.
[[nodiscard]] Result<void> check_declared_sizes(const ArchiveMembers& members,
                                                const HypermapConfig& config,
                                                const BudgetLimits& limits,
                                                const LayerRegistry& types);

}  // namespace hypermap
