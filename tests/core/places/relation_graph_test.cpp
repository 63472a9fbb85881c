// SPDX-License-Identifier: BSD-3-Clause
// What holds for every graph of relations, whatever the objects.
#include "core/places/furniture.hpp"
#include "hypermap/core/places/relations.hpp"
#include "places/pair_rules.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

/// Boxes of all sizes, piled up and side by side; some with points.
FurnishedRoom random_room(std::uint32_t seed, int num_objects) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::uniform_real_distribution<double> size(0.05, 0.8);
  std::uniform_int_distribution<int> step(0, 12);
  const std::vector<std::string> names{"cup", "sofa", "cushion", "cabinet", "bowl", "table"};
  FurnishedRoom room;
  for (int i = 0; i < num_objects; ++i) {
    const Box box = standing(place(random),
                             place(random),
                             0.1 * step(random),
                             {size(random), size(random), size(random)});
    const std::string& name = names[static_cast<std::size_t>(i) % names.size()];
    i % 3 == 0 ? room.add(name, box) : room.add_box(name, box);
  }
  return room;
}

TEST(RelationGraph, SupportsAreAForestAndRelationsHaveOneDirection) {
  for (std::uint32_t seed = 1; seed <= test::repetitions(12U); ++seed) {
    const RelationGraph graph = graph_of(random_room(seed, 60));
    std::set<std::tuple<RelationKind, ObjectId>> single;
    std::set<std::tuple<ObjectId, ObjectId>> directed;
    for (const Relation& one : graph.relations) {
      EXPECT_NE(one.subject, one.object);
      if (one.kind == RelationKind::kBeside) {
        EXPECT_LT(one.subject, one.object);
        continue;
      }
      EXPECT_TRUE(single.emplace(one.kind, one.subject).second);
      EXPECT_FALSE(directed.contains({one.object, one.subject}));
      directed.emplace(one.subject, one.object);
    }
    for (const ObjectSupport& one : graph.supports) {
      std::size_t steps = 0;
      for (ObjectId at = one.id; at != kNoObject && steps <= graph.supports.size(); ++steps) {
        at = support_of(graph, at)->by;
      }
      EXPECT_LE(steps, graph.supports.size()) << "a circle at " << one.id.value;
    }
  }
}

TEST(RelationGraph, IsSortedAndOfAnyOrderOfTheIds) {
  const FurnishedRoom room = random_room(77, 50);
  const RelationGraph graph = graph_of(room);
  EXPECT_TRUE(std::ranges::is_sorted(graph.relations, {}, [](const Relation& one) {
    return std::tuple(one.kind, one.subject, one.object);
  }));
  std::vector<ObjectId> ids = room.ids();
  std::reverse(ids.begin(), ids.end());
  ids.push_back(ids.front());
  EXPECT_EQ(find_relations(room.objects, room.classes, ids), graph);
}

/// Every pair that the rule accepts and no other relation has is in the graph, and no other.
void expect_all_besides(const RelationGraph& graph,
                        const std::vector<PlacedShape>& shapes,
                        const RelationOptions& options) {
  for (const PlacedShape& a : shapes) {
    std::vector<ObjectId> expected;
    for (const PlacedShape& b : shapes) {
      const bool is_related = std::ranges::any_of(graph.relations, [&](const Relation& one) {
        const bool joins = std::minmax(one.subject, one.object) == std::minmax(a.id, b.id);
        return joins && one.kind != RelationKind::kBeside;
      });
      if (a.id != b.id && !is_related && beside_evidence(a, b, options)) expected.push_back(b.id);
    }
    EXPECT_EQ(subjects_of(graph, RelationKind::kBeside, a.id), expected) << a.id.value;
  }
}

TEST(RelationGraph, TheIndexFindsWhatComparingAllPairsFinds) {
  for (std::uint32_t seed = 1; seed <= test::repetitions(8U); ++seed) {
    const FurnishedRoom room = random_room(seed, 40);
    // No class holds and none is a part, so that each pair stands for itself.
    const RelationOptions options{.holders = {}, .parts = {}, .max_beside = 64};
    std::vector<PlacedShape> shapes;
    for (const Object& one : room.objects.objects()) {
      shapes.push_back(placed_shape_of(one, options).value());
    }
    const RelationGraph graph = graph_of(room, options);
    for (const PlacedShape& a : shapes) {
      std::optional<RelationEvidence> highest;
      for (const PlacedShape& b : shapes) {
        if (a.id == b.id) continue;
        const auto on = on_evidence(a, b, options);
        if (on && (!highest || on->contact_height_m > highest->contact_height_m)) highest = on;
      }
      const auto support = support_of(graph, a.id).value();
      ASSERT_EQ(support.kind == SupportKind::kObject, highest.has_value()) << a.id.value;
      if (!highest) continue;
      const auto found = std::ranges::find_if(graph.relations, [&](const Relation& one) {
        return one.kind == RelationKind::kOn && one.subject == a.id;
      });
      EXPECT_EQ(found->evidence.contact_height_m, highest->contact_height_m);
    }
    expect_all_besides(graph, shapes, options);
  }
}

/// Kinds and ends alone.
std::vector<std::tuple<RelationKind, ObjectId, ObjectId>> links_of(const RelationGraph& graph) {
  std::vector<std::tuple<RelationKind, ObjectId, ObjectId>> links;
  for (const Relation& one : graph.relations) {
    links.emplace_back(one.kind, one.subject, one.object);
  }
  return links;
}

/// A kitchen that is turned and moved as a whole.
FurnishedRoom kitchen(double yaw_rad, const Eigen::Vector3d& moved) {
  const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
  const auto placed = [&](Points points) {
    for (Eigen::Vector3f& p : points) p = (turn * p.cast<double>() + moved).cast<float>();
    return points;
  };
  FurnishedRoom room;
  room.add("table", placed(table_at(0, 0)));
  room.add("cup", placed(surface_of(standing(0.3, 0.1, 0.74, kCup))));
  room.add("bottle", placed(surface_of(standing(0.3, -0.05, 0.74, {0.08, 0.08, 0.25}))));
  room.add("book", placed(surface_of(standing(-0.3, 0, 0.74, kBook))));
  room.add("book", placed(surface_of(standing(-0.3, 0, 0.78, kBook))));
  room.add("bin", placed(surface_of(standing(0.1, 0, 0, {0.3, 0.3, 0.4}))));
  room.add("bowl", placed(bowl_at(0.0, 0.15, 0.74)));
  room.add("apple", placed(surface_of(standing(0, 0.15, 0.77, {0.07, 0.07, 0.07}))));
  return room;
}

TEST(RelationGraph, TurningAndMovingTheRoomChangesNothing) {
  const auto still = links_of(graph_of(kitchen(0.0, Eigen::Vector3d::Zero())));
  EXPECT_GE(still.size(), 8U);
  for (const double yaw_rad : {0.3, 0.8, M_PI / 2, 2.5, -1.9}) {
    EXPECT_EQ(links_of(graph_of(kitchen(yaw_rad, {3.21, -7.04, 0.0}))), still) << yaw_rad;
  }
  const Eigen::Vector3d raised(0, 0, 2.0);
  EXPECT_EQ(links_of(graph_of(kitchen(0.0, raised), {.floor_m = 2.0})), still);
}

TEST(RelationGraph, OfNothingAndOfOne) {
  FurnishedRoom room;
  EXPECT_EQ(graph_of(room), RelationGraph());
  const ObjectId id = room.add("cup", standing(0, 0, 0, kCup));
  const RelationGraph graph = graph_of(room);
  EXPECT_THAT(graph.relations, IsEmpty());
  EXPECT_THAT(graph.supports, ElementsAre(ObjectSupport{id, SupportKind::kFloor, kNoObject}));
  EXPECT_FALSE(support_of(graph, ObjectId{9}));
}

TEST(RelationGraph, NamesAreThoseOfTheProgram) {
  std::string names;
  for (const RelationKind kind : kRelationKinds) names += std::string(name_of(kind)) + ";";
  EXPECT_EQ(names, "on;in;under;beside;part of;");
  EXPECT_EQ(key_of(RelationKind::kPartOf), "part_of");
  EXPECT_EQ(name_of(SupportKind::kUnknown), "unknown");
  const RelationEvidence evidence{.gap_m = 0.25, .contact_share = 0.5};
  EXPECT_THAT(measures_of(evidence),
              ElementsAre(std::pair("gap_m", 0.25), std::pair("contact_share", 0.5)));
}

}  // namespace
}  // namespace hypermap
