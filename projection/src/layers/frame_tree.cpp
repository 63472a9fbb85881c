// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/frame_tree.hpp"

#include <cmath>
#include <map>
#include <vector>

namespace hypermap {
namespace {

constexpr double kMaxTranslation = 1e6;

bool is_sane(const FrameTransform& transform) {
  return std::isfinite(transform.yaw_rad) && std::abs(transform.x_m) <= kMaxTranslation &&
         std::abs(transform.y_m) <= kMaxTranslation;
}

}  // namespace

Eigen::Isometry2d FrameTransform::parent_from_child() const {
  Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
  pose.translate(Eigen::Vector2d(x_m, y_m));
  pose.rotate(yaw_rad);
  return pose;
}

Result<void> FrameTree::add(FrameTransform transform) {
  const std::string pair =
      printable(transform.frame_id) + " -> " + printable(transform.child_frame_id);
  if (transform.frame_id.empty() || transform.child_frame_id.empty()) {
    return fail(ErrorCode::kInvalidArgument, "a frame must have a name: " + pair, "frame_id");
  }
  if (!is_sane(transform)) {
    return fail(
        ErrorCode::kInvalidArgument, "must be finite and within 1e6 m: " + pair, "transform_pose");
  }
  if (to_from(transform.frame_id, transform.child_frame_id)) {
    return fail(
        ErrorCode::kInvalidArgument, "the frames are connected already: " + pair, "child_frame_id");
  }
  transforms_.push_back(std::move(transform));
  return {};
}

Result<Eigen::Isometry2d> FrameTree::to_from(std::string_view to, std::string_view from) const {
  // Breadth first from `from`; in a forest there is one way at most.
  std::map<std::string_view, Eigen::Isometry2d> reached_from_from;
  reached_from_from[from] = Eigen::Isometry2d::Identity();
  std::vector<std::string_view> waiting = {from};
  for (std::size_t i = 0; i < waiting.size() && reached_from_from.count(to) == 0; ++i) {
    const std::string_view here = waiting[i];
    const Eigen::Isometry2d here_from_from = reached_from_from.at(here);
    for (const FrameTransform& t : transforms_) {
      const bool is_up = t.child_frame_id == here;
      if (!is_up && t.frame_id != here) continue;
      const std::string_view there = is_up ? t.frame_id : t.child_frame_id;
      const Eigen::Isometry2d parent_from_child = t.parent_from_child();
      const Eigen::Isometry2d there_from_here =
          is_up ? parent_from_child : parent_from_child.inverse();
      if (reached_from_from.emplace(there, there_from_here * here_from_from).second) {
        waiting.push_back(there);
      }
    }
  }
  const auto found = reached_from_from.find(to);
  if (found != reached_from_from.end()) return found->second;
  return fail(ErrorCode::kNotFound,
              "nothing connects " + printable(from) + " and " + printable(to),
              "frame_id");
}

}  // namespace hypermap
