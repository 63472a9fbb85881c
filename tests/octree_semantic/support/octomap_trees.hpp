// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The map as OctoMap itself would hold it: the oracle for our own files of these types.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <iosfwd>
#include <memory>
#include <span>
#include <string>

namespace hypermap::test {

/// A node of OctoMap that also knows class and object.
///
/// In a file: the 32-bit log-odds, then 20 bytes, all little-endian: object (32 bits), votes (16),
/// rest (16), and for each of three classes its id (16) and its log-odds in steps of 0.001 (16).
/// A node without a label has object 0, votes 0, rest 0, and ids 65535 with log-odds 0.
class SemanticOcTreeNode : public octomap::OcTreeNode {
 public:
  SemanticOcTreeNode() = default;

  [[nodiscard]] const VoxelLabel& label() const noexcept { return label_; }
  void set_label(const VoxelLabel& label) noexcept { label_ = label; }

  bool operator==(const SemanticOcTreeNode& rhs) const {
    return rhs.value == value && rhs.label_ == label_;
  }
  // The names below are OctoMap's: its templates call them.
  void copyData(const SemanticOcTreeNode& from) {  // NOLINT(readability-identifier-naming)
    octomap::OcTreeNode::copyData(from);
    label_ = from.label_;
  }
  std::istream& readData(std::istream& stream);         // NOLINT(readability-identifier-naming)
  std::ostream& writeData(std::ostream& stream) const;  // NOLINT(readability-identifier-naming)

 private:
  VoxelLabel label_;
};

/// OctoMap's tree with our payload, registered as "SemanticOcTree": `octomap::AbstractOcTree::read`
/// gives one. Equal siblings (label included) are pruned; inner nodes have no label.
class SemanticOcTree : public octomap::OccupancyOcTreeBase<SemanticOcTreeNode> {
 public:
  explicit SemanticOcTree(double resolution_m);
  [[nodiscard]] SemanticOcTree* create() const override { return new SemanticOcTree(resolution); }
  [[nodiscard]] std::string getTreeType() const override {  // NOLINT(readability-identifier-naming)
    return "SemanticOcTree";
  }

 private:
  /// Registers the type before `main`, as OctoMap asks of its trees.
  class Registration {
   public:
    Registration();
    void ensure_linked() const {}
  };
  static const Registration kRegistration;
};

/// Occupancy alone. The sensor model goes along; the tree is pruned.
[[nodiscard]] std::unique_ptr<octomap::OcTree> to_octomap(const SemanticOctree& tree);
/// Occupancy, and the colour of the class by its id: grey where something unlabelled stands, and
/// white, OctoMap's "no colour", in empty space. Requires: a colour for every class of the tree.
[[nodiscard]] std::unique_ptr<octomap::ColorOcTree> to_color_octomap(const SemanticOctree& tree,
                                                                     std::span<const Rgb8> colors);
/// Everything.
[[nodiscard]] std::unique_ptr<SemanticOcTree> to_semantic_octomap(const SemanticOctree& tree);

}  // namespace hypermap::test
