// SPDX-License-Identifier: BSD-3-Clause
#include "shell_words.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hypermap::app {
namespace {

constexpr std::string_view kBlanks = " \t";
/// What means something outside of quotes.
constexpr std::string_view kSpecial = " \t'\"\\#";

bool is_blank(char c) {
  return kBlanks.find(c) != std::string_view::npos;
}

/// Takes a line byte by byte.
class ShellLineReader {
 public:
  void take(std::string_view line) {
    for (const char c : line) {
      if (is_comment_) return;
      take(c);
    }
  }

  [[nodiscard]] char quote() const { return quote_; }
  [[nodiscard]] bool is_escaping() const { return is_escaping_; }
  [[nodiscard]] bool is_comment() const { return is_comment_; }
  /// The word that is not ended.
  [[nodiscard]] const std::optional<std::string>& open() const { return open_; }
  /// All words that are ended.
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }

  /// The end of the line ends a word.
  void end_word() {
    if (open_) words_.push_back(*std::exchange(open_, std::nullopt));
  }

 private:
  void take(char c) {
    if (is_escaping_) {
      is_escaping_ = false;
      append(c);
    } else if (c == '\\' && quote_ != '\'') {
      is_escaping_ = true;
    } else if (quote_ != '\0') {
      c == quote_ ? void(quote_ = '\0') : append(c);
    } else if (c == '\'' || c == '"') {
      quote_ = c;
      if (!open_) open_.emplace();  // quotes around nothing are an empty word
    } else if (is_blank(c)) {
      end_word();
    } else if (c == '#' && !open_) {
      is_comment_ = true;
    } else {
      append(c);
    }
  }

  void append(char c) {
    if (!open_) open_.emplace();
    open_->push_back(c);
  }

  std::vector<std::string> words_;
  std::optional<std::string> open_;
  char quote_ = '\0';
  bool is_escaping_ = false;
  bool is_comment_ = false;
};

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20U && c != '\t') || byte == 0x7FU;
}

}  // namespace

Result<std::vector<std::string>> split_shell_line(std::string_view line) {
  const auto control = std::ranges::find_if(line, is_control);
  if (control != line.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "has a control character in column " + std::to_string(control - line.begin() + 1) +
                    ", " + printable({control, 1}));
  }
  ShellLineReader reader;
  reader.take(line);
  if (reader.quote() != '\0') {
    return fail(ErrorCode::kInvalidArgument,
                std::string("the quote ") + reader.quote() + " is not closed");
  }
  if (reader.is_escaping())
    return fail(ErrorCode::kInvalidArgument, "a backslash ends the line and keeps nothing");
  reader.end_word();
  return reader.words();
}

OpenShellLine split_open_line(std::string_view line_to_cursor) {
  ShellLineReader reader;
  reader.take(line_to_cursor);
  return {.words = reader.words(),
          .open = reader.open().value_or(""),
          .quote = reader.quote(),
          .is_comment = reader.is_comment()};
}

std::string escaped(std::string_view text, char quote) {
  const std::string_view special = quote == '\0' ? kSpecial : quote == '"' ? "\"\\" : "";
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    // Nothing can stand for a single quote within single quotes: they end and begin again.
    if (quote == '\'' && c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace hypermap::app
