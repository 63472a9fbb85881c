// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which kind of file lies at a path, found by its content.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace hypermap {

/// Kinds of files (and folders) that we read.
enum class FileKind : std::uint8_t {
  kArchive,
  kOctree,
  kMap,  ///< map_server YAML with its image.
  kImage,
  kDepth,
  kSemantic,  ///< A list of names and polygons.
  kTrajectory,
  kIntrinsics,
  kDetections,
  kConfig,  ///< A bare map configuration, or a file of options.
  kDataset,
  kTruth,       ///< A list of what stands in a recorded sequence.
  kTile,        ///< Of a semantic occupancy grid: `.tile`, or `.bin` with its format in its name.
  kEmbedding,   ///< One vector, to be compared with those of objects: `.npy`, or JSON.
  kCloud,       ///< Points, PCD or PLY.
  kSequences,   ///< A list of sequences that are mapped together.
  kUpdate,      ///< Changes to a semantic layer.
  kZones,       ///< Where robots keep out or go slowly.
  kVocabulary,  ///< Aliases and super-classes of classes.
  kPlaces,      ///< What belongs in which places.
  kTileSet,     ///< The index of a map in tiles (`tiles.json`).
};

/// The names of the command line, in the order of the enumerators.
[[nodiscard]] std::span<const std::string_view> file_kind_names();
[[nodiscard]] std::string_view name_of(FileKind kind);
/// Errors: kInvalidArgument with the names there are.
[[nodiscard]] Result<FileKind> file_kind(std::string_view name);

/// What a file most likely is: a folder is a dataset; `.hmap`, `.ot`, `.bt` and tiles are what they
/// say;
/// else its first 64 KiB decide, and where they do not (empty, comments only) its extension.
///
/// Boundary: a 16-bit image of one channel is taken for depth. A broken file is given the kind
/// that it seems to be, so that the reader of that kind can say what is wrong. Errors: kIo;
/// kUnsupported when nothing fits.
[[nodiscard]] Result<FileKind> find_file_kind(const std::filesystem::path& path);

}  // namespace hypermap
