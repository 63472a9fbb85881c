// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "outputs.hpp"
#include "shell_commands.hpp"
#include "tables.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>

namespace hypermap::app {
namespace {

/// What was loaded, for people.
void tell_loaded(const ShellSession& session, const std::string& file) {
  std::fprintf(stderr,
               "%s: %s\n",
               printable(file, 500).c_str(),
               count_text(session.map.layers().size(), "layer").c_str());
}

/// Takes another map by `load`. The frame of the map before is not that of this one.
template <class Load>
Result<void> take_map(ShellSession& session, const std::string& file, const Load& load) {
  const auto unsaved = session.map.unsaved();
  HYPERMAP_TRY(load());
  note_unsaved(unsaved);
  session.frame_id.clear();
  tell_loaded(session, file);
  return {};
}

/// "-1.00 .. 3.00, 0.00 .. 2.00".
std::string extent_text(const LayerStatistics& statistics, bool is_flat) {
  if (!statistics.bounds) return "empty";
  std::string text;
  for (int axis = 0; axis < (is_flat ? 2 : 3); ++axis) {
    text += (axis == 0 ? "" : ", ") + fixed(statistics.bounds->min()[axis], 2) + " .. " +
            fixed(statistics.bounds->max()[axis], 2);
  }
  return text;
}

/// The topics of a map server with their messages. Source: [hypermap] 3.3.3, 3.3.4.
std::string topics_text(const Layer& layer) {
  const std::string name = printable(layer.info.name);
  if (class_of(layer) == "OccupancyGridLayer") {
    return name + "_map (nav_msgs/OccupancyGrid), " + name + "_map_metadata (nav_msgs/MapMetaData)";
  }
  if (class_of(layer) == "SemanticLayer") return name + "_semmap (hypermap_msgs/SemanticMap)";
  return "-";
}

void print_layers_to_publish(const std::vector<Layer>& layers, std::uint64_t revision) {
  Table table({"layer", "class", "frame", "revision", "subscribe", "update", "extent m", "topics"},
              LastColumn::kText);
  for (const Layer& layer : layers) {
    table.add({printable(layer.info.name),
               printable(class_of(layer)),
               printable(layer.info.frame_id),
               std::to_string(revision),
               layer.info.subscribe_mode.value_or(false) ? "yes" : "no",
               layer.info.enable_update.value_or(true) ? "yes" : "no",
               extent_text(layer.content->statistics(), layer.content->is_flat()),
               topics_text(layer)});
  }
  std::printf("%s", table.text().c_str());
}

/// Where the frames of the layers lie in that of the first. Source: [hypermap] F14.
void print_frames_to_publish(const std::vector<Layer>& layers, const FrameTree& frames) {
  if (layers.empty()) return;
  const std::string& base = layers.front().info.frame_id;
  Table table({"frame in " + printable(base), "x m", "y m", "yaw degrees"});
  std::vector<std::string> listed{base};
  for (const Layer& layer : layers) {
    const std::string& frame = layer.info.frame_id;
    if (std::ranges::find(listed, frame) != listed.end()) continue;
    listed.push_back(frame);
    const auto base_from_frame = frames.to_from(base, frame);
    if (!base_from_frame) {
      table.add({printable(frame), "-", "-", "-"});
      continue;
    }
    const Eigen::Vector2d along_x = base_from_frame->linear().col(0);
    const double yaw_rad = std::atan2(along_x.y(), along_x.x());
    table.add({printable(frame),
               fixed(base_from_frame->translation().x(), 3),
               fixed(base_from_frame->translation().y(), 3),
               fixed(yaw_rad * 180.0 / std::numbers::pi, 3)});
  }
  if (listed.size() > 1) std::printf("%s", table.text().c_str());
}

/// All frames that layers lie in or transforms know, ascending.
std::vector<std::string> frames_of(const ShellMap& map) {
  std::set<std::string> frames;
  for (const ShellLayer& layer : map.layers()) frames.insert(layer.frame_id);
  for (const FrameTransform& transform : map.read_by_now().hypermap.frames().transforms()) {
    frames.insert(transform.frame_id);
    frames.insert(transform.child_frame_id);
  }
  return {frames.begin(), frames.end()};
}

}  // namespace

Result<void> do_load(ShellSession& session, const ShellArguments& words) {
  return take_map(session, words[0], [&] { return session.map.load(words[0]); });
}

Result<void> do_load_config(ShellSession& session, const ShellArguments& words) {
  return take_map(session, words[0], [&] { return session.map.load_config(words[0]); });
}

Result<void> do_save(ShellSession& session, const ShellArguments& words) {
  std::optional<std::filesystem::path> path;
  if (!words.empty()) path = words[0];
  if (path && !has_suffix(*path, ".hmap")) {
    return fail(ErrorCode::kInvalidArgument, "must end in .hmap, is '" + printable(words[0]) + "'");
  }
  if (const auto fault = path ? dataset_fault(*path) : std::nullopt) {
    return fail(ErrorCode::kInvalidArgument, *fault);
  }
  return session.map.save(path);
}

Result<void> do_clear(ShellSession& session, const ShellArguments& /*words*/) {
  note_unsaved(session.map.unsaved());
  session.map.clear();
  session.frame_id.clear();
  return {};
}

Result<void> do_frame(ShellSession& session, const ShellArguments& words) {
  const std::vector<std::string> frames = frames_of(session.map);
  if (!words.empty() && std::ranges::find(frames, words[0]) == frames.end())
    return fail(ErrorCode::kNotFound, nothing_named("frame", words[0], frames));
  session.frame_id = words.empty() ? "" : words[0];
  return {};
}

Result<void> do_layers(ShellSession& session, const ShellArguments& /*words*/) {
  Table table({"layer", "class", "frame"}, LastColumn::kText);
  const std::vector<ShellLayer> layers = session.map.layers();
  for (const ShellLayer& layer : layers)
    table.add({printable(layer.name), printable(layer.class_name), printable(layer.frame_id)});
  if (!layers.empty()) std::printf("%s", table.text().c_str());
  return {};
}

Result<void> do_layer_count(ShellSession& session, const ShellArguments& /*words*/) {
  std::printf("%zu\n", session.map.layers().size());
  return {};
}

Result<void> do_republish(ShellSession& session, const ShellArguments& /*words*/) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, session.map.whole());
  const std::vector<Layer> layers = archive_layers(*map);
  if (!layers.empty()) print_layers_to_publish(layers, session.map.revision());
  print_frames_to_publish(layers, map->hypermap.frames());
  print_note("there is no transport here that would publish it");
  return {};
}

}  // namespace hypermap::app
