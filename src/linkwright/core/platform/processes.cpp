// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/processes.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

extern char**
    environ;  // NOLINT(readability-redundant-declaration): no header of the system declares it everywhere

namespace linkwright::platform {
namespace fs = std::filesystem;
namespace {

void (*on_stop)(void*) = nullptr;
void* stopped = nullptr;
struct sigaction old_interrupt, old_terminate;

extern "C" void stop_request(int) {
  if (on_stop) on_stop(stopped);
}

}  // namespace

int process_id() { return ::getpid(); }

bool process_exists(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

fs::path program_file() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

std::error_code start_program(const std::string& program, const std::string& argument) {
  std::string command = program, word = argument;
  char* const arguments[] = {command.data(), word.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, command.c_str(), &silent, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&silent);
  return {problem, std::generic_category()};
}

const char* desktop_opener() {
#ifdef __APPLE__
  return "open";
#else
  return "xdg-open";
#endif
}

void set_where_unset(const char* variable, const char* value) { ::setenv(variable, value, 0); }

void* load_library(const fs::path& file, std::string& problem) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!library) problem = ::dlerror();
  return library;
}

void* function_of(void* library, const char* name) { return ::dlsym(library, name); }

bool is_terminal(Stream stream) {
  return ::isatty(stream == Stream::out ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

std::size_t terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

StopRequest::StopRequest(void (*act)(void*), void* of) {
  stopped = of;
  on_stop = act;
  struct sigaction action = {};
  action.sa_handler = stop_request;
  // Reset by its first use, so that a second signal ends the program.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, &old_interrupt);
  ::sigaction(SIGTERM, &action, &old_terminate);
}

StopRequest::~StopRequest() {
  ::sigaction(SIGINT, &old_interrupt, nullptr);
  ::sigaction(SIGTERM, &old_terminate, nullptr);
  on_stop = nullptr;
}

}  // namespace linkwright::platform
