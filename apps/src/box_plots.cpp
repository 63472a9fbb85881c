// SPDX-License-Identifier: BSD-3-Clause
#include "box_plots.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"

namespace hypermap::app {

FiveNumbers in_milliseconds(const FiveNumbers& seconds) {
  return {.min = 1e3 * seconds.min,
          .lower = 1e3 * seconds.lower,
          .median = 1e3 * seconds.median,
          .upper = 1e3 * seconds.upper,
          .max = 1e3 * seconds.max};
}

Result<void> write_box_plot(const std::filesystem::path& path,
                            const std::string& title,
                            const std::string& axis,
                            const std::vector<BoxPlotRow>& rows) {
  HYPERMAP_ASSIGN_OR_RETURN(const ColorImage plot, draw_box_plot(title, axis, rows));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(plot));
  return write_file_atomically(path, bytes);
}

}  // namespace hypermap::app
