// SPDX-License-Identifier: BSD-3-Clause
// What `export_map` writes as glTF; tests/apps/glb_test.py holds whole files against the format.
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/number_bytes.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Result<std::vector<std::filesystem::path>> export_scene(const MapArchive& archive,
                                                        const std::filesystem::path& output,
                                                        bool with_voxels,
                                                        const std::vector<std::string>& classes) {
  ExportRequest request{
      .format = ExportFormat::kGlb, .output = output, .layer = {}, .classes = classes};
  request.with_voxels = with_voxels;
  return export_map(archive, request);
}

/// The JSON of the exported scene.
nlohmann::json scene_of(const MapArchive& archive,
                        bool with_voxels = false,
                        const std::vector<std::string>& classes = {}) {
  const test::TempDir dir;
  const auto written = export_scene(archive, dir / "a.glb", with_voxels, classes);
  if (!written || written->empty()) return {};
  const std::string glb = read_file(written->front(), 1U << 24U).value();
  return nlohmann::json::parse(glb.substr(20, uint32_at(glb, 12)));
}

nlohmann::json node_named(const nlohmann::json& scene, const std::string& name) {
  for (const auto& node : scene.at("nodes")) {
    if (node.at("name") == name) return node;
  }
  return {};
}

/// Triangles of a node's mesh.
std::size_t num_triangles(const nlohmann::json& scene, const nlohmann::json& node) {
  std::size_t count = 0;
  for (const auto& primitive :
       scene.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")) {
    const auto accessor = primitive.at("indices").get<std::size_t>();
    count += scene.at("accessors").at(accessor).at("count").get<std::size_t>() / 3;
  }
  return count;
}

/// A map of nothing but an object of that class, a cube of 1 m about (1, 2, 3).
MapArchive cube_of(const std::string& class_name) {
  MapArchive archive;
  Object object;
  object.belief.observe(
      std::vector<ClassEvidence>{{archive.classes.add(class_name).value(), Probability(0.9)}},
      Probability(0.5));
  object.box = {{0.5, 1.5, 2.5}, {1.5, 2.5, 3.5}};
  archive.objects.add(object);
  return archive;
}

TEST(ExportGlb, AnObjectIsANodeWithItsBoxAndWhatIsKnownOfIt) {
  const nlohmann::json scene = scene_of(cube_of("chair"));
  const nlohmann::json chair = node_named(scene, "chair 1");
  EXPECT_EQ(chair.at("translation"), nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_EQ(chair.at("extras").at("id"), 1);
  EXPECT_EQ(chair.at("extras").at("class"), "chair");
  EXPECT_EQ(chair.at("extras").at("box"), nlohmann::json({0.5, 1.5, 2.5, 1.5, 2.5, 3.5}));
  EXPECT_EQ(num_triangles(scene, chair), 12U);
  EXPECT_EQ(scene.at("accessors").at(1).at("min"), nlohmann::json({-0.5, -0.5, -0.5}));
  EXPECT_EQ(scene.at("accessors").at(1).at("max"), nlohmann::json({0.5, 0.5, 0.5}));
  EXPECT_TRUE(node_named(scene, "surface").is_null());
}

// (x, y, z, w) of -90 degrees about x: (0, 0, 1), up in the map, becomes (0, 1, 0).
TEST(ExportGlb, UpIsY) {
  const nlohmann::json root = node_named(scene_of(cube_of("chair")), "map");
  const auto turn = root.at("rotation").get<std::vector<double>>();
  const Eigen::Quaterniond y_up_from_z_up(turn[3], turn[0], turn[1], turn[2]);
  EXPECT_TRUE((y_up_from_z_up * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE((y_up_from_z_up * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_EQ(root.at("extras").at("up"), "z");
}

TEST(ExportGlb, TheConfidenceIsThatOfTheSemanticLayer) {
  MapArchive archive = cube_of("chair");
  SemanticObject shape = test::sample_shape(1, "chair", 0.0);
  shape.confidence = {0.625};
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic"}, .content = SemanticLayer::create({shape}).value()}));
  const nlohmann::json chair = node_named(scene_of(archive), "chair 1");
  EXPECT_EQ(chair.at("extras").at("confidence"), 0.625);
}

TEST(ExportGlb, AnyNameOfAClassStands) {
  for (const std::string name : {"a \"b\"\n- c", "Stuhl für Gäste", "\\u0041", "{}"}) {
    EXPECT_EQ(node_named(scene_of(cube_of(name)), name + " 1").at("extras").at("class"), name);
  }
}

/// Two occupied voxels of 10 cm side by side, the first labelled with the cube's object and in it.
MapArchive cube_with_voxels() {
  MapArchive archive = cube_of("chair");
  std::vector<StoredLeaf> leaves;
  for (const auto x : {std::uint16_t{32778}, std::uint16_t{32788}}) {  // from x = 1.0 and 2.0 m on
    StoredLeaf leaf;
    leaf.key = {x, 32788, 32798};
    leaf.log_odds = 2000;
    if (x == 32778) {
      leaf.label = VoxelLabel{};
      leaf.label->object = ObjectId{1};
      leaf.label->object_votes = 2;
    }
    leaves.push_back(leaf);
  }
  OctreeOptions options;
  options.resolution_m = 0.1;
  archive.octree = SemanticOctree::from_leaves(options, leaves).value();
  return archive;
}

TEST(ExportGlb, VoxelsAreTheSurfacesOrTheirObjects) {
  const MapArchive archive = cube_with_voxels();
  const nlohmann::json plain = scene_of(archive);
  EXPECT_EQ(num_triangles(plain, node_named(plain, "surface")), 24U);
  EXPECT_FALSE(node_named(plain, "chair 1").contains("children"));

  const nlohmann::json scene = scene_of(archive, true);
  EXPECT_EQ(num_triangles(scene, node_named(scene, "surface")), 12U);
  const nlohmann::json voxels = node_named(scene, "chair 1 voxels");
  EXPECT_EQ(num_triangles(scene, voxels), 12U);
  const std::size_t child = node_named(scene, "chair 1").at("children").at(0).get<std::size_t>();
  EXPECT_EQ(scene.at("nodes").at(child), voxels);
  // Its corner at (1, 2, 3) is the centre of the box, from which it is told.
  EXPECT_FALSE(voxels.contains("translation")) << voxels;
}

TEST(ExportGlb, OnlyWhatIsAskedFor) {
  MapArchive archive = cube_with_voxels();
  ASSERT_TRUE(archive.classes.add("zebra"));
  const nlohmann::json chairs = scene_of(archive, false, {"Chair"});
  EXPECT_EQ(num_triangles(chairs, node_named(chairs, "surface")), 12U);
  EXPECT_TRUE(scene_of(archive, false, {"zebra"}).is_null()) << "nothing is written";
}

TEST(ExportGlb, WhatCannotBeIsSaid) {
  const test::TempDir dir;
  EXPECT_THAT(export_scene({}, dir / "a.glb", false, {}).error().what,
              HasSubstr("neither objects nor an octree"));
  EXPECT_THAT(export_scene(cube_of("chair"), dir / "a.gltf", false, {}).error().what,
              HasSubstr("must end in .glb"));
  MapArchive archive = cube_of("chair");
  Object far = archive.objects.at(ObjectId{1});
  far.box.max_in_map.x() = 1e7;
  archive.objects.replace(far);
  EXPECT_THAT(export_scene(archive, dir / "a.glb", false, {}).error().what,
              HasSubstr("the box of object 1 reaches to 1e+07 m"));
  ExportRequest request{
      .format = ExportFormat::kPly, .output = dir / "a.ply", .layer = {}, .classes = {}};
  request.with_voxels = true;
  EXPECT_EQ(export_map(archive, request).error().field, "--with-voxels");
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace
}  // namespace hypermap
