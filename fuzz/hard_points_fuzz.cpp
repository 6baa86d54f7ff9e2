// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a list of hard points ends with points or with diagnostics, and points that were read
// survive being written and read again.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "linkwright/suspension/corner/hard_point_list.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  using namespace linkwright::suspension;
  for (const auto& unit : names(PointUnit{})) {
    Diagnostics diagnostics;
    const auto points =
        read_hard_points({reinterpret_cast<const char*>(data), size}, "input", unit.value, diagnostics);
    FUZZ_REQUIRE(points.has_value() != has_errors(diagnostics));
    if (!points) continue;
    for (const HardPoint& point : *points)
      FUZZ_REQUIRE(!point.name.empty() && plain_name(point.name) == point.name);
    const auto again =
        read_hard_points(to_csv(hard_point_table(*points)), "again", PointUnit::m, diagnostics);
    FUZZ_REQUIRE(again && *again == *points);
  }
  return 0;
}
