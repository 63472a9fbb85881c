// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/furniture.hpp"

#include "furniture_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace hypermap {
namespace {

struct Shape {
  std::string_view name;
  TriangleMesh (*build)(const ShapeInput&);
  std::array<double, 3> usual_size_m;
  Rgb8 first;
  Rgb8 second;
};

constexpr Rgb8 kSteel{150, 152, 158};
constexpr Rgb8 kBlack{38, 38, 42};
constexpr Rgb8 kOak{176, 128, 78};
constexpr Rgb8 kWhite{236, 236, 232};

constexpr std::array kShapes{
    Shape{"backpack", &build_backpack, {0.24, 0.34, 0.48}, {40, 74, 140}, {226, 120, 30}},
    Shape{"bed", &build_bed, {2.05, 1.60, 0.95}, {86, 104, 150}, kOak},
    Shape{"bench", &build_bench, {0.58, 1.50, 0.82}, kOak, kBlack},
    Shape{"bin", &build_bin, {0.32, 0.32, 0.40}, {60, 96, 60}, {30, 40, 30}},
    Shape{"book", &build_book, {0.17, 0.24, 0.035}, {150, 46, 50}, kWhite},
    Shape{"bottle", &build_bottle, {0.085, 0.085, 0.30}, {40, 110, 70}, kWhite},
    Shape{"chair", &build_chair, {0.50, 0.46, 0.86}, {150, 78, 44}, {60, 110, 150}},
    Shape{"crate", &build_crate, {0.40, 0.60, 0.35}, {178, 140, 92}, {150, 112, 70}},
    Shape{"cup", &build_cup, {0.085, 0.115, 0.10}, {214, 60, 50}, {250, 246, 236}},
    Shape{"cupboard", &build_cupboard, {0.50, 1.20, 0.90}, {228, 226, 216}, kOak},
    Shape{"fan", &build_fan, {0.42, 0.46, 1.25}, kWhite, kSteel},
    Shape{"keyboard", &build_keyboard, {0.15, 0.45, 0.03}, {52, 52, 58}, {196, 196, 200}},
    Shape{"lamp", &build_lamp, {0.32, 0.32, 0.50}, {240, 226, 190}, kSteel},
    Shape{"laptop", &build_laptop, {0.32, 0.34, 0.23}, {150, 152, 158}, {70, 130, 180}},
    Shape{"microwave", &build_microwave, {0.36, 0.48, 0.28}, kSteel, kBlack},
    Shape{"monitor", &build_monitor, {0.20, 0.54, 0.46}, kBlack, {60, 120, 190}},
    Shape{"mouse", &build_mouse, {0.115, 0.065, 0.04}, {46, 46, 52}, {120, 120, 126}},
    Shape{"noteboard", &build_noteboard, {0.50, 1.30, 1.80}, kWhite, kSteel},
    Shape{"oven", &build_oven, {0.60, 0.60, 0.88}, kWhite, kBlack},
    Shape{"person", &build_person, {0.62, 0.50, 1.76}, {60, 90, 130}, {54, 54, 66}},
    Shape{"plant", &build_plant, {0.75, 0.75, 1.10}, {52, 128, 50}, {168, 90, 58}},
    Shape{"refrigerator", &build_refrigerator, {0.65, 0.60, 1.75}, kWhite, kSteel},
    Shape{"shelf", &build_shelf, {0.45, 1.20, 1.80}, kOak, kSteel},
    Shape{"sink", &build_sink, {0.46, 0.60, 0.98}, kWhite, kSteel},
    Shape{"sofa", &build_sofa, {0.90, 1.90, 0.80}, {96, 112, 84}, {122, 140, 106}},
    Shape{"suitcase", &build_suitcase, {0.26, 0.42, 0.92}, {176, 34, 52}, kBlack},
    Shape{"swivel_chair", &build_swivel_chair, {0.62, 0.62, 0.96}, {48, 60, 88}, kBlack},
    Shape{"table", &build_table, {0.80, 1.60, 0.73}, kOak, kSteel},
    Shape{"umbrella", &build_umbrella, {0.95, 1.00, 0.85}, {120, 40, 130}, {236, 196, 60}},
    Shape{"vase", &build_vase, {0.20, 0.20, 0.34}, {44, 96, 140}, {230, 206, 120}},
};

constexpr auto kFurnitureNames = [] {
  std::array<std::string_view, kShapes.size()> names;
  std::ranges::transform(kShapes, names.begin(), &Shape::name);
  return names;
}();

Unexpected unknown_shape(std::string_view name) {
  std::string what = "no shape of that name is known: " + printable(name) + ", expected one of";
  for (const std::string_view known : kFurnitureNames) what.append(" ").append(known);
  return fail(ErrorCode::kNotFound, std::move(what), "shape");
}

Result<Eigen::Vector3d> full_size(const FurnitureSpec& spec, const Shape& shape) {
  Eigen::Vector3d size{shape.usual_size_m[0], shape.usual_size_m[1], shape.usual_size_m[2]};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double given = spec.size_m[i];
    if (given == 0.0) continue;
    if (!(given >= 0.01 && given <= 20.0))
      return fail(ErrorCode::kInvalidArgument,
                  "must be 0 (the usual size) or in 0.01 .. 20 m, is " + std::to_string(given),
                  "size");
    size[i] = given;
  }
  return size;
}

/// Stretched and moved so that it stands on z = 0, the origin in the middle, with exactly that
/// size.
TriangleMesh fitted(TriangleMesh mesh, const Eigen::Vector3d& size_m) {
  const Box box = bounds(mesh);
  const Eigen::Vector3d base{box.centre().x(), box.centre().y(), box.min_in_map.z()};
  const Eigen::Vector3d scale = size_m.cwiseQuotient(box.extent());
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = scale.cwiseProduct(vertex.cast<double>() - base).cast<float>();
  return mesh;
}

}  // namespace

std::span<const std::string_view> furniture_shapes() {
  return kFurnitureNames;
}

Result<TriangleMesh> build_furniture(const FurnitureSpec& spec) {
  const auto shape = std::ranges::find(kShapes, spec.shape, &Shape::name);
  if (shape == kShapes.end()) return unknown_shape(spec.shape);
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector3d size_m, full_size(spec, *shape));
  const auto color = [&](std::size_t i, Rgb8 usual) {
    return i < spec.colors.size() ? spec.colors[i] : usual;
  };
  return fitted(shape->build({size_m, color(0, shape->first), color(1, shape->second)}), size_m);
}

}  // namespace hypermap
