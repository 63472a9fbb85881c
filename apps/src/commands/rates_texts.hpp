// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rates of runs as text: tables for people, JSON for programs, CSV for spreadsheets.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/rates_job.hpp"

#include <array>
#include <filesystem>
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

/// Files of `write_csv_files`: a row each for classes, runs, things over all runs, and things by
/// run.
inline constexpr std::array<const char*, 4> kCsvNames{
    "classes.csv", "runs.csv", "things.csv", "positions.csv"};

/// Writes these files into `folder`, which is made; what is there by their names is replaced, each
/// as a whole. Errors: kIo, with the files written before.
[[nodiscard]] Result<void> write_csv_files(const RatesOutcome& outcome,
                                           const std::vector<RunName>& names,
                                           const std::filesystem::path& folder);

}  // namespace hypermap::app
