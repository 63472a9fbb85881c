// SPDX-License-Identifier: BSD-3-Clause
#include "manual/bash_completion.hpp"

#include <CLI/StringTools.hpp>

#include <map>
#include <vector>

namespace hypermap::app {
namespace {

constexpr const char* kHead = R"(_hypermap() {
  local IFS=$' \t\n' cur=${COMP_WORDS[COMP_CWORD]} before='' command='' options='' words='' files='' i
  if ((COMP_CWORD > 0)); then before=${COMP_WORDS[COMP_CWORD - 1]}; fi
  # "--option=value" is three words here.
  if [[ $cur == = ]]; then
    cur=''
  elif [[ $before == = ]] && ((COMP_CWORD > 1)); then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)";

constexpr const char* kTail = R"(  if [[ -z $words && -z $files ]]; then
    if [[ $cur == -* ]]; then
      words=$options
    elif [[ -z $command ]]; then
      words=$commands
    elif [[ $takes_files == no ]]; then
      words=$options
    fi
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
  fi
}
complete -F _hypermap hypermap
)";

std::string joined(const std::vector<std::string>& words, const char* separator) {
  return CLI::detail::join(words, separator);
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// The options of the command line's command, which are followed by those of the program.
std::string options_by_command(const CommandText& program) {
  std::string text = "  local takes_files=no\n  case $command in\n";
  for (const CommandText& command : program.commands) {
    text += "    " + command.last_name() + ")\n";
    if (!command.positionals.empty()) text += "      takes_files=yes\n";
    text += "      options='" + joined(option_names(command), " ") + "'\n      ;;\n";
  }
  return text + "  esac\n  options+=' " + joined(option_names(program), " ") + "'\n";
}

/// What stands in a `case` for the value of an option of the command; `*` for all commands.
void add_values(const CommandText& command,
                const std::string& pattern,
                std::map<std::string, std::vector<std::string>>& options_of_words) {
  for (const OptionText& option : command.options) {
    if (option.value.empty()) continue;
    auto& options = options_of_words[joined(option.choices, " ")];
    for (const std::string& name : option.names)
      options.push_back(std::string(pattern).append(":").append(name));
  }
}

std::string words_by_option(const CommandText& program) {
  std::map<std::string, std::vector<std::string>> options_of_words;
  add_values(program, "*", options_of_words);
  for (const CommandText& command : program.commands) {
    add_values(command, command.last_name(), options_of_words);
  }
  std::string text = "  case $command:$before in\n";
  for (const auto& [words, options] : options_of_words) {
    text += "    " + joined(options, " | ") + ")\n      ";
    text += (words.empty() ? "files=yes" : "words='" + words + "'") + "\n      ;;\n";
  }
  return text + "  esac\n";
}

}  // namespace

std::string bash_completion(const CommandText& program, std::string_view version) {
  std::vector<std::string> commands;
  commands.reserve(program.commands.size());
  for (const CommandText& command : program.commands) commands.push_back(command.last_name());
  return "# bash completion of hypermap " + std::string(version) +
         ", written by the build from the definition of the command line.\n" + kHead +
         "  local commands='" + joined(commands, " ") +
         "'\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case ${COMP_WORDS[i]} in\n"
         "      " +
         joined(commands, " | ") +
         ")\n"
         "        command=${COMP_WORDS[i]}\n"
         "        break\n"
         "        ;;\n"
         "    esac\n"
         "  done\n" +
         options_by_command(program) + words_by_option(program) + kTail;
}

}  // namespace hypermap::app
