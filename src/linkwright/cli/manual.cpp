// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/manual.h"

#include <fmt/core.h>

#include <string_view>

#include "linkwright/app/catalogue.h"
#include "linkwright/cli/arguments.h"

namespace linkwright::cli {
namespace {

/// Text as roff: a hyphen is a minus as it is typed, and no line is taken for a request.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && out.empty())
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

std::string entry(std::string_view term, std::string_view text) {
  return fmt::format(".TP\n{}\n{}\n", term, roff(text));
}

std::string command_section(const CommandHelp& command) {
  std::string usage = fmt::format(".B linkwright {}", command.name), described;
  usage += command.options.empty() ? "" : "\n.RI [ options ]";
  for (const CommandHelp::Positional& p : command.positionals) {
    const std::string_view dots = p.repeated ? " ..." : "";
    usage += p.required ? fmt::format("\n.IR {} \"{}\"", p.name, dots)
                        : fmt::format("\n.RI [ {} ]\\c\n.RI \"{}\"", p.name, dots);
    described += entry(fmt::format(".I {}", p.name), p.summary);
  }
  for (const CommandHelp::Option& o : command.options) {
    const std::string names = (o.short_name.empty() ? "" : o.short_name + ", ") + o.long_name;
    described += entry(o.value.empty() ? fmt::format(".B {}", roff(names))
                                       : fmt::format(".BI \"{} \" {}", roff(names), o.value),
                       o.summary);
  }
  return fmt::format(".SS {}\n{}\n.PP\n{}.\n{}", command.name, usage, roff(command.summary), described);
}

}  // namespace

std::string manual_page() {
  std::string page =
      fmt::format(".TH LINKWRIGHT 1 \"\" \"linkwright {}\" \"User Commands\"\n", app::version());
  page += fmt::format(
      ".SH NAME\nlinkwright \\- analyse, balance and synthesise mechanisms\n"
      ".SH SYNOPSIS\n.B linkwright\n.I COMMAND\n.RI [ options ]\n.br\n.B linkwright\n.I STUDY.toml\n"
      ".SH DESCRIPTION\n{}\nA study is a text file (TOML or JSON): a mechanism, a task, how to search and "
      "what the "
      "answer must satisfy. The name of a study alone is short for\n.BR \"linkwright run\" .\n"
      ".SH COMMANDS\n",
      about);
  for (const CommandHelp& command : command_help()) page += command_section(command);
  page += ".SH EXIT STATUS\n";
  for (const ExitCode& e : exit_codes) page += entry(fmt::format(".B {}", e.code), e.meaning);
  page += ".SH ENVIRONMENT\n" + entry(".B NO_COLOR", "if set and not empty, no colours are written") +
          entry(".B CLICOLOR_FORCE", "if set and not 0, colours are written to pipes and files, too");
  page += ".SH FILES\n" +
          entry(".I out/STUDY/", "results: report.html, result.json, a CSV file for each table") +
          entry(".I out/STUDY/checkpoint.jsonl", "what --resume continues from");
  page +=
      ".SH EXAMPLES\n.EX\nlinkwright examples \\-\\-copy hoeken\nlinkwright run hoeken.toml \\-\\-open\n"
      "linkwright new analysis/planar.linkage \\- | linkwright run \\-\n.EE\n";
  return page;
}

}  // namespace linkwright::cli
