// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/value.h"

namespace linkwright::study {

/// JSON text of a value: members in their order, numbers with the fewest digits that read back to the same
/// double (1.0 stays "1.0"), NaN and infinities as null, what is not UTF-8 as U+FFFD.
std::string to_json(const Value& value);  ///< one line; what study_sha256 is computed from
std::string to_json_readable(
    const Value& value);  ///< indented, arrays of plain values on one line, newline at the end

/// TOML text of a table, as people would write it: plain values before tables, tables as [a.b], arrays of
/// tables as
/// [[a]], small tables of plain values within others inline. TOML has no null: such members are left out.
/// Throws ContractError when the value is no table.
std::string to_toml(const Value& value);

}  // namespace linkwright::study
