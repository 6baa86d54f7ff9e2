// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/platform/processes.h"
#include "linkwright/core/run_context.h"

/// The program's use of the terminal and the desktop that it is called from.
namespace linkwright::cli {

using platform::is_terminal;
using platform::Stream;
/// Columns of the terminal behind standard error; 80 if it is none or does not say.
std::size_t terminal_width();

/// True if colours are written to a stream: to a terminal that knows them. NO_COLOR, if set and not empty,
/// forbids them; else CLICOLOR_FORCE, if set and not "0", demands them, also in pipes and files.
bool wants_colours(Stream stream);

enum class Colour { red, green, yellow, bold, pale };
/// The text in a colour; as it is without `on`.
std::string paint(std::string_view text, Colour colour, bool on);
/// to_string(diagnostic) with the word "error" or "warning" in its colour.
std::string painted(const Diagnostic& diagnostic, bool on);

/// Says why a file is not written.
Diagnostic unwritten(std::string file, std::string_view problem);

/// Passes on what was printed so far; why that failed is kept for output_problem().
void flush_output();
/// Says why standard output did not take all that was printed; empty if it did.
std::string output_problem();

/// Writes diagnostics to standard error, with their number if there are several errors.
void print_diagnostics(const Diagnostics& diagnostics);

/// Opens an absolute path, as a double click would, or an address, and does not wait for it. Returns why it
/// could not, empty if nothing went wrong.
std::string open_on_desktop(const std::string& what);

/// While it lives, the first SIGINT or SIGTERM cancels the run, and a second one kills the program.
class Interruptible {
 public:
  explicit Interruptible(RunContext& context);

 private:
  platform::StopRequest request_;
};

}  // namespace linkwright::cli
