// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rules of relations that a user chose.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/relation_options.hpp"

#include <filesystem>

namespace hypermap {

/// A YAML map from names of `RelationOptions` to values; what it does not name has its default.
/// `data/relations.yaml` has them all. Errors: kIo; those of `read_yaml`; kNotFound for an unknown
/// key, with the nearest known name; kMalformedFile for a value, naming file, line and key; those
/// of `validate`.
[[nodiscard]] Result<RelationOptions> read_relation_options(const std::filesystem::path& path);

}  // namespace hypermap
