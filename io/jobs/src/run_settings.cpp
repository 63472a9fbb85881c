// SPDX-License-Identifier: BSD-3-Clause
#include "run_settings.hpp"

#include "content_hash.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_table.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNone = "none";
/// Of the detector: what changes none of its detections, or follows from the job.
constexpr std::array<std::string_view, 2> kLeftOut{"num_threads", "detector"};

/// Name and content of a file; of a folder the name.
Result<std::string> identity_of(const fs::path& path) {
  std::string name = printable(path.filename().string());
  std::error_code failed;
  if (fs::is_directory(path, failed)) return name;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string hash, content_hash(path));
  return name + " " + hash;
}

Result<std::string> identity_of(const std::optional<fs::path>& path) {
  if (!path) return std::string(kNone);
  return identity_of(*path);
}

Result<std::string> identity_of(std::span<const fs::path> paths) {
  if (paths.empty()) return std::string(kNone);
  std::string all;
  for (const fs::path& path : paths) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string one, identity_of(path));
    all.append(all.empty() ? "" : ", ").append(one);
  }
  return all;
}

std::string joined(std::span<const std::string> names) {
  if (names.empty()) return kNone;
  std::string all;
  for (const std::string& name : names) all.append(all.empty() ? "" : ", ").append(printable(name));
  return all;
}

std::string numbers_text(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    text.append(text.empty() ? "" : ",").append(number_text(number));
  }
  return text;
}

std::string text_of(const OptionRow& row, const OptionValue& value) {
  if (value.is_none()) return kNone;
  if (row.kind == OptionKind::kFlag) return value.scalar() != 0.0 ? "yes" : "no";
  if (row.kind == OptionKind::kChoice) {
    return std::string(row.choices[static_cast<std::size_t>(value.scalar())]);
  }
  if (row.kind == OptionKind::kNumbers) return numbers_text(value.numbers());
  return number_text(value.scalar());
}

/// The numbers, flags and choices of an options struct.
template <class Options>
void add_table(const Options& options,
               const std::string& section,
               std::vector<ValueTree::Entry>& entries) {
  for (const OptionRow& row : option_table(options).rows) {
    const bool is_left_out =
        std::find(kLeftOut.begin(), kLeftOut.end(), row.name) != kLeftOut.end();
    const bool is_list = row.kind == OptionKind::kNames || row.kind == OptionKind::kSection;
    if (is_list || is_left_out) continue;
    entries.emplace_back(section + std::string(row.name),
                         make_text(text_of(row, row.get(&options))));
  }
}

/// What belongs where, as one hash.
std::string rules_text(const std::optional<PlaceRules>& rules) {
  if (!rules) return kNone;
  InputHash hash;
  const auto add = [&hash](const std::string& name, double value) {
    hash.add(name + "=" + number_text(value) + ";");
  };
  for (const auto& [name, weights] : rules->belongings) {
    hash.add(name + "/");
    for (const auto& [place, weight] : weights) add(place, weight);
  }
  for (const std::string& place : rules->places) hash.add(place + ";");
  add("tempering", rules->tempering);
  for (const auto& [name, size] : rules->sizes) {
    hash.add(name + "/");
    for (const auto& range : {size.longer, size.shorter, size.height}) {
      add("least", range ? range->least_m : 0.0);
      add("most", range ? range->most_m : 0.0);
    }
  }
  return hash.text();
}

/// What names of classes mean, as one hash.
std::string vocabulary_text(const std::optional<ClassVocabulary>& vocabulary) {
  if (!vocabulary) return kNone;
  InputHash hash;
  hash.add(write_vocabulary(*vocabulary));
  return hash.text();
}

std::string placement_text(const std::optional<WorldPlacement>& placement) {
  if (!placement) return kNone;
  const std::array<double, 4> numbers{
      placement->x_m, placement->y_m, placement->z_m, placement->yaw_rad};
  return numbers_text(numbers);
}

/// The frames by number, names and how much was detected in them.
std::string frames_text(const DatasetReader& dataset) {
  InputHash hash;
  for (std::size_t i = 0; i < dataset.size(); ++i) hash.add(dataset.frame_name(i));
  return std::to_string(dataset.size()) + " with " +
         std::to_string(dataset.summary().num_detections) + " detections, names " + hash.text();
}

const std::string& text_or_none(const ValueTree* value, const std::string& none) {
  return value == nullptr ? none : value->text;
}

}  // namespace

Result<ValueTree> asked_settings(const MappingJob& job) {
  std::vector<ValueTree::Entry> entries;
  add_table(job.dataset, "", entries);
  HYPERMAP_ASSIGN_OR_RETURN(std::string description, identity_of(job.dataset.description));
  HYPERMAP_ASSIGN_OR_RETURN(std::string detections, identity_of(job.dataset.detections));
  HYPERMAP_ASSIGN_OR_RETURN(std::string model, identity_of(job.model));
  HYPERMAP_ASSIGN_OR_RETURN(std::string poses, identity_of(job.poses));
  entries.emplace_back("dataset", make_text(std::move(description)));
  entries.emplace_back("detections", make_text(std::move(detections)));
  entries.emplace_back("detector_names", make_text(joined(job.dataset.detector_names)));
  entries.emplace_back("classes", make_text(joined(job.dataset.detection_reading.class_names)));
  entries.emplace_back("model", make_text(std::move(model)));
  add_table(job.detector, "detector.", entries);
  entries.emplace_back("detector.classes", make_text(joined(job.detector.class_names)));
  add_table(job.looks, "detect.", entries);
  HYPERMAP_ASSIGN_OR_RETURN(std::string combiner, identity_of(job.combiner));
  entries.emplace_back("combiner", make_text(std::move(combiner)));
  entries.emplace_back("poses", make_text(std::move(poses)));
  entries.emplace_back("up", make_text(job.up_axis.value_or(kNone)));
  entries.emplace_back("append", make_text(job.append ? "yes" : "no"));
  entries.emplace_back("same_world", make_text(job.same_world ? "yes" : "no"));
  entries.emplace_back("transform", make_text(placement_text(job.placement)));
  entries.emplace_back("session", make_text(job.session.value_or(kNone)));
  entries.emplace_back("views", make_text(job.keep_views ? "yes" : "no"));
  entries.emplace_back("places", make_text(rules_text(job.place_rules)));
  entries.emplace_back("class_names", make_text(vocabulary_text(job.vocabulary)));
  return make_map(std::move(entries));
}

Result<ValueTree> settings_of(const MappingJob& job, const DatasetReader& dataset) {
  HYPERMAP_ASSIGN_OR_RETURN(ValueTree settings, asked_settings(job));
  settings.entries.emplace_back("frames", make_text(frames_text(dataset)));
  return settings;
}

Result<std::vector<ValueTree::Entry>> companion_settings(const MappingJob& job) {
  std::vector<ValueTree::Entry> entries;
  if (job.combiner) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string combiner, identity_of(job.combiner));
    entries.emplace_back("combiner", make_text(std::move(combiner)));
  }
  const bool asks_places = job.mapper.prior.source == ClassPriorKind::kPlaces;
  if (asks_places && job.place_rules) {
    const std::string name = printable(job.place_rules_name);
    entries.emplace_back("places",
                         make_text((name.empty() ? "" : name + " ") + rules_text(job.place_rules)));
  }
  return entries;
}

Result<void> refuse_other_settings(const ValueTree& now, const ValueTree& before) {
  const std::string nothing = "not said";
  for (const auto& [name, value] : now.entries) {
    const std::string& was = text_or_none(before.find(name), nothing);
    if (value.text == was) continue;
    return fail(ErrorCode::kInvalidArgument,
                "is " + printable(value.text, 300) + ", must be that of the run to go on with, " +
                    printable(was, 300),
                name);
  }
  return {};
}

}  // namespace hypermap
