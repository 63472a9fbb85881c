// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/topological_map_json.hpp"

#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/archive/transformed_map.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::sample_archive;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const SourceName kTopologySource{.file = "a.hmap", .entry = "topological_map.jsonl"};

/// Of 1.5 m of way, and 2 m aside of it an object.
TopologicalMap sample_topology() {
  TopologicalMap map;
  map.observe({0, 0, 1.25});
  map.observe({1.5, 0, 1.25});
  map.cover({0, 2, 1.25});
  return map;
}

std::string topology_refusal(const std::string& bytes) {
  const auto parsed = parse_topological_map(bytes, kTopologySource);
  return parsed ? "none" : to_string(parsed.error());
}

/// The sample's text with `from` replaced.
std::string edited(const std::string& from, const std::string& to) {
  std::string text = write_topological_map(sample_topology()).value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(TopologicalMapJson, ItsTextIsAsWorkedByHand) {
  // Path vertices at 0 and 0.95 m; toward the object, 2 m off, support at 0.95 and 1.9 m.
  EXPECT_EQ(write_topological_map(sample_topology()).value(),
            "{\"format\":\"hypermap-topological-map\",\"version\":1,\"vertex_distance_m\":1,"
            "\"edge_factor\":0.95,\"num_vertices\":4,\"walk\":{\"at\":1,\"position\":[1.5,0,1.25]}}"
            "\n"
            "{\"kind\":\"path\",\"position\":[0,0,1.25],\"joined\":[]}\n"
            "{\"kind\":\"path\",\"position\":[0.95,0,1.25],\"joined\":[0]}\n"
            "{\"kind\":\"support\",\"position\":[0,0.95,1.25],\"joined\":[0]}\n"
            "{\"kind\":\"support\",\"position\":[0,1.9,1.25],\"joined\":[2]}\n");
}

TEST(TopologicalMapJson, WhatIsReadEqualsWhatWasWritten) {
  TopologicalMap resting = sample_topology();
  resting.interrupt();
  for (const TopologicalMap& map :
       {sample_topology(), resting, TopologicalMap({.vertex_distance_m = 0.5})}) {
    const std::string text = write_topological_map(map).value();
    EXPECT_EQ(parse_topological_map(text, kTopologySource).value(), map);
  }
}

TEST(TopologicalMapJson, EveryCutIsRefused) {
  const std::string text = write_topological_map(sample_topology()).value();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THAT(topology_refusal(text.substr(0, size)), HasSubstr("topological_map.jsonl"));
  EXPECT_THAT(topology_refusal(text + text), HasSubstr("says 4 vertices, there are more"));
}

TEST(TopologicalMapJson, WhatBreaksARuleIsRefusedByItsPlace) {
  EXPECT_THAT(topology_refusal(edited("[0.95,0,1.25]", "[1.95,0,1.25]")),
              HasSubstr("edges[0] must be at most 0.95"));
  EXPECT_THAT(topology_refusal(edited("\"joined\":[2]", "\"joined\":[3]")),
              HasSubstr("must name vertices before 3"));
  EXPECT_THAT(topology_refusal(edited("\"at\":1", "\"at\":9")), HasSubstr("walk must be near"));
  EXPECT_THAT(topology_refusal(edited("support", "guess")), HasSubstr("must be path or support"));
  EXPECT_THAT(topology_refusal(edited("0.95,\"num", "1.95,\"num")), HasSubstr("edge_factor"));
  EXPECT_THAT(topology_refusal(edited("\"version\":1", "\"version\":2")),
              HasSubstr("newer version 2"));
  EXPECT_THAT(topology_refusal(edited("\"num_vertices\":4", "\"num_vertices\":1000001")),
              HasSubstr("the limit is 1000000"));
  EXPECT_THAT(topology_refusal(edited("\"joined\"", "\"edges\"")), HasSubstr("joined"));
}

TEST(TopologicalMapJson, AnArchiveKeepsAndCountsItAndMovesWithIt) {
  MapArchive archive = sample_archive();
  archive.topological_map = sample_topology();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, IsEmpty());
  EXPECT_EQ(loaded->value.topological_map, archive.topological_map);
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  const ArchiveInfo info = describe(loaded->value);
  EXPECT_EQ(info.num_vertices, 4U);
  EXPECT_EQ(info.num_edges, 3U);
  EXPECT_THAT(to_json(info), HasSubstr("\"topological_map\":{\"vertices\":4,\"edges\":3}"));
  EXPECT_THAT(load_error(changed(bytes, {{"topological_map.jsonl", "{}\n"}})),
              HasSubstr("a.hmap!topological_map.jsonl"));
}

TEST(TopologicalMapJson, AMovedMapHasMovedPlaces) {
  MapArchive archive;
  archive.topological_map = sample_topology();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation() = Eigen::Vector3d(10, 20, 0.5);
  const auto moved = transformed(archive, MapFromOldMap(motion));
  ASSERT_TRUE(moved) << to_string(moved.error());
  EXPECT_EQ(moved->topological_map->vertices()[1].position_in_map,
            Eigen::Vector3d(10.95, 20, 1.75));
  EXPECT_EQ(moved->topological_map->walk()->position_in_map, Eigen::Vector3d(11.5, 20, 1.75));
  EXPECT_EQ(moved->topological_map->edges(), archive.topological_map->edges());
}

}  // namespace
}  // namespace hypermap
