// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An input that is to be mapped into a map that is there already: where its world lies in it,
/// whether it is in it already, and from where its frames count.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/dataset/gravity_alignment.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// The alignment of the run that has the input's world, taken over bit by bit, or where
/// `job.placement` puts the world.
///
/// A run has the input's world when both name it alike, or, with `job.same_world`, the newest run
/// of an input called `input_name`, else the newest. Errors: kInvalidArgument when nothing says
/// where the world lies, when `job.up_axis` contradicts the map's alignment, or when the map has no
/// run; those of align_to_gravity.
[[nodiscard]] Result<GravityAlignment> align_to_map(const MappingJob& job,
                                                    const DatasetReader& dataset,
                                                    const std::string& input_name,
                                                    std::span<const Provenance> runs);

/// Errors: kInvalidArgument when the frame is the first of a run.
[[nodiscard]] Result<void> refuse_first_frame(const RgbdFrame& frame,
                                              std::span<const Provenance> runs);
/// Errors: kInvalidArgument when a run had the same frames.
[[nodiscard]] Result<void> refuse_input_hash(const std::string& input_hash,
                                             std::span<const Provenance> runs);

/// Errors: kInvalidArgument naming those that there are when a run has that name.
[[nodiscard]] Result<void> refuse_known_session(const std::string& name,
                                                std::span<const Provenance> runs);

/// What the index of each frame of an input grows by, so that it is later than all that the map has
/// seen; 0 when it is later as it is. `first`: the input's first frame.
/// Errors: kLimit when the indices of the map leave no room for others.
[[nodiscard]] Result<std::uint64_t> index_offset(const MapArchive& map, std::uint64_t first);

/// What to say when the newest run knew what belongs where and this one does not: its objects then
/// get classes by another rule than theirs. None when it knows, or the newest did not.
[[nodiscard]] std::optional<Finding> find_dropped_prior(const PlacePriorOptions& prior,
                                                        std::span<const Provenance> runs);

/// Adds a run. Where there are `kMaxRuns` the oldest but one is forgotten.
void add_run(std::vector<Provenance>& runs, Provenance run);
/// What to say of the run that `add_run` will forget. Requires: `runs` has `kMaxRuns`.
[[nodiscard]] Finding forgotten_run(std::span<const Provenance> runs);

}  // namespace hypermap
