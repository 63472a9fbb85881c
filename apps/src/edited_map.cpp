// SPDX-License-Identifier: BSD-3-Clause
#include "edited_map.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hypermap::app {

ExitCode run_edit(const std::string& file,
                  const std::string& output,
                  const LoadArguments& load,
                  const MapEdit& edit) {
  auto whole = load_archive(file, load.limits, archive_layer_types(), stop_when_interrupted());
  if (!whole) return report(whole.error());
  const auto edited = edit(std::move(whole->value));
  if (!edited) {
    Error error = edited.error();
    if (error.file.empty()) error.file = file;
    return report(error);
  }
  if (const auto saved = save_archive(edited->map, output, {.limits = load.limits}); !saved) {
    return report(saved.error());
  }
  std::fputs(edited->text.c_str(), stdout);
  ExitCode worst = edited->findings;
  for (const Finding& finding : whole->findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace hypermap::app
