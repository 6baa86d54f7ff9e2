// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/completion.h"

#include <fmt/format.h>

#include "linkwright/app/examples.h"
#include "linkwright/cli/arguments.h"
#include "linkwright/study/study.h"

namespace linkwright::cli {
namespace {

bool is_file(std::string_view value) { return value == "STUDY" || value == "FILE" || value == "RESULT"; }

/// The words behind a value; empty for files, folders, numbers and texts.
std::string words_of(std::string_view value, const CompletionWords& words) {
  const auto found = words.find(value);
  return found == words.end() ? std::string() : fmt::format("{}", fmt::join(found->second, " "));
}

std::string names_of(const std::vector<CommandHelp>& commands) {
  std::string names;
  for (const CommandHelp& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

/// For bash: the code that completes the current word, a value of this kind; nothing where any text is
/// allowed.
std::string bash_value(std::string_view value, const CompletionWords& words) {
  if (const std::string fixed = words_of(value, words); !fixed.empty())
    return fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$cur\"))", fixed);
  if (value == "FOLDER") return "compopt -o filenames; COMPREPLY=($(compgen -d -- \"$cur\"))";
  if (is_file(value))
    return "compopt -o filenames; COMPREPLY=($(compgen -f -X '!*.@(toml|json)' -- \"$cur\") $(compgen -d -- "
           "\"$cur\"))";
  return {};
}

std::string bash_script(const std::vector<CommandHelp>& commands, const CompletionWords& words) {
  std::string cases;
  for (const CommandHelp& command : commands) {
    std::string options, values, places;
    for (const CommandHelp::Option& option : command.options) {
      options += (options.empty() ? "" : " ") + option.long_name;
      if (option.value.empty()) continue;
      const std::string names = (option.short_name.empty() ? "" : option.short_name + "|") + option.long_name;
      const std::string reply = bash_value(option.value, words);
      values += fmt::format("        {}) {}; return ;;\n", names, reply.empty() ? ":" : reply);
    }
    if (!values.empty()) values = fmt::format("      case $prev in\n{}      esac\n", values);
    for (const CommandHelp::Positional& p : command.positionals)
      if (const std::string reply = bash_value(p.name, words); places.empty()) places = reply;
    cases += fmt::format(
        "    {})\n{}      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W '{}' -- \"$cur\")); return; fi\n"
        "      {} ;;\n",
        command.name, values, options, places.empty() ? ":" : places);
  }
  return fmt::format(
      "# Completion of linkwright in bash; written by `linkwright completion bash`.\n"
      "_linkwright() {{\n"
      "  shopt -q extglob || shopt -s extglob\n"
      "  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  COMPREPLY=()\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
      "    compopt -o filenames\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$cur\") $(compgen -f -X '!*.toml' -- "
      "\"$cur\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "}}\n"
      "complete -F _linkwright linkwright\n",
      names_of(commands), cases);
}

/// For zsh, within single quotes and brackets.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string zsh_value(std::string_view value, const CompletionWords& words) {
  if (const std::string fixed = words_of(value, words); !fixed.empty()) return "(" + fixed + ")";
  if (value == "FOLDER") return "_files -/";
  if (is_file(value)) return "_files -g \"*.(toml|json)\"";
  return " ";
}

std::string zsh_script(const std::vector<CommandHelp>& commands, const CompletionWords& words) {
  std::string list, cases;
  for (const CommandHelp& command : commands) {
    list += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.summary));
    std::string specs;
    for (const CommandHelp::Option& o : command.options) {
      const std::string value =
          o.value.empty() ? "" : fmt::format(":{}:{}", o.value, zsh_value(o.value, words));
      for (const std::string& name : {o.short_name, o.long_name})
        if (!name.empty()) specs += fmt::format(" \\\n        '{}[{}]{}'", name, zsh_text(o.summary), value);
    }
    for (const CommandHelp::Positional& p : command.positionals)
      specs += fmt::format(" \\\n        '{}{}:{}:{}'", p.repeated ? "*" : "", p.required ? "" : ":", p.name,
                           zsh_value(p.name, words));
    cases += fmt::format("    {})\n      _arguments{} ;;\n", command.name, specs);
  }
  return fmt::format(
      "#compdef linkwright\n# Completion of linkwright in zsh; written by `linkwright completion zsh`.\n"
      "_linkwright() {{\n"
      "  local -a commands\n  commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n    _files -g \"*.toml\"\n    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  words=(\"${{(@)words[2,-1]}}\")\n  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n"
      "}}\n"
      "_linkwright \"$@\"\n",
      list, cases);
}

/// For fish, within single quotes.
std::string fish_text(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out;
}

std::string fish_value(std::string_view value, const CompletionWords& words) {
  if (const std::string fixed = words_of(value, words); !fixed.empty())
    return fmt::format(" -f -a '{}'", fixed);
  if (value == "FOLDER") return " -f -a '(__fish_complete_directories)'";
  if (is_file(value)) return " -F";
  return " -f";
}

std::string fish_script(const std::vector<CommandHelp>& commands, const CompletionWords& words) {
  std::string text = "# Completion of linkwright in fish; written by `linkwright completion fish`.\n";
  text += "complete -c linkwright -n __fish_use_subcommand -s V -l version -d 'print the version'\n";
  for (const CommandHelp& command : commands) {
    text += fmt::format("complete -c linkwright -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                        fish_text(command.summary));
    const std::string here =
        fmt::format("complete -c linkwright -n '__fish_seen_subcommand_from {}'", command.name);
    for (const CommandHelp::Option& o : command.options)
      text += fmt::format("{}{} -l {}{} -d '{}'\n", here,
                          o.short_name.empty() ? "" : " -s " + o.short_name.substr(1), o.long_name.substr(2),
                          o.value.empty() ? "" : " -r" + fish_value(o.value, words), fish_text(o.summary));
    if (command.positionals.empty()) {
      text += here + " -f\n";
    } else {
      text += here + fish_value(command.positionals.front().name, words) + "\n";
    }
  }
  return text;
}

}  // namespace

CompletionWords completion_words(std::span<const study::Kind> kinds,
                                 std::span<const study::Reproduction> reproductions) {
  CompletionWords words = {{"SHELL", {"bash", "zsh", "fish"}}};
  for (const study::Kind& kind : kinds) words["KIND"].push_back(study::name_of(kind));
  for (const app::Example& example : app::examples()) words["EXAMPLE"].push_back(example.name);
  words["TABLE"] = {"all"};
  for (const study::Reproduction& table : reproductions) words["TABLE"].push_back(table.id);
  for (const CommandHelp& command : command_help()) words["COMMAND"].push_back(command.name);
  return words;
}

std::string completion_script(std::string_view shell, const CompletionWords& words) {
  const std::vector<CommandHelp> commands = command_help();
  if (shell == "zsh") return zsh_script(commands, words);
  if (shell == "fish") return fish_script(commands, words);
  return bash_script(commands, words);
}

}  // namespace linkwright::cli
