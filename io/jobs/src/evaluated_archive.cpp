// SPDX-License-Identifier: BSD-3-Clause
#include "evaluated_archive.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

const Object* object_of(const MapArchive& archive, std::uint64_t id) {
  if (id > std::numeric_limits<std::uint32_t>::max()) return nullptr;
  return archive.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
}

std::optional<BelievedObject> believed(const Object& object,
                                       const ClassRegistry& classes,
                                       bool is_confirmed) {
  const auto best = best_class(object);
  if (!best || !classes.contains(best->id)) return std::nullopt;
  BelievedObject result{.id = object.id.value,
                        .is_confirmed = is_confirmed,
                        .real_probability = real_probability(object).value(),
                        .best_class_probability = best->probability.value()};
  result.shape.class_name = classes.name(best->id);
  result.shape.centroid = object.centroid_in_map.head<2>();
  result.shape.box = object.box;
  return result;
}

}  // namespace

Result<EvaluatedArchive> load_evaluated(const std::filesystem::path& path,
                                        const EvaluatedSource& source) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(path, source.limits, archive_layer_types(), source.stop));
  EvaluatedArchive result{.archive = std::move(loaded.value)};
  const auto found = result.archive.hypermap.at(source.layer);
  if (!found) return Unexpected(with_source(found.error(), {path.string()}));
  const auto* semantic = (*found)->content.as<SemanticLayer>();
  if (semantic == nullptr) {
    return Unexpected(
        Error{ErrorCode::kUnsupported, "is no semantic layer", path.string(), source.layer});
  }
  result.frame_id = (*found)->info.frame_id;
  result.objects = evaluated_objects(*semantic);
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    const std::uint64_t id = semantic->objects()[i].id;
    result.ids.push_back(id);
    const Object* object = object_of(result.archive, id);
    if (object != nullptr && !result.objects[i].box) result.objects[i].box = object->box;
  }
  return result;
}

Result<EvaluatedArchive> load_in_frame(const std::filesystem::path& path,
                                       const EvaluatedSource& source,
                                       const std::string& frame_id) {
  HYPERMAP_ASSIGN_OR_RETURN(EvaluatedArchive loaded, load_evaluated(path, source));
  if (loaded.frame_id == frame_id) return loaded;
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is in frame " + printable(loaded.frame_id) +
                                  ", must be in that of the truth: " + printable(frame_id),
                          .file = path.string(),
                          .field = source.layer});
}

Result<void> check_classes(const EvaluationReport& report,
                           const EvaluationOptions& options,
                           std::span<const EvaluatedObject> truth) {
  for (const std::string& name : options.classes) {
    if (report.classes.contains(canonical_class_name(name))) continue;
    std::vector<std::string> known;
    known.reserve(truth.size());
    for (const EvaluatedObject& object : truth) known.push_back(object.class_name);
    return fail(ErrorCode::kNotFound,
                "neither the map nor the truth has an object of class '" + printable(name) + "'" +
                    did_you_mean(name, known),
                "classes");
  }
  return {};
}

std::vector<BelievedObject> believed_objects(const EvaluatedArchive& map) {
  std::vector<BelievedObject> objects;
  for (const Object& object : map.archive.objects.objects()) {
    const auto in_layer = std::find(map.ids.begin(), map.ids.end(), object.id.value);
    const bool is_confirmed = in_layer != map.ids.end();
    auto belief = believed(object, map.archive.classes, is_confirmed);
    if (!belief) continue;
    if (is_confirmed) {
      const EvaluatedObject& shown =
          map.objects[static_cast<std::size_t>(in_layer - map.ids.begin())];
      belief->shape.centroid = shown.centroid;
    }
    objects.push_back(*std::move(belief));
  }
  return objects;
}

}  // namespace hypermap
