// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/value.h"

namespace linkwright::app {

/// JSON Schema (2020-12) of result.json: what `linkwright schema result` prints.
Value result_schema();

}  // namespace linkwright::app
