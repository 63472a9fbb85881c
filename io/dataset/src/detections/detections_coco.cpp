// SPDX-License-Identifier: BSD-3-Clause
#include "detector_line.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/codec/value_limits.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <array>
#include <limits>
#include <map>
#include <utility>

namespace hypermap {
namespace {

/// What the numbers of a results list stand for.
struct CocoTables {
  std::map<std::int64_t, std::string> categories;
  std::map<std::string, std::size_t> frame_of_image;  ///< By id as text.
  std::vector<FrameDetections> frames;
};

/// Ids are numbers or texts.
Result<std::string> id_text(const JsonNode& node) {
  if (node.is(JsonKind::kString)) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
    return std::string(text);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto number,
                            node.integer(0, std::numeric_limits<std::int64_t>::max()));
  return std::to_string(number);
}

std::size_t frame_of(const std::string& id, CocoTables& tables) {
  const auto [at, is_new] = tables.frame_of_image.try_emplace(id, tables.frames.size());
  if (is_new) {
    tables.frames.emplace_back();
    tables.frames.back().image = id;
  }
  return at->second;
}

Result<void> parse_image(const JsonNode& node, CocoTables& tables) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode id, node.require("id"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, id_text(id));
  if (tables.frame_of_image.contains(text)) {
    return id.error(ErrorCode::kMalformedFile, "must occur once, is " + printable(text, 60));
  }
  FrameDetections& frame = tables.frames[frame_of(text, tables)];
  if (const auto name = node.find("file_name")) {
    HYPERMAP_ASSIGN_OR_RETURN(frame.image, name->string());
  }
  const auto width = node.find("width");
  const auto height = node.find("height");
  if (!width || !height) return {};
  HYPERMAP_ASSIGN_OR_RETURN(const auto w, width->integer(1, kMaxImageSidePx));
  HYPERMAP_ASSIGN_OR_RETURN(const auto h, height->integer(1, kMaxImageSidePx));
  frame.width_px = static_cast<int>(w);
  frame.height_px = static_cast<int>(h);
  return {};
}

Result<void> parse_category(const JsonNode& node,
                            const DetectionLimits& limits,
                            CocoTables& tables) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode id, node.require("id"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto number,
                            id.integer(0, std::numeric_limits<std::int32_t>::max()));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode name, node.require("name"));
  HYPERMAP_ASSIGN_OR_RETURN(std::string label, parse_label(name, limits));
  if (!tables.categories.try_emplace(number, std::move(label)).second) {
    return id.error(ErrorCode::kMalformedFile, "must occur once, is " + std::to_string(number));
  }
  return {};
}

/// `images` and `categories` of an object, where it has them.
Result<void> parse_tables(const JsonNode& root, const DetectionLimits& limits, CocoTables& tables) {
  if (const auto images = root.find("images")) {
    HYPERMAP_TRY(images->expect(JsonKind::kArray));
    for (std::size_t i = 0; i < images->size(); ++i) {
      HYPERMAP_TRY(parse_image(images->at(i), tables));
    }
  }
  if (const auto categories = root.find("categories")) {
    HYPERMAP_TRY(categories->expect(JsonKind::kArray));
    for (std::size_t i = 0; i < categories->size(); ++i) {
      HYPERMAP_TRY(parse_category(categories->at(i), limits, tables));
    }
  }
  return {};
}

/// A bare list of results has its tables beside it: `instances.json`, or `images.json` and
/// `categories.json`.
Result<void> parse_tables_beside(const std::filesystem::path& folder,
                                 const DetectionLimits& limits,
                                 CocoTables& tables) {
  if (folder.empty()) return {};
  for (const char* name : {"instances.json", "images.json", "categories.json"}) {
    const std::filesystem::path path = folder / name;
    std::error_code ec;
    const std::filesystem::file_type type = std::filesystem::status(path, ec).type();
    // What cannot be looked at is not absent: reading it says why.
    if (type != std::filesystem::file_type::regular && type != std::filesystem::file_type::none)
      continue;
    HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, limits.max_document_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(
        const JsonDocument document,
        JsonDocument::parse(text, path.string(), {.max_bytes = limits.max_document_bytes}));
    HYPERMAP_TRY(parse_tables(document.root(), limits, tables));
  }
  return {};
}

Result<std::string> label_of(const JsonNode& node,
                             const CocoTables& tables,
                             const DetectionReadOptions& options) {
  for (const char* key : {"category", "category_name", "name", "label"}) {
    if (const auto name = node.find(key)) return parse_label(*name, options.limits);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode id, node.require("category_id"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto number,
                            id.integer(0, std::numeric_limits<std::int32_t>::max()));
  const auto found = tables.categories.find(number);
  if (found != tables.categories.end()) return found->second;
  const auto index = static_cast<std::size_t>(number);
  if (tables.categories.empty() && index < options.class_names.size()) {
    return options.class_names[index];
  }
  return id.error(ErrorCode::kMalformedFile,
                  "must be one of the categories, is " + std::to_string(number));
}

Result<std::size_t> frame_of_result(const JsonNode& node, CocoTables& tables) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode id, node.require("image_id"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, id_text(id));
  const std::size_t index = frame_of(text, tables);
  if (const auto name = node.find("file_name")) {
    HYPERMAP_ASSIGN_OR_RETURN(tables.frames[index].image, name->string());
  }
  return index;
}

Result<NamedDetection> parse_result(const JsonNode& node,
                                    const CocoTables& tables,
                                    const FrameDetections& frame,
                                    DetectionSetBuilder& builder) {
  const DetectionReadOptions& options = builder.options();
  NamedDetection out;
  HYPERMAP_ASSIGN_OR_RETURN(out.label, label_of(node, tables, options));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode box, node.require("bbox"));
  HYPERMAP_ASSIGN_OR_RETURN(out.box_px, parse_box(box, true));
  if (frame.width_px > 0 && !clipped(out.box_px, frame.width_px, frame.height_px)) {
    return box.error(ErrorCode::kMalformedFile, "lies wholly outside the image");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode score, node.require("score"));
  HYPERMAP_ASSIGN_OR_RETURN(out.score, parse_probability(score));
  if (const auto scores = node.find("scores")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.scores, parse_scores(*scores, options.limits));
  }
  const auto mask = node.find("segmentation");
  if (mask && mask->is(JsonKind::kObject)) {
    HYPERMAP_ASSIGN_OR_RETURN(out.mask, parse_mask(*mask, options.limits));
  }
  if (const auto embedding = node.find("embedding")) {
    HYPERMAP_ASSIGN_OR_RETURN(out.embeddings, parse_embeddings(*embedding, builder));
  }
  return out;
}

Result<JsonNode> result_list(const JsonNode& root) {
  if (root.is(JsonKind::kArray)) return root;
  for (const char* key : {"annotations", "results"}) {
    if (const auto list = root.find(key)) {
      HYPERMAP_TRY(list->expect(JsonKind::kArray));
      return *list;
    }
  }
  return root.error(ErrorCode::kMalformedFile,
                    "missing key \"detections\", \"annotations\" or \"results\"");
}

}  // namespace

Result<void> parse_coco_json(const JsonNode& root,
                             const std::filesystem::path& folder,
                             DetectionSetBuilder& builder) {
  const DetectionReadOptions& options = builder.options();
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode list, result_list(root));
  CocoTables tables;
  if (root.is(JsonKind::kArray)) {
    HYPERMAP_TRY(parse_tables_beside(folder, options.limits, tables));
  } else {
    HYPERMAP_TRY(parse_tables(root, options.limits, tables));
    HYPERMAP_TRY(parse_detector_key(root, builder));
  }
  for (const auto& [id, name] : tables.categories) builder.add_class(name);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonNode node = list.at(i);
    HYPERMAP_TRY(node.expect(JsonKind::kObject));
    HYPERMAP_ASSIGN_OR_RETURN(const std::size_t index, frame_of_result(node, tables));
    FrameDetections& frame = tables.frames[index];
    HYPERMAP_ASSIGN_OR_RETURN(NamedDetection detection, parse_result(node, tables, frame, builder));
    if (frame.detections.size() >= options.limits.max_per_frame) {
      return node.error(ErrorCode::kLimit,
                        "at most " + std::to_string(options.limits.max_per_frame) +
                            " detections of a frame are read");
    }
    frame.detections.push_back(std::move(detection));
  }
  for (FrameDetections& frame : tables.frames) HYPERMAP_TRY(builder.add(std::move(frame), 0));
  return {};
}

}  // namespace hypermap
