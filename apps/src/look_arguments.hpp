// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which a command says at which frames a network looks.
#pragma once

#include "hypermap/io/jobs/look_options.hpp"

#include <CLI/App.hpp>

#include <string>

namespace hypermap::app {

struct LookArguments {
  std::string rule{kLookRuleNames.front()};
  LookOptions given;  ///< But for the rule.

  /// Each option needs `model`.
  void add_to(CLI::App& command, CLI::Option& model);
  [[nodiscard]] LookOptions options() const;
  /// Throws CLI::ValidationError for an option that is not of the rule.
  void keep_to_rule() const;
};

}  // namespace hypermap::app
