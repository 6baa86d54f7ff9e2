// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/check.h"

#include <string>

namespace linkwright {

void contract_failure(const char* function, const char* condition, fmt::string_view message,
                      fmt::format_args values) {
  throw ContractError(std::string(function) + ": " + fmt::vformat(message, values) + " [" + condition + "]");
}

}  // namespace linkwright
