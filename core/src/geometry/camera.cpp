// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/camera.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <cmath>
#include <string>

namespace hypermap {
namespace {

constexpr int kMaxSidePx = 65535;

Result<void> check_side(int side_px, const char* field) {
  if (side_px >= 1 && side_px <= kMaxSidePx) return {};
  return fail(
      ErrorCode::kInvalidArgument, "must be in 1..65535, is " + std::to_string(side_px), field);
}

Result<void> check_focal_length(double focal_px, const char* field) {
  if (std::isfinite(focal_px) && focal_px > 0.0) return {};
  return fail(
      ErrorCode::kInvalidArgument, "must be finite and > 0, is " + number_text(focal_px), field);
}

Result<void> check_centre(double centre_px, int side_px, const char* field) {
  const double side = side_px;
  if (centre_px >= -0.5 * side && centre_px <= 1.5 * side) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must lie in " + number_text(-0.5 * side) + ".." + number_text(1.5 * side) + ", is " +
                  number_text(centre_px),
              field);
}

}  // namespace

Result<void> validate(const PinholeCamera& camera) {
  HYPERMAP_TRY(check_side(camera.width_px, "width_px"));
  HYPERMAP_TRY(check_side(camera.height_px, "height_px"));
  HYPERMAP_TRY(check_focal_length(camera.fx_px, "fx_px"));
  HYPERMAP_TRY(check_focal_length(camera.fy_px, "fy_px"));
  HYPERMAP_TRY(check_centre(camera.cx_px, camera.width_px, "cx_px"));
  return check_centre(camera.cy_px, camera.height_px, "cy_px");
}

}  // namespace hypermap
