// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands say which stack they make of a map.
#pragma once

#include "class_names.hpp"
#include "command.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "load_arguments.hpp"
#include "sensed_arguments.hpp"

#include <CLI/App.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// A map, and the stack that was asked of it.
struct StackOfFile {
  MapArchive map;  ///< With its own vocabulary.
  GridStack stack;
  std::optional<SensedStackReport> sensed = std::nullopt;  ///< Of the frames that were fused.
  /// As num_cells_without_class, where the stack is of voxels and no occupancy layer was fused.
  std::optional<std::size_t> cells_without_class = std::nullopt;
};

/// Says on stderr, after the command's name, what cells without a class count as; nothing of none.
void tell_cells_without_class(const char* command, std::optional<std::size_t> num_cells);

struct StackArguments {
  std::string file;                    ///< Empty where the stack comes from tiles.
  std::string tiles;                   ///< Folder; empty where it comes from a map.
  std::optional<std::string> archive;  ///< Where the map with what was made is saved.
  std::optional<std::string> from;     ///< The stack is this layer of the map's.
  MapStackRequest request;
  std::string rule = "biodds";
  std::vector<std::string> fused;  ///< NAME or NAME=WEIGHT.
  std::vector<std::string> layers;
  std::optional<std::string> area;
  std::optional<double> resolution_m;
  double yaw_deg = 0.0;
  SensedArguments sensed;
  ClassNames class_names;
  LoadArguments load;

  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError for what is no number, area or layer. To be called before make.
  void finish();
  /// The stack with the frames asked for, cut out as asked; of tiles the map has nothing else.
  /// Errors: those of loading, stack_of_map or read_tile_map, fuse_frames and cut_out; kUnsupported
  /// when the layer to take it from is no stack.
  [[nodiscard]] Result<StackOfFile> make(const CommonOptions& common) const;
  /// Saves the map with the layers that were made, where an archive is asked for; gives its path.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> save(StackOfFile made,
                                                                std::vector<Layer> further) const;

 private:
  void keep_to_one_source() const;
  void keep_heights_in_order() const;
  [[nodiscard]] Result<MapArchive> map() const;
  [[nodiscard]] Result<GridStack> uncut_stack(const MapArchive& map) const;
  [[nodiscard]] Result<std::optional<std::size_t>> cells_without_class(const MapArchive& map) const;
};

/// The full name of a layer that may be named without its parent.
[[nodiscard]] std::string full_layer_name(const GridStackOptions& options, const std::string& name);

}  // namespace hypermap::app
