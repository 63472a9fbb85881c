// SPDX-License-Identifier: BSD-3-Clause
#include "evaluated_archive.hpp"

#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
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

/// That it is of a class by another name of it.
double probability_of_aliases(const Object& object, ClassId id, const MapArchive& archive) {
  double sum = 0.0;
  if (archive.vocabulary.empty()) return sum;
  const std::string class_name = archive.vocabulary.class_of(archive.classes.name(id));
  for (const ClassEvidence& other : object_beliefs(object).classes) {
    if (other.id == id || !archive.classes.contains(other.id)) continue;
    const bool is_same = archive.vocabulary.class_of(archive.classes.name(other.id)) == class_name;
    if (is_same) sum += other.probability.value();
  }
  return sum;
}

std::optional<BelievedObject> believed(const Object& object,
                                       const MapArchive& archive,
                                       bool is_confirmed) {
  const ClassRegistry& classes = archive.classes;
  const auto best = best_class(object);
  if (!best || !classes.contains(best->id)) return std::nullopt;
  const std::string& name = classes.name(best->id);
  BelievedObject result{
      .id = object.id.value,
      .is_confirmed = is_confirmed,
      .real_probability = real_probability(object).value(),
      .best_class_probability =
          best->probability.value() + probability_of_aliases(object, best->id, archive)};
  result.shape.class_name = archive.vocabulary.shown_class(name);
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

void understand(EvaluatedArchive& evaluated, const ClassVocabulary& vocabulary) {
  for (EvaluatedObject& object : evaluated.objects) {
    object.class_name = vocabulary.shown_class(object.class_name);
  }
  if (evaluated.archive.true_surfaces) {
    for (TrueSurface& surface : evaluated.archive.true_surfaces->objects) {
      surface.class_name = vocabulary.shown_class(surface.class_name);
    }
  }
  evaluated.archive.vocabulary = vocabulary;
}

std::vector<BelievedObject> believed_objects(const EvaluatedArchive& map) {
  std::vector<BelievedObject> objects;
  for (const Object& object : map.archive.objects.objects()) {
    const auto in_layer = std::find(map.ids.begin(), map.ids.end(), object.id.value);
    const bool is_confirmed = in_layer != map.ids.end();
    auto belief = believed(object, map.archive, is_confirmed);
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
