// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an ONNX file says of itself, without a protobuf library.
///
/// Source: onnx.proto3 of ONNX 1.7 (field numbers).
#pragma once

#include <optional>
#include <string_view>

namespace hypermap {

/// Whether the bytes are a whole ONNX model at the outermost level: known fields that fill the
/// file, a graph among them. Spares OpenCV files that are cut or something else.
[[nodiscard]] bool looks_like_onnx(std::string_view bytes);

struct InputSize {
  int width_px = 0;
  int height_px = 0;
};

/// Of the first input of three channels that is no weight; none when there is none or its size is
/// left open. Sizes are 1 .. 65,535.
[[nodiscard]] std::optional<InputSize> declared_input(std::string_view bytes);

}  // namespace hypermap
