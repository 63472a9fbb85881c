// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/stack_services.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/nearest_name.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kPoolingNames[] = {"bayesian", "maximum"};

std::vector<std::string> names_of(const GridStack& stack) {
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack.layers()) names.push_back(name);
  return names;
}

/// Every name asked for stands for a layer.
Result<void> check_asked_names(const GridStack& stack, std::span<const std::string> asked) {
  const std::vector<std::string> known = names_of(stack);
  for (const std::string& name : asked) {
    const bool is_there = std::ranges::any_of(
        known, [&](const std::string& layer) { return is_at_or_below(layer, name); });
    if (!is_there) return fail(ErrorCode::kNotFound, nothing_named("layer", name, known), "layers");
  }
  return {};
}

bool is_asked_for(const std::string& layer, std::span<const std::string> asked) {
  return asked.empty() || std::ranges::any_of(asked, [&](const std::string& name) {
           return is_at_or_below(layer, name);
         });
}

/// Each of one cell.
int pooled_steps(Pooling rule, int a, int b) {
  if (a == 0 || b == 0) return a + b;
  return rule == Pooling::kBayesian ? a + b : std::max(a, b);
}

}  // namespace

std::span<const std::string_view> pooling_names() {
  return kPoolingNames;
}

Result<GridStack> cut_out(const GridStack& stack,
                          const StackRequest& request,
                          const JobProgress& progress) {
  HYPERMAP_TRY(check_asked_names(stack, request.layers));
  HYPERMAP_ASSIGN_OR_RETURN(GridStack cut, GridStack::create(request.geometry, stack.options()));
  std::vector<std::string> asked = names_of(stack);
  std::erase_if(asked,
                [&](const std::string& name) { return !is_asked_for(name, request.layers); });
  std::size_t num_done = 0;
  for (const std::string& name : asked) {
    const LogOddsGrid& grid = stack.layers().at(name);
    HYPERMAP_TRY(cut.fuse({.layer = name, .frame_id = stack.options().frame_id, .grid = grid},
                          Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                          request.resampling));
    if (progress && !progress(++num_done, asked.size())) return interrupted();
  }
  return cut;
}

Result<LogOddsGrid> pooled(const GridStack& stack, Pooling rule) {
  return guarded(ErrorCode::kInvalidArgument, "the pooled grid", [&]() -> Result<LogOddsGrid> {
    std::vector<int> sums(stack.geometry().num_cells(), 0);
    for (const auto& [name, grid] : stack.layers()) {
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = pooled_steps(rule, sums[i], grid.cells()[i]);
      }
    }
    std::vector<LogOddsSteps> cells;
    cells.reserve(sums.size());
    for (const int sum : sums) cells.push_back(to_steps(from_steps(sum)));
    return LogOddsGrid::create(stack.geometry(), std::move(cells));
  });
}

}  // namespace hypermap
