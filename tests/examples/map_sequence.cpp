// SPDX-License-Identifier: BSD-3-Clause
// The README's example: maps a dataset and saves the archive. Usage: map_sequence DATASET
// OUTPUT.hmap
#include <hypermap/io/jobs/mapping_job.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 4;
  hypermap::MappingJob job{.input = argv[1], .output = argv[2]};
  job.mapper.octree.resolution_m = 0.05;
  const auto report = hypermap::run_mapping(job);
  if (!report) {
    std::fprintf(stderr, "%s\n", hypermap::to_string(report.error()).c_str());
    return 2;
  }
  std::printf("%zu frames, %zu objects\n", report->num_frames, report->num_objects);
}
