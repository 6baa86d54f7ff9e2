// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a list of hard points ends with points or with diagnostics, and points that were read
// survive being written and read again: as a table, in every form of lists, and as the list itself with other
// coordinates.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/suspension/corner/hard_point_list.h"
#include "require.h"

namespace {

using namespace linkwright;
using namespace linkwright::suspension;

/// True if both are the same within the rounding of a unit.
bool near(const Vec3& a, const Vec3& b) { return norm(a - b) <= 1e-15 * (1 + norm(a)); }

/// Points by their names: sections of a list put them into another order.
std::vector<HardPoint> in_order(std::vector<HardPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const HardPoint& a, const HardPoint& b) { return a.name < b.name; });
  return points;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const auto& unit : names(PointUnit{})) {
    Diagnostics diagnostics;
    const auto list =
        read_hard_point_list({reinterpret_cast<const char*>(data), size}, "input", unit.value, diagnostics);
    FUZZ_REQUIRE(list.has_value() != has_errors(diagnostics));
    if (!list) continue;
    std::vector<HardPoint> points;
    std::vector<Vec3> moved;
    for (const ListedPoint& listed : list->points) {
      FUZZ_REQUIRE(!listed.point.name.empty() && plain_name(listed.point.name) == listed.point.name);
      FUZZ_REQUIRE(plain_name(listed.label) == listed.point.name && !listed.places.empty());
      points.push_back(listed.point);
      moved.push_back({listed.point.at.y, 0.5 - listed.point.at.x, listed.point.at.z});
    }
    const auto again = read_hard_points(to_csv(hard_point_table(points)), "again", PointUnit::m, diagnostics);
    FUZZ_REQUIRE(again && *again == points);
    for (const auto& format : names(ListFormat{})) {
      auto written = read_hard_points(write_hard_points(points, format.value, PointUnit::m), "new",
                                      PointUnit::m, diagnostics);
      FUZZ_REQUIRE(written && in_order(*std::move(written)) == in_order(points));
    }
    const auto changed =
        read_hard_point_list(write_hard_points(*list, moved), "changed", unit.value, diagnostics);
    FUZZ_REQUIRE(changed && changed->points.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      FUZZ_REQUIRE(changed->points[i].point.name == points[i].name &&
                   near(changed->points[i].point.at, moved[i]));
  }
  return 0;
}
