// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A sequence of pages whose copies share them.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap {

/// Pages 0, 1, 2, ..., found through directories of 64. A copy shares directories and pages until
/// either side writes to one of them; it costs one reference for each directory.
/// Requires: Page has a member `OwnerCount owners`.
template <class Page>
class PageTree {
 public:
  static constexpr std::size_t kFanOut = 64;

  [[nodiscard]] std::size_t size() const noexcept { return num_pages_; }
  /// Requires, here and below: index < size().
  [[nodiscard]] const Page& operator[](std::size_t index) const noexcept {
    return *directories_[index / kFanOut]->pages[index % kFanOut];
  }
  /// The page as one that no copy shares. Throws std::bad_alloc, and the content is unchanged then.
  [[nodiscard]] Page& unshared(std::size_t index) {
    return directories_[index / kFanOut].writable().pages[index % kFanOut].writable();
  }
  /// Requires: `unshared(index)` was called and the tree was not copied since.
  [[nodiscard]] Page& sole(std::size_t index) noexcept {
    return directories_[index / kFanOut].sole().pages[index % kFanOut].sole();
  }
  /// Throws std::bad_alloc, and nothing has changed then.
  void append(CowRef<Page> page) {
    const std::size_t slot = num_pages_ % kFanOut;
    if (slot == 0) {
      directories_.push_back(CowRef<Directory>::make());
    }
    directories_.back().writable().pages[slot] = std::move(page);
    ++num_pages_;
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return directories_.capacity() * sizeof(CowRef<Directory>) +
           directories_.size() * sizeof(Directory) + num_pages_ * sizeof(Page);
  }

 private:
  struct Directory {
    std::array<CowRef<Page>, kFanOut> pages;
    OwnerCount owners;
  };

  std::vector<CowRef<Directory>> directories_;
  std::size_t num_pages_ = 0;
};

}  // namespace hypermap
