// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/detections_file.hpp"

#include "detections_head.hpp"
#include "detector_line.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {

DetectionSetBuilder::DetectionSetBuilder(std::string file, const DetectionReadOptions& options)
    : file_(std::move(file)), options_(options) {
  set_.embeddings = options.embeddings;
  for (const std::string& name : options.class_names) add_class(name);
}

void DetectionSetBuilder::add_class(const std::string& name) {
  if (known_classes_.insert(name).second) set_.class_names.push_back(name);
}

void DetectionSetBuilder::set_detector(DetectorDescription detector) {
  for (const std::string& name : detector.classes) add_class(name);
  set_.detector = std::move(detector);
}

Result<void> DetectionSetBuilder::add(FrameDetections frame, int line) {
  if (frame.detections.size() > options_.limits.max_per_frame) {
    return Unexpected(Error{.code = ErrorCode::kLimit,
                            .what = "at most " + std::to_string(options_.limits.max_per_frame) +
                                    " detections of a frame are read, has " +
                                    std::to_string(frame.detections.size()),
                            .file = file_,
                            .field = "detections",
                            .line = line});
  }
  for (NamedDetection& detection : frame.detections) {
    add_class(detection.label);
    for (const NamedScore& score : detection.scores) add_class(score.label);
    look_at_mask(detection);
    if (frame.width_px == 0) continue;
    const auto inside = clipped(detection.box_px, frame.width_px, frame.height_px);
    if (inside && *inside != detection.box_px) {
      detection.box_px = *inside;
      ++set_.num_clipped;
    }
  }
  set_.frames.push_back(std::move(frame));
  return {};
}

Result<void> DetectionSetBuilder::add_embedding(const Embedding& embedding, const JsonNode& node) {
  const auto added = set_.embeddings.add(embedding.model, embedding.vector.size());
  if (added) return {};
  return node.error(
      added.error().code == ErrorCode::kLimit ? ErrorCode::kLimit : ErrorCode::kMalformedFile,
      added.error().what);
}

void DetectionSetBuilder::note_unknown_key(const JsonNode& member) {
  if (!unknown_keys_.insert(std::string(member.key())).second) return;
  findings_.push_back({Severity::kWarning,
                       member.error(ErrorCode::kMalformedFile, "unknown key, ignored").value()});
}

void DetectionSetBuilder::look_at_mask(NamedDetection& detection) {
  if (!detection.mask) return;
  const PixelRect bounds = bounds_of(*detection.mask);
  const PixelBox& box = detection.box_px;
  if (bounds.empty()) {
    detection.mask.reset();
    ++num_empty_masks_;
    return;
  }
  const bool meets = bounds.u_begin < box.u_max_px && bounds.u_end > box.u_min_px &&
                     bounds.v_begin < box.v_max_px && bounds.v_end > box.v_min_px;
  num_masks_apart_ += meets ? 0U : 1U;
}

void DetectionSetBuilder::warn_of(std::size_t count, const char* what, const char* field) {
  if (count == 0) return;
  findings_.push_back({Severity::kWarning,
                       {.code = ErrorCode::kMalformedFile,
                        .what = std::to_string(count) + what,
                        .file = file_,
                        .field = field}});
}

Loaded<DetectionSet> DetectionSetBuilder::take() && {
  warn_of(set_.num_clipped, " box(es) reached beyond the image and were clipped", "bbox");
  warn_of(num_empty_masks_, " mask(s) have no pixel; the box alone counts", "mask");
  warn_of(num_masks_apart_, " mask(s) lie outside their box; the mask is believed", "mask");
  return {std::move(set_), std::move(findings_)};
}

std::optional<PixelBox> clipped(const PixelBox& box, int width_px, int height_px) {
  const PixelBox inside{std::max(box.u_min_px, 0.0),
                        std::max(box.v_min_px, 0.0),
                        std::min(box.u_max_px, static_cast<double>(width_px)),
                        std::min(box.v_max_px, static_cast<double>(height_px))};
  if (!(inside.width_px() > 0.0 && inside.height_px() > 0.0)) return std::nullopt;
  return inside;
}

namespace {

/// The first line that is not blank, and whether others follow.
struct FirstLine {
  TextLine line;
  bool has_more = false;
};

FirstLine first_line(const std::vector<TextLine>& lines) {
  FirstLine out;
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) continue;
    if (out.line.number > 0) {
      out.has_more = true;
      break;
    }
    out.line = line;
  }
  return out;
}

JsonLimits json_limits(const DetectionReadOptions& options) {
  return {.max_bytes = options.limits.max_document_bytes};
}

/// Many lines of which the first is a whole frame.
bool is_json_lines(const FirstLine& first, const DetectionReadOptions& options) {
  if (!first.has_more) return false;
  const auto document = JsonDocument::parse(first.line.text, "", json_limits(options));
  return document && document->root().is(JsonKind::kObject);
}

/// What follows on a line of `text`.
std::string_view text_behind(std::string_view line, std::string_view text) {
  const std::size_t end =
      text.find('\n', static_cast<std::size_t>(line.data() - text.data()) + line.size());
  return end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
}

Result<void> parse_json_lines(std::string_view text,
                              const std::vector<TextLine>& lines,
                              DetectionSetBuilder& builder) {
  bool is_first = true;
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) continue;
    HYPERMAP_ASSIGN_OR_RETURN(
        const JsonDocument document,
        JsonDocument::parse(
            line.text, builder.file(), json_limits(builder.options()), line.number));
    if (std::exchange(is_first, false) && is_detections_head(document.root())) {
      HYPERMAP_TRY(check_detections_head(document.root(), text_behind(line.text, text)));
      continue;
    }
    if (is_detector_line(document.root())) {
      HYPERMAP_TRY(parse_detector_line(document.root(), builder));
      continue;
    }
    HYPERMAP_TRY(parse_frame_json(document.root(), builder));
  }
  return {};
}

Result<void> parse_json(std::string_view text,
                        const std::filesystem::path& folder,
                        DetectionSetBuilder& builder) {
  const std::vector<TextLine> lines = split_lines(text);
  if (is_json_lines(first_line(lines), builder.options())) {
    return parse_json_lines(text, lines, builder);
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      const JsonDocument document,
      JsonDocument::parse(text, builder.file(), json_limits(builder.options())));
  const JsonNode root = document.root();
  if (is_detections_head(root)) return check_detections_head(root, {});
  const bool is_coco =
      root.is(JsonKind::kArray) || root.find("annotations") || root.find("results");
  if (!is_coco && is_detector_line(root)) return parse_detector_line(root, builder);
  return is_coco ? parse_coco_json(root, folder, builder) : parse_frame_json(root, builder);
}

bool is_json(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const char c = text[first];
  const bool is_number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  return !is_number;
}

Result<std::vector<std::filesystem::path>> text_files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ec;
  for (auto it = std::filesystem::directory_iterator(folder, ec);
       !ec && it != std::filesystem::directory_iterator();
       it.increment(ec)) {
    if (it->path().extension() == ".txt") files.push_back(it->path());
  }
  if (ec) {
    return Unexpected(Error{.code = ErrorCode::kIo, .what = ec.message(), .file = folder.string()});
  }
  if (files.empty()) {
    return Unexpected(Error{.code = ErrorCode::kNotFound,
                            .what = "holds no *.txt, expected one for each image",
                            .file = folder.string()});
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<void> parse_text_folder(const std::filesystem::path& folder, DetectionSetBuilder& builder) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto files, text_files_of(folder));
  for (const std::filesystem::path& file : files) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string text,
                              read_file(file, builder.options().limits.max_document_bytes));
    HYPERMAP_TRY(parse_detection_text(text, file.string(), file.stem().string(), builder));
  }
  return {};
}

}  // namespace

std::size_t DetectionSet::num_detections() const {
  std::size_t count = 0;
  for (const FrameDetections& frame : frames) count += frame.detections.size();
  return count;
}

Result<Loaded<DetectionSet>> read_detections(const std::filesystem::path& path,
                                             const DetectionReadOptions& options) {
  DetectionSetBuilder builder(path.string(), options);
  std::error_code ec;
  if (std::filesystem::is_directory(path, ec)) {
    HYPERMAP_TRY(parse_text_folder(path, builder));
    return std::move(builder).take();
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, options.limits.max_file_bytes));
  const bool is_text = path.extension() == ".txt" && !is_json(text);
  if (is_text) {
    HYPERMAP_TRY(parse_detection_text(text, path.string(), path.stem().string(), builder));
  } else {
    HYPERMAP_TRY(parse_json(text, path.parent_path(), builder));
  }
  return std::move(builder).take();
}

Result<Loaded<DetectionSet>> parse_detections(std::string_view text,
                                              const std::string& name,
                                              const DetectionReadOptions& options) {
  DetectionSetBuilder builder(name, options);
  HYPERMAP_TRY(parse_json(text, {}, builder));
  return std::move(builder).take();
}

std::vector<std::string> distinct_classes(std::span<const std::string> class_names) {
  std::vector<std::string> distinct;
  std::set<std::string> seen;
  for (const std::string& name : class_names) {
    if (seen.insert(canonical_class_name(name)).second) distinct.push_back(name);
  }
  return distinct;
}

Result<std::vector<ClassId>> register_classes(std::span<const std::string> class_names,
                                              ClassRegistry& registry) {
  std::vector<ClassId> ids;
  std::set<ClassId> seen;
  for (const std::string& name : class_names) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, registry.add(name));
    if (!seen.insert(id).second) {
      return fail(ErrorCode::kInvalidArgument,
                  "must name each class once, \"" + printable(name) +
                      "\" is another spelling of \"" + printable(registry.name(id)) + "\"",
                  "class names");
    }
    ids.push_back(id);
  }
  return ids;
}

}  // namespace hypermap
