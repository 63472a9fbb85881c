// SPDX-License-Identifier: BSD-3-Clause
#include "evaluated_archive.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
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

Result<MapArchive> archive_of(const std::filesystem::path& path, const EvaluatedSource& source) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(path, source.limits, archive_layer_types(), source.stop));
  return std::move(loaded.value);
}

/// An archive whose only layer is a semantic YAML file.
Result<MapArchive> archive_of_shapes(const std::filesystem::path& path,
                                     const EvaluatedSource& source) {
  const LoadBudget budget(source.limits.sums, source.stop);
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_semantic_layer(path, {}, budget));
  MapArchive archive;
  HYPERMAP_TRY(archive.hypermap.add_layer({{.name = source.layer}, std::move(layer.value)}));
  return archive;
}

}  // namespace

Result<UnderstoodVoxels> understood_voxels(const MapArchive& archive) {
  UnderstoodVoxels voxels{.leaves = shown_leaves(archive), .classes = archive.classes};
  if (archive.vocabulary.empty()) return voxels;
  voxels.classes = {};
  std::vector<ClassId> meant;
  meant.reserve(archive.classes.size());
  for (const std::string& name : archive.classes.names()) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id,
                              voxels.classes.add(archive.vocabulary.shown_class(name)));
    meant.push_back(id);
  }
  voxels.leaves = [leaves = std::move(voxels.leaves), meant](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      LeafSample understood = leaf;
      if (leaf.best_class) understood.best_class = meant[leaf.best_class->value];
      visit(understood);
    });
  };
  return voxels;
}

Result<EvaluatedArchive> load_evaluated(const std::filesystem::path& path,
                                        const EvaluatedSource& source) {
  const bool is_bare = find_file_kind(path) == FileKind::kSemantic;
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive archive,
                            is_bare ? archive_of_shapes(path, source) : archive_of(path, source));
  EvaluatedArchive result{.archive = std::move(archive)};
  const auto found = result.archive.hypermap.at(source.layer);
  if (!found) return Unexpected(with_source(found.error(), {path.string()}));
  const auto* semantic = (*found)->content.as<SemanticLayer>();
  if (semantic == nullptr) {
    return Unexpected(
        Error{ErrorCode::kUnsupported, "is no semantic layer", path.string(), source.layer});
  }
  if (!is_bare) result.frame_id = (*found)->info.frame_id;
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
  const bool is_said = !loaded.frame_id.empty() && !frame_id.empty();
  if (!is_said || loaded.frame_id == frame_id) return loaded;
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is in frame " + printable(loaded.frame_id) +
                                  ", must be in that of the truth: " + printable(frame_id),
                          .file = path.string(),
                          .field = source.layer});
}

ClassVocabulary vocabulary_of(const std::optional<ClassVocabulary>& given,
                              const MapArchive& map,
                              const MapArchive& truth) {
  if (given) return *given;
  return map.vocabulary.empty() ? truth.vocabulary : map.vocabulary;
}

Result<EvaluationOptions> understood_options(const EvaluationOptions& given,
                                             const EvaluatedArchive& map,
                                             const EvaluatedArchive& truth) {
  const ClassVocabulary& vocabulary = truth.archive.vocabulary;
  std::vector<std::string> known;
  known.reserve(map.objects.size() + truth.objects.size());
  for (const EvaluatedObject& object : truth.objects) known.push_back(object.class_name);
  for (const EvaluatedObject& object : map.objects) known.push_back(object.class_name);
  EvaluationOptions options = given;
  std::set<std::string> names;
  for (const std::string& text : given.classes) {
    const auto asked = asked_names(text, known, vocabulary);
    if (!asked) return fail(asked.error().code, asked.error().what, "classes");
    const auto is_asked = [&](const std::string& name) { return asked->contains(name); };
    if (std::ranges::none_of(known, is_asked)) {
      return fail(ErrorCode::kNotFound,
                  "neither the map nor the truth has an object of class '" + printable(text) + "'" +
                      did_you_mean(text, known),
                  "classes");
    }
    names.insert(asked->canonical_names().begin(), asked->canonical_names().end());
  }
  options.classes.assign(names.begin(), names.end());
  return options;
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
