// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What one load may cost in all, and whether it shall go on.
///
/// Limits of single images, shapes and members do not bound a file that has many of them. Readers
/// therefore draw on one account before they do work or keep memory. It counts, and knows no clock:
/// the same file is refused on every machine, at the same place.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <functional>
#include <memory>

namespace hypermap {

/// Sums over everything that one load reads. A single image, octree, or ring that crosses itself,
/// at its own limit passes.
///
/// Measured: the most that one of eight archives by others (a hand-made office, recorded maps of a
/// laboratory, a grid of 16 million cells) and a mapped room of 60 frames uses, by lowering each
/// limit until `hypermap info` refused.
struct BudgetLimits {
  /// Of all images, decoded; a grid keeps a byte for each. Default: what a map can derive, one
  /// grid of 2^28 cells and class grids of 2^30. Measured: 16,121,856.
  std::uint64_t max_pixels = std::uint64_t{5} << 28U;
  /// Pairs of edges, or of an edge and a point, that are held against each other because a shape
  /// crosses or touches itself, has holes or parts; a crossing counts as 500. Default: below a
  /// second. Measured: 911,360.
  std::uint64_t max_edge_tests = std::uint64_t{1} << 26U;
  /// Of members that are kept as they are because nothing here reads them. Measured: 0.
  std::uint64_t max_opaque_bytes = std::uint64_t{1} << 28U;
  /// Of all octrees, inner nodes included; a leaf takes 16 bytes. Default: more than 2 GiB of our
  /// own octree hold. Measured: 312,832.
  std::uint64_t max_octree_nodes = std::uint64_t{1} << 27U;
};

/// Asked now and then during a load: true ends it with kInterrupted. Must be quick.
using StopCheck = std::function<bool()>;

/// The account of one load. Copies draw on the same account.
///
/// Errors, of all calls: kInterrupted when the stop check says so; kLimit naming the limit and the
/// sum that would exceed it, and nothing is drawn. Whoever draws adds file, member and field.
/// Threads: one account serves one load, on one thread.
class LoadBudget {
 public:
  /// Without limits, and never stopped.
  LoadBudget() = default;
  explicit LoadBudget(const BudgetLimits& limits, StopCheck stop = {});

  [[nodiscard]] Result<void> draw_pixels(std::uint64_t count) const;
  [[nodiscard]] Result<void> draw_edge_tests(std::uint64_t count) const;
  [[nodiscard]] Result<void> draw_opaque_bytes(std::uint64_t count) const;
  [[nodiscard]] Result<void> draw_octree_nodes(std::uint64_t count) const;
  /// Draws nothing: for work that other limits bound.
  [[nodiscard]] Result<void> check_stop() const;

 private:
  struct Account;
  std::shared_ptr<Account> account_;
};

}  // namespace hypermap
