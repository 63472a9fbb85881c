// SPDX-License-Identifier: BSD-3-Clause
#include "map_many_text.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

Json counts_json(const PartCounts& counts) {
  return {{"frames", counts.frames},
          {"skipped", counts.skipped},
          {"objects", counts.objects},
          {"tentative", counts.tentative},
          {"sessions", counts.sessions},
          {"occupied", counts.leaves.occupied},
          {"free", counts.leaves.free}};
}

Json sequence_json(const MappedSequence& sequence) {
  Json json{{"name", sequence.name},
            {"file", sequence.part.string()},
            {"note", sequence.note},
            {"error", nullptr}};
  if (sequence.error) json["error"] = to_string(*sequence.error);
  if (!sequence.error) json.update(counts_json(sequence.counts));
  return json;
}

Json worker_json(const WorkerReport& worker) {
  return {{"tasks", worker.num_tasks},
          {"busy_s", worker.busy_s},
          {"peak_rss_bytes", worker.peak_rss_bytes}};
}

}  // namespace

void print_map_many(const MapManyReport& report, const MapManyJob& job) {
  Table table({"sequence", "frames", "skipped", "objects", "occupied", "free", "part"},
              LastColumn::kText);
  for (const MappedSequence& sequence : report.sequences) {
    const PartCounts& counts = sequence.counts;
    table.add({printable(sequence.name),
               std::to_string(counts.frames),
               std::to_string(counts.skipped),
               std::to_string(counts.objects),
               std::to_string(counts.leaves.occupied),
               std::to_string(counts.leaves.free),
               sequence.error ? "failed" : sequence.note});
  }
  std::printf("%s", table.text().c_str());
  if (!report.merged) {
    std::printf("not merged: a sequence is missing; the others are kept in %s\n",
                job.parts.c_str());
    return;
  }
  std::printf("%s merged now; %zu objects (and %zu tentative), %zu occupied and %zu free voxels\n",
              count_text(report.num_merges, "pair").c_str(),
              static_cast<std::size_t>(report.merged->objects),
              static_cast<std::size_t>(report.merged->tentative),
              report.merged->leaves.occupied,
              report.merged->leaves.free);
  std::printf("%.1f s; written to %s\n", report.wall_s, job.output.c_str());
}

void print_map_many_json(const MapManyReport& report, const MapManyJob& job) {
  Json sequences = Json::array();
  for (const MappedSequence& sequence : report.sequences) {
    sequences.push_back(sequence_json(sequence));
  }
  Json workers = Json::array();
  for (const WorkerReport& worker : report.workers) workers.push_back(worker_json(worker));
  Json document{{"sequences", std::move(sequences)},
                {"merged", nullptr},
                {"merges", report.num_merges},
                {"workers", std::move(workers)},
                {"wall_s", report.wall_s},
                {"files", Json::array()}};
  if (report.merged) {
    document["merged"] = counts_json(*report.merged);
    document["files"].push_back(job.output.string());
  }
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace hypermap::app
