// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Detections of any detector as files: read in three forms, written in two.
///
/// Forms: frame JSON (one object, or one per line), COCO JSON (results list, or object with
/// `images`, `categories` and `annotations`), plain text (a file per image): docs/DETECTIONS.md.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Bounds of what is read. A file beyond one of them is refused with kLimit, which names it.
struct DetectionLimits {
  std::size_t max_file_bytes = std::size_t{1} << 30U;       ///< JSON lines and folders of text.
  std::size_t max_document_bytes = std::size_t{16} << 20U;  ///< One JSON document or line.
  std::size_t max_per_frame = 1000;
  std::size_t max_label_bytes = 256;
  std::uint64_t max_image_pixels = std::uint64_t{1} << 28U;
};

struct DetectionReadOptions {
  /// Classes of the detector, in the order of its class numbers: YOLO text and class ids without
  /// `categories` are named by it; a class vector that a file does not give is spread over it.
  /// Empty: the classes that occur in the file.
  std::vector<std::string> class_names = {};
  DetectionLimits limits = {};
  /// Dimensions of the embeddings that are known from elsewhere: earlier files, the map that is
  /// gone on from.
  EmbeddingDimensions embeddings = {};
};

struct NamedScore {
  std::string label;
  Probability probability;
  friend bool operator==(const NamedScore&, const NamedScore&) = default;
};

/// Pixels of an object, run-length coded: runs of 0 and 1 in turn, the first of 0, column by
/// column.
struct RleMask {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint32_t> runs;  ///< Their sum is width_px * height_px.
  friend bool operator==(const RleMask&, const RleMask&) = default;
};

[[nodiscard]] MaskImage decode(const RleMask& mask);
[[nodiscard]] RleMask encode(const MaskImage& mask);

/// One detection with classes by name, before it meets a registry.
struct NamedDetection {
  std::string label;  ///< Plain text, whatever it holds.
  Probability score;
  PixelBox box_px;                 ///< As written; inside the image once its size is known.
  std::vector<NamedScore> scores;  ///< Empty: only label and score are known.
  std::optional<RleMask> mask;
  std::vector<Embedding> embeddings = {};  ///< A model each.
  friend bool operator==(const NamedDetection&, const NamedDetection&) = default;
};

/// What was detected in one image.
struct FrameDetections {
  std::string image;           ///< Path or name as written; empty when only a stamp is given.
  std::optional<Stamp> stamp;  ///< Exact to the nanosecond.
  int width_px = 0;            ///< 0: not stated.
  int height_px = 0;
  /// Boxes are shares of the image's sides (YOLO text), not pixels.
  bool boxes_are_shares = false;
  std::vector<NamedDetection> detections;
  friend bool operator==(const FrameDetections&, const FrameDetections&) = default;
};

/// All that one detector said about a sequence.
struct DetectionSet {
  std::vector<FrameDetections> frames;  ///< In the order of the file.
  DetectorDescription detector = {};    ///< Whose words these are; without a name: not stated.
  /// What the detector can name: given by the options, else by its description or the file's
  /// categories, and the labels in the order of first mention.
  std::vector<std::string> class_names;
  std::size_t num_clipped = 0;     ///< Boxes that exceeded an image whose size is stated.
  EmbeddingDimensions embeddings;  ///< Those of the options, and of the file.

  [[nodiscard]] std::size_t num_detections() const;
};

/// Reads `path` in whichever form it is; for plain text also a folder of `<image>*.txt`.
///
/// Plain text: "class x y w h [score]" with a number for the class and centre and size as shares of
/// the image (YOLO), or "x y w h score" in pixels with upper left corner (no class: `object`, or
/// the only name of `class_names`).
/// Errors: kIo; kLimit; kMalformedFile naming line and JSON path: no UTF-8, duplicate keys,
/// literals that are no JSON, text after the end; score outside [0, 1]; box swapped, without area,
/// not finite or wholly outside; mask whose runs do not fill its size; empty label or NUL in it;
/// embeddings out of their bounds, or of another dimension than those of the model before them;
/// JSON lines that are not those of which their head (see to_json_lines), if they have one, was
/// written.
/// Findings: boxes clipped, keys unknown (each once).
[[nodiscard]] Result<Loaded<DetectionSet>> read_detections(
    const std::filesystem::path& path, const DetectionReadOptions& options = {});

/// The same for text in memory; `name` stands in errors. JSON forms only.
[[nodiscard]] Result<Loaded<DetectionSet>> parse_detections(
    std::string_view text, const std::string& name, const DetectionReadOptions& options = {});

/// Detections of one frame in ids, boxes clipped to the image, each with a full class vector.
struct ResolvedDetections {
  std::vector<Detection> detections;
  std::size_t num_clipped = 0;
};

/// `class_names` without other spellings of a class that was named before ("Chair", "chair").
[[nodiscard]] std::vector<std::string> distinct_classes(std::span<const std::string> class_names);

/// Adds all `class_names` to `registry`, in order; the ids are in the same order.
/// Errors: those of ClassRegistry::add; kInvalidArgument when two names are one class.
[[nodiscard]] Result<std::vector<ClassId>> register_classes(
    std::span<const std::string> class_names, ClassRegistry& registry);

/// Errors: kInvalidArgument when the stated image size is another one, when a box is wholly
/// outside, when a mask has another size; kNotFound when a label is not in `registry`.
[[nodiscard]] Result<ResolvedDetections> resolve(const FrameDetections& frame,
                                                 const ClassRegistry& registry,
                                                 std::span<const ClassId> known_classes,
                                                 DetectorId detector,
                                                 int width_px,
                                                 int height_px);

/// The reverse of `resolve`, for writing.
[[nodiscard]] FrameDetections named(std::span<const Detection> detections,
                                    const ClassRegistry& registry,
                                    std::string image,
                                    std::optional<Stamp> stamp,
                                    int width_px,
                                    int height_px);

/// One line of JSON, newline included: image, timestamp, size, and per detection label, score,
/// bbox, the full class vector, the mask and the embeddings. Numbers in shortest form that reads
/// back the same; embeddings in base64.
[[nodiscard]] std::string to_json_line(const FrameDetections& frame);

/// A file of such lines, one an image, behind a head that holds their number and the CRC-32 of all
/// that follows: `{"format": "hypermap-detections", "version": 1, "num_images": 2, "crc32": "8
/// digits"}`. Where `detector` has a name, a line `{"detector": {"name": ...}}` stands between.
[[nodiscard]] std::string to_json_lines(std::string_view lines,
                                        const DetectorDescription& detector = {});

/// COCO results: a list of {image_id, file_name, category_id, category, bbox [x, y, w, h], score,
/// scores, segmentation}. `image_id` counts frames from 0, `category_id` counts `class_names` from
/// 0; names stand beside the numbers, so that the list needs no other file.
/// Errors: kNotFound when a label is not among `class_names`.
[[nodiscard]] Result<std::string> to_coco_results(std::span<const FrameDetections> frames,
                                                  std::span<const std::string> class_names);

}  // namespace hypermap
