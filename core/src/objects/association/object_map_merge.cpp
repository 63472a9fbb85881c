// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_map_merge.hpp"

#include "duplicates.hpp"
#include "overlap.hpp"
#include "policies.hpp"
#include "sparse_assignment.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// An object with its points, ready to be compared.
struct ComparedObject {
  const Object* object = nullptr;
  PointSet points;
};

std::vector<ComparedObject> compared_objects(const ObjectMap& objects, double near_m) {
  std::vector<ComparedObject> all;
  all.reserve(objects.size());
  for (const Object& object : objects.objects()) {
    all.push_back({&object, point_set_of(object, near_m)});
  }
  return all;
}

/// For each object of `added` that which it is of the others, if any. Staying alone costs nothing,
/// so that a good pair is never given up for two bad ones.
std::vector<std::optional<ObjectId>> partners(const ObjectMap& objects,
                                              const ObjectMap& added,
                                              const AssignmentOptions& options) {
  const auto known = compared_objects(objects, options.near_m);
  const auto news = compared_objects(added, options.near_m);
  std::map<ObjectId, std::size_t> place_of;
  for (std::size_t i = 0; i < known.size(); ++i) place_of[known[i].object->id] = i;
  std::vector<CostedPair> candidates;
  for (std::size_t i = 0; i < news.size(); ++i) {
    for (const ObjectId id : objects.query(grown(news[i].object->box, 2.0 * options.near_m))) {
      const std::size_t column = place_of.at(id);
      const Overlap c = measure_overlap(news[i].points, known[column].points, options.near_m);
      if (is_same_object(c, options)) candidates.push_back({{i, column}, -affinity(c)});
    }
    candidates.push_back({{i, known.size() + i}, 0.0});
  }
  std::vector<std::optional<ObjectId>> found(news.size());
  for (const IndexPair& pair : assign_sparse(candidates)) {
    if (pair.column < known.size()) found[pair.row] = known[pair.column].object->id;
  }
  return found;
}

/// What `merged` of two objects requires.
Result<void> check_same_options(const Object& a, const Object& b) {
  std::string_view part;
  if (a.belief.options() != b.belief.options()) part = "belief";
  if (a.histogram.options() != b.histogram.options()) part = "histogram";
  if (a.points.options() != b.points.options()) part = "points";
  if (part.empty()) return {};
  return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                          .what = "was made with other options than that of object " +
                                  std::to_string(a.id.value) + " of the other map",
                          .entry = "object " + std::to_string(b.id.value),
                          .field = std::string(part)});
}

Result<void> check_embeddings(const ObjectMap& objects, const ObjectMap& added) {
  HYPERMAP_ASSIGN_OR_RETURN(EmbeddingDimensions dimensions, embedding_dimensions(objects));
  HYPERMAP_ASSIGN_OR_RETURN(const EmbeddingDimensions others, embedding_dimensions(added));
  for (const auto& [model, dimension] : others.models()) {
    HYPERMAP_TRY(dimensions.add(model, dimension));
  }
  return {};
}

/// Both maps' ids after those merges.
void follow_merges(ObjectMapMerge& out, const ObjectMap& objects, const AssociationReport& report) {
  for (const auto& [from, into] : report.merged) {
    for (auto* ids : {&out.id_of_added, &out.id_of_absorbed}) {
      for (auto& [id, now] : *ids) now = now == from ? into : now;
    }
    if (objects.contains(from)) out.id_of_absorbed[from] = into;
  }
  for (const auto& [id, now] : out.id_of_added) {
    ++(objects.contains(now) ? out.num_joined : out.num_new);
  }
}

}  // namespace

Result<ObjectMapMerge> merged(const ObjectMap& objects,
                              const ObjectMap& added,
                              const AssociationOptions& options) {
  HYPERMAP_TRY(check_embeddings(objects, added));
  const auto partner_of = partners(objects, added, options.assignment);
  ObjectMapMerge out{.objects = objects};
  // What two runs saw was in view together in none of them.
  const AssociationOptions of_runs_apart = without_hidden_parts(options);
  AssociationRun run{out.objects, {}, of_runs_apart, {}};
  std::size_t i = 0;
  for (const Object& object : added.objects()) {
    const std::optional<ObjectId> partner = partner_of[i++];
    if (partner) {
      const Object& known = objects.at(*partner);
      HYPERMAP_TRY(check_same_options(known, object));
      Object younger = object;
      younger.id = objects.next_id();
      out.objects.replace(merged(known, younger, options.max_existence));
      run.report.matched.push_back(*partner);
      out.id_of_added[object.id] = *partner;
    } else {
      const ObjectId id = out.objects.add(object);
      run.report.created.push_back(id);
      out.id_of_added[object.id] = id;
    }
  }
  PointSetCache point_sets(out.objects, options.assignment.near_m);
  merge_duplicates(
      run, point_sets, std::set<ObjectId>(run.report.matched.begin(), run.report.matched.end()));
  follow_merges(out, objects, run.report);
  for (const ObjectMerge& merge : run.report.merged) run.report.matched.push_back(merge.into);
  settle_contested_cells(run);
  return out;
}

}  // namespace hypermap
