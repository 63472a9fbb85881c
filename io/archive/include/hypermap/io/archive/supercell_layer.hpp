// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Supercells of a stack and their topometric graph as a layer of a hypermap.
///
/// Source: [sogm] III-D.2, Eq. (11), figure 6; [hypermap] 3.2 (a layer of any type).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/layers/layer_members.hpp"
#include "hypermap/projection/layers/map_layer.hpp"
#include "hypermap/projection/supercells/supercells.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include <string_view>
#include <vector>

namespace hypermap {

/// The layer of an archive that holds the supercells of its stack.
inline constexpr std::string_view kSupercellLayer = "supercells";
inline constexpr std::string_view kSupercellLayerClass = "SupercellLayer";

/// Which supercell each cell belongs to, and the graph of them.
///
/// A supercell answers with its number: as string the last part of the name of its best layer (the
/// class), `Free` where its layers know and none says yes, else `Unknown`; where its cell nearest
/// to its centroid is; with the probability of its mean on the best layer.
///
/// Members: `.yaml` with geometry, frame, layers and energies; `.labels`, the number of each cell's
/// supercell, 32 bits, little endian; `.jsonl`, a line for each supercell: centroid, number of
/// cells, neighbours, log-odds and mean of each layer.
class SupercellLayer final : public MapLayer {
 public:
  SupercellLayer() = default;  ///< Without cells.
  /// Errors: kInvalidArgument when the graph is not one of these supercells: other counts of nodes
  /// or cells, neighbours that are none, vectors of another length than the layers.
  [[nodiscard]] static Result<SupercellLayer> create(Supercells supercells, TopometricGraph graph);

  /// Errors: kMalformedFile for what `create` refuses.
  [[nodiscard]] static Result<LayerContent> load(LayerReader& reader);

  [[nodiscard]] const Supercells& supercells() const noexcept { return supercells_; }
  [[nodiscard]] const TopometricGraph& graph() const noexcept { return graph_; }

  [[nodiscard]] std::string_view class_name() const override { return kSupercellLayerClass; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  /// Cells in the colours of their supercells' best layers, over them a line for each pair of
  /// supercells that touch, from centroid to centroid.
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const SupercellLayer& a, const SupercellLayer& b) {
    return a.supercells_ == b.supercells_ && a.graph_ == b.graph_;
  }

 private:
  SupercellLayer(Supercells supercells, TopometricGraph graph);

  Supercells supercells_;
  TopometricGraph graph_;
  std::vector<Eigen::Vector2d> positions_;  ///< Of each supercell, within one of its cells.
};

}  // namespace hypermap
