// SPDX-License-Identifier: BSD-3-Clause
#include "why_removal.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"

#include <cstdint>
#include <optional>

namespace hypermap::app {
namespace {

double seconds_between(Stamp first, Stamp last) {
  return 1e-9 * (static_cast<double>(last.ns) - static_cast<double>(first.ns));
}

/// Those that count already.
std::string looks_text(const AbsenceRun& run) {
  if (run.looks == 0) return "";
  if (run.looks == 1) return " (so was the newest)";
  return " (so were the newest " + std::to_string(run.looks) + ", over " +
         fixed(seconds_between(run.first, run.last), 1) + " s)";
}

std::string hidden_text(const Removal& removal) {
  const double least_s = removal.seconds_until_gone;
  return "hidden after " + count_text(*removal.looks_until_gone, "more clear look") +
         " in a row through its place" + looks_text(removal.clear_looks) +
         (least_s > 0.0 ? ", over " + fixed(least_s, 1) + " s at least" : std::string());
}

std::string threshold_text(const Removal::Threshold& threshold) {
  return "out of the map when its confidence, " + fixed(threshold.confidence.value(), 2) +
         " now, falls below " + fixed(threshold.removed_below.value(), 2);
}

/// How many looks remove it: those from sides on which it was never detected count less.
std::string removed_text(const Removal& removal, bool is_hidden_first) {
  const std::uint32_t removed = *removal.looks_until_removed;
  const std::optional<std::uint32_t>& unseen = removal.looks_until_removed_unseen;
  const std::string looks = is_hidden_first ? "such look" : "clear look";
  std::string text = "out of the map after " + count_text(removed, looks);
  if (!is_hidden_first) text += " through its place";
  if (!unseen || *unseen == removed) return text;
  return text + " from where it was detected, " + std::to_string(*unseen) + " from elsewhere";
}

}  // namespace

std::vector<std::string> removal_texts(const Removal& removal, bool is_shown) {
  const auto& gone = removal.looks_until_gone;
  const auto& removed = removal.looks_until_removed;
  const bool is_hidden_first = is_shown && gone && *gone > 0 && (!removed || *gone < *removed);
  std::vector<std::string> texts;
  if (gone == 0U) texts.emplace_back("it is gone until something shows it again");
  if (is_hidden_first) texts.push_back(hidden_text(removal));
  if (removal.threshold) texts.push_back(threshold_text(*removal.threshold));
  if (removed) texts.push_back(removed_text(removal, is_hidden_first));
  return texts;
}

}  // namespace hypermap::app
