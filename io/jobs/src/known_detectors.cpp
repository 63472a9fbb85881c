// SPDX-License-Identifier: BSD-3-Clause
#include "known_detectors.hpp"

#include "hypermap/core/segmentation/trained_combiner.hpp"
#include "hypermap/io/combiner/combiner_file.hpp"
#include "hypermap/io/dataset/class_names.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace hypermap {
namespace {

/// One more than the largest id of a detection in the logs.
std::uint64_t num_logged_detectors(const ObjectMap& objects) {
  std::uint64_t count = 0;
  const auto note = [&count](DetectorId id) {
    count = std::max<std::uint64_t>(count, id.value + std::uint64_t{1});
  };
  for (const Object& object : objects.objects()) {
    const ObservationLogState& log = object.observation_log.state();
    if (log.first) note(log.first->detector);
    for (const ObservationLogEntry& entry : log.newest) note(entry.detector);
    for (const ObservationLogSummary& summary : log.summaries) note(summary.detector);
  }
  return count;
}

}  // namespace

Result<DetectorRegistry> known_detectors(const MapArchive& map) {
  DetectorRegistry detectors = map.detectors;
  const std::uint64_t num_logged = num_logged_detectors(map.objects);
  for (std::uint64_t id = detectors.size(); id < num_logged; ++id) {
    HYPERMAP_TRY(detectors.add({.name = "unnamed detector " + std::to_string(id)}));
  }
  return detectors;
}

DetectorDescription described_network(const std::filesystem::path& model,
                                      const OnnxDetectorOptions& options,
                                      NetworkForm form) {
  return {.name = printable(model.stem().string()),
          .type = "detection",
          .architecture = std::string(name_of(form)),
          .classes = options.class_names.empty() ? coco_class_names() : options.class_names};
}

Result<Loaded<StackingModel>> model_of_stacking(
    const StackingOptions& options,
    const std::optional<std::filesystem::path>& combiner,
    const DetectorRegistry& detectors,
    ClassRegistry& classes) {
  if (combiner.has_value() != (options.rule == StackingRule::kTrained)) {
    return fail(ErrorCode::kInvalidArgument,
                combiner ? "must be trained where a combiner is given"
                         : "is trained, which needs a combiner (--combiner)",
                "stacking.rule");
  }
  Loaded<StackingModel> loaded{.value = stacking_model(options, detectors),
                               .findings = check_weights(options, detectors)};
  if (options.rule == StackingRule::kWeighted && options.weights.empty()) {
    loaded.findings.push_back(
        {.error = {.what = "must name a detector where stacking.rule is weighted, names none: all "
                           "weigh 1, as by rule sum (--weights NAME=WEIGHT)",
                   .field = "stacking.weights"}});
  }
  if (!combiner) return loaded;
  HYPERMAP_ASSIGN_OR_RETURN(const CombinerModel model, read_combiner(*combiner));
  auto bound = TrainedCombiner::bind(model, detectors, classes);
  if (!bound) {
    bound.error().file = combiner->string();
    return Unexpected(bound.error());
  }
  for (std::uint32_t id = 0; id < detectors.size(); ++id) {
    if ((*bound)->knows(DetectorId{id})) continue;
    loaded.findings.push_back({.error = {.code = ErrorCode::kNotFound,
                                         .what = "was not learnt of detector " +
                                                 to_string(detectors.description(DetectorId{id})) +
                                                 ": what it says counts where no other speaks",
                                         .file = combiner->string()}});
  }
  loaded.value.combiner = *bound;
  return loaded;
}

}  // namespace hypermap
