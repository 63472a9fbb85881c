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
