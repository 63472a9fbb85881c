// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One part of a damaged archive at a time.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "salvaged_members.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// Whether an error is no matter of the part that was being read.
[[nodiscard]] bool is_of_the_system(const Error& error);

/// A part that was read; its findings say what was mended for that.
template <class T>
struct ReadPart {
  Loaded<T> loaded;
  std::vector<std::string> used;  ///< Its members.
};

/// Reads parts from members that are sound, each by itself. Refers to file, limits and layers.
class PartReader {
 public:
  PartReader(SalvagedContents contents,
             const std::string& file,
             const ArchiveLimits& limits,
             const LayerRegistry& layers,
             const StopCheck& stop)
      : contents_(std::move(contents)),
        file_(file),
        limits_(limits),
        layers_(layers),
        budget_(limits.sums, stop) {}

  [[nodiscard]] const SalvagedContents& contents() const noexcept { return contents_; }
  [[nodiscard]] const LoadBudget& budget() const noexcept { return budget_; }
  /// That the members belong to a part from now on.
  void use(const std::vector<std::string>& names) { used_.insert(names.begin(), names.end()); }
  [[nodiscard]] bool is_used(std::string_view name) const { return used_.contains(name); }

  /// What `read(members)` gives, a Result<Loaded<T>>. Errors: its own; kMalformedFile when it has a
  /// member that another part has.
  template <class T, class Read>
  [[nodiscard]] Result<ReadPart<T>> read(const Read& read) const {
    SalvagedMembers members(contents_, file_, budget_);
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read(members));
    ReadPart<T> part{.loaded = std::move(loaded), .used = members.taken_names()};
    for (const std::string& name : part.used) {
      if (is_used(name))
        return fail(ErrorCode::kMalformedFile, "has a member that another part has: " + name);
    }
    return part;
  }

  /// The layer that `layers[index]` tells of; where it cannot be read as it is, a semantic one
  /// without its wrong shapes, a grid by mended metadata. Errors: those of read_layer.
  [[nodiscard]] Result<ReadPart<LayerContent>> read_layer_part(const LayerEntry& entry,
                                                               std::size_t index);

 private:
  [[nodiscard]] Result<ReadPart<LayerContent>> read_as_it_is(const LayerEntry& entry,
                                                             std::size_t index) const;
  /// Errors: kMalformedFile when no shape is right.
  [[nodiscard]] Result<ReadPart<LayerContent>> read_sound_shapes(const LayerEntry& entry) const;
  /// The metadata stay mended where that helps.
  [[nodiscard]] Result<ReadPart<LayerContent>> read_mended_grid(const LayerEntry& entry,
                                                                std::size_t index);

  SalvagedContents contents_;
  const std::string& file_;
  const ArchiveLimits& limits_;
  const LayerRegistry& layers_;
  LoadBudget budget_;
  std::set<std::string, std::less<>> used_;
};

}  // namespace hypermap
