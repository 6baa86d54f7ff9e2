// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

namespace linkwright::platform {

/// Number of this process.
int process_id();
/// False only if there is surely no process of this number (> 0) any more.
bool process_exists(int process);

/// File of the program that runs; empty where the system does not say.
std::filesystem::path program_file();

/// Starts a program with one argument, without any input or output, and does not wait for it.
std::error_code start_program(const std::string& program, const std::string& argument);
/// The program that opens files and addresses as a double click would.
const char* desktop_opener();

/// Sets an environment variable of this process that has no value yet. While no other thread runs.
void set_where_unset(const char* variable, const char* value);

/// A library that is loaded while the program runs, and stays. Null with `problem` where it cannot be.
void* load_library(const std::filesystem::path& file, std::string& problem);
/// A function of a library that load_library has given; null where it has none of this name.
void* function_of(void* library, const char* name);

enum class Stream { out, err };
bool is_terminal(Stream stream);
/// Columns of the terminal behind standard error; 0 where it is none or does not say.
std::size_t terminal_columns();

/// While it lives, the first Ctrl-C, or request to end from outside, calls `act` with `of`, in whatever
/// thread and at whatever moment; the second ends the program. One at a time.
class StopRequest {
 public:
  StopRequest(void (*act)(void* of), void* of);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
};

}  // namespace linkwright::platform
