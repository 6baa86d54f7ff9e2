// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/cli/arguments.h"

namespace linkwright::cli {

/// `linkwright serve`: serves the workbench until Ctrl-C. Returns the exit code.
int serve_workbench(const Arguments& arguments);

}  // namespace linkwright::cli
