// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rates of runs as text: tables for people, JSON for programs, CSV for spreadsheets.
#pragma once

#include "csv_text.hpp"
#include "hypermap/io/jobs/rates_job.hpp"

#include <array>
#include <string>
#include <vector>

namespace hypermap::app {

/// What a run is called in tables: the names of its files.
struct RunName {
  std::string map;
  std::string truth;
};

/// As many as the maps of the job. Requires: a job that run_rates_job took.
[[nodiscard]] std::vector<RunName> run_names(const RatesJob& job);

[[nodiscard]] std::string table_text_of(const RatesOutcome& outcome,
                                        const std::vector<RunName>& names);
[[nodiscard]] std::string json_text_of(const RatesOutcome& outcome,
                                       const std::vector<RunName>& names);

/// Names of `csv_files_of`: a row each for classes, runs, things over all runs, things by run,
/// objects that are no thing, by run, and figures over all runs.
inline constexpr std::array<const char*, 6> kCsvNames{
    "classes.csv", "runs.csv", "things.csv", "positions.csv", "false.csv", "over_runs.csv"};

[[nodiscard]] std::vector<CsvFile> csv_files_of(const RatesOutcome& outcome,
                                                const std::vector<RunName>& names);

}  // namespace hypermap::app
