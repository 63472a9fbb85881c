// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A learnt combiner as a file: one JSON object of `format` hypermap-combiner, `version` 1,
/// `detectors` [{`name`, `classes`}] and `classes` [{`name`, `offset`, `weights`, `share`}].
/// Without `share` a class is as common as any.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/trained_combiner.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// Errors: kMalformedFile naming the JSON path: keys unknown or missing, and what
/// `validate(CombinerModel)` refuses; kUnsupported "written by a newer version N"; kLimit.
[[nodiscard]] Result<CombinerModel> parse_combiner(std::string_view text, const std::string& name);
/// A file of at most 16 MiB. Errors: those of parse_combiner; kIo; kLimit.
[[nodiscard]] Result<CombinerModel> read_combiner(const std::filesystem::path& path);

/// Numbers in the shortest form that reads back the same. Requires: validate(model).
[[nodiscard]] std::string write_combiner(const CombinerModel& model);

}  // namespace hypermap
