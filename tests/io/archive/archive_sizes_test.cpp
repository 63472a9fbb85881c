// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_sizes.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "io/archive/sample_archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// Members' sizes as the zip itself tells them.
std::uint64_t packed_of(const ZipReader& zip, std::initializer_list<const char*> names) {
  std::uint64_t sum = 0;
  for (const char* name : names) sum += zip.find(name)->num_packed_bytes;
  return sum;
}

TEST(ArchiveSizes, EachPartHasItsMembersAndNoneIsLost) {
  MapArchive archive = test::sample_archive();
  archive.opaque_files.push_back({.name = "notes.md", .bytes = "of somebody"});
  const std::string bytes = write_archive(archive).value();
  const ZipReader zip = ZipReader::create(view_bytes(bytes)).value();
  const ArchiveSizes sizes = archive_sizes(archive).value();
  const auto packed = [&](const std::string& name) {
    const auto found = std::ranges::find(sizes.parts, name, &PartSize::name);
    return found == sizes.parts.end() ? 0 : found->num_packed_bytes;
  };
  EXPECT_EQ(sizes.num_bytes, bytes.size());
  EXPECT_EQ(packed("occupancy"), packed_of(zip, {"occupancy.yaml", "occupancy.png"}));
  EXPECT_EQ(packed("octree"), packed_of(zip, {"octree.ot"}));
  EXPECT_EQ(packed("octree_twin"), packed_of(zip, {"octree.bt"}));
  EXPECT_EQ(packed("class_grid_0"), packed_of(zip, {"class_grid_0.yaml", "class_grid_0.png"}));
  EXPECT_EQ(packed("configuration"), packed_of(zip, {"hmap_config.yaml"}));
  EXPECT_EQ(packed("other members"), packed_of(zip, {"notes.md"}));
  std::uint64_t members = 0;
  for (const ZipMember& member : zip.members()) members += member.num_packed_bytes;
  std::uint64_t parts = 0;
  for (const PartSize& part : sizes.parts) parts += part.num_packed_bytes;
  EXPECT_EQ(parts, members);
  EXPECT_TRUE(std::ranges::is_sorted(sizes.parts, std::greater(), &PartSize::num_packed_bytes));
}

TEST(ArchiveSizes, AnObjectsFieldsAreItsLineAndTheLargestIsFound) {
  MapArchive archive = test::sample_archive();
  Object large = test::sample_object();
  std::vector<Eigen::Vector3f> points;
  points.reserve(4000);
  for (int i = 0; i < 4000; ++i) {
    points.emplace_back(0.037F * static_cast<float>(i % 91),
                        0.023F * static_cast<float>(i % 83),
                        0.011F * static_cast<float>(i));
  }
  large.points.observe(points);
  const ObjectId id = archive.objects.add(large);
  archive.objects.add(test::sample_object());
  const ObjectSizes objects = archive_sizes(archive).value().objects.value();
  EXPECT_EQ(objects.num_objects, 3U);
  EXPECT_EQ(objects.largest, id);
  EXPECT_GT(objects.largest_alone, 4 * objects.median_alone);
  EXPECT_EQ(objects.num_large, 1U) << "4,000 cells far apart";
  EXPECT_EQ(objects.fields.front().key, "cells") << "the dearest of 4,000 cells";
  std::set<std::string> keys;
  for (const ObjectFieldSize& field : objects.fields) keys.insert(field.key);
  EXPECT_EQ(keys,
            (std::set<std::string>{"id",
                                   "belief",
                                   "existence",
                                   "box_confidence",
                                   "box",
                                   "centroid",
                                   "histogram",
                                   "shapes",
                                   "points",
                                   "cells",
                                   "ledger",
                                   "first_seen_ns",
                                   "last_seen_ns",
                                   "num_observations",
                                   "farthest_detection_m"}));
}

TEST(ArchiveSizes, AsGridsIsAByteForEachClassAndCell) {
  MapArchive archive = test::sample_archive();
  const GridSizes grids = archive_sizes(archive).value().as_grids.value();
  const GridGeometry geometry = test::sample_grid(3).geometry();
  EXPECT_EQ(grids.num_classes, 2U) << "sink and cup";
  EXPECT_EQ(grids.flat_bytes, 2 * geometry.num_cells());
  EXPECT_EQ(grids.volume_bytes % grids.flat_bytes, 0U);
  archive.hypermap = {};
  EXPECT_FALSE(archive_sizes(archive).value().as_grids.has_value());
}

TEST(ArchiveSizes, AnEmptyMapCostsItsConfiguration) {
  const ArchiveSizes sizes = archive_sizes({}).value();
  ASSERT_EQ(sizes.parts.size(), 1U);
  EXPECT_EQ(sizes.parts.front().name, "configuration");
  EXPECT_FALSE(sizes.objects.has_value());
}

TEST(ArchiveSizes, JsonSaysTheSame) {
  const ArchiveSizes sizes = archive_sizes(test::sample_archive()).value();
  const auto json = JsonDocument::parse(to_json(sizes), "sizes").value();
  const JsonNode root = json.root();
  const auto number = [](const JsonNode& node, const char* key) {
    return static_cast<std::uint64_t>(node.find(key)->number().value());
  };
  EXPECT_EQ(number(root, "bytes"), sizes.num_bytes);
  EXPECT_EQ(root.find("parts")->size(), sizes.parts.size());
  EXPECT_EQ(number(root.find("parts")->at(0), "packed_bytes"), sizes.parts[0].num_packed_bytes);
  EXPECT_EQ(number(*root.find("objects"), "count"), 1U);
  EXPECT_EQ(root.find("objects")->find("fields")->size(), sizes.objects->fields.size());
  EXPECT_EQ(number(*root.find("as_grids"), "flat_bytes"), sizes.as_grids->flat_bytes);
  const auto empty = JsonDocument::parse(to_json(ArchiveSizes{}), "sizes").value();
  EXPECT_TRUE(empty.root().find("objects")->is(JsonKind::kNull));
}

}  // namespace
}  // namespace hypermap
