// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/detector/onnx_detector.hpp"

#include "box_candidates.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"
#include "network_input.hpp"
#include "network_rows.hpp"
#include "onnx_file.hpp"
#include "output_layout.hpp"

#include <opencv2/dnn.hpp>

#include <algorithm>
#include <new>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxModelBytes = std::size_t{1} << 30U;
constexpr std::size_t kMaxOutputNumbers = std::size_t{1} << 26U;  // of one output
constexpr int kUsualSide = 416;

Unexpected model_error(const std::filesystem::path& path, std::string what) {
  return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                          .what = std::move(what),
                          .file = path.string(),
                          .field = "network"});
}

/// The side of the square that the network takes. Errors: kMalformedFile.
Result<int> side_of(const OnnxDetectorOptions& options,
                    std::string_view bytes,
                    const std::filesystem::path& path) {
  if (options.input_side_px > 0) return options.input_side_px;
  const auto declared = declared_input(bytes);
  if (!declared) return kUsualSide;
  constexpr int kMaxSide = 2048;
  if (declared->width_px == declared->height_px && declared->width_px <= kMaxSide)
    return declared->width_px;
  return model_error(path,
                     "takes images of " + std::to_string(declared->width_px) + " x " +
                         std::to_string(declared->height_px) + " pixels, expected a square of at " +
                         "most " + std::to_string(kMaxSide));
}

std::vector<std::size_t> shape_of(const cv::Mat& output) {
  std::vector<std::size_t> shape;
  shape.reserve(static_cast<std::size_t>(output.dims));
  for (int i = 0; i < output.dims; ++i) shape.push_back(static_cast<std::size_t>(output.size[i]));
  return shape;
}

/// What a network gave for an image, with the memory that it lies in.
struct RunOutputs {
  std::vector<cv::Mat> memory;
  std::vector<NetworkOutput> outputs;
};

}  // namespace

struct OnnxDetector::Impl {
  cv::dnn::Net net;
  std::vector<cv::String> output_names;
  OnnxDetectorOptions options;
  NetworkSize size;
  NetworkForm form = NetworkForm::kAuto;
  DetectorId id{0};
  InputConvention convention;
  std::vector<ClassId> classes;
  std::filesystem::path model;

  [[nodiscard]] Error located(Error error) const {
    if (error.file.empty()) error.file = model.string();
    return error;
  }

  /// Errors: kMalformedFile, kOutOfMemory.
  Result<RunOutputs> run(const cv::Mat& input) {
    try {
      RunOutputs run;
      net.setInput(input);
      net.forward(run.memory, output_names);
      for (std::size_t i = 0; i < run.memory.size(); ++i) {
        const cv::Mat& output = run.memory[i];
        if (output.type() != CV_32F || !output.isContinuous() ||
            output.total() > kMaxOutputNumbers) {
          return model_error(model,
                             "gives " + printable(output_names[i], 60) + " of " +
                                 shape_text(shape_of(output)) + ", expected at most " +
                                 std::to_string(kMaxOutputNumbers) + " numbers of 32 bits");
        }
        run.outputs.push_back({.name = output_names[i],
                               .shape = shape_of(output),
                               .values = {output.ptr<float>(), output.total()}});
      }
      return run;
    } catch (const cv::Exception& e) {
      return model_error(model, "cannot be run: " + printable(e.what()));
    } catch (const std::bad_alloc&) {
      return Unexpected(Error{.code = ErrorCode::kOutOfMemory,
                              .what = "not enough memory to run the network",
                              .file = model.string()});
    }
  }

  /// Finds out what the outputs are.
  Result<void> settle_form() {
    const ColorImage grey(size.input_side_px, size.input_side_px, Rgb8{114, 114, 114});
    const InputPlacement whole =
        place(size.input_side_px, size.input_side_px, size.input_side_px, ImageFit::kStretch);
    HYPERMAP_ASSIGN_OR_RETURN(const RunOutputs tried,
                              run(network_input(grey, whole, size.input_side_px, {})));
    const auto layout = find_layout(tried.outputs, options.network_form, size);
    if (!layout) return Unexpected(located(layout.error()));
    form = layout->form;
    convention = convention_of(form, options);
    return {};
  }

  /// The whole class vector of a row.
  [[nodiscard]] Result<std::vector<ClassEvidence>> class_scores(
      const BoxCandidate& candidate, const std::vector<double>& probabilities) const {
    if (probabilities.empty()) {
      return spread_score(classes[candidate.best_class], Probability(candidate.score), classes);
    }
    std::vector<ClassEvidence> scores;
    scores.reserve(classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const double p = probabilities[c];
      if (!(p >= 0.0 && p <= 1.0 + 1e-6)) {
        return model_error(model,
                           "must give class probabilities in 0 .. 1, gives " + json_number(p));
      }
      scores.push_back({classes[c], Probability(std::min(p, 1.0))});
    }
    return normalized(std::move(scores));
  }

  [[nodiscard]] Result<Detection> detection_of(const BoxCandidate& candidate,
                                               const NetworkRows& rows,
                                               const InputPlacement& placement,
                                               const ColorImage& image) const {
    Detection out;
    out.detector = id;
    out.score = Probability(candidate.score);
    const auto inside =
        clipped(placement.in_image(candidate.box_px), image.width_px(), image.height_px());
    if (inside) out.box_px = *inside;
    HYPERMAP_ASSIGN_OR_RETURN(out.class_scores,
                              class_scores(candidate, rows.scores(candidate.row).classes));
    const auto grid = inside ? rows.mask(candidate.row) : std::nullopt;
    if (!grid) return out;
    if (!is_finite(*grid)) {
      return model_error(
          model, "must give finite masks, row " + std::to_string(candidate.row) + " does not");
    }
    MaskImage mask = drawn(*grid, out.box_px, placement, image.width_px(), image.height_px());
    if (!bounds_of(mask).empty()) out.mask = std::move(mask);
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

NetworkForm OnnxDetector::form() const noexcept {
  return impl_->form;
}

void OnnxDetector::set_id(DetectorId id) noexcept {
  impl_->id = id;
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
  HYPERMAP_ASSIGN_OR_RETURN(impl->size.input_side_px, side_of(options, bytes, model));
  ClassRegistry grown = registry;
  HYPERMAP_ASSIGN_OR_RETURN(impl->classes, register_classes(impl->options.class_names, grown));
  impl->size.num_classes = impl->classes.size();
  try {
    constexpr int kAllCores = -1;
    cv::setNumThreads(options.num_threads > 0 ? options.num_threads : kAllCores);
    impl->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    impl->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    impl->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    impl->output_names = impl->net.getUnconnectedOutLayersNames();
  } catch (const std::exception& e) {
    return model_error(model, "cannot be read by OpenCV: " + printable(e.what()));
  }
  HYPERMAP_TRY(impl->settle_form());
  registry = std::move(grown);
  return OnnxDetector(std::move(impl));
}

Result<std::vector<Detection>> OnnxDetector::detect(const ColorImage& image) {
  if (image.empty()) return fail(ErrorCode::kInvalidArgument, "must not be empty", "image");
  const OnnxDetectorOptions& options = impl_->options;
  const int side = impl_->size.input_side_px;
  const InputPlacement placement =
      place(image.width_px(), image.height_px(), side, impl_->convention.fit);
  HYPERMAP_ASSIGN_OR_RETURN(const RunOutputs run,
                            impl_->run(network_input(image, placement, side, impl_->convention)));
  const auto layout = find_layout(run.outputs, impl_->form, impl_->size);
  if (!layout) return Unexpected(impl_->located(layout.error()));
  const auto rows = rows_of(run.outputs, *layout, impl_->size);
  HYPERMAP_ASSIGN_OR_RETURN(auto candidates, candidates_of(*rows, options.min_score));
  if (!rows->is_suppressed()) candidates = suppress_overlaps(candidates, options.nms_overlap);
  std::vector<Detection> detections;
  for (const BoxCandidate& candidate : candidates) {
    if (detections.size() >= options.max_detections) break;
    HYPERMAP_ASSIGN_OR_RETURN(Detection detection,
                              impl_->detection_of(candidate, *rows, placement, image));
    if (detection.box_px.width_px() > 0.0) detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace hypermap
