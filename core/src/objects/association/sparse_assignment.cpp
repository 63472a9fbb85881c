// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_assignment.hpp"

#include "hypermap/core/objects/assignment.hpp"

#include <Eigen/Core>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace hypermap {
namespace {

using Group = std::vector<CostedPair>;

/// Ascending, each once.
std::vector<std::size_t> members_of(const Group& group, std::size_t IndexPair::*side) {
  std::set<std::size_t> members;
  for (const CostedPair& one : group) members.insert(one.pair.*side);
  return {members.begin(), members.end()};
}

/// Requires: it is there.
Eigen::Index place_of(std::size_t member, const std::vector<std::size_t>& ascending) {
  return std::ranges::lower_bound(ascending, member) - ascending.begin();
}

/// Pairs that share no member with those of another group; groups in the order of their first row.
std::vector<Group> independent_groups(std::span<const CostedPair> candidates) {
  std::size_t num_rows = 0;
  std::size_t num_columns = 0;
  for (const CostedPair& one : candidates) {
    num_rows = std::max(num_rows, one.pair.row + 1);
    num_columns = std::max(num_columns, one.pair.column + 1);
  }
  boost::disjoint_sets_with_storage<> sets(num_rows + num_columns);
  for (const CostedPair& one : candidates) {
    sets.union_set(one.pair.row, num_rows + one.pair.column);
  }
  std::map<std::size_t, std::size_t> first_rows;  // of each set
  for (const CostedPair& one : candidates) {
    const auto [found, is_new] = first_rows.try_emplace(sets.find_set(one.pair.row), one.pair.row);
    found->second = std::min(found->second, one.pair.row);
  }
  std::map<std::size_t, Group> by_first_row;
  for (const CostedPair& one : candidates) {
    by_first_row[first_rows.at(sets.find_set(one.pair.row))].push_back(one);
  }
  std::vector<Group> groups;
  groups.reserve(by_first_row.size());
  for (auto& [row, group] : by_first_row) groups.push_back(std::move(group));
  return groups;
}

std::vector<IndexPair> assigned_in(const Group& group) {
  const auto rows = members_of(group, &IndexPair::row);
  const auto columns = members_of(group, &IndexPair::column);
  Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(rows.size()),
                                                    static_cast<Eigen::Index>(columns.size()),
                                                    kForbiddenPair);
  for (const CostedPair& one : group) {
    costs(place_of(one.pair.row, rows), place_of(one.pair.column, columns)) = one.cost;
  }
  std::vector<IndexPair> pairs;
  const auto assigned = assign(costs);
  for (std::size_t row = 0; row < assigned.size(); ++row) {
    if (assigned[row]) pairs.push_back({rows[row], columns[*assigned[row]]});
  }
  return pairs;
}

}  // namespace

std::vector<IndexPair> assign_sparse(std::span<const CostedPair> candidates) {
  std::vector<IndexPair> pairs;
  for (const Group& group : independent_groups(candidates)) {
    const auto of_group = assigned_in(group);
    pairs.insert(pairs.end(), of_group.begin(), of_group.end());
  }
  return pairs;
}

}  // namespace hypermap
