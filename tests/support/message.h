// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/diagnostic.h"

namespace linkwright::test {

/// Text of the ContractError that a call throws.
template <class Call>
std::string message(Call&& call) {
  try {
    call();
  } catch (const ContractError& error) {
    return error.what();
  }
  return "no error";
}

/// Diagnostics as a user sees them, one a line.
inline std::string lines_of(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& d : diagnostics) out += to_string(d) + "\n";
  return out;
}

}  // namespace linkwright::test
