// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which depth image, colour image and pose make up each frame of a dataset.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// One frame before its images are read. Paths are relative to the folder, empty where missing.
struct SequenceEntry {
  std::string name;
  std::optional<std::uint64_t> number;
  Stamp stamp;
  std::string depth;
  std::string color;
  std::string labels;
  std::string instances;
  std::string pose_file;                ///< With TrajectoryFormat::kMatrix.
  std::optional<InputFromCamera> pose;  ///< With the other formats; optical axes.
  std::string missing_pose_reason;      ///< When there is neither.
};

struct SequenceIndex {
  std::vector<SequenceEntry> entries;  ///< By number or stamp.
  std::size_t num_depth = 0;
  std::size_t num_color = 0;
  std::size_t num_poses = 0;
  std::vector<std::string> unpaired;
  std::vector<Finding> findings;
};

/// Errors: those of lists and trajectories; kNotFound when there is no depth image.
[[nodiscard]] Result<SequenceIndex> index_sequence(const std::filesystem::path& folder,
                                                   const DatasetDescription& description);

/// Poses as written, for the description's direction and axes, as camera to world of optical axes.
[[nodiscard]] InputFromCamera as_optical(const InputFromCamera& written,
                                         const DatasetDescription& description);

/// The element of `sorted` (by stamp) nearest to `stamp`, the earlier of equals; none when it is
/// farther than `tolerance_ns` or there is none. Gives its position.
template <class Elements, class StampOf>
[[nodiscard]] std::optional<std::size_t> nearest_stamp(const Elements& sorted,
                                                       Stamp stamp,
                                                       std::int64_t tolerance_ns,
                                                       const StampOf& stamp_of) {
  std::size_t low = 0;
  std::size_t high = sorted.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (stamp_of(sorted[middle]) < stamp) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  std::optional<std::size_t> best;
  std::int64_t best_ns = tolerance_ns;
  const auto consider = [&](std::size_t i) {
    const std::int64_t apart = std::abs(stamp_of(sorted[i]).ns - stamp.ns);
    if (apart < best_ns || (apart == best_ns && !best)) {
      best = i;
      best_ns = apart;
    }
  };
  if (low > 0) consider(low - 1);
  if (low < sorted.size()) consider(low);
  return best;
}

}  // namespace hypermap
