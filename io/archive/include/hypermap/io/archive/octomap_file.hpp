// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// OctoMap's files `.ot` and `.bt`, read as if an enemy had written them.
///
/// OctoMap's own reader recurses as deep as the file says and takes a cut file for another map.
/// This one keeps a stack of sixteen levels, counts every node, and must meet the end of the file
/// exactly at the end of the tree.
/// Source: OctoMap 1.9, AbstractOcTree.h and OccupancyOcTreeBase.hxx (layout of the two formats).
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

struct OctomapLimits {
  std::uint64_t max_file_bytes = std::uint64_t{2} << 30;
  std::uint64_t max_nodes = std::uint64_t{1} << 31;
};

/// Reads `.ot` (OcTree, ColorOcTree, OcTreeStamped, SemanticOcTree) and `.bt`, distinguished by the
/// first line; a name that ends in `.ot` or `.bt` must agree with it.
///
/// `.bt` knows free and occupied only; they become OctoMap's clamping values -2 and 3.511.
/// Findings: unknown header keys; inner nodes whose value is not that of their children (a tree
/// saved before its inner nodes were brought up to date), which are computed anew.
/// Errors: kMalformedFile naming header field or node (counted from 0 in file order): cut, longer
/// than the tree, deeper than 16, size or resolution that are wrong or absurd, log-odds that are
/// not finite or beyond +-32.767, bytes that are not those of a `# crc32` line; kUnsupported for
/// other types of trees; kLimit; kOutOfMemory; those of LoadBudget::draw_octree_nodes. Cost:
/// linear; memory 16 bytes a leaf (plus colour or label), nothing is taken on the word of the
/// header. The nodes that it says are drawn from `budget` first.
[[nodiscard]] Result<Loaded<OctomapTree>> parse_octomap(std::string_view bytes,
                                                        const SourceName& source,
                                                        const OctomapLimits& limits = {},
                                                        const LoadBudget& budget = {});
/// A file on disk. Errors: those of parse_octomap and kIo.
[[nodiscard]] Result<Loaded<OctomapTree>> read_octomap(const std::filesystem::path& path,
                                                       const OctomapLimits& limits = {});

/// The tree as `.ot`, inner nodes with the maximum of their children's log-odds and the mean of
/// their colours, as OctoMap has them. A node of `SemanticOcTree` is the 32-bit log-odds, then 20
/// bytes, all little-endian: object (32 bits), votes (16), rest (16), and for each of three classes
/// its id (16) and its log-odds in steps of 0.001 (16). Without a label: object 0, votes 0, rest 0,
/// and ids 65535 with log-odds 0. A comment of the header, which OctoMap skips, holds the checksum:
/// `# crc32 <8 digits>` is the CRC-32 of all of the file but this line. Errors: those of validate;
/// kOutOfMemory.
[[nodiscard]] Result<std::string> write_octomap(const OctomapTree& tree);

/// The tree as `.bt`: only whether each leaf is occupied. Errors: as write_octomap, and
/// kInvalidArgument for a tree that is one leaf, which the format cannot express.
[[nodiscard]] Result<std::string> write_octomap_binary(const OctomapTree& tree);

}  // namespace hypermap
