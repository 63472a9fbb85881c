// SPDX-License-Identifier: BSD-3-Clause
#include "manual/man_page.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <CLI/StringTools.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace hypermap::app {
namespace {

/// Commands of the shell keep their ASCII characters when they are copied from a page.
std::string_view roff_ascii(char c) {
  switch (c) {
    case '\\':
      return "\\e";
    case '-':
      return "\\-";
    case '\'':
      return "\\(aq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    case '"':
      return "\\(dq";
    default:
      return {};
  }
}

/// Requires: a whole character of UTF-8, not ASCII.
std::string roff_character(std::string_view bytes) {
  std::uint32_t code = static_cast<std::uint8_t>(bytes[0]) & (0x7FU >> bytes.size());
  for (const char byte : bytes.substr(1)) {
    code = (code << 6U) | (static_cast<std::uint8_t>(byte) & 0x3FU);
  }
  char text[16];
  std::snprintf(text, sizeof text, "\\[u%04X]", code);
  return text;
}

std::string bold(std::string_view text) {
  return "\\fB" + roff(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string bold_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(bold(name));
  return text;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

/// "hypermap-map"
std::string page_name(const CommandText& command) {
  return CLI::detail::find_and_replace(command.name, " ", "-");
}

std::string reference(const std::string& page) {
  return bold(page) + "(1)";
}

/// With a full stop, unless there is nothing.
std::string sentence_end(const std::string& text) {
  return text.empty() ? text : text + ".";
}

/// What an option takes besides its effect, a sentence each.
std::string conditions_of(const OptionText& option) {
  std::string text;
  const auto add = [&text](const std::string& what, const std::string& sentence) {
    if (sentence.empty()) return;
    text.append(text.empty() ? ".br\n" : " ").append(what).append(sentence);
  };
  add("One of ", sentence_end(bold_list(option.choices)));
  add("Range: ", sentence_end(roff(option.range)));
  add("Default: ", sentence_end(option.default_value.empty() ? "" : bold(option.default_value)));
  add("Required", option.is_required ? "." : "");
  add("May be repeated, or followed by several values", option.may_be_repeated ? "." : "");
  add("Needs ", sentence_end(bold_list(option.needs)));
  add("Excludes ", sentence_end(bold_list(option.excludes)));
  return text.empty() ? text : text + "\n";
}

std::string option_entry(const OptionText& option) {
  std::string text = ".TP\n" + bold_list(option.names);
  if (!option.value.empty()) text += " " + italic(option.choices.empty() ? option.value : "CHOICE");
  return text + "\n" + roff(option.effect) + "\n" + conditions_of(option);
}

/// Options by their groups, each group under its heading.
std::string option_sections(const CommandText& command) {
  std::vector<std::string> groups;
  for (const OptionText& option : command.options) {
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  }
  std::string text;
  if (!command.positionals.empty()) {
    text += ".SH ARGUMENTS\n";
    for (const OptionText& option : command.positionals) text += option_entry(option);
  }
  text += ".SH OPTIONS\n";
  for (const std::string& group : groups) {
    if (group != "Options") text += ".SS " + roff(group) + "\n";
    for (const OptionText& option : command.options) {
      if (option.group == group) text += option_entry(option);
    }
  }
  return text;
}

std::string synopsis_of(const CommandText& command) {
  std::string text = bold(command.name);
  for (const OptionText& option : command.options) {
    if (option.is_required) text += " " + bold(option.names.back()) + " " + italic(option.value);
  }
  text += " [" + italic("OPTION") + "]...";
  for (const OptionText& option : command.positionals) {
    text += " " + italic(option.names.front()) + (option.may_be_repeated ? "..." : "");
  }
  if (!command.commands.empty())
    text += " " + italic("COMMAND") + " [" + italic("ARGUMENT") + "]...";
  return text + "\n";
}

std::string exit_status_section(std::span<const ExitStatus> statuses) {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitStatus& status : statuses) {
    text += ".TP\n" + bold(status.numbers) + "\n" + roff(status.meaning) + "\n";
  }
  return text;
}

std::string examples_section(const std::vector<std::string>& examples) {
  std::string text = ".SH EXAMPLES\n";
  for (const std::string& example : examples) text += ".PP\n.nf\n" + roff(example) + "\n.fi\n";
  return text;
}

std::string head_of(const CommandText& command, std::string_view version) {
  const std::string page = page_name(command);
  return ".\\\" SPDX-License-Identifier: BSD-3-Clause\n"
         ".\\\" Written by the build from the definition of the command line.\n"
         ".TH " +
         roff(upper(page)) + " 1 \"\" \"hypermap " + std::string(version) +
         "\" \"hypermap\"\n"
         ".SH NAME\n" +
         roff(page) + " \\- " + roff(command.summary) +
         "\n"
         ".SH SYNOPSIS\n" +
         synopsis_of(command);
}

std::string page_of_program(const CommandText& program,
                            std::span<const ExitStatus> statuses,
                            std::string_view version) {
  std::string text =
      head_of(program, version) + ".SH DESCRIPTION\n" + roff(program.summary) +
      ".\n"
      ".PP\n"
      "Results go to standard output, messages and progress to standard error. Outputs that "
      "exist are replaced as a whole or not at all. Case does not count in commands, "
      "options and choices.\n"
      ".SH COMMANDS\n";
  std::vector<std::string> examples;
  std::string pages;
  for (const CommandText& command : program.commands) {
    text += ".TP\n" + bold(command.last_name()) + "\n" + roff(command.summary) + ".\n";
    if (!command.examples.empty()) examples.push_back(command.examples.front());
    pages.append(pages.empty() ? "" : ",\n").append(reference(page_name(command)));
  }
  return text + option_sections(program) + exit_status_section(statuses) +
         examples_section(examples) + ".SH SEE ALSO\n" + pages + "\n";
}

std::string page_of_command(const CommandText& command,
                            const CommandText& program,
                            std::span<const ExitStatus> statuses,
                            std::string_view version) {
  const std::string general = page_name(program);
  return head_of(command, version) + ".SH DESCRIPTION\n" + roff(command.summary) +
         ".\n.PP\nOptions of " + reference(general) + " are taken here, too.\n" +
         option_sections(command) + exit_status_section(statuses) +
         examples_section(command.examples) + ".SH SEE ALSO\n" + reference(general) + "\n";
}

}  // namespace

std::string roff(std::string_view text) {
  std::string out;
  if (text.starts_with('.')) out = "\\&";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, at), 1);
    const std::string_view escape = roff_ascii(text[at]);
    if (length > 1) {
      out += roff_character(text.substr(at, length));
    } else if (escape.empty()) {
      out.push_back(text[at]);
    } else {
      out.append(escape);
    }
    at += length;
  }
  return out;
}

std::vector<ManPage> man_pages(const CommandText& program,
                               std::span<const ExitStatus> statuses,
                               std::string_view version) {
  std::vector<ManPage> pages;
  pages.push_back({page_name(program) + ".1", page_of_program(program, statuses, version)});
  for (const CommandText& command : program.commands) {
    pages.push_back(
        {page_name(command) + ".1", page_of_command(command, program, statuses, version)});
  }
  return pages;
}

}  // namespace hypermap::app
