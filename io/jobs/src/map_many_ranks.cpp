// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/map_many_ranks.hpp"

#include "hypermap/io/archive/provenance.hpp"
#include "many_parts.hpp"

#include <string>
#include <utility>

namespace hypermap {
namespace {

/// What tells two jobs apart, but for the content of files.
std::string digest_of(const MapManyJob& job) {
  InputHash hash;
  hash.add(ManyParts(job).settings_text());
  hash.add(job.output.string());
  hash.add(job.parts.string());
  for (const ListedSequence& sequence : job.sequences) {
    hash.add(sequence.name);
    hash.add(sequence.input.string());
  }
  return hash.text();
}

void serve(const Result<MapManyJob>& job, MessagePort& port) {
  if (!job) {
    serve_rank(port, Unexpected(job.error()), {});
    return;
  }
  ManyParts parts(*job);
  serve_rank(port, digest_of(*job), [&parts](std::size_t number) { return parts.do_task(number); });
}

}  // namespace

Result<std::optional<MapManyReport>> run_map_many_by_ranks(const Result<MapManyJob>& job,
                                                           MessagePort& port,
                                                           const JobProgress& progress) {
  if (port.rank() != 0) {
    serve(job, port);
    return std::optional<MapManyReport>();
  }
  RankCrew crew(port, job ? digest_of(*job) : "");
  if (!job) return Unexpected(job.error());
  HYPERMAP_ASSIGN_OR_RETURN(MapManyReport report, run_map_many(*job, crew, progress));
  return std::optional(std::move(report));
}

}  // namespace hypermap
