// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as CSV ends with a table or with diagnostics, and a table that was read survives being
// written and read again.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "linkwright/core/csv.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  Diagnostics diagnostics;
  const auto table = read_csv({reinterpret_cast<const char*>(data), size}, "input", diagnostics);
  FUZZ_REQUIRE(table.has_value() != has_errors(diagnostics));
  if (!table) return 0;
  const auto again = read_csv(to_csv(*table), "again", diagnostics);
  FUZZ_REQUIRE(again && again->rows() == table->rows() && again->columns.size() == table->columns.size());
  for (std::size_t c = 0; c < table->columns.size(); ++c)
    for (std::size_t r = 0; r < table->rows(); ++r) {
      const double a = table->columns[c].values[r], b = again->columns[c].values[r];
      FUZZ_REQUIRE(a == b || (std::isnan(a) && std::isnan(b)));
    }
  return 0;
}
