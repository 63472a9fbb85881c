// SPDX-License-Identifier: BSD-3-Clause
#include "line_editor.hpp"

#include "hypermap/core/base/result.hpp"
#include "shell_history.hpp"
#include "shell_input.hpp"

#include <fcntl.h>
#include <histedit.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <utility>

namespace hypermap::app {
namespace {

constexpr char kEndOfInput = '\x04';

/// Reading of the terminal that never waits. Ctrl-C drops what was typed, also after poll() saw it:
/// a read that waits would then miss the interruption. All that have standard input share its
/// flags, so the terminal is opened a second time; -1 where it may not be, as after su.
class TerminalInput {
 public:
  TerminalInput() : own_(::open("/dev/stdin", O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~TerminalInput() {
    if (own_ >= 0) ::close(own_);
  }
  TerminalInput(const TerminalInput&) = delete;
  TerminalInput& operator=(const TerminalInput&) = delete;
  TerminalInput(TerminalInput&&) = delete;
  TerminalInput& operator=(TerminalInput&&) = delete;

  [[nodiscard]] int descriptor() const { return own_ >= 0 ? own_ : STDIN_FILENO; }

 private:
  int own_;
};

}  // namespace

/// The editor of libedit, and what its callbacks need.
struct LineEditor::Terminal {
  std::string prompt;
  Completer completer;
  TerminalInput opened;
  ShellInput input{opened.descriptor()};
  bool is_interrupted = false;
  EditLine* editor = nullptr;
  ::History* history = nullptr;

  Terminal() = default;
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  Terminal(Terminal&&) = delete;
  Terminal& operator=(Terminal&&) = delete;
  ~Terminal() {
    if (editor != nullptr) el_end(editor);
    if (history != nullptr) history_end(history);
  }

  static Terminal& of(EditLine* editor) {
    void* data = nullptr;
    el_get(editor, EL_CLIENTDATA, &data);
    return *static_cast<Terminal*>(data);
  }

  static char* show_prompt(EditLine* editor) { return of(editor).prompt.data(); }

  /// One character of UTF-8; bytes that are none are dropped. 0 at the end and when interrupted.
  static int read_character(EditLine* editor, wchar_t* character) {
    Terminal& self = of(editor);
    std::mbstate_t state{};
    while (true) {
      const auto byte = self.input.next();
      if (!byte || byte->state == ShellInputState::kEnd) return 0;
      if (byte->state == ShellInputState::kInterrupted) {
        self.is_interrupted = true;
        return 0;
      }
      // Ctrl-D that was typed while a command ran: the terminal marks the end of its input so.
      const char value = byte->value == '\0' ? kEndOfInput : byte->value;
      const std::size_t used = std::mbrtowc(character, &value, 1, &state);
      constexpr auto kIncomplete = static_cast<std::size_t>(-2);
      constexpr auto kNoCharacter = static_cast<std::size_t>(-1);
      if (used == kNoCharacter) state = {};
      if (used != kNoCharacter && used != kIncomplete) return 1;
    }
  }

  static unsigned char complete_word(EditLine* editor, int /*key*/) {
    Terminal& self = of(editor);
    const LineInfo* line = el_line(editor);
    const auto num_bytes = static_cast<std::size_t>(line->cursor - line->buffer);
    const ShellCompletion completion = self.completer({line->buffer, num_bytes});
    const std::string text = insertion_of(completion);
    if (!text.empty()) return el_insertstr(editor, text.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
    if (completion.candidates.size() < 2) return CC_ERROR;
    list(completion);
    return CC_REDISPLAY;
  }

  static void list(const ShellCompletion& completion) {
    constexpr std::size_t kMostListed = 100;
    std::string text = "\n";
    const std::size_t count = completion.candidates.size();
    for (std::size_t i = 0; i < std::min(count, kMostListed); ++i)
      text += printable(completion.candidates[i]) + "  ";
    if (count > kMostListed) text += "and " + std::to_string(count - kMostListed) + " more";
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
  }
};

LineEditor::LineEditor(std::unique_ptr<Terminal> terminal) : terminal_(std::move(terminal)) {}
LineEditor::~LineEditor() = default;
LineEditor::LineEditor(LineEditor&&) noexcept = default;
LineEditor& LineEditor::operator=(LineEditor&&) noexcept = default;

std::optional<LineEditor> LineEditor::create(std::string prompt, Completer completer) {
  // What is typed is UTF-8, as all text here is; numbers keep their points.
  std::setlocale(LC_CTYPE, "C.UTF-8");
  auto terminal = std::make_unique<Terminal>();
  terminal->prompt = std::move(prompt);
  terminal->completer = std::move(completer);
  terminal->history = history_init();
  EditLine* editor = el_init("hypermap", stdin, stdout, stderr);
  terminal->editor = editor;
  if (editor == nullptr || terminal->history == nullptr) return std::nullopt;
  HistEvent event;
  ::history(terminal->history, &event, H_SETSIZE, static_cast<int>(kMaxHistoryLines));
  ::history(terminal->history, &event, H_SETUNIQUE, 1);
  el_set(editor, EL_CLIENTDATA, terminal.get());
  el_set(editor, EL_PROMPT, Terminal::show_prompt);
  el_set(editor, EL_EDITOR, "emacs");
  el_set(editor, EL_HIST, ::history, terminal->history);
  el_set(editor, EL_GETCFN, Terminal::read_character);
  el_set(editor, EL_ADDFN, "complete-word", "Completes a word", Terminal::complete_word);
  el_set(editor, EL_BIND, "^I", "complete-word", nullptr);
  el_source(editor, nullptr);
  return LineEditor(std::move(terminal));
}

void LineEditor::remember(const std::string& line) {
  HistEvent event;
  ::history(terminal_->history, &event, H_ENTER, line.c_str());
}

LineEditor::Line LineEditor::next() {
  terminal_->is_interrupted = false;
  el_resize(terminal_->editor);
  int count = 0;
  const char* text = el_gets(terminal_->editor, &count);
  if (terminal_->is_interrupted) return {.state = State::kInterrupted};
  if (text == nullptr || count <= 0) return {.state = State::kEnd};
  Line line{.state = State::kLine, .text = text};
  if (line.text.ends_with('\n')) line.text.pop_back();
  return line;
}

}  // namespace hypermap::app
