// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

namespace linkwright::cli {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

const char* code(Colour colour) {
  switch (colour) {
    case Colour::red:
      return "1;31";
    case Colour::green:
      return "32";
    case Colour::yellow:
      return "33";
    case Colour::bold:
      return "1";
    case Colour::pale:
      return "2";
  }
  return "0";
}

}  // namespace

std::size_t terminal_width() {
  const std::size_t columns = platform::terminal_columns();
  return columns > 0 ? columns : 80;
}

bool wants_colours(Stream stream) {
  if (!variable("NO_COLOR").empty()) return false;
  const std::string_view force = variable("CLICOLOR_FORCE");
  if (!force.empty() && force != "0") return true;
  return is_terminal(stream) && variable("TERM") != "dumb";
}

std::string paint(std::string_view text, Colour colour, bool on) {
  return on ? fmt::format("\033[{}m{}\033[0m", code(colour), text) : std::string(text);
}

std::string painted(const Diagnostic& diagnostic, bool on) {
  std::string text = to_string(diagnostic);
  const bool error = diagnostic.severity == Diagnostic::Severity::error;
  const std::string_view word = error ? "error:" : "warning:";
  // The name of the file precedes the word and may contain it.
  if (const std::size_t place = text.find(word, diagnostic.file.size()); place != std::string::npos)
    text.replace(place, word.size(), paint(word, error ? Colour::red : Colour::yellow, on));
  return text;
}

namespace {
std::atomic<int> output_error = 0;  ///< the first of standard output
}  // namespace

void flush_output() {
  int none = 0;
  if (std::fflush(stdout) != 0) output_error.compare_exchange_strong(none, errno != 0 ? errno : EIO);
}

std::string output_problem() {
  flush_output();
  if (const int error = output_error) return std::strerror(error);
  return std::ferror(stdout) != 0 ? std::strerror(EIO) : std::string();
}

Diagnostic unwritten(std::string file, std::string_view problem) {
  return {Diagnostic::Severity::error,
          std::move(file),
          {},
          {},
          fmt::format("cannot be written: {}", problem),
          {}};
}

void print_diagnostics(const Diagnostics& diagnostics) {
  const bool colours = wants_colours(Stream::err);
  // A stream that takes no more is no reason to throw here, where errors are reported.
  for (const Diagnostic& diagnostic : diagnostics)
    std::fputs((painted(diagnostic, colours) + "\n").c_str(), stderr);
  const auto errors = std::count_if(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Diagnostic::Severity::error;
  });
  if (errors > 1) std::fputs(fmt::format("{} errors\n", errors).c_str(), stderr);
}

std::string open_on_desktop(const std::string& what) {
  const char* const program = platform::desktop_opener();
  const std::error_code error = platform::start_program(program, what);
  if (!error) return {};
  if (error == std::errc::no_such_file_or_directory)
    return fmt::format("there is no '{}' on this machine", program);
  return fmt::format("'{}' cannot be started: {}", program, error.message());
}

Interruptible::Interruptible(RunContext& context)
    : request_([](void* run) { static_cast<RunContext*>(run)->cancel(); }, &context) {}

}  // namespace linkwright::cli
