// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/load_budget.hpp"

#include "hypermap/core/base/job_progress.hpp"

#include <string>
#include <utility>

namespace hypermap {

struct LoadBudget::Account {
  /// What was drawn of one kind, and how an error tells of it.
  struct Sum {
    const char* what;
    const char* unit;
    const char* name_of_limit;
    std::uint64_t limit;
    std::uint64_t drawn = 0;

    [[nodiscard]] Result<void> draw(std::uint64_t count) {
      if (count <= limit - drawn) {
        drawn += count;
        return {};
      }
      return fail(ErrorCode::kLimit,
                  std::string("brings ") + what + " to " + std::to_string(drawn + count) + " " +
                      unit + ", the limit for all together is " + std::to_string(limit) + " (" +
                      name_of_limit + ")");
    }
  };

  Sum pixels;
  Sum edge_tests;
  Sum opaque_bytes;
  Sum octree_nodes;
  StopCheck stop;
};

LoadBudget::LoadBudget(const BudgetLimits& limits, StopCheck stop)
    : account_(std::make_shared<Account>(Account{
          .pixels = {"the images", "pixels", "max_pixels", limits.max_pixels},
          .edge_tests = {"the shapes", "edge tests", "max_edge_tests", limits.max_edge_tests},
          .opaque_bytes =
              {"what is kept unread", "bytes", "max_opaque_bytes", limits.max_opaque_bytes},
          .octree_nodes = {"the octrees", "nodes", "max_octree_nodes", limits.max_octree_nodes},
          .stop = std::move(stop)})) {}

Result<void> LoadBudget::check_stop() const {
  if (account_ != nullptr && account_->stop && account_->stop()) return interrupted();
  return {};
}

Result<void> LoadBudget::draw_pixels(std::uint64_t count) const {
  HYPERMAP_TRY(check_stop());
  return account_ == nullptr ? Result<void>() : account_->pixels.draw(count);
}

Result<void> LoadBudget::draw_edge_tests(std::uint64_t count) const {
  HYPERMAP_TRY(check_stop());
  return account_ == nullptr ? Result<void>() : account_->edge_tests.draw(count);
}

Result<void> LoadBudget::draw_opaque_bytes(std::uint64_t count) const {
  HYPERMAP_TRY(check_stop());
  return account_ == nullptr ? Result<void>() : account_->opaque_bytes.draw(count);
}

Result<void> LoadBudget::draw_octree_nodes(std::uint64_t count) const {
  HYPERMAP_TRY(check_stop());
  return account_ == nullptr ? Result<void>() : account_->octree_nodes.draw(count);
}

}  // namespace hypermap
