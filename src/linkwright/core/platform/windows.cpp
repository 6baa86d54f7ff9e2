// SPDX-License-Identifier: BSD-3-Clause

// All of the folder but sockets, for Windows.
#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#define _CRT_RAND_S
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <windows.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/core/platform/files.h"
#include "linkwright/core/platform/machine.h"
#include "linkwright/core/platform/processes.h"

namespace linkwright::platform {
namespace fs = std::filesystem;

// --- Machine ---------------------------------------------------------------------------------------------

double memory() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return ::GlobalMemoryStatusEx(&status) ? static_cast<double>(status.ullTotalPhys) : 0;
}

int processors() { return std::max(1, static_cast<int>(::GetActiveProcessorCount(ALL_PROCESSOR_GROUPS))); }

int own_processors() {
  DWORD_PTR own = 0, all = 0;
  if (!::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all) || own == 0) return processors();
  return std::popcount(static_cast<unsigned long long>(own));
}

std::string host_name() {
  std::array<char, 256> name{};
  auto size = static_cast<DWORD>(name.size());
  return ::GetComputerNameA(name.data(), &size) ? std::string(name.data()) : std::string();
}

void fill_random(std::span<unsigned char> bytes) {
  if (bytes.size() > 256)
    throw std::system_error(EIO, std::generic_category(), "no random numbers from the system");
  for (unsigned char& byte : bytes) {
    unsigned int number = 0;
    if (::rand_s(&number) != 0)
      throw std::system_error(EIO, std::generic_category(), "no random numbers from the system");
    byte = static_cast<unsigned char>(number >> 8);
  }
}

// --- Files -----------------------------------------------------------------------------------------------

std::error_code write_to_disk(const fs::path& file, const std::function<std::string_view()>& next,
                              const fs::path& like) {
  std::error_code unknown;
  const fs::file_status before = fs::status(like, unknown);
  if (fs::is_regular_file(before) && (before.permissions() & fs::perms::owner_write) == fs::perms::none)
    return std::make_error_code(std::errc::permission_denied);
  const auto failed = [] { return std::error_code(errno, std::generic_category()); };
  const int descriptor = ::_wopen(file.c_str(), _O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY | _O_NOINHERIT,
                                  _S_IREAD | _S_IWRITE);
  if (descriptor < 0) return failed();
  std::error_code error;
  std::string_view text;
  while (!error && !(text.empty() && (text = next()).empty())) {
    constexpr std::size_t most = 1u << 30;
    const int count = ::_write(descriptor, text.data(), static_cast<unsigned>(std::min(text.size(), most)));
    if (count >= 0)
      text.remove_prefix(static_cast<std::size_t>(count));
    else
      error = failed();
  }
  if (!error && ::_commit(descriptor) != 0) error = failed();
  if (::_close(descriptor) != 0 && !error) error = failed();
  return error;
}

void report_size_limits() {}

void sync_folder(const fs::path&) {}

fs::path make_private_folder(const fs::path& parent, std::error_code& error) {
  // Folders for temporary files are those of a user, and what is in them has their permissions.
  for (int tries = 0; tries < 100; ++tries) {
    unsigned int number = 0;
    ::rand_s(&number);
    const fs::path folder = parent / ("linkwright-" + std::to_string(number));
    if (fs::create_directory(folder, error)) return folder;
    if (error) return {};
  }
  error = std::make_error_code(std::errc::file_exists);
  return {};
}

// --- Processes -------------------------------------------------------------------------------------------

namespace {

std::atomic<void (*)(void*)> on_stop{nullptr};
std::atomic<void*> stopped{nullptr};

// Called in a thread of its own; false leaves it to the system, which ends the program.
BOOL WINAPI stop_request(DWORD) {
  void (*const act)(void*) = on_stop.exchange(nullptr);
  if (act) act(stopped);
  return act != nullptr;
}

}  // namespace

int process_id() { return static_cast<int>(::GetCurrentProcessId()); }

bool process_exists(int process) {
  const HANDLE handle = ::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(process));
  if (!handle) return ::GetLastError() != ERROR_INVALID_PARAMETER;
  DWORD code = STILL_ACTIVE;
  const bool known = ::GetExitCodeProcess(handle, &code);
  ::CloseHandle(handle);
  return !known || code == STILL_ACTIVE;
}

fs::path program_file() {
  std::array<wchar_t, 32768> name{};
  const DWORD size = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
  return size < name.size() ? fs::path(std::wstring(name.data(), size)) : fs::path();
}

std::error_code start_program(const std::string& program, const std::string& argument) {
  const std::string quoted = '"' + argument + '"';
  const auto child = ::_spawnlp(_P_DETACH, program.c_str(), program.c_str(), quoted.c_str(), nullptr);
  return {child == -1 ? errno : 0, std::generic_category()};
}

const char* desktop_opener() { return "explorer"; }

void set_where_unset(const char* variable, const char* value) {
  if (!::getenv(variable)) ::_putenv_s(variable, value);
}

void* load_library(const fs::path& file, std::string& problem) {
  const HMODULE library = ::LoadLibraryW(file.c_str());
  if (!library) problem = std::system_category().message(static_cast<int>(::GetLastError()));
  return library;
}

void* function_of(void* library, const char* name) {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

bool is_terminal(Stream stream) { return ::_isatty(::_fileno(stream == Stream::out ? stdout : stderr)) != 0; }

std::size_t terminal_columns() {
  CONSOLE_SCREEN_BUFFER_INFO info{};
  return ::GetConsoleScreenBufferInfo(::GetStdHandle(STD_ERROR_HANDLE), &info)
             ? static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1)
             : 0;
}

StopRequest::StopRequest(void (*act)(void*), void* of) {
  stopped = of;
  on_stop = act;
  ::SetConsoleCtrlHandler(stop_request, TRUE);
}

StopRequest::~StopRequest() {
  ::SetConsoleCtrlHandler(stop_request, FALSE);
  on_stop = nullptr;
}

}  // namespace linkwright::platform
