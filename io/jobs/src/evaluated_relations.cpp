// SPDX-License-Identifier: BSD-3-Clause
#include "evaluated_relations.hpp"

#include "hypermap/core/places/vocabulary_rules.hpp"
#include "hypermap/io/archive/object_relations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kSpacingM = 0.02;

/// Points of a triangle, none farther than the spacing from the next.
void append_points(const Triangle& triangle, std::vector<Eigen::Vector3f>& points) {
  const Eigen::Vector3d first = triangle[1] - triangle[0];
  const Eigen::Vector3d second = triangle[2] - triangle[0];
  const double longest_m = std::max({first.norm(), second.norm(), (second - first).norm()});
  const int steps = std::max(1, static_cast<int>(std::ceil(longest_m / kSpacingM)));
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k + i <= steps; ++k) {
      const Eigen::Vector3d point = triangle[0] + first * i / steps + second * k / steps;
      points.emplace_back(point.cast<float>());
    }
  }
}

/// The true object as one that was seen whole. None when its class or its surface is no good.
std::optional<Object> object_of_surface(const TrueSurface& surface, ClassRegistry& classes) {
  const auto class_id = classes.add(surface.class_name);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    append_points(triangle_at(surface, i), points);
  }
  if (!class_id || points.empty()) return std::nullopt;
  Object object;
  object.id = surface.id;
  object.belief.observe(std::array{ClassEvidence{*class_id, Probability(1.0)}}, Probability(0.5));
  object.points.observe(points);
  object.box = bounding_box(points);
  return object;
}

ObjectId object_id_of(std::uint64_t id) {
  return ObjectId{static_cast<std::uint32_t>(id)};
}

/// The true object of each matched object of the map.
std::map<ObjectId, ObjectId> matches_of(const EvaluatedArchive& map,
                                        const EvaluatedArchive& truth,
                                        const EvaluationReport& report) {
  std::map<ObjectId, ObjectId> truth_of;
  for (const TruthResult& result : report.truths) {
    if (!result.matched_map_index) continue;
    truth_of.emplace(object_id_of(map.ids[*result.matched_map_index]),
                     object_id_of(truth.ids[result.truth_index]));
  }
  return truth_of;
}

/// What the rules say of the true surfaces of matched objects.
std::vector<Relation> surface_relations(const EvaluatedArchive& truth,
                                        const std::map<ObjectId, ObjectId>& truth_of,
                                        const RelationOptions& options) {
  const RelationOptions understood = with_vocabulary(options, truth.archive.vocabulary);
  ClassRegistry classes;
  std::vector<Object> objects;
  std::vector<ObjectId> among;
  ObjectId next{1};
  for (const TrueSurface& surface : truth.archive.true_surfaces->objects) {
    const bool is_matched = std::ranges::any_of(
        truth_of, [&](const auto& match) { return match.second == surface.id; });
    if (!is_matched) continue;
    auto object = object_of_surface(surface, classes);
    if (!object) continue;
    among.push_back(object->id);
    next = ObjectId{object->id.value + 1};
    objects.push_back(*std::move(object));
  }
  const auto all = ObjectMap::restore(std::move(objects), next);
  return all ? find_relations(*all, classes, among, understood).relations : std::vector<Relation>{};
}

/// The text of a key of a true object; empty when it has none.
std::string_view text_of(const SemanticObject& object, std::string_view key) {
  for (const auto& [name, value] : object.extra.entries) {
    if (name == key) return value.text;
  }
  return {};
}

/// What the scene says of what stands on what; none when it says nothing of anything.
std::optional<std::vector<Relation>> said_supports(const SemanticLayer& layer) {
  bool says = false;
  std::vector<Relation> supports;
  for (const SemanticObject& object : layer.objects()) {
    const std::string_view text = text_of(object, "stands_on");
    says = says || !text.empty();
    std::uint32_t below = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), below);
    if (error != std::errc()) continue;  // the floor
    supports.push_back({RelationKind::kOn, object_id_of(object.id), ObjectId{below}, {}});
  }
  return says ? std::optional(std::move(supports)) : std::nullopt;
}

}  // namespace

std::optional<RelationEvaluation> evaluated_relations(const EvaluatedArchive& map,
                                                      const EvaluatedArchive& truth,
                                                      const EvaluationReport& report) {
  if (!truth.archive.true_surfaces || map.archive.objects.empty()) return std::nullopt;
  const auto truth_of = matches_of(map, truth, report);
  RelationOptions options;
  if (map.archive.octree) options.voxel_m = map.archive.octree->resolution_m();
  std::vector<Relation> expected = surface_relations(truth, truth_of, options);
  if (const auto* layer = truth.archive.hypermap.find_as<SemanticLayer>("semantic")) {
    if (const auto said = said_supports(*layer)) {
      std::erase_if(expected, [](const Relation& one) { return one.kind == RelationKind::kOn; });
      expected.insert(expected.end(), said->begin(), said->end());
    }
  }
  return evaluate_relations(archive_relations(map.archive, options).relations, expected, truth_of);
}

}  // namespace hypermap
