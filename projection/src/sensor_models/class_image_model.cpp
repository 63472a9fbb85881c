// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/class_image_model.hpp"

#include "class_layers.hpp"
#include "ground_view.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/map_floor.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kClassImageRows[] = {
    option::section<&ClassImageOptions::evidence>("evidence"),
    option::number<&ClassImageOptions::ground_m>("ground_m",
                                                 {-kMaxFloorHeightM, kMaxFloorHeightM},
                                                 {.unit = "m", .effect = "Where the ground is."}),
    option::number<&ClassImageOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 100.0),
        {.unit = "m", .effect = "Farther cells are left out."}),
};

}  // namespace

Result<void> validate(const ClassImage& image) {
  constexpr double kMaxRotationError = 1e-3;
  constexpr double kMaxCoordinateM = 1e6;
  HYPERMAP_TRY(validate(image.camera));
  const Eigen::Isometry3d& pose = image.map_from_camera.isometry();
  if (!is_rigid(pose, kMaxRotationError) ||
      pose.translation().cwiseAbs().maxCoeff() > kMaxCoordinateM) {
    return fail(ErrorCode::kInvalidArgument,
                "must be a finite rigid motion within 1e6 m",
                "map_from_camera");
  }
  const bool has_size = image.classes.width_px() == image.camera.width_px &&
                        image.classes.height_px() == image.camera.height_px;
  if (image.classes.empty() || has_size) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be of the camera's size, is " + std::to_string(image.classes.width_px()) +
                  " x " + std::to_string(image.classes.height_px()),
              "classes");
}

const OptionTable& option_table(const ClassImageOptions&) {
  static constexpr OptionTable kTable{kClassImageRows};
  return kTable;
}

Result<void> validate(const ClassImageOptions& options) {
  return check_options(options);
}

Result<ClassImageModel> ClassImageModel::create(ClassRegistry classes, ClassImageOptions options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_has_classes(classes));
  return ClassImageModel(std::move(classes), std::move(options));
}

Result<std::vector<SensorGrid>> ClassImageModel::grids(const ClassImage& image) const {
  HYPERMAP_TRY(validate(image));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the image", [&]() -> Result<Grids> {
    const GroundRange range{
        {.ground_m = options_.ground_m}, options_.evidence.resolution_m, options_.max_range_m};
    HYPERMAP_ASSIGN_OR_RETURN(const GroundView view,
                              GroundView::create(image.camera, image.map_from_camera, range));
    HYPERMAP_ASSIGN_OR_RETURN(
        ClassLayers layers,
        ClassLayers::create(classes_, {options_.parent, options_.frame_id}, view.geometry()));
    if (image.classes.empty()) return std::move(layers).cropped();
    const LogOddsSteps hit = to_steps(LogOdds::of(options_.evidence.p_hit));
    const LogOddsSteps free = to_steps(LogOdds::of(options_.evidence.p_free));
    for (const CellInView& seen : view.cells_in_view()) {
      const ClassId shown{image.classes.at(seen.u_px, seen.v_px)};
      if (!classes_.contains(shown)) continue;
      layers.set_all(seen.cell, free);
      layers.set(shown, seen.cell, hit);
    }
    return std::move(layers).cropped();
  });
}

}  // namespace hypermap
