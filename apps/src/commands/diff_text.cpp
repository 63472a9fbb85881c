// SPDX-License-Identifier: BSD-3-Clause
#include "diff_text.hpp"

#include "command.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

std::string named(const MapArchive& archive, const std::optional<ObjectId>& id) {
  return id ? printable(called(archive, *id)) : "-";
}

std::string place_text(const MapArchive& archive, const std::optional<ObjectId>& id) {
  if (!id) return "-";
  const Eigen::Vector3d& at = archive.objects.at(*id).centroid_in_map;
  return fixed(at.x(), 2) + "," + fixed(at.y(), 2) + "," + fixed(at.z(), 2);
}

std::string shares_text(const std::optional<SpaceShares>& shares) {
  if (!shares) return "-";
  return fixed(shares->free, 2) + "/" + fixed(shares->occupied, 2) + "/" +
         fixed(shares->unknown, 2);
}

std::size_t count_of(const ArchiveChanges& found, ChangeKind kind) {
  return static_cast<std::size_t>(std::ranges::count(found.changes, kind, &ObjectChange::kind));
}

/// "2 moved, 1 gone, 24 same"
std::string counts_text(const ArchiveChanges& found) {
  std::string text;
  for (const ChangeKind kind : kChangeKinds) {
    const std::size_t count = count_of(found, kind);
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(name_of(kind));
  }
  return text.empty() ? "no objects in either map" : text;
}

Json shares_json(const std::optional<SpaceShares>& shares) {
  if (!shares) return nullptr;
  return {{"free", shares->free}, {"occupied", shares->occupied}, {"unknown", shares->unknown}};
}

Json object_json(const MapArchive& archive, const std::optional<ObjectId>& id) {
  if (!id) return nullptr;
  const Object& object = archive.objects.at(*id);
  const Eigen::Vector3d& at = object.centroid_in_map;
  return {{"id", id->value},
          {"name", best_class_name(object, archive.classes)},
          {"position", {at.x(), at.y(), at.z()}}};
}

}  // namespace

void print_changes(const MapArchive& before,
                   const MapArchive& after,
                   const ArchiveChanges& found,
                   bool with_same) {
  Table table(
      {"change", "before", "after", "was at x,y,z", "is at x,y,z", "m", "old place", "new place"});
  bool is_any = false;
  for (const ObjectChange& change : found.changes) {
    if (change.kind == ChangeKind::kSame && !with_same) continue;
    is_any = true;
    table.add({std::string(name_of(change.kind)),
               named(before, change.before),
               named(after, change.after),
               place_text(before, change.before),
               place_text(after, change.after),
               fixed(change.distance_m, 2),
               shares_text(change.old_place),
               shares_text(change.new_place)});
  }
  if (is_any) {
    std::printf("%sold place, new place: free/filled/unknown shares of it, in the other map\n",
                table.text().c_str());
  }
  std::printf("%s\n", counts_text(found).c_str());
}

void print_changes_json(const MapArchive& before,
                        const MapArchive& after,
                        const ArchiveChanges& found,
                        std::span<const std::filesystem::path> files) {
  Json counts = Json::object();
  for (const ChangeKind kind : kChangeKinds) counts[key_of(kind)] = count_of(found, kind);
  Json changes = Json::array();
  for (const ObjectChange& change : found.changes) {
    changes.push_back({{"change", key_of(change.kind)},
                       {"before", object_json(before, change.before)},
                       {"after", object_json(after, change.after)},
                       {"distance_m", change.distance_m ? Json(*change.distance_m) : Json()},
                       {"old_place", shares_json(change.old_place)},
                       {"new_place", shares_json(change.new_place)}});
  }
  Json written = Json::array();
  for (const auto& file : files) written.push_back(file.string());
  const Json document{{"frame", found.frame_id},
                      {"goes_on", found.goes_on},
                      {"counts", std::move(counts)},
                      {"changes", std::move(changes)},
                      {"files", std::move(written)}};
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace hypermap::app
