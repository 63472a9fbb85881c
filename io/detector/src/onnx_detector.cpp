// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/detector/onnx_detector.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"
#include "yolox_decoding.hpp"

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxModelBytes = std::size_t{1} << 30U;
constexpr double kPaddingGrey = 114.0;  // what the network was trained with

/// Protobuf's variable-length integer; false when it is cut.
bool take_varint(std::string_view bytes, std::size_t& at, std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64 && at < bytes.size(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return true;
  }
  return false;
}

/// Whether the bytes are a whole ONNX model at the outermost level: known fields that fill the
/// file, a graph among them. Spares OpenCV files that are cut or something else.
bool looks_like_onnx(std::string_view bytes) {
  constexpr std::uint64_t kGraphField = 7;
  constexpr std::uint64_t kLastField = 26;
  bool has_graph = false;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t tag = 0;
    std::uint64_t value = 0;
    if (!take_varint(bytes, at, tag) || !take_varint(bytes, at, value)) return false;
    const std::uint64_t field = tag >> 3U;
    const std::uint64_t type = tag & 7U;
    if (field == 0 || field > kLastField || (type != 0 && type != 2)) return false;
    if (type == 0) continue;
    if (value > bytes.size() - at) return false;
    at += static_cast<std::size_t>(value);
    has_graph = has_graph || field == kGraphField;
  }
  return has_graph;
}

Unexpected model_error(const std::filesystem::path& path, std::string what) {
  return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                          .what = std::move(what),
                          .file = path.string(),
                          .field = "network"});
}

std::string shape_text(const cv::Mat& output) {
  std::string out;
  for (int i = 0; i < output.dims; ++i) {
    out += (i > 0 ? " x " : "") + std::to_string(output.size[i]);
  }
  return out;
}

/// The image, shrunk or grown to fit the upper left of the input square, as a network's input.
cv::Mat letterbox(const ColorImage& image, int side_px, double scale) {
  const cv::Mat whole(image.height_px(),
                      image.width_px(),
                      CV_8UC3,
                      // OpenCV has no read-only view; nothing is written through it.
                      const_cast<Rgb8*>(image.pixels().data()));
  const auto scaled = [&](int length) {
    return std::clamp(static_cast<int>(length * scale + 1e-9), 1, side_px);
  };
  cv::Mat square(side_px, side_px, CV_8UC3, cv::Scalar::all(kPaddingGrey));
  const cv::Rect place(0, 0, scaled(image.width_px()), scaled(image.height_px()));
  cv::Mat target = square(place);
  cv::resize(whole, target, place.size(), 0.0, 0.0, cv::INTER_LINEAR);
  constexpr bool kSwapRedAndBlue = true;
  return cv::dnn::blobFromImage(square, 1.0, cv::Size(), cv::Scalar(), kSwapRedAndBlue);
}

}  // namespace

struct OnnxDetector::Impl {
  cv::dnn::Net net;
  OnnxDetectorOptions options;
  std::vector<ClassId> classes;
  std::filesystem::path model;

  /// Rows of the network for an image. Errors: kMalformedFile.
  Result<cv::Mat> run(const cv::Mat& input) {
    try {
      net.setInput(input);
      cv::Mat output = net.forward();
      const std::size_t length = 5 + classes.size();
      const std::size_t rows = num_yolox_rows(options.input_side_px);
      if (output.type() != CV_32F || !output.isContinuous() || output.total() != rows * length ||
          output.size[output.dims - 1] != static_cast<int>(length)) {
        return model_error(model,
                           "gives " + shape_text(output) + " numbers, expected 1 x " +
                               std::to_string(rows) + " x " + std::to_string(length) + " for " +
                               std::to_string(classes.size()) + " classes and an input of " +
                               std::to_string(options.input_side_px) + " pixels");
      }
      return output;
    } catch (const cv::Exception& e) {
      return model_error(model, "cannot be run: " + printable(e.what()));
    } catch (const std::bad_alloc&) {
      return Unexpected(Error{.code = ErrorCode::kOutOfMemory,
                              .what = "not enough memory to run the network",
                              .file = model.string()});
    }
  }

  [[nodiscard]] Result<Detection> detection_of(const YoloxCandidate& candidate,
                                               std::span<const float> rows,
                                               const ColorImage& image) const {
    Detection out;
    out.detector = options.detector;
    out.score = Probability(candidate.score);
    const auto inside = clipped(candidate.box_px, image.width_px(), image.height_px());
    if (inside) out.box_px = *inside;
    const std::size_t length = 5 + classes.size();
    std::vector<ClassEvidence> scores;
    scores.reserve(classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const double p = static_cast<double>(rows[candidate.row * length + 5 + c]);
      if (!(p >= 0.0 && p <= 1.0 + 1e-6)) {
        return model_error(model,
                           "must give class probabilities in 0 .. 1, gives " + json_number(p));
      }
      scores.push_back({classes[c], Probability(std::min(p, 1.0))});
    }
    HYPERMAP_ASSIGN_OR_RETURN(out.class_scores, normalized(std::move(scores)));
    return out;
  }
};

OnnxDetector::OnnxDetector(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OnnxDetector::OnnxDetector(OnnxDetector&&) noexcept = default;
OnnxDetector& OnnxDetector::operator=(OnnxDetector&&) noexcept = default;
OnnxDetector::~OnnxDetector() = default;

std::span<const ClassId> OnnxDetector::classes() const noexcept {
  return impl_->classes;
}

Result<OnnxDetector> OnnxDetector::load(const std::filesystem::path& model,
                                        const OnnxDetectorOptions& options,
                                        ClassRegistry& registry) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(model, kMaxModelBytes));
  if (!looks_like_onnx(bytes)) return model_error(model, "is no ONNX model, or is cut");
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->model = model;
  if (options.class_names.empty()) impl->options.class_names = coco_class_names();
  ClassRegistry grown = registry;
  HYPERMAP_ASSIGN_OR_RETURN(impl->classes, register_classes(impl->options.class_names, grown));
  try {
    constexpr int kAllCores = -1;
    cv::setNumThreads(options.num_threads > 0 ? options.num_threads : kAllCores);
    impl->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    impl->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    impl->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const std::exception& e) {
    return model_error(model, "cannot be read by OpenCV: " + printable(e.what()));
  }
  const ColorImage grey(options.input_side_px, options.input_side_px, Rgb8{114, 114, 114});
  HYPERMAP_TRY(impl->run(letterbox(grey, options.input_side_px, 1.0)));
  registry = std::move(grown);
  return OnnxDetector(std::move(impl));
}

Result<std::vector<Detection>> OnnxDetector::detect(const ColorImage& image) {
  if (image.empty()) return fail(ErrorCode::kInvalidArgument, "must not be empty", "image");
  const OnnxDetectorOptions& options = impl_->options;
  const double scale = std::min(static_cast<double>(options.input_side_px) / image.width_px(),
                                static_cast<double>(options.input_side_px) / image.height_px());
  HYPERMAP_ASSIGN_OR_RETURN(const cv::Mat output,
                            impl_->run(letterbox(image, options.input_side_px, scale)));
  const std::span<const float> rows(output.ptr<float>(), output.total());
  HYPERMAP_ASSIGN_OR_RETURN(const auto candidates,
                            decode_yolox(rows,
                                         {.input_side_px = options.input_side_px,
                                          .num_classes = impl_->classes.size(),
                                          .scale = scale,
                                          .min_score = options.min_score}));
  std::vector<Detection> detections;
  for (const YoloxCandidate& candidate : suppress_overlaps(candidates, options.nms_overlap)) {
    if (detections.size() >= options.max_detections) break;
    HYPERMAP_ASSIGN_OR_RETURN(Detection detection, impl_->detection_of(candidate, rows, image));
    if (detection.box_px.width_px() > 0.0) detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace hypermap
