// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/sequence_list.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 1> kListKeys{"sequences"};
constexpr std::array<std::string_view, 7> kSequenceKeys{
    "input", "name", "dataset", "detections", "poses", "up", "transform"};
constexpr std::array<std::string_view, 2> kDetectionsKeys{"file", "detector"};
constexpr std::array<std::string_view, 7> kUpAxisNames{"x", "-x", "y", "-y", "z", "-z", "floor"};
constexpr std::size_t kMaxPathBytes = 4096;
/// Of a transform's numbers: what a map holds at a voxel of a metre.
constexpr double kMaxShiftM = 32'768.0;

Unexpected refused_entry(const YamlNode& node,
                         std::string what,
                         ErrorCode code = ErrorCode::kMalformedFile) {
  return Unexpected(node.error(std::move(what), code));
}

Result<fs::path> path_at(const YamlNode& node, const fs::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
  if (text.empty() || text.size() > kMaxPathBytes || text.find('\0') != std::string::npos) {
    return refused_entry(node,
                         "must be a path of 1 to " + std::to_string(kMaxPathBytes) +
                             " bytes, has " + std::to_string(text.size()));
  }
  return folder / text;
}

Result<std::optional<fs::path>> path_at_key(const YamlNode& map,
                                            std::string_view key,
                                            const fs::path& folder) {
  const auto node = map.find(key);
  if (!node) return std::optional<fs::path>();
  HYPERMAP_ASSIGN_OR_RETURN(fs::path path, path_at(*node, folder));
  return std::optional(std::move(path));
}

/// A name is that of a file, and one that is given that of a session, too.
Result<void> check_name(const YamlNode& node, const std::string& name, bool is_given) {
  const bool is_file_name =
      !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
  if (!is_file_name || printable(name) != name || name.size() > 100) {
    return refused_entry(
        node,
        "must have a name of 1 to 100 bytes that begins without a dot and has no '/', "
        "is '" +
            printable(name) + "'");
  }
  if (!is_given) return {};
  if (const auto checked = check_session_name(name); !checked) {
    return refused_entry(node, checked.error().what);
  }
  return {};
}

/// The last folder of the path, whatever follows it.
std::string name_of_input(const fs::path& input) {
  const fs::path whole = fs::absolute(input).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

Result<void> read_name(const YamlNode& node, ListedSequence& sequence) {
  const auto given = node.find("name");
  sequence.is_named = given.has_value();
  if (!given) {
    sequence.name = name_of_input(sequence.input);
    return check_name(node, sequence.name, false);
  }
  HYPERMAP_ASSIGN_OR_RETURN(sequence.name, given->as_string());
  return check_name(*given, sequence.name, true);
}

/// A file, or a map that says whose words it holds.
Result<void> read_detections_file(const YamlNode& node,
                                  const fs::path& folder,
                                  ListedSequence& sequence) {
  if (!node.is_map()) {
    HYPERMAP_ASSIGN_OR_RETURN(fs::path file, path_at(node, folder));
    sequence.detections.push_back(std::move(file));
    return {};
  }
  HYPERMAP_TRY(node.refuse_other_keys(kDetectionsKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode file_node, node.at("file"));
  HYPERMAP_ASSIGN_OR_RETURN(fs::path file, path_at(file_node, folder));
  if (const auto detector = node.find("detector")) {
    if (sequence.detector_names.size() != sequence.detections.size()) {
      return refused_entry(*detector, "must be said of the files before it, too");
    }
    HYPERMAP_ASSIGN_OR_RETURN(std::string name, detector->as_string());
    sequence.detector_names.push_back(std::move(name));
  }
  sequence.detections.push_back(std::move(file));
  return {};
}

Result<void> read_detections(const YamlNode& node,
                             const fs::path& folder,
                             ListedSequence& sequence) {
  const auto files = node.find("detections");
  if (!files) return {};
  if (!files->is_list()) return read_detections_file(*files, folder, sequence);
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, files->as_list());
  if (items.size() > kMaxListedDetections) {
    return refused_entry(*files,
                         "must have " + std::to_string(kMaxListedDetections) +
                             " files or fewer, has " + std::to_string(items.size()),
                         ErrorCode::kLimit);
  }
  for (const YamlNode& item : items) HYPERMAP_TRY(read_detections_file(item, folder, sequence));
  return {};
}

Result<void> read_up_axis(const YamlNode& node, ListedSequence& sequence) {
  const auto up = node.find("up");
  if (!up) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string axis, up->as_string());
  if (std::ranges::find(kUpAxisNames, axis) == kUpAxisNames.end()) {
    return refused_entry(*up, not_one_of(axis, kUpAxisNames));
  }
  sequence.up_axis = std::move(axis);
  return {};
}

Result<void> read_placement(const YamlNode& node, bool is_first, ListedSequence& sequence) {
  const auto transform = node.find("transform");
  if (!transform) return {};
  if (is_first) {
    return refused_entry(*transform,
                         "is of the first sequence, in whose frame the others are placed");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers, transform->as_doubles(4));
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(numbers[i]) <= kMaxShiftM) continue;
    return refused_entry(*transform, "must be [x, y, z, yaw] in metres and degrees within 32768 m");
  }
  sequence.placement = WorldPlacement{.x_m = numbers[0],
                                      .y_m = numbers[1],
                                      .z_m = numbers[2],
                                      .yaw_rad = numbers[3] * std::numbers::pi / 180.0};
  return {};
}

Result<ListedSequence> read_sequence(const YamlNode& node, const fs::path& folder, bool is_first) {
  ListedSequence sequence;
  if (!node.is_map()) {
    HYPERMAP_ASSIGN_OR_RETURN(sequence.input, path_at(node, folder));
    HYPERMAP_TRY(read_name(node, sequence));
    return sequence;
  }
  HYPERMAP_TRY(node.refuse_other_keys(kSequenceKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode input, node.at("input"));
  HYPERMAP_ASSIGN_OR_RETURN(sequence.input, path_at(input, folder));
  HYPERMAP_TRY(read_name(node, sequence));
  HYPERMAP_ASSIGN_OR_RETURN(sequence.description, path_at_key(node, "dataset", folder));
  HYPERMAP_ASSIGN_OR_RETURN(sequence.poses, path_at_key(node, "poses", folder));
  HYPERMAP_TRY(read_detections(node, folder, sequence));
  HYPERMAP_TRY(read_up_axis(node, sequence));
  HYPERMAP_TRY(read_placement(node, is_first, sequence));
  return sequence;
}

Result<std::vector<ListedSequence>> read_root(const YamlNode& root, const fs::path& folder) {
  HYPERMAP_TRY(root.refuse_other_keys(kListKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode list, root.at("sequences"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, list.as_list());
  if (items.empty()) return refused_entry(list, "must have 1 sequence or more, has 0");
  if (items.size() > kMaxListedSequences) {
    return refused_entry(list,
                         "must have " + std::to_string(kMaxListedSequences) +
                             " sequences or fewer, has " + std::to_string(items.size()),
                         ErrorCode::kLimit);
  }
  std::vector<ListedSequence> sequences;
  sequences.reserve(items.size());
  std::map<std::string, int> line_of_name;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(ListedSequence sequence,
                              read_sequence(item, folder, sequences.empty()));
    const auto [known, is_new] = line_of_name.try_emplace(sequence.name, item.line());
    if (!is_new) {
      return refused_entry(item,
                           "must have another name than the sequence of line " +
                               std::to_string(known->second) + ", is " + printable(sequence.name) +
                               ": `name` gives it one");
    }
    sequences.push_back(std::move(sequence));
  }
  return sequences;
}

}  // namespace

Result<std::vector<ListedSequence>> parse_sequence_list(std::string_view bytes,
                                                        const SourceName& source,
                                                        const fs::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document,
                            parse_yaml(bytes, source, {.max_bytes = kMaxSequenceListBytes}));
  return read_root(document.root(), folder);
}

Result<std::vector<ListedSequence>> read_sequence_list(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document,
                            read_yaml(path, {.max_bytes = kMaxSequenceListBytes}));
  return read_root(document.root(), path.parent_path());
}

}  // namespace hypermap
