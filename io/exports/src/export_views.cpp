// SPDX-License-Identifier: BSD-3-Clause
#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/io/codec/staged_folder.hpp"

#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kViewEnding = ".jpg";

Result<void> require_replaceable_views(const std::filesystem::path& folder) {
  return require_replaceable(
      folder, "view", [](const std::string& name) { return name.ends_with(kViewEnding); });
}

/// Whether the object is of a class that was asked for.
bool is_wanted(const Object& object, const std::optional<std::set<ClassId>>& classes) {
  if (!classes) return true;
  const auto best = best_class(object);
  return best && classes->contains(best->id);
}

}  // namespace

Result<WrittenFiles> export_views(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto classes, wanted_classes(archive, request));
  HYPERMAP_TRY(require_replaceable_views(request.output));
  if (archive.views.empty()) {
    return fail(ErrorCode::kNotFound, "the map holds no views; map --views keeps them", "views");
  }
  FileNames names;
  std::vector<std::pair<std::string, ObjectId>> files;
  for (const ObjectId id : confirmed_objects(archive.objects, ConfirmationOptions{})) {
    const Object& object = archive.objects.at(id);
    if (!archive.views.contains(id) || !is_wanted(object, classes)) continue;
    const std::string name =
        std::to_string(id.value) + "-" + best_class_name(object, archive.classes);
    files.emplace_back(names.add(name) + std::string(kViewEnding), id);
  }
  WrittenFiles written;
  if (files.empty()) return written;
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(request.output));
  for (const auto& [name, id] : files) {
    HYPERMAP_TRY(staged.write(name, archive.views.at(id).jpeg));
    written.push_back(request.output / name);
  }
  HYPERMAP_TRY(staged.commit());
  return written;
}

}  // namespace hypermap
