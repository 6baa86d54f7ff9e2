// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <stdexcept>

namespace linkwright {

/// The caller broke a function's contract (wrong size, negative length, ...). The message holds the condition
/// and the values. Bad files and physics that says no are not contract errors: see diagnostic.h and status.h.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Reports a broken contract. Out of line, so that a check costs its place only a comparison and a call.
/// @param function name of the function that was called
/// @param condition condition that does not hold, as it is written
/// @param message format of the message, for example "needs 3 points, got {}"
/// @param values arguments of the format
/// @throws ContractError always: "function: message [condition]"
[[noreturn]] void contract_failure(const char* function, const char* condition, fmt::string_view message,
                                   fmt::format_args values);

/// The same, with the format of the message checked where it is written.
/// @param function name of the function that was called
/// @param condition condition that does not hold, as it is written
/// @param message format of the message
/// @param values arguments of the format
/// @throws ContractError always
template <class... T>
[[noreturn]] void contract_message(const char* function, const char* condition,
                                   fmt::format_string<T...> message, const T&... values) {
  contract_failure(function, condition, message, fmt::make_format_args(values...));
}

}  // namespace linkwright

/// @ingroup core
/// Always-on check at a public entry: LINKWRIGHT_REQUIRE(n >= 3, "needs 3 points, got {}", n). Throws
/// ContractError when the condition does not hold.
#define LINKWRIGHT_REQUIRE(condition, ...)                               \
  do {                                                                   \
    if (!(condition)) [[unlikely]]                                       \
      ::linkwright::contract_message(__func__, #condition, __VA_ARGS__); \
  } while (false)
