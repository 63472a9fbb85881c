// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of a network's outputs means what.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/detector/network_form.hpp"
#include "network_output.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Strides of the grids whose cells are rows, in their order.
struct OutputGrids {
  std::vector<int> strides_px;
  std::size_t num_rows = 0;
};

/// Rows for strides 8, 16, 32, or with 64 besides: ceil(side / stride)^2 each.
[[nodiscard]] OutputGrids output_grids(int input_side_px, bool has_stride_64);

struct OutputLayout {
  NetworkForm form = NetworkForm::kYolox;
  std::size_t boxes = 0;                   ///< The output that has the boxes.
  std::optional<std::size_t> labels = {};  ///< That with one class a row.
  std::optional<std::size_t> masks = {};   ///< That with masks, or prototypes of them.
  std::optional<std::size_t> scores = {};  ///< That with the classes, where it is another one.
  bool has_stride_64 = false;              ///< Of forms with grids.
};

/// The layout of the outputs, in the form that is asked for or that they have.
///
/// Errors: kMalformedFile with the shapes there are and those that the forms have: when they are of
/// no form, or of several and their names tell none of them.
[[nodiscard]] Result<OutputLayout> find_layout(std::span<const NetworkOutput> outputs,
                                               NetworkForm form,
                                               const NetworkSize& size);

}  // namespace hypermap
