#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace linkwright {

/// The caller broke a function's contract (wrong size, negative length, ...). The message holds the condition
/// and the values. Bad files and physics that says no are not contract errors: see diagnostic.h and status.h.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace linkwright

/// Always-on check at a public entry: LINKWRIGHT_REQUIRE(n >= 3, "needs 3 points, got {}", n).
#define LINKWRIGHT_REQUIRE(condition, ...)                                                          \
  do {                                                                                              \
    if (!(condition)) [[unlikely]]                                                                  \
      throw ::linkwright::ContractError(std::string(__func__) + ": " + ::fmt::format(__VA_ARGS__) + \
                                        " [" #condition "]");                                       \
  } while (false)
