// SPDX-License-Identifier: BSD-3-Clause
#include "load_arguments.hpp"

#include "hypermap/io/codec/archive_size.hpp"
#include "interruption.hpp"
#include "number_lists.hpp"

#include <cstdint>

namespace hypermap::app {
void LoadArguments::add_to(CLI::App& command) {
  BudgetLimits& sums = limits.sums;
  const auto add = [&command](const char* flag, std::uint64_t& limit, const char* what) {
    command.add_option(flag, limit, what)
        ->transform(whole_number())
        ->capture_default_str()
        ->group("Limits of what is read");
  };
  add("--max-pixels", sums.max_pixels, "of all images of an archive");
  add("--max-edge-tests", sums.max_edge_tests, "of edges, for shapes that cross themselves");
  add("--max-opaque-bytes", sums.max_opaque_bytes, "of members that nothing here reads");
  add("--max-octree-nodes", sums.max_octree_nodes, "of all octrees of an archive");
  command
      .add_flag_callback(
          "--large",
          [this] {
            limits.zip.max_archive_bytes = kLargeArchiveBytes;
            limits.zip.max_total_bytes = 2 * kLargeArchiveBytes;
          },
          "archives up to 64 GiB, not 4, also those that are written")
      ->group("Limits of what is read");
  command
      .add_flag_callback(
          "--confined",
          [this] { limits.reach = FileReach::kOwnFolder; },
          "a configuration or map_server YAML may name files of its own folder alone")
      ->group("Limits of what is read");
}

StopCheck stop_when_interrupted() {
  return [] { return interrupting_signal() != 0; };
}

}  // namespace hypermap::app
