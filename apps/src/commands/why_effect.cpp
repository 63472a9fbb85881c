// SPDX-License-Identifier: BSD-3-Clause
#include "why_effect.hpp"

#include "tables.hpp"

#include <cmath>
#include <string>

namespace hypermap::app {
namespace {

/// Smaller changes would be told as 0.00.
constexpr double kLeastTold = 0.005;

std::string changed_text(const std::string& what, double by) {
  return what + " " + fixed(std::abs(by), 2) + (by > 0.0 ? " more" : " less");
}

std::string class_name(ClassId id, const ClassRegistry& classes) {
  return classes.contains(id) ? printable(classes.name(id)) : "class " + std::to_string(id.value);
}

}  // namespace

std::string effect_text(const ObservationLogEntry& entry, const ClassRegistry& classes) {
  std::string text;
  const auto tell = [&text](const std::string& what, float by, const std::string& between) {
    const auto change = static_cast<double>(by);
    if (std::abs(change) < kLeastTold) return false;
    text += (text.empty() ? "in log-odds: " : between) + changed_text(what, change);
    return true;
  };
  tell("existence", entry.effect, ", ");
  tell(class_name(entry.class_id, classes), entry.belief_change, ", ");
  std::string between = ", and ";
  for (const BeliefChange& change : entry.other_changes.entries()) {
    if (tell(class_name(change.class_id, classes), change.log_odds, between)) between = ", ";
  }
  return text;
}

}  // namespace hypermap::app
