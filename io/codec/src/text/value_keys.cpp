// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/value_keys.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {

ValueTree other_keys(const ValueTree& map, std::span<const std::string_view> known) {
  std::vector<ValueTree::Entry> entries;
  for (const ValueTree::Entry& entry : map.entries)
    if (std::find(known.begin(), known.end(), entry.first) == known.end()) entries.push_back(entry);
  return entries.empty() ? ValueTree{} : make_map(std::move(entries));
}

void append_keys(std::vector<ValueTree::Entry>& entries, const ValueTree& extra) {
  entries.insert(entries.end(), extra.entries.begin(), extra.entries.end());
}

}  // namespace hypermap
