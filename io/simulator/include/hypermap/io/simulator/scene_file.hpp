// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Scenes for the simulator as YAML files; `data/scenes/` holds those that ship.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/simulator/scene.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// Reads a scene. The keys are described in `data/scenes/README.md`; lengths are metres, angles
/// degrees, and an unknown key is an error that suggests the nearest known one.
///
/// Errors: kIo; kMalformedFile or kInvalidArgument with file, key and line; kLimit beyond 1,000
/// objects, 1,000 fixtures, 10,000 waypoints or what the YAML reader bounds.
[[nodiscard]] Result<Scene> load_scene(const std::filesystem::path& path);

/// The same from text. `name` stands for the file in messages.
[[nodiscard]] Result<Scene> parse_scene(std::string_view yaml, const std::string& name);

/// Where the scene that the user named lies: a file of that name, else
/// `<data_dir>/scenes/<name>.yaml`.
///
/// Errors: kNotFound with the names of the scenes that ship.
[[nodiscard]] Result<std::filesystem::path> find_scene(const std::string& name_or_path,
                                                       const std::filesystem::path& data_dir);

}  // namespace hypermap
