// SPDX-License-Identifier: BSD-3-Clause
#include "shell_completion.hpp"

#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "shell_commands.hpp"
#include "shell_words.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

namespace hypermap::app {
namespace {

namespace fs = std::filesystem;

/// More entries of one folder are not looked at.
constexpr std::size_t kMaxFolderEntries = 10'000;

using Names = std::set<std::string>;

Names command_names() {
  Names names;
  for (const ShellCommand& command : shell_commands()) names.emplace(command.name);
  return names;
}

Names layer_names(const ShellMap& map) {
  Names names;
  for (const ShellLayer& layer : map.layers()) names.insert(layer.name);
  return names;
}

Names frame_names(const ShellMap& map) {
  Names names;
  for (const ShellLayer& layer : map.layers()) names.insert(layer.frame_id);
  return names;
}

/// Of the shapes of a layer, by `name_of`.
template <class NameOf>
Names shape_names(const SemanticLayer& shapes, const NameOf& name_of) {
  Names names;
  for (const SemanticObject& object : shapes.objects()) names.insert(name_of(object));
  return names;
}

/// What the layer's own answers are called; without a layer of that name all of the map's names.
Names class_names(const MapArchive& map, const std::string& layer) {
  if (map.hypermap.find_as<OccupancyLayer>(layer) != nullptr)
    return {"Free", "Occupied", "Unknown"};
  if (const auto* shapes = map.hypermap.find_as<SemanticLayer>(layer))
    return shape_names(*shapes, [](const SemanticObject& object) { return object.name; });
  const std::vector<std::string> all = names_in(map);
  return {all.begin(), all.end()};
}

/// Of the layer's shapes; without one of that name of the objects and of all shapes.
Names id_names(const MapArchive& map, const std::string& layer) {
  const auto id_of = [](const SemanticObject& object) { return std::to_string(object.id); };
  if (const auto* shapes = map.hypermap.find_as<SemanticLayer>(layer))
    return shape_names(*shapes, id_of);
  Names names;
  for (const Object& object : map.objects.objects()) names.insert(std::to_string(object.id.value));
  for (const Layer& each : map.hypermap.layers()) {
    if (const auto* shapes = each.content.as<SemanticLayer>())
      names.merge(shape_names(*shapes, id_of));
  }
  return names;
}

/// Files whose name begins so, folders with a slash behind. Hidden ones are asked for by their dot.
Names file_names(const std::string& open) {
  const std::size_t name_begin = open.rfind('/') + 1;  // 0 without a slash
  const std::string folder = open.substr(0, name_begin);
  const std::string begin = open.substr(name_begin);
  Names names;
  std::error_code failed;
  std::size_t num_seen = 0;
  fs::directory_iterator entry(folder.empty() ? "." : folder, failed);
  for (; !failed && entry != fs::directory_iterator() && num_seen < kMaxFolderEntries;
       entry.increment(failed), ++num_seen) {
    const std::string name = entry->path().filename().string();
    const bool is_hidden = name.starts_with('.') && begin.empty();
    if (is_hidden || !name.starts_with(begin)) continue;
    std::error_code unknown;
    names.insert(folder + name + (entry->is_directory(unknown) ? "/" : ""));
  }
  return names;
}

/// What may stand at the cursor.
Names names_for(const ShellSession& session, const OpenShellLine& line) {
  if (line.is_comment) return {};
  if (line.words.empty()) return command_names();
  const auto command = find_shell_command(line.words.front());
  const std::size_t position = line.words.size() - 1;
  if (!command || position >= (*command)->kinds.size()) return {};
  const MapArchive& map = session.map.read_by_now();
  const std::string layer = position == 0 ? "" : line.words[1];
  switch ((*command)->kinds[position]) {
    case ShellWordKind::kFile:
      return file_names(line.open);
    case ShellWordKind::kLayer:
      return layer_names(session.map);
    case ShellWordKind::kClass:
      return class_names(map, layer);
    case ShellWordKind::kId:
      return id_names(map, layer);
    case ShellWordKind::kFrame:
      return frame_names(session.map);
    case ShellWordKind::kCommand:
      return command_names();
    case ShellWordKind::kNone:
      break;
  }
  return {};
}

}  // namespace

ShellCompletion complete(const ShellSession& session, std::string_view line_to_cursor) {
  const OpenShellLine line = split_open_line(line_to_cursor);
  ShellCompletion completion{.open = line.open, .quote = line.quote, .candidates = {}};
  for (const std::string& name : names_for(session, line)) {
    if (name.starts_with(line.open)) completion.candidates.push_back(name);
  }
  return completion;
}

std::string insertion_of(const ShellCompletion& completion) {
  const auto& candidates = completion.candidates;
  if (candidates.empty()) return "";
  // Of words in order, what the first and the last begin with all begin with.
  const std::string& first = candidates.front();
  const std::string& last = candidates.back();
  const auto [end, other] = std::ranges::mismatch(first, last);
  const std::string common(first.begin(), end);
  std::string text = escaped(common.substr(completion.open.size()), completion.quote);
  if (candidates.size() > 1 || first.ends_with('/')) return text;
  if (completion.quote != '\0') text += completion.quote;
  return text + " ";
}

}  // namespace hypermap::app
