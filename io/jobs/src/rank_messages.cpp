// SPDX-License-Identifier: BSD-3-Clause
#include "rank_messages.hpp"

#include "hypermap/core/base/caught.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <exception>

namespace hypermap {
namespace {

using RankJson = nlohmann::json;

constexpr const char* kReadyKey = "ready";
constexpr const char* kErrorKey = "error";
constexpr const char* kOutcomeKey = "outcome";
constexpr const char* kTaskKey = "task";

std::string text_of(const RankJson& json) {
  return json.dump(-1, ' ', false, RankJson::error_handler_t::replace);
}

RankJson error_json(const Error& error) {
  return {{"code", static_cast<int>(error.code)},
          {"what", error.what},
          {"file", error.file},
          {"entry", error.entry},
          {"field", error.field},
          {"line", error.line}};
}

Error error_of(const RankJson& json) {
  return {.code = static_cast<ErrorCode>(json.at("code").get<std::uint8_t>()),
          .what = json.at("what").get<std::string>(),
          .file = json.at("file").get<std::string>(),
          .entry = json.at("entry").get<std::string>(),
          .field = json.at("field").get<std::string>(),
          .line = json.at("line").get<int>()};
}

RankJson outcome_json(const TaskOutcome& outcome) {
  RankJson json{{"number", outcome.number},
                {"note", outcome.note},
                {"wall_s", outcome.wall_s},
                {"peak_rss_bytes", outcome.peak_rss_bytes}};
  if (outcome.error) json[kErrorKey] = error_json(*outcome.error);
  return json;
}

TaskOutcome outcome_of(const RankJson& json) {
  TaskOutcome outcome{.number = json.at("number").get<std::size_t>(),
                      .note = json.at("note").get<std::string>(),
                      .wall_s = json.at("wall_s").get<double>(),
                      .peak_rss_bytes = json.at("peak_rss_bytes").get<std::uint64_t>()};
  if (json.contains(kErrorKey)) outcome.error = error_of(json.at(kErrorKey));
  return outcome;
}

/// What nlohmann's accessors throw of another document is an error.
template <class Read>
auto read_message(std::string_view bytes, const Read& read) -> Result<decltype(read(RankJson()))> {
  try {
    return read(RankJson::parse(bytes));
  } catch (const std::exception& exception) {
    return caught(exception, ErrorCode::kMalformedFile, "a message between ranks");
  }
}

}  // namespace

std::string write_rank_says(const RankSays& says) {
  if (const auto* ready = std::get_if<RankIsReady>(&says)) {
    return text_of({{kReadyKey, ready->job}});
  }
  if (const auto* cannot = std::get_if<RankCannotBegin>(&says)) {
    return text_of({{kErrorKey, error_json(cannot->error)}});
  }
  return text_of({{kOutcomeKey, outcome_json(std::get<RankIsDone>(says).outcome)}});
}

Result<RankSays> parse_rank_says(std::string_view bytes) {
  return read_message(bytes, [](const RankJson& json) -> RankSays {
    if (json.contains(kReadyKey)) return RankIsReady{json.at(kReadyKey).get<std::string>()};
    if (json.contains(kErrorKey)) return RankCannotBegin{error_of(json.at(kErrorKey))};
    return RankIsDone{outcome_of(json.at(kOutcomeKey))};
  });
}

std::string write_rank_task(const RankTask& task) {
  RankJson json{{kTaskKey, nullptr}};
  if (task) json[kTaskKey] = *task;
  return text_of(json);
}

Result<RankTask> parse_rank_task(std::string_view bytes) {
  return read_message(bytes, [](const RankJson& json) -> RankTask {
    const RankJson& task = json.at(kTaskKey);
    if (task.is_null()) return std::nullopt;
    return task.get<std::size_t>();
  });
}

}  // namespace hypermap
