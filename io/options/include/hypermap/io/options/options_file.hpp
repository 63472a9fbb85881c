// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Options of the main job by name: listed, set, read from YAML and written.
///
/// A name is the way to the field, "segmentation.foreground.max_planes"; in a file the sections
/// nest.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "hypermap/projection/grids/layer_options.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct OptionTable;

/// Everything that changes a map, besides the data.
struct MapOptions {
  SemanticMapperOptions mapper;
  LayerOptions layers;  ///< In files: section `projection`.
  friend bool operator==(const MapOptions&, const MapOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const MapOptions& options);
[[nodiscard]] const OptionTable& option_table(const MapOptions& options);

/// What `hypermap config` prints of one option.
struct OptionDescription {
  std::string name;
  std::string value;  ///< As it stands in a file.
  std::string unit;   ///< "m", "px", "log-odds" ...; empty for counts, shares and choices.
  std::string range;  ///< "0 .. 100", or the names of a choice.
  std::vector<std::string> choices;  ///< These names one by one; empty for all else.
  std::string source;                ///< Where the default comes from.
  std::string effect;
};

/// All options with their values in `options`, in the order of the stages.
[[nodiscard]] std::vector<OptionDescription> describe_options(const MapOptions& options);

/// A copy of `options` in which `name` has the value that `text` says in YAML.
/// Errors: kNotFound for an unknown name, with the nearest one; kInvalidArgument or kMalformedFile
/// for a value of the wrong kind or outside its range; those of `validate`.
[[nodiscard]] Result<MapOptions> with_option(const MapOptions& options,
                                             std::string_view name,
                                             std::string_view text);

/// Whether the option `name` may have the value that `text` says, whatever the others are.
/// Errors: as with_option.
[[nodiscard]] Result<void> check_option(std::string_view name, std::string_view text);

/// A copy of `base` with what the file says. A key `preset` (default, smap, hypermap) replaces the
/// `mapper.objects` of `base` before all other keys.
/// Errors: kIo; those of `read_yaml`; kNotFound for an unknown key, with the nearest known name;
/// kMalformedFile for a value, naming file, line and key; those of `validate`.
[[nodiscard]] Result<MapOptions> read_options(const std::filesystem::path& path,
                                              const MapOptions& base);

/// All options as a file that `read_options` gives back, with unit, range, source and effect as
/// comments. Threads and classes by number are no part of it: they do not change the result, or
/// have no meaning elsewhere.
[[nodiscard]] std::string write_options(const MapOptions& options);

}  // namespace hypermap
