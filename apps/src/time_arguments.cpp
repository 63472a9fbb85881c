// SPDX-License-Identifier: BSD-3-Clause
#include "time_arguments.hpp"

#include "commands/shown_rules.hpp"
#include "hypermap/io/archive/provenance.hpp"

#include <utility>

namespace hypermap::app {
namespace {

CLI::Validator moment() {
  const auto check = [](const std::string& text) -> std::string {
    const auto time = parse_time(text);
    return time ? "" : time.error().what;
  };
  return {check, "SECONDS or YYYY-MM-DDThh:mm:ssZ"};
}

Result<std::optional<WrittenTime>> time_of(const std::optional<std::string>& text,
                                           const char* option) {
  if (!text) return std::optional<WrittenTime>();
  auto time = parse_time(*text);
  if (!time) return fail(time.error().code, time.error().what, option);
  return std::optional(*time);
}

std::optional<Stamp> stamp_of(const std::optional<WrittenTime>& time) {
  return time ? std::optional(time->stamp) : std::nullopt;
}

/// Dates count from 1970: a map whose clock does not has none.
Result<void> check_dates(const MapArchive& archive, const AskedTime& asked) {
  const auto times = times_of(archive);
  if (!times || is_since_1970(times->last)) return {};
  for (const auto& [time, field] : {std::pair(asked.since, "since"),
                                    std::pair(asked.until, "until"),
                                    std::pair(asked.as_of, "as-of")}) {
    if (!time || !time->is_date) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be seconds of the map's own clock, which go from " +
                    seconds_text(times->first) + " to " + seconds_text(times->last) + ", is a date",
                field);
  }
  return {};
}

}  // namespace

CLI::Validator name_of_session() {
  const auto check = [](const std::string& text) -> std::string {
    const auto sound = check_session_name(text);
    return sound ? "" : sound.error().what;
  };
  return {check, ""};
}

void TimeArguments::add_to(CLI::App& command) {
  command
      .add_option("--since",
                  since,
                  "objects that were detected at this time or later, as the frames' stamps count; "
                  "with --until in that span")
      ->check(moment());
  command.add_option("--until", until, "objects that were detected at this time or before")
      ->check(moment());
  command
      .add_option("--as-of",
                  as_of,
                  "objects and the layer semantic as they were believed at this time; what else "
                  "the map has is not kept through time")
      ->check(moment());
  command.add_option("--session",
                     session,
                     "objects that were detected in this run, by its name or number as info lists "
                     "them; with --as-of the run that the time is of");
}

Result<AskedTime> TimeArguments::time() const {
  AskedTime asked{.session = session};
  HYPERMAP_ASSIGN_OR_RETURN(asked.since, time_of(since, "--since"));
  HYPERMAP_ASSIGN_OR_RETURN(asked.until, time_of(until, "--until"));
  HYPERMAP_ASSIGN_OR_RETURN(asked.as_of, time_of(as_of, "--as-of"));
  if (asked.as_of && (asked.since || asked.until)) {
    return fail(ErrorCode::kInvalidArgument,
                "is a moment: --since and --until, which ask for what was seen, go without it",
                "--as-of");
  }
  if (asked.since && asked.until && asked.until->stamp < asked.since->stamp) {
    return fail(ErrorCode::kInvalidArgument,
                "must not be after --until " + *until + ", is " + *since,
                "--since");
  }
  return asked;
}

Result<PastMap> past_of(const MapArchive& archive, const AskedTime& asked) {
  HYPERMAP_TRY(check_dates(archive, asked));
  if (asked.as_of) {
    return map_as_of(archive, asked.as_of->stamp, asked.session, rules_of(archive).confirmation);
  }
  return map_seen_in(
      archive,
      {.since = stamp_of(asked.since), .until = stamp_of(asked.until), .session = asked.session});
}

std::string text_of(const AskedTime& asked) {
  std::string text;
  const auto add = [&text](const std::string& words) { text += (text.empty() ? "" : " ") + words; };
  if (asked.as_of) add("as of " + dated_text(asked.as_of->stamp));
  if (asked.since && asked.until) {
    add("from " + dated_text(asked.since->stamp) + " to " + dated_text(asked.until->stamp));
  } else if (asked.since) {
    add("from " + dated_text(asked.since->stamp) + " on");
  } else if (asked.until) {
    add("up to " + dated_text(asked.until->stamp));
  }
  if (asked.session) add("in session " + printable(*asked.session));
  return text;
}

std::string dated_text(Stamp stamp) {
  const std::string text = seconds_text(stamp) + " s";
  return is_since_1970(stamp) ? text + " (" + date_text(stamp) + ")" : text;
}

}  // namespace hypermap::app
