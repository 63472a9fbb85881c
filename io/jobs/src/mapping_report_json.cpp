// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/mapping_job.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <string_view>

namespace hypermap {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const PoseCounts& poses) {
  return {{"refined", poses.num_refined},
          {"too_few_points", poses.num_too_few_points},
          {"ambiguous", poses.num_ambiguous},
          {"too_large", poses.num_too_large},
          {"no_better", poses.num_no_better},
          {"mean_translation_m", poses.mean_translation_m},
          {"max_translation_m", poses.max_translation_m},
          {"mean_rotation_rad", poses.mean_rotation_rad},
          {"max_rotation_rad", poses.max_rotation_rad}};
}

/// Quartiles of each stage's times; stages that took no time in any frame are null.
Json json_of(const FrameTimes& times) {
  Json json = Json::object();
  for (const FrameStage stage : kFrameStages) {
    const SeriesSample& sample = times.of(stage);
    const FiveNumbers numbers = sample.numbers();
    Json& entry = json[std::string(name_of(stage))];
    if (!(numbers.max > 0.0)) continue;
    entry = {{"frames", sample.n()},
             {"one_of", sample.stride()},
             {"min_s", numbers.min},
             {"lower_s", numbers.lower},
             {"median_s", numbers.median},
             {"upper_s", numbers.upper},
             {"max_s", numbers.max}};
  }
  return json;
}

}  // namespace

std::string_view name_of(FrameStage stage) {
  constexpr std::array<std::string_view, kFrameStages.size()> kNames{"read",
                                                                     "detect",
                                                                     "wait",
                                                                     "smooth",
                                                                     "refine",
                                                                     "segment",
                                                                     "integrate",
                                                                     "associate",
                                                                     "visibility",
                                                                     "frame"};
  return kNames[static_cast<std::size_t>(stage)];
}

std::string to_json(const MappingReport& report) {
  const MappingSeconds& seconds = report.seconds;
  const IntegrationReport& points = report.points;
  Json json;
  json["frames"] = report.num_frames;
  json["frames_resumed"] = report.num_resumed;
  json["frames_skipped"] = report.skipped.size();
  json["skipped"] = Json::array();
  for (const Error& error : report.skipped) json["skipped"].push_back(to_string(error));
  json["points"] = points.num_hits + points.num_beyond_range + points.num_outside_volume;
  json["points_skipped"] = {{"beyond_range", points.num_beyond_range},
                            {"not_measured", points.num_not_measured},
                            {"not_finite", points.num_not_finite},
                            {"outside_volume", points.num_outside_volume},
                            {"transient", points.num_transient}};
  json["detections"] = report.num_detections;
  json["detections_filtered"] = report.num_filtered;
  json["segments"] = report.num_segments;
  json["frames_unjudged"] = report.num_visibility_skipped;
  json["poses"] = json_of(report.poses);
  json["objects"] = report.num_objects;
  json["objects_tentative"] = report.num_tentative;
  json["leaves"] = {{"occupied", report.leaves.occupied}, {"free", report.leaves.free}};
  if (report.network_form != NetworkForm::kAuto) {
    json["network_form"] = std::string(name_of(report.network_form));
    json["frames_looked_at"] = report.num_looks;
  }
  json["up"] = report.up;
  json["floor"] = {{"height_m", report.floor.height_m},
                   {"source", std::string(name_of(report.floor.source))}};
  json["wall_s"] = seconds.wall;
  json["stages_s"] = {{"read", seconds.read},
                      {"detect", seconds.detect},
                      {"wait", seconds.wait},
                      {"smooth", seconds.smooth},
                      {"refine", seconds.refine},
                      {"segment", seconds.segment},
                      {"integrate", seconds.integrate},
                      {"associate", seconds.associate},
                      {"visibility", seconds.visibility},
                      {"project", seconds.project},
                      {"write", seconds.write}};
  json["frame_times"] = json_of(report.frame_times);
  const auto num_mapped_now = static_cast<double>(report.num_frames - report.num_resumed);
  json["frames_per_s"] = seconds.wall > 0.0 ? num_mapped_now / seconds.wall : 0.0;
  json["peak_rss_bytes"] = report.peak_rss_bytes;
  json["threads"] = report.num_threads;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hypermap
