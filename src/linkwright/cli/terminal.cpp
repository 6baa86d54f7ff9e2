#include "linkwright/cli/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <system_error>

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
  // The name of the file stands before the word and may hold it.
  if (const std::size_t place = text.find(word, diagnostic.file.size()); place != std::string::npos)
    text.replace(place, word.size(), paint(word, error ? Colour::red : Colour::yellow, on));
  return text;
}

void print_diagnostics(const Diagnostics& diagnostics) {
  const bool colours = wants_colours(Stream::err);
  for (const Diagnostic& diagnostic : diagnostics) fmt::print(stderr, "{}\n", painted(diagnostic, colours));
  const auto errors = std::count_if(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Diagnostic::Severity::error;
  });
  if (errors > 1) fmt::print(stderr, "{} errors\n", errors);
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
