// SPDX-License-Identifier: BSD-3-Clause
#include "output_layout.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

using Outputs = std::span<const NetworkOutput>;
using Shape = std::vector<std::size_t>;

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::optional<std::size_t> find_shape(Outputs outputs, const Shape& shape) {
  const auto found = std::ranges::find(outputs, shape, &NetworkOutput::shape);
  if (found == outputs.end()) return std::nullopt;
  return static_cast<std::size_t>(found - outputs.begin());
}

/// One output whose rows are the cells of grids: `shape_of(rows)`.
template <class ShapeOf>
std::optional<OutputLayout> match_grids(Outputs outputs,
                                        const NetworkSize& size,
                                        NetworkForm form,
                                        const ShapeOf& shape_of) {
  for (const bool has_stride_64 : {false, true}) {
    const std::size_t rows = output_grids(size.input_side_px, has_stride_64).num_rows;
    if (const auto found = find_shape(outputs, shape_of(rows))) {
      return OutputLayout{.form = form, .boxes = *found, .has_stride_64 = has_stride_64};
    }
  }
  return std::nullopt;
}

Shape yolox_shape(const NetworkSize& size, std::size_t rows) {
  return {1, rows, 5 + size.num_classes};
}
Shape yolov5_shape(const NetworkSize& size, std::size_t rows, std::size_t num_coefficients = 0) {
  return {1, 3 * rows, 5 + size.num_classes + num_coefficients};
}
Shape yolov8_shape(const NetworkSize& size, std::size_t rows, std::size_t num_coefficients = 0) {
  return {1, 4 + size.num_classes + num_coefficients, rows};
}

bool are_prototypes(const NetworkOutput& output) {
  constexpr std::size_t kMaxNumbers = std::size_t{1} << 23U;  // 32 of 512 x 512
  const Shape& shape = output.shape;
  return shape.size() == 4 && shape[0] == 1 && !output.values.empty() &&
         output.values.size() <= kMaxNumbers;
}

/// With prototypes of masks or without: `shape_of(rows, number of prototypes)`.
template <class ShapeOf>
std::optional<OutputLayout> match_with_masks(Outputs outputs,
                                             const NetworkSize& size,
                                             NetworkForm form,
                                             const ShapeOf& shape_of) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (!are_prototypes(outputs[i])) continue;
    auto found = match_grids(
        outputs, size, form, [&](std::size_t rows) { return shape_of(rows, outputs[i].shape[1]); });
    if (!found) continue;
    found->masks = i;
    return found;
  }
  return match_grids(
      outputs, size, form, [&](std::size_t rows) { return shape_of(rows, std::size_t{0}); });
}

std::optional<OutputLayout> match_yolox(Outputs outputs, const NetworkSize& size) {
  return match_grids(outputs, size, NetworkForm::kYolox, [&](std::size_t rows) {
    return yolox_shape(size, rows);
  });
}

std::optional<OutputLayout> match_yolov5(Outputs outputs, const NetworkSize& size) {
  return match_with_masks(
      outputs, size, NetworkForm::kYolov5, [&](std::size_t rows, std::size_t num_coefficients) {
        return yolov5_shape(size, rows, num_coefficients);
      });
}

std::optional<OutputLayout> match_yolov8(Outputs outputs, const NetworkSize& size) {
  return match_with_masks(
      outputs, size, NetworkForm::kYolov8, [&](std::size_t rows, std::size_t num_coefficients) {
        return yolov8_shape(size, rows, num_coefficients);
      });
}

/// Boxes and, beside them, classes with one more for what is no object.
std::optional<OutputLayout> match_two(Outputs outputs, const NetworkSize& size, NetworkForm form) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Shape& shape = outputs[i].shape;
    if (shape.size() != 3 || shape[0] != 1 || shape[1] == 0 || shape[2] != 4) continue;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      if (k == i || outputs[k].shape != Shape{1, shape[1], size.num_classes + 1}) continue;
      return OutputLayout{.form = form, .boxes = i, .scores = k};
    }
  }
  return std::nullopt;
}

std::optional<OutputLayout> match_ssd(Outputs outputs, const NetworkSize& size) {
  constexpr std::size_t kDetectionNumbers = 7;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Shape& shape = outputs[i].shape;
    if (shape.size() == 4 && shape[0] == 1 && shape[1] == 1 && shape[3] == kDetectionNumbers) {
      return OutputLayout{.form = NetworkForm::kSsd, .boxes = i};
    }
  }
  return match_two(outputs, size, NetworkForm::kSsd);
}

std::optional<OutputLayout> match_detr(Outputs outputs, const NetworkSize& size) {
  return match_two(outputs, size, NetworkForm::kDetr);
}

std::optional<OutputLayout> match_nanodet(Outputs outputs, const NetworkSize& size) {
  constexpr std::size_t kMaxBins = 64;
  for (std::size_t bins = 2; bins <= kMaxBins; ++bins) {
    auto found = match_grids(outputs, size, NetworkForm::kNanodet, [&](std::size_t rows) {
      return Shape{1, rows, size.num_classes + 4 * bins};
    });
    if (found) return found;
  }
  return std::nullopt;
}

/// An output of one number a row whose name has one of the words.
std::optional<std::size_t> find_column(Outputs outputs,
                                       std::size_t num_rows,
                                       std::initializer_list<std::string_view> words) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string name = lower_case(outputs[i].name);
    const bool is_named = std::ranges::any_of(
        words, [&](std::string_view word) { return name.find(word) != std::string::npos; });
    if (is_named && outputs[i].shape == Shape{num_rows, 1}) return i;
  }
  return std::nullopt;
}

bool are_masks(const Shape& shape, std::size_t num_rows, const NetworkSize& size) {
  if (shape.size() != 4 || shape[0] != num_rows || shape[2] == 0 || shape[3] == 0) return false;
  return shape[1] == 1 || shape[1] == size.num_classes || shape[1] == size.num_classes + 1;
}

std::optional<OutputLayout> match_mask_rcnn(Outputs outputs, const NetworkSize& size) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].shape.size() != 2 || outputs[i].shape[1] != 4) continue;
    const std::size_t num_rows = outputs[i].shape[0];
    const auto labels = find_column(outputs, num_rows, {"label", "class"});
    const auto scores = find_column(outputs, num_rows, {"score", "conf", "prob"});
    const auto masks = std::ranges::find_if(outputs, [&](const NetworkOutput& output) {
      return are_masks(output.shape, num_rows, size);
    });
    if (!labels || !scores || masks == outputs.end()) continue;
    return OutputLayout{.form = NetworkForm::kMaskRcnn,
                        .boxes = i,
                        .labels = labels,
                        .masks = static_cast<std::size_t>(masks - outputs.begin()),
                        .scores = scores};
  }
  return std::nullopt;
}

struct FormRule {
  NetworkForm form;
  std::optional<OutputLayout> (*match)(Outputs, const NetworkSize&);
  std::string (*expected)(const NetworkSize&);
};

std::size_t grid_rows(const NetworkSize& size) {
  return output_grids(size.input_side_px, false).num_rows;
}

std::string two_outputs(const NetworkSize& size) {
  return "1 x N x 4 and 1 x N x " + std::to_string(size.num_classes + 1);
}

const std::array<FormRule, 7> kRules{
    FormRule{NetworkForm::kYolox,
             match_yolox,
             [](const NetworkSize& s) { return shape_text(yolox_shape(s, grid_rows(s))); }},
    FormRule{NetworkForm::kYolov5,
             match_yolov5,
             [](const NetworkSize& s) { return shape_text(yolov5_shape(s, grid_rows(s))); }},
    FormRule{NetworkForm::kYolov8,
             match_yolov8,
             [](const NetworkSize& s) { return shape_text(yolov8_shape(s, grid_rows(s))); }},
    FormRule{NetworkForm::kSsd,
             match_ssd,
             [](const NetworkSize& s) { return two_outputs(s) + " or 1 x 1 x N x 7"; }},
    FormRule{NetworkForm::kDetr, match_detr, two_outputs},
    FormRule{NetworkForm::kNanodet,
             match_nanodet,
             [](const NetworkSize& s) {
               return "1 x " + std::to_string(grid_rows(s)) + " x (" +
                      std::to_string(s.num_classes) + " + 4 B)";
             }},
    FormRule{NetworkForm::kMaskRcnn, match_mask_rcnn, [](const NetworkSize&) {
               return std::string("boxes N x 4, labels N, scores N and masks N x K x H x W");
             }}};

std::string expectation(const NetworkSize& size, NetworkForm form) {
  std::string text;
  for (const FormRule& rule : kRules) {
    if (form != NetworkForm::kAuto && form != rule.form) continue;
    text +=
        (text.empty() ? "" : "; ") + std::string(name_of(rule.form)) + " " + rule.expected(size);
  }
  return text + " for " + std::to_string(size.num_classes) + " classes and an input of " +
         std::to_string(size.input_side_px) + " pixels";
}

/// SSD and DETR have one shape: logits are DETR's, scores and probabilities SSD's.
bool is_named_as(const OutputLayout& layout, Outputs outputs) {
  if (!layout.scores) return true;
  const std::string name = lower_case(outputs[*layout.scores].name);
  const bool has_logits = name.find("logit") != std::string::npos;
  if (layout.form == NetworkForm::kDetr) return has_logits;
  return !has_logits &&
         (name.find("score") != std::string::npos || name.find("conf") != std::string::npos ||
          name.find("prob") != std::string::npos);
}

Unexpected no_layout(std::string what) {
  return fail(ErrorCode::kMalformedFile, std::move(what), "network");
}

}  // namespace

std::string shape_text(std::span<const std::size_t> shape) {
  std::string text;
  for (const std::size_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text;
}

std::string shapes_text(std::span<const NetworkOutput> outputs) {
  constexpr std::size_t kMostShown = 8;
  std::string text;
  for (const NetworkOutput& output : outputs.first(std::min(outputs.size(), kMostShown))) {
    text +=
        (text.empty() ? "" : ", ") + printable(output.name, 60) + " " + shape_text(output.shape);
  }
  if (outputs.size() > kMostShown) {
    text += " and " + std::to_string(outputs.size() - kMostShown) + " more";
  }
  return text.empty() ? "nothing" : text;
}

OutputGrids output_grids(int input_side_px, bool has_stride_64) {
  OutputGrids grids{.strides_px = {8, 16, 32}};
  if (has_stride_64) grids.strides_px.push_back(64);
  for (const int stride : grids.strides_px) {
    const auto side = static_cast<std::size_t>((input_side_px + stride - 1) / stride);
    grids.num_rows += side * side;
  }
  return grids;
}

Result<OutputLayout> find_layout(std::span<const NetworkOutput> outputs,
                                 NetworkForm form,
                                 const NetworkSize& size) {
  std::vector<OutputLayout> found;
  for (const FormRule& rule : kRules) {
    if (form != NetworkForm::kAuto && form != rule.form) continue;
    if (auto layout = rule.match(outputs, size)) found.push_back(*layout);
  }
  if (found.empty()) {
    return no_layout("gives " + shapes_text(outputs) + ", expected " + expectation(size, form));
  }
  if (found.size() == 1) return found.front();
  std::vector<OutputLayout> named;
  std::ranges::copy_if(found, std::back_inserter(named), [&](const OutputLayout& layout) {
    return is_named_as(layout, outputs);
  });
  if (named.size() == 1) return named.front();
  std::string names;
  for (const OutputLayout& layout : found) {
    names += (names.empty() ? "" : " or ") + std::string(name_of(layout.form));
  }
  return no_layout("gives " + shapes_text(outputs) + ", which may be " + names +
                   ": say which (network_form)");
}

}  // namespace hypermap
