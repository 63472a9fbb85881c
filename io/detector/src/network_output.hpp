// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a network gave for one image, as plain numbers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct NetworkOutput {
  std::string name;
  std::vector<std::size_t> shape;  ///< At least two sizes; their product is that of `values`.
  std::span<const float> values;
};

/// What is known of a network before it runs.
struct NetworkSize {
  int input_side_px = 416;
  std::size_t num_classes = 80;
};

/// "1 x 21 x 7".
[[nodiscard]] std::string shape_text(std::span<const std::size_t> shape);
/// "output0 1 x 21 x 7, output1 ...", names of strangers made printable.
[[nodiscard]] std::string shapes_text(std::span<const NetworkOutput> outputs);

}  // namespace hypermap
