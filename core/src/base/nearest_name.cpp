// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/nearest_name.hpp"

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kLongestName = 64;  // longer ones are no typing errors
constexpr std::size_t kShortestPart = 3;  // less is in many names

bool are_same(char a, char b) {
  return lower_ascii(a) == lower_ascii(b);
}

/// Insertions, deletions, replacements and exchanges of neighbours (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (are_same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool exchanged =
          i > 1 && j > 1 && are_same(a[i - 1], b[j - 2]) && are_same(a[i - 2], b[j - 1]);
      if (exchanged) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last.swap(row);
  }
  return last.back();
}

/// The shortest name that has `part` in it, the first of equally short ones.
std::optional<std::string_view> shortest_with(std::string_view part,
                                              std::span<const std::string_view> known) {
  std::optional<std::string_view> shortest;
  if (part.size() < kShortestPart) return shortest;
  for (const std::string_view candidate : known) {
    const bool is_in_it =
        std::search(candidate.begin(), candidate.end(), part.begin(), part.end(), are_same) !=
        candidate.end();
    const bool is_shorter = !shortest || candidate.size() < shortest->size();
    if (is_in_it && is_shorter) shortest = candidate;
  }
  return shortest;
}

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    text.append(text.empty() ? "" : ", ").append(printable(name));
  }
  return text;
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> known) {
  if (name.size() > kLongestName) return std::nullopt;
  std::optional<std::string_view> nearest;
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string_view candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest ? nearest : shortest_with(name, known);
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const auto nearest = nearest_name(name, known);
  return nearest ? ", did you mean \"" + printable(*nearest) + "\"?" : std::string();
}

std::string did_you_mean(std::string_view name, std::span<const std::string> known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return did_you_mean(name, views);
}

std::string not_one_of(std::string_view name, std::span<const std::string_view> choices) {
  return "must be one of " + listed(choices) + ", is \"" + printable(name) + "\"" +
         did_you_mean(name, choices);
}

std::string not_one_of(std::string_view name, std::span<const std::string> choices) {
  const std::vector<std::string_view> views(choices.begin(), choices.end());
  return not_one_of(name, views);
}

std::string nothing_named(std::string_view kind,
                          std::string_view name,
                          std::span<const std::string> known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return "no " + std::string(kind) + " is named \"" + printable(name) + "\"" +
         did_you_mean(name, views) + " (there are: " + (known.empty() ? "none" : listed(views)) +
         ")";
}

}  // namespace hypermap
