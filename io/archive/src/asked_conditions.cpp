// SPDX-License-Identifier: BSD-3-Clause
#include "asked_conditions.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace hypermap {

std::string conditions_of(const MapQuery& query) {
  std::string text;
  if (query.text) text += " of class '" + printable(*query.text) + "'";
  if (query.value) text += " with id " + std::to_string(*query.value);
  if (query.area) text += " in the area";
  return text;
}

std::string unmet_conditions_of(const MapQuery& query, const MapArchive& archive) {
  std::string text = conditions_of(query);
  if (!query.text) return text;
  const auto classes = archive.classes.names();
  std::vector<std::string> known(classes.begin(), classes.end());
  if (known.empty()) known = names_in(archive);
  const auto names = asked_of_map(archive, *query.text);
  const auto is_asked = [&](const std::string& name) { return names->contains(name); };
  if (names && std::ranges::any_of(known, is_asked)) return text;
  const bool is_plain = names && names->contains(*query.text);
  if (is_plain && !archive.vocabulary.knows(*query.text)) {
    return text + did_you_mean(*query.text, known);
  }
  return text + ": " + nothing_asked(*query.text, known, archive.vocabulary);
}

Result<void> check_frame(const MapArchive& archive, const std::string& frame_id) {
  if (frame_id.empty()) return {};
  std::set<std::string> known;
  for (const Layer& layer : archive_layers(archive)) known.insert(layer.info.frame_id);
  for (const FrameTransform& transform : archive.hypermap.frames().transforms()) {
    known.insert(transform.frame_id);
    known.insert(transform.child_frame_id);
  }
  if (known.contains(frame_id)) return {};
  const std::vector<std::string> names(known.begin(), known.end());
  return fail(ErrorCode::kNotFound, nothing_named("frame", frame_id, names), "frame_id");
}

}  // namespace hypermap
