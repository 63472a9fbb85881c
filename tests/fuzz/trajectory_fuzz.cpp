// SPDX-License-Identifier: BSD-3-Clause
// All forms; TUM's is written, too.
#include "fuzz_target.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "targets.hpp"

#include <cstddef>

namespace hypermap::fuzz {

void fuzz_trajectory(std::string_view bytes) {
  const std::filesystem::path path = file_of(bytes, "trajectory.txt");
  static_cast<void>(read_log_trajectory(path));
  static_cast<void>(read_pose_matrix(path));
  static_cast<void>(read_pose_lines(path));
  const auto read = read_tum_trajectory(path);
  if (!read) return;
  std::string written;
  for (const StampedPose& pose : read->value.poses)
    written += to_tum_line(pose.stamp, pose.input_from_camera);
  const auto again = read_tum_trajectory(file_of(written, "written.txt"));
  require(require(again, "what was written is read").value.poses.size() == read->value.poses.size(),
          "as many poses");
  for (std::size_t i = 0; i < read->value.poses.size(); ++i)
    require(again->value.poses[i].stamp == read->value.poses[i].stamp, "at the same times");
}

}  // namespace hypermap::fuzz
