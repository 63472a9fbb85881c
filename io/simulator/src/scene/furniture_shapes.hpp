// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The single shapes behind `build_furniture`. Each is built near its size and then fitted to it.
#pragma once

#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <Eigen/Core>

namespace hypermap {

/// What every shape is given: its extent, and two colours.
struct ShapeInput {
  Eigen::Vector3d size_m;
  Rgb8 first;
  Rgb8 second;
};

// Objects to sit on (furniture_seats.cpp).
[[nodiscard]] TriangleMesh build_chair(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_swivel_chair(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_sofa(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_bench(const ShapeInput& input);

// What belongs to the room (furniture_room.cpp).
[[nodiscard]] TriangleMesh build_table(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_cupboard(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_sink(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_bin(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_fan(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_noteboard(const ShapeInput& input);

// What lies on tables (furniture_desk.cpp).
[[nodiscard]] TriangleMesh build_monitor(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_keyboard(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_mouse(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_cup(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_laptop(const ShapeInput& input);

// What people bring and leave (furniture_belongings.cpp).
[[nodiscard]] TriangleMesh build_suitcase(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_umbrella(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_backpack(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_plant(const ShapeInput& input);

// What a flat has beside (furniture_home.cpp).
[[nodiscard]] TriangleMesh build_bed(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_refrigerator(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_oven(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_microwave(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_lamp(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_vase(const ShapeInput& input);

// What is stored (furniture_store.cpp).
/// Four boards: at the top, and at 2/3, 1/3 and 0 of the way up from 12 cm above the floor.
[[nodiscard]] TriangleMesh build_shelf(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_crate(const ShapeInput& input);
[[nodiscard]] TriangleMesh build_bottle(const ShapeInput& input);
/// Lying, its spine at -x.
[[nodiscard]] TriangleMesh build_book(const ShapeInput& input);

// Who walks about (furniture_people.cpp).
[[nodiscard]] TriangleMesh build_person(const ShapeInput& input);

}  // namespace hypermap
