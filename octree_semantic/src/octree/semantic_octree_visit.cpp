// SPDX-License-Identifier: BSD-3-Clause
// Visits and queries over many voxels of a SemanticOctree.
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "octree/brick_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

Box everywhere() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::Vector3d::Constant(-infinity), Eigen::Vector3d::Constant(infinity)};
}

/// Bricks from `min` to `max` per axis, both included; none when min > max.
struct BrickRange {
  std::array<int, 3> min{};
  std::array<int, 3> max{};

  [[nodiscard]] bool contains(BrickKey key) const {
    const VoxelKey corner = key.corner();
    const std::array<int, 3> at{
        corner.x / kBrickEdge, corner.y / kBrickEdge, corner.z / kBrickEdge};
    for (std::size_t i = 0; i < 3; ++i) {
      if (at[i] < min[i] || at[i] > max[i]) return false;
    }
    return true;
  }
  [[nodiscard]] double volume() const {
    double total = 1.0;
    for (std::size_t i = 0; i < 3; ++i) total *= std::max(0, max[i] - min[i] + 1);
    return total;
  }
};

BrickRange bricks_around(const Box& box, const VoxelGrid& grid) {
  const auto brick_along = [&grid](double coordinate_m) {
    const double voxels = coordinate_m * grid.voxels_per_m() + kOriginKey;
    // NaN compares false and becomes the lower end.
    const double inside = voxels > 0.0 ? std::min(voxels, kKeysPerAxis - 1.0) : 0.0;
    return static_cast<int>(inside) / kBrickEdge;
  };
  BrickRange range;
  for (int i = 0; i < 3; ++i) {
    range.min[static_cast<std::size_t>(i)] = brick_along(box.min_in_map[i]);
    range.max[static_cast<std::size_t>(i)] = brick_along(box.max_in_map[i]);
  }
  return range;
}

/// Positions of the bricks in the range, in Morton order: looked up one by one when the range is
/// small, else picked from all.
std::vector<std::uint32_t> positions_in(const BrickTable& table, const BrickRange& range) {
  std::vector<std::uint32_t> found;
  if (range.volume() < static_cast<double>(table.size())) {
    for (int x = range.min[0]; x <= range.max[0]; ++x) {
      for (int y = range.min[1]; y <= range.max[1]; ++y) {
        for (int z = range.min[2]; z <= range.max[2]; ++z) {
          const VoxelKey corner{static_cast<std::uint16_t>(x * kBrickEdge),
                                static_cast<std::uint16_t>(y * kBrickEdge),
                                static_cast<std::uint16_t>(z * kBrickEdge)};
          const std::uint32_t position = table.position(BrickKey::of(corner));
          if (position != BrickTable::kNone) found.push_back(position);
        }
      }
    }
  } else {
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      if (range.contains(table.key(i))) found.push_back(i);
    }
  }
  std::sort(found.begin(), found.end(), [&table](std::uint32_t a, std::uint32_t b) {
    return table.key(a) < table.key(b);
  });
  return found;
}

}  // namespace

void SemanticOctree::for_each_leaf(const LeafVisitor& visit) const {
  for (const std::uint32_t position : bricks_->in_morton_order()) {
    const Brick& brick = bricks_->brick(position);
    const BrickKey key = bricks_->key(position);
    brick.known.for_each([&](std::size_t cell) { visit(sample(key.voxel(cell), brick, cell)); });
  }
}

void SemanticOctree::for_each_stored_leaf(const StoredLeafVisitor& visit) const {
  for (const std::uint32_t position : bricks_->in_morton_order()) {
    const Brick& brick = bricks_->brick(position);
    const VoxelKey corner = bricks_->key(position).corner();
    brick.known.for_each([&](std::size_t cell) {
      StoredLeaf leaf{.key = voxel_in_brick(corner, cell),
                      .log_odds = brick.log_odds[cell],
                      .label = std::nullopt};
      if (const VoxelLabel* label = brick.label(cell)) leaf.label = *label;
      visit(leaf);
    });
  }
}

void SemanticOctree::for_each_label(const LabelVisitor& visit) const {
  for (std::uint32_t position = 0; position < bricks_->size(); ++position) {
    const Brick& brick = bricks_->brick(position);
    if (!brick.labels) continue;
    brick.labels->labelled().for_each([&](std::size_t cell) { visit(*brick.label(cell)); });
  }
}

void SemanticOctree::for_each_leaf_in(const Box& box_in_map, const LeafVisitor& visit) const {
  for (const std::uint32_t position : positions_in(*bricks_, bricks_around(box_in_map, grid_))) {
    const Brick& brick = bricks_->brick(position);
    const BrickKey key = bricks_->key(position);
    brick.known.for_each([&](std::size_t cell) {
      const LeafSample leaf = sample(key.voxel(cell), brick, cell);
      if (box_in_map.contains(leaf.centre_in_map)) visit(leaf);
    });
  }
}

void SemanticOctree::for_each_leaf_of(ClassId id, const LeafVisitor& visit) const {
  for (const std::uint32_t position : bricks_->in_morton_order()) {
    const Brick& brick = bricks_->brick(position);
    if (!brick.labels) continue;
    const BrickKey key = bricks_->key(position);
    brick.labels->labelled().for_each([&](std::size_t cell) {
      const LeafSample leaf = sample(key.voxel(cell), brick, cell);
      if (leaf.occupied && leaf.best_class == id) visit(leaf);
    });
  }
}

void SemanticOctree::for_each_leaf_of(ObjectId id,
                                      const Box& bounds_in_map,
                                      const LeafVisitor& visit) const {
  for (const std::uint32_t position : positions_in(*bricks_, bricks_around(bounds_in_map, grid_))) {
    const Brick& brick = bricks_->brick(position);
    if (!brick.labels) continue;
    const BrickKey key = bricks_->key(position);
    brick.labels->labelled().for_each([&](std::size_t cell) {
      const LeafSample leaf = sample(key.voxel(cell), brick, cell);
      const bool wanted = leaf.occupied && leaf.object == id;
      if (wanted && bounds_in_map.contains(leaf.centre_in_map)) visit(leaf);
    });
  }
}

void SemanticOctree::for_each_leaf_of(ObjectId id, const LeafVisitor& visit) const {
  for_each_leaf_of(id, everywhere(), visit);
}

std::size_t SemanticOctree::relabel(
    const Box& bounds_in_map, const std::function<ObjectId(const VoxelKey&, ObjectId)>& object_of) {
  std::size_t num_changed = 0;
  std::vector<std::pair<std::size_t, ObjectId>> changes;  // cells of a brick
  for (const std::uint32_t shared : positions_in(*bricks_, bricks_around(bounds_in_map, grid_))) {
    const Brick& brick = bricks_->brick(shared);
    if (!brick.labels) continue;
    changes.clear();
    const BrickKey key = bricks_->key(shared);
    brick.labels->labelled().for_each([&](std::size_t cell) {
      const ObjectId object = brick.label(cell)->object;
      const bool inside = bounds_in_map.contains(grid_.centre(key.voxel(cell)).xyz);
      if (!inside || object == kNoObject) return;
      const ObjectId changed = object_of(key.voxel(cell), object);
      if (changed != object) changes.emplace_back(cell, changed);
    });
    if (changes.empty()) continue;
    BrickTable& bricks = bricks_.writable();
    const std::uint32_t position = bricks.prepare(key);
    for (const auto& [cell, object] : changes) {
      VoxelLabel& label = bricks.writable(position).labels->at(cell);
      label.object = object;
      if (object == kNoObject) label.object_votes = 0;
    }
    bricks.note_written(position, true);
    num_changed += changes.size();
  }
  if (num_changed != 0) bricks_.sole().commit();
  return num_changed;
}

std::size_t SemanticOctree::divide_object(ObjectId from,
                                          ObjectId to,
                                          const Box& bounds_in_map,
                                          const std::function<bool(const VoxelKey&)>& moves) {
  return relabel(bounds_in_map, [&](const VoxelKey& key, ObjectId object) {
    return object == from && moves(key) ? to : object;
  });
}

std::size_t SemanticOctree::divide_object(ObjectId from,
                                          ObjectId to,
                                          std::span<const Eigen::Vector3f> of_from,
                                          std::span<const Eigen::Vector3f> of_to) {
  const auto squared_distance = [](const Eigen::Vector3d& centre,
                                   std::span<const Eigen::Vector3f> points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& point : points) {
      least = std::min(least, (point.cast<double>() - centre).squaredNorm());
    }
    return least;
  };
  return divide_object(from, to, everywhere(), [&](const VoxelKey& key) {
    const Eigen::Vector3d centre = grid_.centre(key).xyz;
    return squared_distance(centre, of_to) < squared_distance(centre, of_from);
  });
}

std::size_t SemanticOctree::relabel_object(ObjectId from, ObjectId to, const Box& bounds_in_map) {
  return divide_object(from, to, bounds_in_map, [](const VoxelKey&) { return true; });
}

std::size_t SemanticOctree::relabel_object(ObjectId from, ObjectId to) {
  return relabel_object(from, to, everywhere());
}

std::size_t SemanticOctree::forget_objects(const std::function<bool(ObjectId)>& is_gone) {
  return relabel(everywhere(), [&](const VoxelKey&, ObjectId object) {
    return is_gone(object) ? kNoObject : object;
  });
}

std::vector<Box> SemanticOctree::changed_regions(Revision since) const {
  std::vector<BrickKey> keys;
  for (const std::uint32_t position : bricks_->written_since(since)) {
    keys.push_back(bricks_->key(position));
  }
  std::sort(keys.begin(), keys.end());
  const Eigen::Vector3d half_voxel = Eigen::Vector3d::Constant(0.5 * resolution_m());
  std::vector<Box> regions;
  regions.reserve(keys.size());
  for (const BrickKey key : keys) {
    regions.push_back({grid_.centre(key.corner()).xyz - half_voxel,
                       grid_.centre(key.voxel(kBrickVolume - 1)).xyz + half_voxel});
  }
  return regions;
}

LeafSource leaf_source(const SemanticOctree& tree) {
  return [&tree](const LeafVisitor& visit) { tree.for_each_leaf(visit); };
}

}  // namespace hypermap
