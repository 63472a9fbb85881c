// SPDX-License-Identifier: BSD-3-Clause
#include "surface_score.hpp"

#include <algorithm>
#include <cstdlib>

namespace hypermap {
namespace {

/// A plane that goes on outside the box is background, unless nothing else is there.
constexpr double kBackgroundPlaneScore = 0.05;
/// A surface that overlaps another detection's box by this, and ours less, is that one's.
constexpr double kCompetingOverlap = 0.5;
constexpr double kCompetingScore = 0.025;
/// A detector's box ends with its object: what reaches beyond it by this share of its side stands
/// before or behind the object.
constexpr double kMaxOverhang = 0.15;
constexpr double kOverhangScore = 0.25;
/// But for a box that is too narrow at one end: the object ends with it, by this, at the other.
constexpr double kSameEnd = 0.05;
/// No box is more exact than this.
constexpr double kEndNoiseCells = 1.5;
/// The rim of a desk is before the object, and no more likely it than a background plane.
constexpr double kRimScore = 0.05;

double overlap(const PixelRect& a, const PixelRect& b) {
  const double width = std::min(a.u_end, b.u_end) - std::max(a.u_begin, b.u_begin);
  const double height = std::min(a.v_end, b.v_end) - std::max(a.v_begin, b.v_begin);
  const double common = std::max(0.0, width) * std::max(0.0, height);
  return common / (static_cast<double>(a.width()) * a.height() +
                   static_cast<double>(b.width()) * b.height() - common);
}

/// A stretch of columns or rows.
struct Stretch {
  int begin = 0;
  int end = 0;
};

/// Whether a surface overhangs the box on one axis of a window that is so large. A tapering end is
/// little of a surface and yet reaches far. Where the picture cuts the box, nothing ends with it.
bool overhangs_along(Stretch surface, Stretch box, int window_end) {
  const auto side = static_cast<double>(box.end - box.begin);
  const auto reaches = [&](int cells) {
    return cells > std::max(kMaxOverhang * side, kEndNoiseCells);
  };
  const auto ends_with = [&](int cells, bool is_cut) {
    return !is_cut && std::abs(cells) <= std::max(kSameEnd * side, kEndNoiseCells);
  };
  const int before = box.begin - surface.begin;
  const int after = surface.end - box.end;
  return (reaches(before) && !ends_with(after, box.end == window_end)) ||
         (reaches(after) && !ends_with(before, box.begin == 0));
}

bool overhangs(const PixelRect& bounds, const DepthWindow& window) {
  const PixelRect& box = window.box;
  return overhangs_along(
             {bounds.u_begin, bounds.u_end}, {box.u_begin, box.u_end}, window.width()) ||
         overhangs_along({bounds.v_begin, bounds.v_end}, {box.v_begin, box.v_end}, window.height());
}

}  // namespace

double span_share(const PixelRect& rect, const PixelRect& box) {
  return static_cast<double>(rect.width()) * rect.height() /
         (static_cast<double>(box.width()) * box.height());
}

bool is_of_competing_box(const DepthComponent& component, const DepthWindow& window) {
  const double own = overlap(component.bounds, window.box);
  return std::any_of(window.competing_boxes.begin(),
                     window.competing_boxes.end(),
                     [&](const CompetingBox& competing_box) {
                       const double theirs = overlap(component.bounds, competing_box.cells);
                       return theirs > own && theirs > kCompetingOverlap;
                     });
}

double surface_score(const DepthWindow& window,
                     const DepthComponents& labelled,
                     const SupportContacts& supports,
                     std::uint32_t id) {
  const DepthComponent& component = labelled.components[id];
  if (component.kind == kOthersKind) return 0.0;
  const double outside = component.outside_share();
  return component.num_in_box * (1.0 - outside) * (1.0 - outside) *
         span_share(component.bounds_in_box, window.box) *
         std::min(1.0, 2.0 * component.outline_share()) *
         (component.kind != 0 ? kBackgroundPlaneScore : 1.0) *
         (supports.is_rim(id) ? kRimScore : 1.0) *
         (is_of_competing_box(component, window) ? kCompetingScore
          : overhangs(component.bounds, window)  ? kOverhangScore
                                                 : 1.0);
}

}  // namespace hypermap
