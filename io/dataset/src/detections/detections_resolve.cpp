// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <utility>

namespace hypermap {
namespace {

Result<ClassId> id_of(const std::string& label, const ClassRegistry& registry) {
  if (const auto id = registry.find(label)) return *id;
  return fail(
      ErrorCode::kNotFound, "must be a known class, is \"" + printable(label) + "\"", "label");
}

/// The file's own class vector, or the score spread over what the detector knows.
Result<std::vector<ClassEvidence>> class_vector(const NamedDetection& detection,
                                                const ClassRegistry& registry,
                                                std::span<const ClassId> known_classes) {
  if (detection.scores.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, id_of(detection.label, registry));
    return spread_score(id, detection.score, known_classes);
  }
  std::vector<ClassEvidence> scores;
  scores.reserve(detection.scores.size());
  for (const NamedScore& score : detection.scores) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, id_of(score.label, registry));
    scores.push_back({id, score.probability});
  }
  return normalized(std::move(scores));
}

Result<void> check_size(const FrameDetections& frame, int width_px, int height_px) {
  if (frame.width_px == 0 || (frame.width_px == width_px && frame.height_px == height_px))
    return {};
  return fail(ErrorCode::kInvalidArgument,
              "detections are for an image of " + std::to_string(frame.width_px) + " x " +
                  std::to_string(frame.height_px) + ", expected " + std::to_string(width_px) +
                  " x " + std::to_string(height_px),
              "width, height");
}

PixelBox in_pixels(const PixelBox& box, bool is_share, int width_px, int height_px) {
  if (!is_share) return box;
  return {box.u_min_px * width_px,
          box.v_min_px * height_px,
          box.u_max_px * width_px,
          box.v_max_px * height_px};
}

Result<std::optional<MaskImage>> mask_of(const NamedDetection& detection,
                                         int width_px,
                                         int height_px) {
  if (!detection.mask) return std::optional<MaskImage>{};
  if (detection.mask->width_px != width_px || detection.mask->height_px != height_px) {
    return fail(ErrorCode::kInvalidArgument,
                "must have the image's size " + std::to_string(width_px) + " x " +
                    std::to_string(height_px) + ", has " +
                    std::to_string(detection.mask->width_px) + " x " +
                    std::to_string(detection.mask->height_px),
                "mask");
  }
  return std::optional<MaskImage>(decode(*detection.mask));
}

}  // namespace

Result<ResolvedDetections> resolve(const FrameDetections& frame,
                                   const ClassRegistry& registry,
                                   std::span<const ClassId> known_classes,
                                   DetectorId detector,
                                   int width_px,
                                   int height_px) {
  HYPERMAP_TRY(check_size(frame, width_px, height_px));
  ResolvedDetections out;
  for (const NamedDetection& written : frame.detections) {
    Detection detection;
    const PixelBox box = in_pixels(written.box_px, frame.boxes_are_shares, width_px, height_px);
    const auto inside = clipped(box, width_px, height_px);
    if (!inside) {
      return fail(ErrorCode::kInvalidArgument,
                  "lies wholly outside the image of " + std::to_string(width_px) + " x " +
                      std::to_string(height_px),
                  "bbox of \"" + printable(written.label, 60) + "\"");
    }
    out.num_clipped += *inside == box ? 0U : 1U;
    detection.box_px = *inside;
    HYPERMAP_ASSIGN_OR_RETURN(detection.class_scores,
                              class_vector(written, registry, known_classes));
    HYPERMAP_ASSIGN_OR_RETURN(detection.mask, mask_of(written, width_px, height_px));
    detection.score = written.score;
    detection.embeddings = written.embeddings;
    detection.detector = detector;
    out.detections.push_back(std::move(detection));
  }
  return out;
}

FrameDetections named(std::span<const Detection> detections,
                      const ClassRegistry& registry,
                      std::string image,
                      std::optional<Stamp> stamp,
                      int width_px,
                      int height_px) {
  FrameDetections frame;
  frame.image = std::move(image);
  frame.stamp = stamp;
  frame.width_px = width_px;
  frame.height_px = height_px;
  for (const Detection& detection : detections) {
    NamedDetection out;
    if (const auto best = best_class(detection.class_scores)) out.label = registry.name(best->id);
    out.score = detection.score;
    out.box_px = detection.box_px;
    for (const ClassEvidence& score : detection.class_scores) {
      out.scores.push_back({registry.name(score.id), score.probability});
    }
    if (detection.mask) out.mask = encode(*detection.mask);
    out.embeddings = detection.embeddings;
    frame.detections.push_back(std::move(out));
  }
  return frame;
}

}  // namespace hypermap
