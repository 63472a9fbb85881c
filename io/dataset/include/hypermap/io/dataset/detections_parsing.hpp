// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the readers of the detection forms share.
#pragma once

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/dataset/detections_file.hpp"

#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

/// A detection set that grows while a file is read, with what is noticed on the way.
class DetectionSetBuilder {
 public:
  DetectionSetBuilder(std::string file, const DetectionReadOptions& options);

  /// Clips boxes to the frame's stated size and counts them, and masks that can find nothing.
  /// Errors: kLimit for too many detections; kMalformedFile for a box wholly outside.
  Result<void> add(FrameDetections frame, int line);
  /// Adds a finding for `key` the first time it is met.
  void note_unknown_key(const JsonNode& member);
  /// Notes the dimension of an embedding that stands at `node`.
  /// Errors: those of EmbeddingDimensions::add, at the node.
  Result<void> add_embedding(const Embedding& embedding, const JsonNode& node);
  void note(Finding finding) { findings_.push_back(std::move(finding)); }
  /// Classes that the file lists.
  void add_class(const std::string& name);
  /// Whose words the file holds; its classes are known from here on.
  void set_detector(DetectorDescription detector);
  /// Whether the file said who speaks, or what was detected in some image.
  [[nodiscard]] bool has_begun() const {
    return !set_.frames.empty() || !set_.detector.name.empty();
  }
  [[nodiscard]] const DetectionReadOptions& options() const { return options_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] Loaded<DetectionSet> take() &&;

 private:
  /// A mask without a pixel says nothing: it is taken off.
  void look_at_mask(NamedDetection& detection);
  /// A class that a detection names: one that its detector does not state is told.
  void add_label(const std::string& name);
  void warn_of_unstated_labels();
  /// Warns of `count` things of one field, when there are any.
  void warn_of(std::size_t count, const char* what, const char* field);

  std::string file_;
  const DetectionReadOptions& options_;
  DetectionSet set_;
  std::vector<Finding> findings_;
  std::set<std::string, std::less<>> known_classes_;
  std::set<std::string, std::less<>> unknown_keys_;
  std::set<std::string, std::less<>> known_labels_;
  std::set<std::string, std::less<>> stated_classes_;    ///< By the detector; canonical, as the
  std::set<std::string, std::less<>> unstated_classes_;  ///< ones that it names without.
  std::vector<std::string> unstated_labels_;             ///< Those, as first written.
  std::size_t num_empty_masks_ = 0;
  std::size_t num_masks_apart_ = 0;
};

/// The part of `box` in the image; none when they share no area.
[[nodiscard]] std::optional<PixelBox> clipped(const PixelBox& box, int width_px, int height_px);

/// Box edges from four numbers, `is_xywh`: corner and size, else two corners.
/// Errors: kMalformedFile for other counts, numbers beyond 1e6, swapped or equal edges.
[[nodiscard]] Result<PixelBox> parse_box(const JsonNode& node, bool is_xywh);
[[nodiscard]] Result<Probability> parse_probability(const JsonNode& node);
/// Errors: kMalformedFile when empty or with NUL; kLimit for its length.
[[nodiscard]] Result<std::string> parse_label(const JsonNode& node, const DetectionLimits& limits);
[[nodiscard]] Result<std::vector<NamedScore>> parse_scores(const JsonNode& node,
                                                           const DetectionLimits& limits);
/// `{size: [h, w], counts: [...] or "..."}`.
[[nodiscard]] Result<RleMask> parse_mask(const JsonNode& node, const DetectionLimits& limits);
/// The smallest rectangle around the pixels of the mask; empty when it has none. Cost: O(runs).
[[nodiscard]] PixelRect bounds_of(const RleMask& mask);

/// One embedding (embedding_json.hpp) or a list of them. Errors: kMalformedFile, kLimit at what
/// breaks a rule of `validate`, and at one of another dimension than those before of its model.
[[nodiscard]] Result<std::vector<Embedding>> parse_embeddings(const JsonNode& node,
                                                              DetectionSetBuilder& builder);
/// What `parse_embeddings` reads back: an object, or a list of several. Requires: not empty.
[[nodiscard]] std::string embeddings_json(std::span<const Embedding> embeddings);

/// COCO's compressed counts: six bits a character, differences to the run before the last.
/// Errors: kMalformedFile for a character outside '0' .. 'o', a cut number, a negative run.
[[nodiscard]] Result<std::vector<std::uint32_t>> decompress_runs(std::string_view text);

/// One frame object. Errors: as `read_detections`.
Result<void> parse_frame_json(const JsonNode& root, DetectionSetBuilder& builder);
/// A COCO list or object; names and images that it lacks may lie beside it in `folder`.
Result<void> parse_coco_json(const JsonNode& root,
                             const std::filesystem::path& folder,
                             DetectionSetBuilder& builder);
/// A text file's lines, as the detections of `image`.
Result<void> parse_detection_text(std::string_view text,
                                  const std::string& file,
                                  const std::string& image,
                                  DetectionSetBuilder& builder);

}  // namespace hypermap
