// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_images.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/jobs/reliability_plot.hpp"
#include "hypermap/viewer_offscreen/figures/plan_figure.hpp"
#include "outputs.hpp"

#include <filesystem>
#include <vector>

namespace hypermap::app {
namespace {

Result<void> write_image(const std::string& path, const ColorImage& image) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(image));
  return write_file_atomically(path, bytes);
}

}  // namespace

Result<void> write_images(const EvaluationOutcome& outcome, const EvaluationImages& images) {
  std::vector<std::filesystem::path> written;
  if (images.reliability) {
    HYPERMAP_TRY(
        write_image(*images.reliability, draw_reliability(outcome.best_class, outcome.real)));
    written.emplace_back(*images.reliability);
  }
  if (!images.plan) return {};
  const auto drawn = draw_compared_plan(outcome.plan, images.title);
  const Result<void> done =
      drawn ? write_image(*images.plan, *drawn) : Result<void>(Unexpected(drawn.error()));
  if (!done) return Unexpected(with_written(done.error(), written));
  return {};
}

}  // namespace hypermap::app
