// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The surfaces of true objects as lines of JSON: a head, then one line for each object, so that
/// what is read equals what was written bit by bit.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/true_surfaces.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hypermap {

/// The newest version that is read, and the one that is written.
inline constexpr int kTrueSurfacesVersion = 1;

struct TrueSurfacesLimits {
  std::size_t max_objects = 1'000'000;
  std::size_t max_line_bytes = std::size_t{64} << 20;  ///< One object is one line.
};

/// Errors: those of validate(TrueSurfaces).
[[nodiscard]] Result<std::string> write_true_surfaces(const TrueSurfaces& surfaces);

/// Errors: kMalformedFile with line and path for a missing or unknown key, a wrong type, what
/// `validate` refuses, a number of lines that is not the one said; kUnsupported "written by a newer
/// version N"; kLimit; kInterrupted when `budget` is told to stop; nothing is drawn of it.
[[nodiscard]] Result<TrueSurfaces> parse_true_surfaces(std::string_view bytes,
                                                       const SourceName& source,
                                                       const TrueSurfacesLimits& limits = {},
                                                       const LoadBudget& budget = {});

}  // namespace hypermap
