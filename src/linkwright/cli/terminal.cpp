#include "linkwright/cli/terminal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern char**
    environ;  // NOLINT(readability-redundant-declaration): no header of the system declares it everywhere

namespace linkwright::cli {
namespace {

int descriptor(Stream stream) { return stream == Stream::out ? STDOUT_FILENO : STDERR_FILENO; }

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

// The run that Ctrl-C asks to stop. The handler is reset by its first use, so a second Ctrl-C kills the
// program.
RunContext* interruptible = nullptr;
struct sigaction old_interrupt, old_terminate;

extern "C" void interrupt(int) {
  if (interruptible) interruptible->cancel();
}

}  // namespace

bool is_terminal(Stream stream) { return ::isatty(descriptor(stream)) == 1; }

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
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
#ifdef __APPLE__
  const char* const program = "open";
#else
  const char* const program = "xdg-open";
#endif
  std::string name = what, command = program;
  char* const arguments[] = {command.data(), name.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, program, &silent, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&silent);
  if (problem == 0) return {};
  if (problem == ENOENT) return fmt::format("there is no '{}' on this machine", program);
  return fmt::format("'{}' cannot be started: {}", program, std::strerror(problem));
}

Interruptible::Interruptible(RunContext& context) {
  interruptible = &context;
  struct sigaction action = {};
  action.sa_handler = interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &old_interrupt);
  sigaction(SIGTERM, &action, &old_terminate);
}

Interruptible::~Interruptible() {
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGTERM, &old_terminate, nullptr);
  interruptible = nullptr;
}

}  // namespace linkwright::cli
