// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map over its truth, seen from above: what was found, what was missed, what is not there.
///
/// Source: [hypermap] figures 11 to 16 (maps beside their truth). Deviation: one lies over the
/// other, so that nobody has to compare by eye.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/compared_plan.hpp"

#include <filesystem>
#include <string>

namespace hypermap {

/// Outlines of the truth in blue (dashed: those that do not count), footprints of the map filled in
/// orange, a line between the middles of what belongs together, a red cross on what was missed, a
/// red ring around what is false, a grey one around duplicates, each with class and id; below them
/// the legend with counts, and a scale bar. +x is to the right, +y up.
///
/// Boundary: without shapes the picture says so; shapes below a pixel are seen by their marks.
/// Errors: as SegmentationFigures::create.
[[nodiscard]] Result<ColorImage> draw_compared_plan(const ComparedPlan& plan,
                                                    const std::string& title,
                                                    const std::filesystem::path& font_file = {});

}  // namespace hypermap
