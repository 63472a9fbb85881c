// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "outputs.hpp"
#include "rates_texts.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <system_error>

namespace hypermap::app {
namespace {

/// Lines of cells after RFC 4180, but for plain line ends; what is not known is an empty cell.
class CsvText {
 public:
  explicit CsvText(const std::vector<std::string>& heading) {
    for (const std::string& name : heading) add(name);
    end_line();
  }

  void add(const std::string& cell) {
    if (!is_first_) text_ += ',';
    is_first_ = false;
    if (cell.find_first_of(",\"\r\n") == std::string::npos) {
      text_ += cell;
      return;
    }
    text_ += '"';
    for (const char c : cell) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
    text_ += '"';
  }
  void add(std::size_t count) { add(std::to_string(count)); }
  void add(const std::optional<std::size_t>& count) {
    add(count ? std::to_string(*count) : std::string());
  }
  void add(const std::optional<double>& number) {
    add(number ? number_text(*number) : std::string());
  }
  void add(const std::optional<Eigen::Vector3d>& vector) {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      add(vector ? std::optional<double>((*vector)[axis]) : std::nullopt);
  }
  void end_line() {
    text_ += '\n';
    is_first_ = true;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool is_first_ = true;
};

std::vector<std::string> rate_heading(std::vector<std::string> first) {
  for (const char* name :
       {"things",  "TP",         "FP",       "FN",       "TN",       "TPr",      "TNr",
        "FPr",     "FNr",        "ACC",      "PRE",      "AP_gate",  "AP_iou25", "AP_iou50",
        "box_iou", "distance_m", "rmse_x_m", "rmse_y_m", "rmse_z_m", "rmse_m"})
    first.emplace_back(name);
  return first;
}

void add_rates(CsvText& csv, const RateRow& row) {
  const BinaryCounts& counts = row.counts;
  csv.add(counts.true_positives + counts.false_negatives);
  csv.add(counts.true_positives);
  csv.add(counts.false_positives);
  csv.add(counts.false_negatives);
  csv.add(counts.true_negatives);
  csv.add(counts.true_positive_rate());
  csv.add(counts.true_negative_rate());
  csv.add(counts.false_positive_rate());
  csv.add(counts.false_negative_rate());
  csv.add(counts.accuracy());
  csv.add(counts.precision());
  for (const auto& precision : row.average_precision) csv.add(precision);
  csv.add(row.box_iou);
  csv.add(row.position.mean_distance_m);
  csv.add(row.position.rmse_m);
  csv.add(row.position.total_rmse_m);
  csv.end_line();
}

std::string classes_csv(const RunTables& tables) {
  CsvText csv(rate_heading({"class"}));
  for (const auto& [name, row] : tables.classes) {
    csv.add(name);
    add_rates(csv, row.rates);
  }
  csv.add("all");
  add_rates(csv, tables.all);
  return csv.text();
}

std::string runs_csv(const RunTables& tables, const std::vector<RunName>& names) {
  CsvText csv(rate_heading({"map", "truth"}));
  for (std::size_t i = 0; i < tables.runs.size(); ++i) {
    csv.add(names[i].map);
    csv.add(names[i].truth);
    add_rates(csv, tables.runs[i]);
  }
  return csv.text();
}

std::string instances_csv(const RunTables& tables) {
  CsvText csv({"thing",
               "class",
               "runs",
               "found",
               "error_x_m",
               "error_y_m",
               "error_z_m",
               "distance_m",
               "std_distance_m"});
  for (const ObjectRow& row : tables.objects) {
    csv.add(row.reference);
    csv.add(row.class_name);
    csv.add(row.num_counting);
    csv.add(row.num_found);
    csv.add(row.position.mean_m);
    csv.add(row.position.mean_distance_m);
    csv.add(row.position.std_distance_m);
    csv.end_line();
  }
  return csv.text();
}

std::string positions_csv(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  CsvText csv({"map",
               "truth",
               "thing",
               "class",
               "counts",
               "object",
               "true_x_m",
               "true_y_m",
               "true_z_m",
               "x_m",
               "y_m",
               "z_m",
               "error_x_m",
               "error_y_m",
               "error_z_m",
               "box_iou"});
  for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
    for (const TruthRun& instance : outcome.runs[i].truths) {
      csv.add(names[i].map);
      csv.add(names[i].truth);
      csv.add(instance.reference);
      csv.add(instance.class_name);
      csv.add(std::string(instance.counts ? "yes" : "no"));
      csv.add(instance.object_id ? std::to_string(*instance.object_id) : std::string());
      csv.add(instance.true_centre);
      csv.add(instance.centre);
      csv.add(instance.error_m);
      csv.add(instance.overlap);
      csv.end_line();
    }
  }
  return csv.text();
}

}  // namespace

Result<void> write_csv_files(const RatesOutcome& outcome,
                             const std::vector<RunName>& names,
                             const std::filesystem::path& folder) {
  const std::array<std::string, kCsvNames.size()> texts{classes_csv(outcome.tables),
                                                        runs_csv(outcome.tables, names),
                                                        instances_csv(outcome.tables),
                                                        positions_csv(outcome, names)};
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
  std::vector<std::filesystem::path> written;
  written.reserve(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (const auto done = write_file_atomically(folder / kCsvNames[i], texts[i]); !done)
      return Unexpected(with_written(done.error(), written));
    written.push_back(folder / kCsvNames[i]);
  }
  return {};
}

}  // namespace hypermap::app
