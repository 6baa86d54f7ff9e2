// SPDX-License-Identifier: BSD-3-Clause

// Any text is a formula, or is refused with a column inside it or just behind it.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "linkwright/math/formula.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr math::FormulaName names[] = {
      {"time", Dimension::time}, {"s", Dimension::length}, {"v", Dimension::speed}};
  math::FormulaError error;
  const auto formula = math::Formula::read(text, Dimension::force, names, error);
  if (!formula) {
    FUZZ_REQUIRE(!error.message.empty() && error.column >= 1 && error.column <= size + 1);
    return 0;
  }
  FUZZ_REQUIRE(formula->text() == text);
  // The value depends on nothing but the values of its names.
  for (const std::array<double, 3>& values : {std::array{0.0, 0.0, 0.0}, {0.5, 0.2, -3.0}}) {
    const double one = (*formula)(values), again = (*formula)(values);
    FUZZ_REQUIRE(one == again || (std::isnan(one) && std::isnan(again)));
  }
  return 0;
}
