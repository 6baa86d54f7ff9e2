// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/study/kind.h"
#include "linkwright/study/reproduction.h"

namespace linkwright::cli {

/// The whole program for a catalogue of studies and of published tables: reads the command line, runs the
/// command, prints. Returns the exit code: 0 done, 1 a check failed, 2 bad input or usage, 3 numeric failure,
/// 4 cancelled, 5 a limit of the system, 70 internal error.
int program(int argc, const char* const* argv, std::span<const study::Kind> kinds,
            std::span<const study::Reproduction> reproductions = {});

}  // namespace linkwright::cli
