// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/cloud_evaluation_job.hpp"

#include "evaluated_archive.hpp"
#include "hypermap/io/codec/label_names_file.hpp"
#include "hypermap/io/codec/point_cloud_file.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Unexpected no_such_part(const std::filesystem::path& file, std::string what, std::string field) {
  return Unexpected(Error{.code = ErrorCode::kNotFound,
                          .what = std::move(what),
                          .file = file.string(),
                          .field = std::move(field)});
}

using LabelNames = std::map<std::int64_t, std::string>;

Result<LabelNames> names_of_labels(const CloudEvaluationJob& job, const LabelledPoints& cloud) {
  if (job.label_names) return read_label_names(*job.label_names);
  if (!cloud.names.empty()) return cloud.names;
  return no_such_part(job.cloud, "has labels without names: a file must name them", "labels");
}

/// The classes of the names, each once, and of each label which it is.
struct LabelledClasses {
  std::vector<std::string> names;
  std::map<std::int64_t, std::uint32_t> of_label;
};

LabelledClasses labelled_classes(const LabelNames& names, const ClassVocabulary& vocabulary) {
  LabelledClasses classes;
  std::map<std::string, std::uint32_t> known;
  for (const auto& [label, name] : names) {
    const std::string shown = vocabulary.shown_class(name);
    const auto [entry, is_new] = known.emplace(canonical_class_name(shown),
                                               static_cast<std::uint32_t>(classes.names.size()));
    if (is_new) classes.names.push_back(shown);
    classes.of_label[label] = entry->second;
  }
  return classes;
}

Result<TrueCloud> true_cloud(const CloudEvaluationJob& job,
                             const LabelledPoints& cloud,
                             const ClassVocabulary& vocabulary) {
  if (cloud.points.empty()) return no_such_part(job.cloud, "has no measured point", "points");
  if (cloud.labels.empty())
    return no_such_part(job.cloud, "has no field label, class or classification", "fields");
  HYPERMAP_ASSIGN_OR_RETURN(const LabelNames names, names_of_labels(job, cloud));
  const LabelledClasses classes = labelled_classes(names, vocabulary);
  TrueCloud truth{.class_names = classes.names};
  truth.points.reserve(cloud.points.size());
  truth.class_of_point.reserve(cloud.points.size());
  bool any_named = false;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto named = classes.of_label.find(cloud.labels[i]);
    const bool is_named = named != classes.of_label.end();
    truth.class_of_point.push_back(is_named ? named->second : TrueCloud::kNoTrueClass);
    truth.points.push_back(
        (job.map_from_cloud.isometry() * cloud.points[i].cast<double>()).cast<float>());
    any_named = any_named || is_named;
  }
  if (!any_named)
    return no_such_part(job.cloud, "bears none of the labels that are named", "labels");
  if (auto valid = validate(truth); !valid)
    return Unexpected(with_source(std::move(valid).error(), {job.cloud.string()}));
  return truth;
}

}  // namespace

Result<CloudEvaluationOutcome> run_cloud_evaluation(const CloudEvaluationJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(const LabelledPoints cloud, read_point_cloud(job.cloud));
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(job.map, job.limits, archive_layer_types(), job.stop));
  MapArchive& map = loaded.value;
  if (!map.octree && map.octomaps.empty())
    return no_such_part(job.map, "has no octree: its voxels are compared", "octree");
  if (job.vocabulary) map.vocabulary = *job.vocabulary;
  HYPERMAP_ASSIGN_OR_RETURN(const TrueCloud truth, true_cloud(job, cloud, map.vocabulary));
  HYPERMAP_ASSIGN_OR_RETURN(const UnderstoodVoxels voxels, understood_voxels(map));
  HYPERMAP_ASSIGN_OR_RETURN(CloudEvaluation evaluation,
                            evaluate_cloud(voxels.leaves, voxels.classes, truth, job.stop));
  return CloudEvaluationOutcome{std::move(evaluation), cloud.num_unmeasured};
}

}  // namespace hypermap
