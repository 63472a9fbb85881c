// SPDX-License-Identifier: BSD-3-Clause
#include "merge_findings.hpp"

#include "hypermap/io/archive/map_sessions.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kAssociation = "association.";

std::string value_in(const MapOptions& options, std::string_view name) {
  const auto all = describe_options(options);
  const auto found = std::ranges::find(all, name, &OptionDescription::name);
  return found == all.end() ? "" : found->value;
}

bool may_share_frames(const Provenance& a, const Provenance& b) {
  if (is_import(a) || is_import(b) || a.input.empty() || a.input != b.input) return false;
  if (a.input_hash == b.input_hash) return false;
  const bool have_times = a.first_stamp && a.last_stamp && b.first_stamp && b.last_stamp;
  return have_times && *a.first_stamp <= *b.last_stamp && *b.first_stamp <= *a.last_stamp;
}

}  // namespace

std::optional<Finding> other_association(std::span<const Provenance> runs,
                                         const MapOptions& options) {
  if (runs.empty()) return std::nullopt;
  for (const auto& [name, value] : runs.back().options.entries) {
    if (!name.starts_with(kAssociation)) continue;
    const auto then = with_option(options, name, value.text);
    if (!then || *then == options) continue;
    return Finding{.error = {.code = ErrorCode::kInvalidArgument,
                             .what = "was " + printable(value.text) +
                                     " when the map was made, is " + value_in(options, name) +
                                     " now: objects are joined by other rules",
                             .field = name}};
  }
  return std::nullopt;
}

std::optional<Finding> shared_recording(std::span<const Provenance> runs,
                                        std::span<const Provenance> runs_of_other,
                                        const std::filesystem::path& other) {
  for (const Provenance& run : runs) {
    for (const Provenance& known : runs_of_other) {
      if (!may_share_frames(run, known)) continue;
      return Finding{.error = {.code = ErrorCode::kInvalidArgument,
                               .what = "has frames of " + printable(run.input) +
                                       " of the time of which " + printable(other.string()) +
                                       " has some: of one recording they count twice"}};
    }
  }
  return std::nullopt;
}

}  // namespace hypermap
