// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relations.hpp"

#include "places/class_rules.hpp"
#include "places/pair_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

/// Of heights; decides nothing.
constexpr double kHeightRoundingM = 1e-9;

/// The shapes of the objects in question, ascending by id.
using Shapes = std::vector<PlacedShape>;
/// One object for each that has a relation of a kind: what it is on, in, under, a part of.
using Chosen = std::map<ObjectId, Relation>;

Shapes shapes_of(const ObjectMap& objects,
                 std::span<const ObjectId> among,
                 const RelationOptions& options) {
  std::vector<ObjectId> ids(among.begin(), among.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  Shapes shapes;
  shapes.reserve(ids.size());
  for (const ObjectId id : ids) {
    if (auto shape = placed_shape_of(objects.at(id), options)) shapes.push_back(*std::move(shape));
  }
  return shapes;
}

const PlacedShape* shape_of(const Shapes& shapes, ObjectId id) {
  const auto found = std::ranges::lower_bound(shapes, id, {}, &PlacedShape::id);
  return found != shapes.end() && found->id == id ? &*found : nullptr;
}

/// Around an object what may be beside it, below its foot and above its top.
Box neighbourhood_of(const PlacedShape& shape, const RelationOptions& options) {
  Box box = grown(shape.box, reach_m(shape, options));
  box.min_in_map.z() = shape.foot_m() - options.gap_voxels * voxel_of(options);
  box.max_in_map.z() = shape.top_m() + options.max_clearance_m;
  return box;
}

using Neighbours = std::vector<const PlacedShape*>;

/// Of each shape, in their order, the others near it, ascending by id.
std::vector<Neighbours> neighbours_of(const ObjectMap& objects,
                                      const Shapes& shapes,
                                      const RelationOptions& options) {
  std::vector<Neighbours> all(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const ObjectId id : objects.query(neighbourhood_of(shapes[i], options))) {
      const PlacedShape* other = shape_of(shapes, id);
      if (other != nullptr && id != shapes[i].id) all[i].push_back(other);
    }
  }
  return all;
}

/// Decides the relations kind by kind; each sees what was decided before.
class RelationFinder {
 public:
  RelationFinder(const ObjectMap& objects,
                 const ClassRegistry& classes,
                 std::span<const ObjectId> among,
                 const RelationOptions& options)
      : options_(options),
        rules_(options, classes),
        shapes_(shapes_of(objects, among, options)),
        neighbours_(neighbours_of(objects, shapes_, options)) {}

  RelationGraph find() {
    find_parts();
    find_holders();
    find_supports();
    find_covers();
    RelationGraph graph{.relations = {}, .supports = supports()};
    for (const Chosen* chosen : {&on_, &in_, &under_}) append(*chosen, graph.relations);
    append(besides(), graph.relations);
    append(parts_, graph.relations);
    return graph;
  }

 private:
  static void append(const Chosen& chosen, std::vector<Relation>& relations) {
    for (const auto& [id, relation] : chosen) relations.push_back(relation);
  }
  static void append(const std::vector<Relation>& more, std::vector<Relation>& relations) {
    relations.insert(relations.end(), more.begin(), more.end());
  }

  /// For each object the best of its neighbours. `evidence(a, b)`: whether and how; `rank(b,
  /// evidence)`: the least one is chosen, of equals the lowest id.
  template <class Evidence, class Rank>
  [[nodiscard]] Chosen choose(RelationKind kind, const Evidence& evidence, const Rank& rank) const {
    Chosen chosen;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      std::optional<std::pair<decltype(rank(shapes_[i], RelationEvidence{})), Relation>> best;
      for (const PlacedShape* other : neighbours_[i]) {
        const std::optional<RelationEvidence> found = evidence(shapes_[i], *other);
        if (!found) continue;
        const auto rank_here = rank(*other, *found);
        if (best && !(rank_here < best->first)) continue;
        best.emplace(rank_here, Relation{kind, shapes_[i].id, other->id, *found});
      }
      if (best) chosen.emplace(shapes_[i].id, best->second);
    }
    return chosen;
  }

  void find_parts() {
    parts_ = choose(
        RelationKind::kPartOf,
        [&](const PlacedShape& a, const PlacedShape& b) -> std::optional<RelationEvidence> {
          if (!rules_.may_be_part(a.class_id, b.class_id)) return std::nullopt;
          return part_evidence(a, b, options_);
        },
        [](const PlacedShape& whole, const RelationEvidence&) { return whole.volume_m3; });
  }

  void find_holders() {
    in_ = choose(
        RelationKind::kIn,
        [&](const PlacedShape& a, const PlacedShape& b) -> std::optional<RelationEvidence> {
          if (parts_.contains(a.id) || !rules_.may_hold(b.class_id)) return std::nullopt;
          return in_evidence(a, b, options_);
        },
        [](const PlacedShape& holder, const RelationEvidence&) { return holder.volume_m3; });
  }

  void find_supports() {
    on_ = choose(
        RelationKind::kOn,
        [&](const PlacedShape& a, const PlacedShape& b) -> std::optional<RelationEvidence> {
          if (parts_.contains(a.id) || is_kept_from(a.id, b.id)) return std::nullopt;
          return on_evidence(a, b, options_);
        },
        [](const PlacedShape&, const RelationEvidence& evidence) {
          return std::tuple(-evidence.contact_height_m.value_or(0.0),
                            -evidence.plan_share.value_or(0.0));
        });
  }

  void find_covers() {
    under_ = choose(
        RelationKind::kUnder,
        [&](const PlacedShape& a, const PlacedShape& b) -> std::optional<RelationEvidence> {
          if (are_related(a.id, b.id)) return std::nullopt;
          return under_evidence(a, b, options_);
        },
        [](const PlacedShape&, const RelationEvidence& evidence) {
          return evidence.gap_m.value_or(0.0);
        });
  }

  /// What is in a holder stands on it, or on what is in it too, not on what is outside.
  [[nodiscard]] bool is_kept_from(ObjectId a, ObjectId b) const {
    const ObjectId holder = holder_of(a);
    return holder != kNoObject && b != holder && holder_of(b) != holder;
  }

  [[nodiscard]] ObjectId holder_of(ObjectId id) const {
    const auto found = in_.find(id);
    return found == in_.end() ? kNoObject : found->second.object;
  }

  /// Whether a relation other than beside holds between them, in either direction.
  [[nodiscard]] bool are_related(ObjectId a, ObjectId b) const {
    const auto has = [](const Chosen& chosen, ObjectId subject, ObjectId object) {
      const auto found = chosen.find(subject);
      return found != chosen.end() && found->second.object == object;
    };
    const auto any = [&](ObjectId x, ObjectId y) {
      return has(on_, x, y) || has(in_, x, y) || has(under_, x, y) || has(parts_, x, y);
    };
    return any(a, b) || any(b, a);
  }

  /// All that might be, then those that are among the nearest of both.
  [[nodiscard]] std::vector<Relation> besides() const {
    std::vector<Relation> near;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const PlacedShape& a = shapes_[i];
      for (const PlacedShape* b : neighbours_[i]) {
        if (b->id < a.id && is_near_too(*b, a)) continue;
        const bool is_kept = holder_of(a.id) == holder_of(b->id) && !are_related(a.id, b->id);
        const auto evidence = is_kept ? beside_evidence(a, *b, options_) : std::nullopt;
        if (!evidence) continue;
        near.push_back(
            {RelationKind::kBeside, std::min(a.id, b->id), std::max(a.id, b->id), *evidence});
      }
    }
    return nearest_of_both(std::move(near));
  }

  /// Whether `b` is among a's neighbours, and the pair was seen from there.
  [[nodiscard]] bool is_near_too(const PlacedShape& a, const PlacedShape& b) const {
    const auto at = std::ranges::lower_bound(shapes_, a.id, {}, &PlacedShape::id);
    const Neighbours& near = neighbours_[static_cast<std::size_t>(at - shapes_.begin())];
    return std::ranges::binary_search(near, b.id, {}, &PlacedShape::id);
  }

  [[nodiscard]] std::vector<Relation> nearest_of_both(std::vector<Relation> near) const {
    std::ranges::sort(near, {}, [](const Relation& relation) {
      return std::tuple(relation.evidence.gap_m, relation.subject, relation.object);
    });
    std::map<ObjectId, std::uint32_t> num_nearer;
    std::erase_if(near, [&](const Relation& relation) {
      const std::uint32_t of_subject = num_nearer[relation.subject]++;
      const std::uint32_t of_object = num_nearer[relation.object]++;
      return std::max(of_subject, of_object) >= options_.max_beside;
    });
    std::ranges::sort(near, {}, [](const Relation& relation) {
      return std::tuple(relation.subject, relation.object);
    });
    return near;
  }

  [[nodiscard]] std::vector<ObjectSupport> supports() const {
    std::vector<ObjectSupport> supports;
    supports.reserve(shapes_.size());
    for (const PlacedShape& shape : shapes_) supports.push_back(support_of_shape(shape));
    return supports;
  }

  [[nodiscard]] ObjectSupport support_of_shape(const PlacedShape& shape) const {
    const auto by = [&](SupportKind kind, const Chosen& chosen) -> std::optional<ObjectSupport> {
      const auto found = chosen.find(shape.id);
      if (found == chosen.end()) return std::nullopt;
      return ObjectSupport{shape.id, kind, found->second.object};
    };
    if (const auto whole = by(SupportKind::kWhole, parts_)) return *whole;
    if (const auto below = by(SupportKind::kObject, on_)) return *below;
    if (const auto holder = by(SupportKind::kHolder, in_)) return *holder;
    return {
        shape.id, rests_on_floor(shape) ? SupportKind::kFloor : SupportKind::kUnknown, kNoObject};
  }

  /// Below the floor its noise is added to that of the foot.
  [[nodiscard]] bool rests_on_floor(const PlacedShape& shape) const {
    const double above_m = shape.foot_m() - options_.floor_m.value_or(0.0);
    const double gap_m = options_.gap_voxels * voxel_of(options_);
    return above_m <= gap_m && above_m >= -2.0 * gap_m - kHeightRoundingM;
  }

  const RelationOptions& options_;
  ClassRules rules_;
  Shapes shapes_;
  std::vector<Neighbours> neighbours_;
  Chosen parts_;
  Chosen in_;
  Chosen on_;
  Chosen under_;
};

}  // namespace

RelationGraph find_relations(const ObjectMap& objects,
                             const ClassRegistry& classes,
                             std::span<const ObjectId> among,
                             const RelationOptions& options) {
  return RelationFinder(objects, classes, among, options).find();
}

}  // namespace hypermap
