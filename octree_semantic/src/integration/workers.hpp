// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Threads that share the work of a frame.
#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>

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

  /// As `for_each` over `done.size()` chunks, for work that must not stay half done: what the
  /// threads did not get to for want of memory is done by the caller alone. Requires: `done` is 0
  /// throughout, `work` does not throw. All of `done` is 1 then.
  template <class Work>
  void finish_each(std::span<std::uint8_t> done, const Work& work) const noexcept {
    const auto finish = [&](std::size_t slot, std::size_t chunk) {
      if (done[chunk] != 0) return;
      work(slot, chunk);
      done[chunk] = 1;
    };
    try {
      for_each(done.size(), finish);
    } catch (const std::exception&) {  // TBB's, before it gave a chunk to a thread
      for (std::size_t chunk = 0; chunk < done.size(); ++chunk) finish(std::size_t{0}, chunk);
    }
  }

 private:
  std::unique_ptr<tbb::task_arena> arena_;  // null for one thread
  int num_slots_ = 1;
};

}  // namespace hypermap
