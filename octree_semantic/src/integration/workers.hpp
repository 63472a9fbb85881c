// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Threads that share the work of a frame.
#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace hypermap {

/// Runs the chunks of a loop in any order, each with the working memory of one slot. Whoever wants
/// the same result at any number of threads combines the slots by what does not depend on the order
/// (unions, sums).
class Workers {
 public:
  /// At most one thread for each that the machine has: more would only make TBB complain.
  void set_num_threads(int num_threads) {
    const int num = std::min(num_threads, std::max(1, tbb::info::default_concurrency()));
    if (num == num_slots_) return;
    arena_ = num > 1 ? std::make_unique<tbb::task_arena>(num) : nullptr;
    num_slots_ = num;
  }
  [[nodiscard]] std::size_t num_slots() const noexcept {
    return static_cast<std::size_t>(num_slots_);
  }

  /// Calls `work(slot, chunk)` for each chunk; no two calls with one slot at a time.
  template <class Work>
  void for_each(std::size_t num_chunks, const Work& work) const {
    if (!arena_) {
      for (std::size_t chunk = 0; chunk < num_chunks; ++chunk) work(std::size_t{0}, chunk);
      return;
    }
    arena_->execute([&] {
      tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
        const int slot = tbb::this_task_arena::current_thread_index();
        work(static_cast<std::size_t>(slot), chunk);
      });
    });
  }

 private:
  std::unique_ptr<tbb::task_arena> arena_;  // null for one thread
  int num_slots_ = 1;
};

}  // namespace hypermap
