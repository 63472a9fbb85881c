// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/count_text.hpp"
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

void DetectionSetBuilder::add_label(const std::string& name) {
  if (!known_labels_.insert(name).second) return;
  add_class(name);
  const std::string canonical = canonical_class_name(name);
  if (stated_classes_.empty() || stated_classes_.contains(canonical)) return;
  if (unstated_classes_.insert(canonical).second) unstated_labels_.push_back(name);
}

void DetectionSetBuilder::add_class(const std::string& name) {
  if (known_classes_.insert(name).second) set_.class_names.push_back(name);
}

void DetectionSetBuilder::set_detector(DetectorDescription detector) {
  for (const std::string& name : detector.classes) {
    add_class(name);
    stated_classes_.insert(canonical_class_name(name));
  }
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
    add_label(detection.label);
    for (const NamedScore& score : detection.scores) add_label(score.label);
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

void DetectionSetBuilder::warn_of_unstated_labels() {
  if (unstated_labels_.empty()) return;
  constexpr std::size_t kMostNamed = 3;
  std::string named;
  for (std::size_t i = 0; i < std::min(unstated_labels_.size(), kMostNamed); ++i) {
    named.append(i == 0 ? " \"" : ", \"").append(printable(unstated_labels_[i], 60)).append("\"");
  }
  if (unstated_labels_.size() > kMostNamed) named += " ...";
  findings_.push_back({Severity::kWarning,
                       {.code = ErrorCode::kMalformedFile,
                        .what = count_text(unstated_labels_.size(), "label") +
                                " that the detector does not state among its classes:" + named,
                        .file = file_,
                        .field = "label"}});
}

Loaded<DetectionSet> DetectionSetBuilder::take() && {
  warn_of_unstated_labels();
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

}  // namespace hypermap
