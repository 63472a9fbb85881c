// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_texts.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

using InstanceJson = nlohmann::ordered_json;

std::string object_name(const ListedEvaluation& outcome, std::size_t object) {
  return printable(outcome.objects[object].class_name) + " " +
         std::to_string(outcome.object_ids[object].value);
}

std::string object_names(const ListedEvaluation& outcome, const std::vector<std::size_t>& objects) {
  std::string text;
  for (const std::size_t object : objects) {
    if (!text.empty()) text += ", ";
    text += object_name(outcome, object);
  }
  return text;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += ", ";
    text += printable(name);
  }
  return text.empty() ? "-" : text;
}

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

/// What is wrong with a thing, or `right`.
std::string fault_text(const InstanceResult& result, const ListedEvaluation& outcome) {
  if (!result.object) {
    return result.others.empty() ? "missed" : "is " + object_names(outcome, result.others);
  }
  if (result.is_right()) return "right";
  std::string text;
  const auto add = [&](const std::string& fault) {
    if (!text.empty()) text += "; ";
    text += fault;
  };
  if (!result.is_in_place) add("out of place");
  if (!result.is_of_right_size) add("wrong size");
  if (!result.duplicates.empty()) add("again as " + object_names(outcome, result.duplicates));
  return text;
}

std::vector<std::string> instance_row(const ListedEvaluation& outcome, std::size_t t) {
  const ListedInstance& instance = outcome.listed.instances[t];
  const InstanceResult& result = outcome.comparison.instances[t];
  const bool has_object = result.object.has_value();
  const auto ratio = [&](int axis) {
    return has_object ? fixed(result.side_ratios[axis], 2) : std::string("-");
  };
  return {printable(instance.name),
          joined(instance.class_names),
          std::string(name_of(outcome.instances[t].standing)),
          outcome.frames_named.empty() ? "-" : std::to_string(outcome.frames_named[t]),
          has_object ? object_name(outcome, *result.object) : "-",
          has_object ? fixed(result.distance_m, 3) : "-",
          ratio(0),
          ratio(1),
          ratio(2),
          fault_text(result, outcome)};
}

std::string instances_table(const ListedEvaluation& outcome) {
  Table table({"thing",
               "class",
               "counts",
               "frames named",
               "object",
               "distance m",
               "x / true",
               "y / true",
               "z / true",
               "verdict"});
  for (std::size_t t = 0; t < outcome.instances.size(); ++t) table.add(instance_row(outcome, t));
  return table.text();
}

std::string false_text(const ListedEvaluation& outcome) {
  if (outcome.comparison.false_objects.empty()) return "";
  Table table({"on no listed thing", "x m", "y m", "z m"});
  for (const std::size_t object : outcome.comparison.false_objects) {
    const Eigen::Vector3d centre = outcome.objects[object].box.centre();
    table.add({object_name(outcome, object),
               fixed(centre.x(), 2),
               fixed(centre.y(), 2),
               fixed(centre.z(), 2)});
  }
  return table.text();
}

std::string summary_text(const ListedEvaluation& outcome,
                         const InstanceComparisonOptions& options) {
  const InstanceCounts& counts = outcome.comparison.counts;
  std::string text =
      std::to_string(counts.right) + " of " + std::to_string(counts.counted) +
      " things that count are right; found " + std::to_string(counts.found) + ", in place " +
      std::to_string(counts.in_place) + ", of the right size " + std::to_string(counts.right_size) +
      "; missed " + std::to_string(counts.counted - counts.found) + ", " +
      std::to_string(counts.wrong_class) + " of them under another name; duplicates " +
      std::to_string(counts.duplicates) + "; objects on no listed thing " +
      std::to_string(counts.false_objects) + "\n";
  text += "right: there once, centre within " + fixed(options.max_distance_m, 2) +
          " m, each side within " + percent(options.max_side_share) +
          ", heights of chairs within " + percent(options.max_chair_height_share) + "\n";
  if (outcome.frames_named.empty())
    text += "not known how often things were named: none is taken out as rarely seen (--input)\n";
  else
    text += "named in " + count_text(outcome.num_frames, "frame") +
            "; rarely seen: in fewer than " + std::to_string(kMinFramesNamed) + "\n";
  return text;
}

InstanceJson json_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

InstanceJson json_of_object(const ListedEvaluation& outcome, std::size_t object) {
  const Box& box = outcome.objects[object].box;
  return {{"id", outcome.object_ids[object].value},
          {"class", outcome.objects[object].class_name},
          {"centre", json_of(box.centre())},
          {"size", json_of(box.extent())}};
}

InstanceJson json_of_objects(const ListedEvaluation& outcome,
                             const std::vector<std::size_t>& objects) {
  InstanceJson list = InstanceJson::array();
  for (const std::size_t object : objects) list.push_back(json_of_object(outcome, object));
  return list;
}

InstanceJson json_of_instance(const ListedEvaluation& outcome, std::size_t t) {
  const ListedInstance& instance = outcome.listed.instances[t];
  const InstanceResult& result = outcome.comparison.instances[t];
  InstanceJson json{{"name", instance.name},
                    {"classes", instance.class_names},
                    {"standing", name_of(outcome.instances[t].standing)},
                    {"centre", json_of(outcome.instances[t].box.centre())},
                    {"size", json_of(outcome.instances[t].box.extent())},
                    {"frames_named", nullptr},
                    {"object", nullptr},
                    {"distance_m", nullptr},
                    {"side_ratios", nullptr},
                    {"in_place", result.is_in_place},
                    {"right_size", result.is_of_right_size},
                    {"right", result.is_right()},
                    {"duplicates", json_of_objects(outcome, result.duplicates)},
                    {"others", json_of_objects(outcome, result.others)}};
  if (!outcome.frames_named.empty()) json["frames_named"] = outcome.frames_named[t];
  if (!result.object) return json;
  json["object"] = json_of_object(outcome, *result.object);
  json["distance_m"] = result.distance_m;
  json["side_ratios"] = json_of(result.side_ratios);
  return json;
}

InstanceJson json_of(const InstanceCounts& counts) {
  return {{"counted", counts.counted},
          {"found", counts.found},
          {"in_place", counts.in_place},
          {"right_size", counts.right_size},
          {"right", counts.right},
          {"missed", counts.counted - counts.found},
          {"wrong_class", counts.wrong_class},
          {"duplicates", counts.duplicates},
          {"false", counts.false_objects}};
}

}  // namespace

std::string json_text_of(const ListedEvaluation& outcome,
                         const InstanceComparisonOptions& options) {
  InstanceJson json{{"sequence", outcome.listed.sequence},
                    {"counts", json_of(outcome.comparison.counts)},
                    {"things", InstanceJson::array()},
                    {"false", json_of_objects(outcome, outcome.comparison.false_objects)},
                    {"frames", nullptr},
                    {"tolerances",
                     {{"distance_m", options.max_distance_m},
                      {"side_share", options.max_side_share},
                      {"chair_height_share", options.max_chair_height_share},
                      {"frames_named", kMinFramesNamed}}}};
  if (!outcome.frames_named.empty()) json["frames"] = outcome.num_frames;
  for (std::size_t t = 0; t < outcome.instances.size(); ++t)
    json["things"].push_back(json_of_instance(outcome, t));
  return json.dump(2) + "\n";
}

std::string table_text_of(const ListedEvaluation& outcome,
                          const InstanceComparisonOptions& options) {
  std::string text = instances_table(outcome);
  text += false_text(outcome);
  text += summary_text(outcome, options);
  return text;
}

}  // namespace hypermap::app
