// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Results and errors of the library's functions.
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// What a caller can act on. Add a value only when some caller would branch on it.
enum class ErrorCode : std::uint8_t {
  kInvalidArgument,  ///< A value given by the caller or by an options file breaks its rule.
  kNotFound,         ///< Asked for by name or id, and not there.
  kMalformedFile,    ///< Content of a file breaks its format.
  kUnsupported,      ///< Well-formed, but of a kind or version that is not read here.
  kLimit,            ///< Larger than a stated limit; the limit is named.
  kIo,               ///< The system refused: open, read, write, sync, rename.
  kOutOfMemory,      ///< An allocation failed.
  kUnavailable,      ///< A part of the system is missing (no EGL device).
  kInterrupted,      ///< The caller asked a long job to end.
};

/// Says what is wrong so that a person can mend it. Empty fields are left out when printed, see
/// `to_string`. Whoever knows the file, the archive member, the key or the line fills it in.
struct [[nodiscard]] Error {
  ErrorCode code = ErrorCode::kInvalidArgument;
  std::string what;        ///< The rule and the value: "must be > 0, is -0.05".
  std::string file = {};   ///< As the caller named it.
  std::string entry = {};  ///< Archive member, layer or object.
  std::string field = {};  ///< Key, JSON path or column.
  int line = 0;            ///< 1-based; 0 when there is none.
};

template <class T>
using Result = tl::expected<T, Error>;

using Unexpected = tl::unexpected<Error>;

/// Shorthand for the common case: `return fail(ErrorCode::kInvalidArgument, "must be > 0, is -1",
/// "resolution_m")`.
[[nodiscard]] Unexpected fail(ErrorCode code, std::string what, std::string field = {});

/// One line as `<file>[!entry][:line]: <field>: <what>`; absent parts are left out, text that came
/// from the input is cut at 200 bytes and control characters are escaped.
[[nodiscard]] std::string to_string(const Error& error);

/// `text` with control characters and invalid UTF-8 escaped, cut at `max_bytes` (with an ellipsis).
[[nodiscard]] std::string printable(std::string_view text, std::size_t max_bytes = 200);

/// How bad a finding is: a repair or warning ends a check with 1, an error with 2.
enum class Severity : std::uint8_t { kWarning, kError };

/// Something noticed while reading that did not stop the reading (a repair, an unknown key).
struct Finding {
  Severity severity = Severity::kWarning;
  Error error;
};

/// A value that was read, and what was noticed or repaired on the way.
template <class T>
struct Loaded {
  T value;
  std::vector<Finding> findings;
};

}  // namespace hypermap

/// Evaluates `expression` (a Result) and hands its error to the caller.
#define HYPERMAP_TRY(expression)                                          \
  do {                                                                    \
    if (auto hypermap_try_result = (expression); !hypermap_try_result)    \
      return tl::make_unexpected(std::move(hypermap_try_result).error()); \
  } while (false)

#define HYPERMAP_CONCAT_INNER(a, b) a##b
#define HYPERMAP_CONCAT(a, b) HYPERMAP_CONCAT_INNER(a, b)
// A declaration cannot stand in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define HYPERMAP_ASSIGN_OR_RETURN_IMPL(result, declaration, expression) \
  auto result = (expression);                                           \
  if (!result) return tl::make_unexpected(std::move(result).error());   \
  declaration = std::move(*result)
// NOLINTEND(bugprone-macro-parentheses)

/// `HYPERMAP_ASSIGN_OR_RETURN(const auto grid, read_grid(path));` declares `grid` or hands on the
/// error.
#define HYPERMAP_ASSIGN_OR_RETURN(declaration, expression) \
  HYPERMAP_ASSIGN_OR_RETURN_IMPL(                          \
      HYPERMAP_CONCAT(hypermap_result_, __LINE__), declaration, expression)
