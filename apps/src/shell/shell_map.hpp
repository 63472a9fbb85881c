// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The map that a session of the shell works on.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// A layer that can be asked, read or not.
struct ShellLayer {
  std::string name;
  std::string class_name;  ///< Of a layer; the format of an extension.
  std::string frame_id;
};

/// A map of which octrees, objects and class grids are read once something asks for them. A load
/// that fails, of the map or of such a part, changes nothing.
class ShellMap {
 public:
  explicit ShellMap(ArchiveLimits limits) : limits_(limits) {}

  /// Takes the map of an archive, or of a bare configuration with its files.
  /// Errors: those of load_archive_parts and load_archive.
  [[nodiscard]] Result<void> load(const std::filesystem::path& path);
  /// Takes the map of a bare configuration. Errors: also kInvalidArgument for an archive.
  [[nodiscard]] Result<void> load_config(const std::filesystem::path& path);
  /// Saves the whole map and stands for that file from now on; without a path to the archive that
  /// it stands for. Errors: kInvalidArgument when there is none; those of `whole` and save_archive.
  [[nodiscard]] Result<void> save(const std::optional<std::filesystem::path>& path);
  void clear();

  /// All that is read by now.
  [[nodiscard]] const MapArchive& read_by_now() const noexcept { return partial_.map; }
  /// With these parts. Errors: those of load_archive_parts; kIo when the file is no longer the one
  /// that was loaded.
  [[nodiscard]] Result<const MapArchive*> with(const ArchiveParts& parts);
  /// With all there is. Errors: the same.
  [[nodiscard]] Result<const MapArchive*> whole();
  /// With what answers for the layer of that name. Errors: the same.
  [[nodiscard]] Result<const MapArchive*> for_layer(std::string_view name);

  /// In the order of `archive_layers`, without reading more.
  [[nodiscard]] std::vector<ShellLayer> layers() const;
  /// How many maps were taken before this one and with it; 0: none.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// The file whose map is in no archive; none: nothing is unsaved.
  [[nodiscard]] const std::optional<std::filesystem::path>& unsaved() const { return unsaved_; }
  /// What was noticed on reading since it was last taken, each once.
  [[nodiscard]] std::vector<Finding> take_findings();

 private:
  /// What the system says of a file, by which another one of its name is known.
  struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t number = 0;
    std::int64_t num_bytes = 0;
    std::int64_t changed_ns = 0;
    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
  };

  [[nodiscard]] static Result<FileIdentity> identity_of(const std::filesystem::path& path);
  [[nodiscard]] Result<void> load_whole_config(const std::filesystem::path& path);
  void take(PartialMap map, const ArchiveParts& parts);
  void keep(std::vector<Finding> findings);
  /// Errors: kIo when the file is no longer the one that was loaded.
  [[nodiscard]] Result<void> expect_same_file() const;
  [[nodiscard]] ArchiveParts parts_of(std::string_view layer) const;

  ArchiveLimits limits_;
  PartialMap partial_;
  ArchiveParts parts_ = {};                                      ///< That are read.
  bool is_whole_ = true;                                         ///< With what no question needs.
  std::optional<std::filesystem::path> archive_ = std::nullopt;  ///< That the map stands for.
  std::optional<FileIdentity> identity_ = std::nullopt;          ///< Of that, until all is read.
  std::optional<std::filesystem::path> unsaved_ = std::nullopt;
  std::uint64_t revision_ = 0;
  std::vector<Finding> findings_;
  std::set<std::string> told_;  ///< Findings of this map; parts are read with what they stand on.
};

}  // namespace hypermap::app
