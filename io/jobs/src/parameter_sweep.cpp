// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/parameter_sweep.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

/// A score, its key in JSON, and whether more of it is worse.
struct ScoreField {
  const char* key;
  std::optional<double> SweepScores::*value;
  bool is_error;
};

constexpr std::array<ScoreField, 7> kScoreFields{{
    {"f1", &SweepScores::f1, false},
    {"precision", &SweepScores::precision, false},
    {"recall", &SweepScores::recall, false},
    {"jaccard", &SweepScores::jaccard, false},
    {"label_precision", &SweepScores::label_precision, false},
    {"label_recall", &SweepScores::label_recall, false},
    {"distance_m", &SweepScores::distance_m, true},
}};

std::vector<double> known_values(const std::vector<SweepScores>& runs, const ScoreField& field) {
  std::vector<double> values;
  for (const SweepScores& run : runs) {
    if (const auto& value = run.*field.value) values.push_back(*value);
  }
  return values;
}

/// Every combination of the axes' values, the last axis varying first.
std::vector<std::vector<std::string>> combinations(const std::vector<SweepAxis>& axes) {
  std::vector<std::vector<std::string>> all{{}};
  for (const SweepAxis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& values : all) {
      for (const std::string& value : axis.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string combination_text(const std::vector<SweepAxis>& axes,
                             const std::vector<std::string>& values) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text += (i > 0 ? ", " : "") + axes[i].option + "=" + values[i];
  }
  return text;
}

Unexpected of_combination(Error error,
                          const std::vector<SweepAxis>& axes,
                          const std::vector<std::string>& values) {
  error.what += ", with " + combination_text(axes, values);
  return Unexpected(std::move(error));
}

bool takes_places(const MapOptions& options) {
  return options.mapper.prior.source == ClassPriorKind::kPlaces;
}
bool takes_combiner(const MapOptions& options) {
  return options.mapper.objects.stacking.rule == StackingRule::kTrained;
}

Result<MapOptions> combined(const SweepJob& job, const std::vector<std::string>& values) {
  MapOptions options = job.options;
  for (std::size_t i = 0; i < job.axes.size(); ++i) {
    auto changed = with_option(options, job.axes[i].option, values[i]);
    if (!changed) return of_combination(std::move(changed).error(), job.axes, values);
    options = std::move(*changed);
  }
  return options;
}

/// What a map with these options is made with besides them.
Result<void> check_companions(const SweepJob& job, const MapOptions& options) {
  if (takes_places(options) && !job.place_rules) {
    return fail(ErrorCode::kInvalidArgument, "needs rules of what belongs where", "prior.source");
  }
  if (takes_combiner(options) && !job.combiner) {
    return fail(ErrorCode::kInvalidArgument,
                "is trained, which needs a combiner (--combiner)",
                "stacking.rule");
  }
  return {};
}

/// An option of the prior says nothing while there is none.
Result<void> check_prior_axes(const SweepJob& job) {
  const auto is_of_prior = [](const SweepAxis& axis) { return axis.option.starts_with("prior."); };
  const auto idle = std::ranges::find_if(job.axes, is_of_prior);
  const bool has_source =
      job.options.mapper.prior.source != ClassPriorKind::kNone ||
      std::ranges::find(job.axes, "prior.source", &SweepAxis::option) != job.axes.end();
  if (idle == job.axes.end() || has_source) return {};
  return fail(ErrorCode::kInvalidArgument,
              "changes nothing while prior.source is none (--places)",
              idle->option);
}

Result<void> check_sweep(const SweepJob& job) {
  if (job.axes.empty()) return fail(ErrorCode::kInvalidArgument, "must have one or more", "axes");
  if (job.sequences.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must have one or more", "sequences");
  }
  std::set<std::string> options;
  std::size_t num_runs = job.sequences.size();
  for (const SweepAxis& axis : job.axes) {
    if (axis.values.empty()) return fail(ErrorCode::kInvalidArgument, "has no values", axis.option);
    if (!options.insert(axis.option).second) {
      return fail(ErrorCode::kInvalidArgument, "is swept twice", axis.option);
    }
    num_runs *= axis.values.size();
    if (num_runs > kMaxSweepRuns) {
      return fail(ErrorCode::kInvalidArgument,
                  "more than " + std::to_string(kMaxSweepRuns) + " maps were to be made",
                  "axes");
    }
  }
  return {};
}

/// The file goes when this does.
class PassingMap {
 public:
  explicit PassingMap(std::filesystem::path path) : path_(std::move(path)) {}
  PassingMap(const PassingMap&) = delete;
  PassingMap& operator=(const PassingMap&) = delete;
  PassingMap(PassingMap&&) = delete;
  PassingMap& operator=(PassingMap&&) = delete;
  ~PassingMap() {
    std::error_code stays;
    std::filesystem::remove(path_, stays);
    std::filesystem::remove(rescue_path(path_), stays);
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

SweepScores scores_of(const EvaluationOutcome& outcome) {
  const OneToOneMetric& metric = outcome.report.all.one_to_one;
  SweepScores scores{.f1 = metric.f1,
                     .precision = metric.precision,
                     .recall = metric.recall,
                     .jaccard = metric.jaccard_in_place,
                     .distance_m = metric.distance_m};
  if (outcome.voxels) {
    scores.label_precision = outcome.voxels->labels.all.precision();
    scores.label_recall = outcome.voxels->labels.all.recall();
  }
  return scores;
}

Result<SweepScores> scores_with(const SweepJob& job,
                                const MapOptions& options,
                                const SweptSequence& sequence,
                                const std::function<bool()>& goes_on) {
  const PassingMap map(job.folder / "swept.hmap");
  MappingJob mapping{.input = sequence.input, .output = map.path(), .dataset = sequence.dataset};
  mapping.mapper = options.mapper;
  mapping.layers = options.layers;
  if (takes_places(options)) mapping.place_rules = job.place_rules;
  if (takes_combiner(options)) mapping.combiner = job.combiner;
  HYPERMAP_TRY(run_mapping(mapping, [&](std::size_t, std::size_t) { return goes_on(); }));
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluationOutcome outcome,
                            run_evaluation({.map = map.path(), .truth = sequence.truth}));
  return scores_of(outcome);
}

std::string score_json(const SweepScores& scores) {
  std::string text = "{";
  for (const ScoreField& field : kScoreFields) {
    const auto& value = scores.*field.value;
    text += (text.size() > 1 ? "," : "") + json_quoted(field.key) + ":" +
            (value ? json_number(*value) : "null");
  }
  return text + "}";
}

std::string texts_json(const std::vector<std::string>& texts) {
  return json_array(texts, [](const std::string& text) { return json_quoted(text); });
}

}  // namespace

Result<SweepAxis> parse_sweep_axis(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    return fail(ErrorCode::kInvalidArgument,
                "must be OPTION=a,b,c, is '" + printable(std::string(text)) + "'");
  }
  SweepAxis axis{.option = std::string(text.substr(0, equals)), .values = {}};
  std::string_view rest = text.substr(equals + 1);
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    const std::string value(rest.substr(0, comma));
    HYPERMAP_TRY(check_option(axis.option, value));
    if (std::ranges::find(axis.values, value) != axis.values.end()) {
      return fail(ErrorCode::kInvalidArgument, "has the value " + value + " twice", axis.option);
    }
    axis.values.push_back(value);
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  return axis;
}

SweepScores mean_of(const std::vector<SweepScores>& runs) {
  SweepScores mean;
  for (const ScoreField& field : kScoreFields) {
    const std::vector<double> values = known_values(runs, field);
    if (values.empty()) continue;
    double sum = 0.0;
    for (const double value : values) sum += value;
    mean.*field.value = sum / static_cast<double>(values.size());
  }
  return mean;
}

SweepScores worst_of(const std::vector<SweepScores>& runs) {
  SweepScores worst;
  for (const ScoreField& field : kScoreFields) {
    const std::vector<double> values = known_values(runs, field);
    if (values.empty()) continue;
    worst.*field.value =
        field.is_error ? *std::ranges::max_element(values) : *std::ranges::min_element(values);
  }
  return worst;
}

Result<SweepReport> run_sweep(const SweepJob& job, const JobProgress& progress) {
  HYPERMAP_TRY(check_sweep(job));
  HYPERMAP_TRY(check_prior_axes(job));
  const auto all = combinations(job.axes);
  std::vector<MapOptions> options;
  for (const auto& values : all) {
    HYPERMAP_ASSIGN_OR_RETURN(MapOptions changed, combined(job, values));
    auto checked = check_companions(job, changed);
    if (!checked) return of_combination(std::move(checked).error(), job.axes, values);
    options.push_back(std::move(changed));
  }
  SweepReport report{.axes = job.axes, .sequences = {}, .points = {}};
  for (const SweptSequence& sequence : job.sequences) report.sequences.push_back(sequence.name);
  const std::size_t total = all.size() * job.sequences.size();
  std::size_t done = 0;
  const auto goes_on = [&] { return !progress || progress(done, total); };
  for (std::size_t i = 0; i < all.size(); ++i) {
    SweepPoint point{.values = all[i], .runs = {}};
    for (const SweptSequence& sequence : job.sequences) {
      auto scores = scores_with(job, options[i], sequence, goes_on);
      if (!scores) return of_combination(std::move(scores).error(), job.axes, all[i]);
      point.runs.push_back(*scores);
      ++done;
      if (!goes_on()) return fail(ErrorCode::kInterrupted, "the sweep was ended");
    }
    point.mean = mean_of(point.runs);
    point.worst = worst_of(point.runs);
    report.points.push_back(std::move(point));
  }
  return report;
}

std::string to_json(const SweepReport& report) {
  const std::string axes = json_array(report.axes, [](const SweepAxis& axis) {
    return json_object({{"option", json_quoted(axis.option)}, {"values", texts_json(axis.values)}});
  });
  const std::string points = json_array(report.points, [](const SweepPoint& point) {
    return json_object(
        {{"values", texts_json(point.values)},
         {"mean", score_json(point.mean)},
         {"worst", score_json(point.worst)},
         {"runs", json_array(point.runs, [](const SweepScores& run) { return score_json(run); })}});
  });
  return json_object(
      {{"axes", axes}, {"sequences", texts_json(report.sequences)}, {"points", points}});
}

}  // namespace hypermap
