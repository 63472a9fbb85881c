// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The nodes of an OctoMap file, byte by byte.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "octomap_node.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {

/// Hands out bytes and counts nodes, so that every error can name one.
class NodeCursor {
 public:
  NodeCursor(std::string_view bytes, std::uint64_t num_nodes, const LoadBudget& budget)
      : bytes_(bytes), num_nodes_(num_nodes), budget_(budget) {}

  [[nodiscard]] Unexpected error(std::string what) const {
    return fail(ErrorCode::kMalformedFile,
                std::move(what) + " at node " + std::to_string(num_counted_),
                "octree");
  }

  /// Errors: there are more nodes than the header said; kInterrupted.
  Result<void> count_node() {
    if (num_counted_ % kNodesBetweenChecks == 0) HYPERMAP_TRY(budget_.check_stop());
    if (++num_counted_ > num_nodes_)
      return fail(ErrorCode::kMalformedFile,
                  "says " + std::to_string(num_nodes_) + " nodes, the tree has more",
                  "size");
    return {};
  }

  template <class T>
  Result<T> take() {
    if (bytes_.size() - at_ < sizeof(T)) return error("unexpected end of data");
    const T value = load<T>(bytes_, at_);
    at_ += sizeof(T);
    return value;
  }

  /// The next bytes, all there.
  Result<std::string_view> take_bytes(std::size_t count) {
    if (bytes_.size() - at_ < count) return error("unexpected end of data");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  /// The next bytes, not taken yet; fewer where the data end.
  [[nodiscard]] std::string_view ahead(std::size_t count) const {
    return bytes_.substr(at_, count);
  }
  /// Takes bytes and counts a node, where nothing is to be checked but that they are there; else
  /// takes nothing and returns false.
  [[nodiscard]] bool pass_node(std::size_t count) {
    if (num_counted_ % kNodesBetweenChecks == 0 || num_counted_ >= num_nodes_) return false;
    ++num_counted_;
    at_ += count;
    return true;
  }

  [[nodiscard]] Result<void> finish() const {
    if (num_counted_ != num_nodes_)
      return fail(ErrorCode::kMalformedFile,
                  "says " + std::to_string(num_nodes_) + " nodes, the tree has " +
                      std::to_string(num_counted_),
                  "size");
    if (at_ != bytes_.size())
      return fail(ErrorCode::kMalformedFile,
                  std::to_string(bytes_.size() - at_) + " bytes follow the last node",
                  "octree");
    return {};
  }

 private:
  static constexpr std::uint64_t kNodesBetweenChecks = std::uint64_t{1} << 16U;

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t num_nodes_;
  std::uint64_t num_counted_ = 0;
  const LoadBudget& budget_;
};

}  // namespace hypermap
