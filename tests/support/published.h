// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/value.h"

namespace linkwright::test {

/// Case of tests/published/<file> by its id; throws when there is none.
const Value& published_case(const std::string& file, std::string_view id);

/// All cases of tests/published/<file>.
const Value& published_cases(const std::string& file);

/// Array of numbers.
std::vector<double> numbers(const Value& array);

/// Member along a dotted path: at(value, "inputs.design.L1_m"); throws when it is missing.
const Value& at(const Value& value, std::string_view path);
double number_at(const Value& value, std::string_view path);

}  // namespace linkwright::test
