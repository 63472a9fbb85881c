// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands that run a network say what it takes and gives.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

struct NetworkArguments {
  std::string form{kNetworkFormNames.front()};
  std::string fit{kImageFitNames.front()};
  std::string channels{kChannelOrderNames.front()};
  int side_px = 0;
  std::optional<std::string> mean;
  std::optional<std::string> stddev;

  /// Each option needs `model`.
  void add_to(CLI::App& command, CLI::Option& model);
  /// `options` as the arguments say. Errors: kInvalidArgument naming what is no three numbers.
  [[nodiscard]] Result<OnnxDetectorOptions> applied_to(OnnxDetectorOptions options) const;
};

}  // namespace hypermap::app
