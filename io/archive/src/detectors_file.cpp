// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/detectors_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <iterator>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 4> kDetectorKeys{"name", "type", "architecture", "classes"};

Result<std::string> optional_text(const YamlNode& map, std::string_view key) {
  const auto node = map.find(key);
  return node ? node->as_string() : Result<std::string>(std::string());
}

Result<DetectorDescription> parse_detector_map(const YamlNode& map) {
  DetectorDescription detector;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode name, map.at("name"));
  HYPERMAP_ASSIGN_OR_RETURN(detector.name, name.as_string());
  HYPERMAP_ASSIGN_OR_RETURN(detector.type, optional_text(map, "type"));
  HYPERMAP_ASSIGN_OR_RETURN(detector.architecture, optional_text(map, "architecture"));
  const auto classes = map.find("classes");
  if (!classes) return detector;
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, classes->as_list());
  for (const YamlNode& node : names) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string text, node.as_string());
    detector.classes.push_back(std::move(text));
  }
  return detector;
}

}  // namespace

Result<Loaded<DetectorRegistry>> parse_detectors(std::string_view bytes, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> nodes, document.root().as_list());
  Loaded<DetectorRegistry> loaded;
  for (const YamlNode& node : nodes) {
    HYPERMAP_ASSIGN_OR_RETURN(const DetectorDescription detector, parse_detector_map(node));
    if (loaded.value.find(detector.name)) {
      return Unexpected(node.error("\"" + printable(detector.name) + "\" is there twice"));
    }
    if (const auto added = loaded.value.add(detector); !added) {
      const Error& error = added.error();
      return Unexpected(node.error(
          error.field + " " + error.what,
          error.code == ErrorCode::kLimit ? ErrorCode::kLimit : ErrorCode::kMalformedFile));
    }
    std::vector<Finding> unknown = node.unknown_keys(kDetectorKeys);
    std::move(unknown.begin(), unknown.end(), std::back_inserter(loaded.findings));
  }
  return loaded;
}

std::string write_detectors(const DetectorRegistry& detectors) {
  std::vector<ValueTree> list;
  for (const DetectorDescription& detector : detectors.detectors()) {
    std::vector<ValueTree::Entry> entries{{"name", make_text(detector.name)}};
    if (!detector.type.empty()) entries.emplace_back("type", make_text(detector.type));
    if (!detector.architecture.empty()) {
      entries.emplace_back("architecture", make_text(detector.architecture));
    }
    if (!detector.classes.empty()) {
      std::vector<ValueTree> names;
      for (const std::string& name : detector.classes) names.push_back(make_text(name));
      entries.emplace_back("classes", make_list(std::move(names)));
    }
    list.push_back(make_map(std::move(entries)));
  }
  return write_yaml(make_list(std::move(list)), YamlStyle::kBlock);
}

}  // namespace hypermap
