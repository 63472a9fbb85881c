// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/voxel_evaluation.hpp"

#include "hypermap/core/base/job_progress.hpp"
#include "point_tree.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint32_t kNoClassIndex = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kTrianglesBetweenStops = 1024;
/// Centres of voxels are rounded: at exactly one edge they still lie at the object.
constexpr double kReachSlack = 1e-6;

std::optional<double> share_of(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// An occupied voxel: what the map says of it, and what the truth does.
struct VoxelState {
  std::uint32_t label = kNoClassIndex;
  std::uint32_t nearest = kNoClassIndex;  ///< Class of the nearest nameable object.
  double nearest_distance2 = std::numeric_limits<double>::infinity();
  bool is_label_right = false;
};

/// Occupied voxels with their classes as positions in a sorted list of names.
class VoxelLabelComparison {
 public:
  VoxelLabelComparison(const LeafSource& leaves,
                       const ClassRegistry& classes,
                       const TrueSurfaces& truth)
      : truth_(truth) {
    name_classes(classes);
    std::vector<std::uint32_t> index_of_id;
    index_of_id.reserve(classes.size());
    for (const std::string& name : classes.names()) index_of_id.push_back(index_of(name));
    leaves([&](const LeafSample& leaf) {
      if (!leaf.occupied) return;
      edge_m_ = leaf.edge_m;
      centres_.push_back(leaf.centre_in_map);
      voxels_.push_back(
          {.label = leaf.best_class ? index_of_id[leaf.best_class->value] : kNoClassIndex});
    });
  }

  Result<VoxelEvaluation> run(const StopCheck& stop) {
    const PointTree tree(centres_);
    for (const TrueSurface& surface : truth_.objects) {
      HYPERMAP_TRY(meet(surface, tree, stop));
    }
    VoxelEvaluation evaluation;
    for (const VoxelState& voxel : voxels_) count(voxel, evaluation);
    for (const TrueSurface& surface : truth_.objects)
      evaluation.coverage.push_back(coverage_of(surface, tree));
    return evaluation;
  }

 private:
  void name_classes(const ClassRegistry& classes) {
    std::set<std::string> names;
    for (const std::string& name : classes.names()) names.insert(canonical_class_name(name));
    for (const TrueSurface& surface : truth_.objects)
      names.insert(canonical_class_name(surface.class_name));
    names_.assign(names.begin(), names.end());
  }

  [[nodiscard]] std::uint32_t index_of(const std::string& name) const {
    const auto found = std::lower_bound(names_.begin(), names_.end(), canonical_class_name(name));
    return static_cast<std::uint32_t>(found - names_.begin());
  }

  /// Tells the voxels at a surface of it.
  Result<void> meet(const TrueSurface& surface, const PointTree& tree, const StopCheck& stop) {
    const std::uint32_t name = index_of(surface.class_name);
    const double reach_m = edge_m_ * (1.0 + kReachSlack);
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      if (i % kTrianglesBetweenStops == 0 && stop && stop()) return interrupted();
      tree.for_each_near(
          triangle_at(surface, i), reach_m, [&](std::size_t voxel, double distance2) {
            VoxelState& state = voxels_[voxel];
            if (state.label == name) state.is_label_right = true;
            if (!surface.is_nameable) return;
            const bool is_nearer = distance2 < state.nearest_distance2 ||
                                   (distance2 == state.nearest_distance2 && name < state.nearest);
            if (!is_nearer) return;
            state.nearest_distance2 = distance2;
            state.nearest = name;
          });
    }
    return {};
  }

  void count(const VoxelState& voxel, VoxelEvaluation& evaluation) const {
    const bool is_labelled = voxel.label != kNoClassIndex;
    const bool is_true = voxel.nearest != kNoClassIndex;
    VoxelLabelCounts& all = evaluation.all;
    if (is_labelled) {
      ClassVoxelCounts& named = evaluation.classes[names_[voxel.label]];
      const bool is_wrong_class = !voxel.is_label_right && is_true;
      ++all.labelled;
      ++named.labelled;
      all.right += voxel.is_label_right ? 1U : 0U;
      named.right_labels += voxel.is_label_right ? 1U : 0U;
      all.wrong_class += is_wrong_class ? 1U : 0U;
      named.wrong_class += is_wrong_class ? 1U : 0U;
    }
    if (!is_true) return;
    ClassVoxelCounts& there = evaluation.classes[names_[voxel.nearest]];
    ++all.true_voxels;
    ++there.true_voxels;
    if (!is_labelled) {
      ++all.true_unlabelled;
      ++there.true_unlabelled;
    } else if (voxel.is_label_right) {
      ++all.true_right;
      ++there.found;
    } else {
      ++there.confused_for[names_[voxel.label]];
    }
  }

  [[nodiscard]] SurfaceCoverage coverage_of(const TrueSurface& surface,
                                            const PointTree& tree) const {
    SurfaceCoverage coverage{.id = surface.id, .seen_cells = surface.seen_cells.size()};
    const double reach_m = std::max(edge_m_, truth_.seen_cell_m) * (1.0 + kReachSlack);
    for (const SurfaceCell& cell : surface.seen_cells) {
      const Eigen::Vector3d centre = centre_of(cell, truth_.seen_cell_m);
      bool is_covered = false;
      tree.for_each_near(
          {centre, centre, centre}, reach_m, [&](std::size_t, double) { is_covered = true; });
      coverage.covered_cells += is_covered ? 1U : 0U;
    }
    return coverage;
  }

  const TrueSurfaces& truth_;
  std::vector<std::string> names_;  ///< Canonical, ascending.
  double edge_m_ = 0.0;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<VoxelState> voxels_;  ///< Of the same positions.
};

}  // namespace

std::optional<double> VoxelLabelCounts::precision() const {
  return share_of(right, labelled);
}
std::optional<double> VoxelLabelCounts::recall() const {
  return share_of(true_right, true_voxels);
}
std::optional<double> VoxelLabelCounts::wrong_class_share() const {
  return share_of(wrong_class, labelled);
}
std::optional<double> ClassVoxelCounts::precision() const {
  return share_of(right_labels, labelled);
}
std::optional<double> ClassVoxelCounts::recall() const {
  return share_of(found, true_voxels);
}

std::optional<std::string> ClassVoxelCounts::most_confused_for() const {
  const auto most =
      std::max_element(confused_for.begin(), confused_for.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  return most == confused_for.end() ? std::nullopt : std::optional(most->first);
}

std::optional<double> SurfaceCoverage::share() const {
  return share_of(covered_cells, seen_cells);
}

Result<VoxelEvaluation> evaluate_voxels(const LeafSource& leaves,
                                        const ClassRegistry& classes,
                                        const TrueSurfaces& truth,
                                        const StopCheck& stop) {
  return VoxelLabelComparison(leaves, classes, truth).run(stop);
}

}  // namespace hypermap
