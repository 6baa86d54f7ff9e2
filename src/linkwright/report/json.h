#pragma once

#include <string>

#include "linkwright/core/value.h"

namespace linkwright::report {

/// JSON text without blanks; numbers with the shortest digits that read back to the same value, NaN and infinities as
/// null, bytes that are not UTF-8 as U+FFFD.
std::string to_json(const Value& value);

}  // namespace linkwright::report
