// SPDX-License-Identifier: BSD-3-Clause
#include "support_contacts.hpp"

#include "surface_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// Cosine of the angle from level up to which a plane supports things: 10 degrees.
constexpr float kLevelCos = 0.985F;
/// A plane that goes on beyond the box by less of its side may be the object's own.
constexpr double kLeastBeyond = 0.15;
/// What is of a support touches it along so much of its border.
constexpr double kLeastContact = 0.25;
/// An object passes a plane when so much of its best surface is farther below than this.
constexpr float kBelowM = 0.05F;
constexpr double kLeastBelow = 0.15;
/// A rim is no higher than this in so many of its surface's columns ...
constexpr float kMostRimHeightM = 0.12F;
constexpr double kLeastRimColumns = 0.5;
/// ... and has this share of its cells outside the box.
constexpr double kLeastRimOutside = 0.03;
/// The edge of a table's top and the frame below it are no farther apart in depth.
constexpr float kMostRimDepthM = 0.1F;
/// A top that is seen so flat that nothing is measured on it has so many pixels: at edges sensors
/// lose half of this.
constexpr int kUnmeasuredTopPx = 20;
constexpr int kNoColumn = -1;
/// What lies below a ledge is measured within so many cells of it.
constexpr int kLedgeReachCells = 4;
/// Cosine of the roll up to which a column of the picture stands upright: 30 degrees. A camera that
/// looks straight down has none.
constexpr float kLeastUpright = 0.866F;
constexpr float kLeastLevel = 0.1F;

bool goes_on_beyond(const PixelRect& bounds, const PixelRect& box) {
  const double columns = std::max(box.u_begin - bounds.u_begin, bounds.u_end - box.u_end);
  const double rows = std::max(box.v_begin - bounds.v_begin, bounds.v_end - box.v_end);
  return columns >= kLeastBeyond * box.width() || rows >= kLeastBeyond * box.height();
}

/// Whether the surface goes on outside the box, to the sides of the window at least where those are
/// not the picture's, which cuts the box as well.
bool leaves_box(const DepthComponent& component, const DepthWindow& window) {
  const PixelRect& bounds = component.bounds;
  return component.outside_share() >= kLeastRimOutside ||
         (bounds.u_begin == 0 && window.box.u_begin > 0) ||
         (bounds.u_end == window.width() && window.box.u_end < window.width());
}

}  // namespace

SupportContacts::SupportContacts(const DepthImage& depth_m,
                                 const DepthWindow& window,
                                 const DepthComponents& labelled,
                                 const std::vector<Plane>& planes,
                                 const Eigen::Vector3f& up_in_camera)
    : depth_m_(depth_m),
      window_(window),
      labelled_(labelled),
      planes_(planes),
      up_in_camera_(up_in_camera),
      is_support_(labelled.components.size(), false),
      num_borders_(labelled.components.size(), 0),
      num_contacts_(labelled.components.size() * planes.size(), 0),
      num_rim_columns_(labelled.components.size(), 0),
      last_rim_column_(labelled.components.size(), kNoColumn) {
  for (std::size_t id = 0; id < is_support_.size(); ++id) {
    const DepthComponent& component = labelled.components[id];
    is_support_[id] = component.kind != 0 && component.kind != kOthersKind &&
                      is_level(planes[component.kind - 1U]) &&
                      goes_on_beyond(component.bounds, window.box);
  }
  if (std::ranges::find(is_support_, true) != is_support_.end()) count_borders();
  const float level = std::hypot(up_in_camera.x(), up_in_camera.y());
  if (level < kLeastLevel || -up_in_camera.y() < kLeastUpright * level) return;
  for (int x = window.box.u_begin; x < window.box.u_end; ++x) {
    count_rims_of_column(x, kMostRimHeightM * level);
  }
}

bool SupportContacts::is_level(const Plane& plane) const {
  return std::abs(plane.normal.dot(up_in_camera_)) >= kLevelCos;
}

bool SupportContacts::touches_plane(std::size_t cell, std::size_t other) const {
  const std::uint32_t other_id = labelled_.of_cell[other];
  if (other_id == kNoComponent || !is_support_[other_id]) return false;
  const float depth_m = window_.depth_m[cell];
  const float other_m = window_.depth_m[other];
  return std::abs(depth_m - other_m) <= window_.step_m[depth_m < other_m ? cell : other];
}

void SupportContacts::count_borders() {
  const PixelRect& box = window_.box;
  const auto count = [&](int x, int y, std::size_t to) {
    const std::size_t from = window_.cell(x, y);
    const std::uint32_t id = labelled_.of_cell[from];
    if (id == kNoComponent || labelled_.components[id].kind != 0 || !box.contains(x, y)) return;
    ++num_borders_[id];
    if (touches_plane(from, to))
      ++num_contacts(id, labelled_.components[labelled_.of_cell[to]].kind - 1U);
  };
  const auto meet = [&](int x, int y, int to_x, int to_y) {
    if (to_x >= window_.width() || to_y >= window_.height()) return;
    const std::size_t to = window_.cell(to_x, to_y);
    if (labelled_.of_cell[window_.cell(x, y)] == labelled_.of_cell[to]) return;
    count(x, y, to);
    count(to_x, to_y, window_.cell(x, y));
  };
  for (int y = std::max(0, box.v_begin - 1); y < box.v_end; ++y) {
    for (int x = std::max(0, box.u_begin - 1); x < box.u_end; ++x) {
      meet(x, y, x + 1, y);
      meet(x, y, x, y + 1);
    }
  }
}

std::optional<int> SupportContacts::next_below(int x, int y) const {
  const int end = std::min(y + 1 + kLedgeReachCells, window_.height());
  for (int below = y + 1; below < end; ++below) {
    if (window_.depth_m[window_.cell(x, below)] > 0.0F) return below;
  }
  return std::nullopt;
}

int SupportContacts::end_of_run(int x, int y) const {
  const std::uint32_t id = labelled_.of_cell[window_.cell(x, y)];
  int end = y + 1;
  while (end < window_.height() && labelled_.of_cell[window_.cell(x, end)] == id) ++end;
  return end;
}

bool SupportContacts::is_of_no_plane(int x, int y) const {
  const std::uint32_t id = labelled_.of_cell[window_.cell(x, y)];
  return id != kNoComponent && labelled_.components[id].kind == 0;
}

bool SupportContacts::is_below_unmeasured(int x, int y) const {
  const int num_rows = kUnmeasuredTopPx / window_.block_px;
  if (y < num_rows) return false;
  for (int above = y - num_rows; above < y; ++above) {
    if (is_measured(depth_m_.at(window_.pixel_u(x), window_.pixel_v(above)))) return false;
  }
  return true;
}

int SupportContacts::end_of_rims(int x, int y, float most_across_ray_m) const {
  const float slope = window_.slope_y[1] - window_.slope_y[0];
  const float first_m = window_.depth_m[window_.cell(x, y)];
  const auto is_far = [&](float depth_m) { return std::abs(depth_m - first_m) > kMostRimDepthM; };
  int last = y;
  for (int end = end_of_run(x, y);;) {
    const std::size_t bottom = window_.cell(x, end - 1);
    const float bottom_m = window_.depth_m[bottom];
    const float across_ray_m = static_cast<float>(end - y) * slope * bottom_m;
    const std::optional<int> below = next_below(x, end - 1);
    if (across_ray_m > most_across_ray_m || is_far(bottom_m) || !below) return last;
    const float below_m = window_.depth_m[window_.cell(x, *below)];
    if (below_m > bottom_m + window_.step_m[bottom]) last = end;
    if (is_far(below_m) || !is_of_no_plane(x, *below)) return last;
    end = end_of_run(x, *below);
  }
}

void SupportContacts::count_rims_of_column(int x, float most_across_ray_m) {
  if (window_.height() < 2) return;
  for (int y = std::max(1, window_.box.v_begin); y < window_.box.v_end; y = end_of_run(x, y)) {
    const bool hangs =
        is_of_no_plane(x, y) &&
        (touches_plane(window_.cell(x, y), window_.cell(x, y - 1)) || is_below_unmeasured(x, y));
    const int end = hangs ? end_of_rims(x, y, most_across_ray_m) : y;
    for (int rim = y; rim < end; rim = end_of_run(x, rim)) {
      if (is_of_no_plane(x, rim)) count_rim(labelled_.of_cell[window_.cell(x, rim)], x);
    }
  }
}

void SupportContacts::count_rim(std::uint32_t id, int x) {
  num_rim_columns_[id] += last_rim_column_[id] == x ? 0U : 1U;
  last_rim_column_[id] = x;
}

bool SupportContacts::is_rim(std::uint32_t id) const {
  const DepthComponent& component = labelled_.components[id];
  return num_rim_columns_[id] > 0 && leaves_box(component, window_) &&
         num_rim_columns_[id] >= kLeastRimColumns * component.bounds_in_box.width();
}

bool SupportContacts::is_passed_by(std::uint32_t best, const Plane& plane) const {
  if (!is_level(plane)) return false;
  const bool is_upright = plane.normal.dot(up_in_camera_) > 0.0F;
  std::uint32_t num_below = 0;
  for_each_cell_of(window_, labelled_, best, [&](int x, int y) {
    const float distance_m = plane.distance_m(window_.point_in_camera(x, y));
    num_below += (is_upright ? distance_m : -distance_m) < -kBelowM ? 1U : 0U;
  });
  return num_below >= kLeastBelow * labelled_.components[best].num_in_box;
}

std::vector<bool> SupportContacts::of_passed_supports(std::uint32_t best) const {
  std::vector<bool> result(num_borders_.size(), false);
  for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
    if (!is_passed_by(best, planes_[plane])) continue;
    for (std::size_t id = 0; id < result.size(); ++id) {
      const std::uint32_t contacts = num_contacts_[id * planes_.size() + plane];
      if (contacts > 0 && contacts >= kLeastContact * num_borders_[id]) result[id] = true;
    }
  }
  return result;
}

}  // namespace hypermap
