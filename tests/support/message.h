#pragma once

#include <string>

#include "linkwright/core/check.h"

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

}  // namespace linkwright::test
