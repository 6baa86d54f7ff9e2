// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/serial_arm/workspace.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::parallel {
namespace {

constexpr std::size_t block = 4096;  // nodes between looks at the context: about a millisecond

std::size_t nodes_along(double low, double high, double step) {
  LINKWRIGHT_REQUIRE(std::isfinite(low) && std::isfinite(high) && high >= low, "grid from {} to {} m", low,
                     high);
  // The end counts when it is missed by rounding alone.
  const double steps = std::floor((high - low) / step + 1e-6);
  LINKWRIGHT_REQUIRE(steps < 1e8, "grid from {} to {} m in steps of {} m", low, high, step);
  return static_cast<std::size_t>(steps) + 1;
}

SerialCriterion criterion_of(const SerialConditions& c, const SerialDrives& drives, const PerArm& angles,
                             const SerialPlace& place) {
  if (drives.status != Status::done) return SerialCriterion::travel;
  const double elbow = elbow_angle(angles);
  if (elbow < c.min_elbow || elbow > c.max_elbow) return SerialCriterion::elbow;
  if (place[SerialIndex::drive_transmission] < c.min_drive_transmission)
    return SerialCriterion::drive_transmission;
  if (place[SerialIndex::conditioning] < c.min_conditioning) return SerialCriterion::conditioning;
  return SerialCriterion::none;
}

}  // namespace

double elbow_angle(const PerArm& angles) { return pi - std::abs(math::wrap_angle(angles[1] - angles[0])); }

SerialPlace look_at(const SerialConditions& c, const math::Vec2& point) {
  SerialPlace out{.criterion = SerialCriterion::reach};
  out.index.fill(nan);
  const SerialAngles found = inverse(c.arm, point, c.mode);
  if (found.status != Status::done) return out;
  const SerialQuality q = quality(c.arm, found.angle);
  const SerialDrives drives = drives_at(c.arm, found.angle);
  out.index = {1 / q.condition, std::abs(q.sine), q.manipulability,
               std::min(q.transmission[0], q.transmission[1])};
  if (drives.status == Status::no_assembly) out.index[3] = nan;
  out.criterion = criterion_of(c, drives, found.angle, out);
  return out;
}

math::Vec2 SerialMap::position(std::size_t node) const {
  const std::size_t column = node % nodes[0], row = node / nodes[0];
  return {grid.low.x + grid.step * static_cast<double>(column),
          grid.low.y + grid.step * static_cast<double>(row)};
}

std::size_t SerialMap::count(SerialCriterion criterion) const {
  return static_cast<std::size_t>(std::count_if(
      place.begin(), place.end(), [criterion](const SerialPlace& p) { return p.criterion == criterion; }));
}

SerialMap workspace(const SerialConditions& conditions, const SerialGrid& grid, const RunContext& context) {
  LINKWRIGHT_REQUIRE(grid.step > 0 && std::isfinite(grid.step), "grid step {} m must be positive", grid.step);
  SerialMap out{.grid = grid};
  out.nodes = {nodes_along(grid.low.x, grid.high.x, grid.step),
               nodes_along(grid.low.y, grid.high.y, grid.step)};
  const double all = static_cast<double>(out.nodes[0]) * static_cast<double>(out.nodes[1]);
  LINKWRIGHT_REQUIRE(all <= 1e8, "grid of {} nodes", all);
  out.place.resize(out.nodes[0] * out.nodes[1]);
  for (std::size_t n = 0; n < out.place.size(); ++n) {
    if (n % block == 0) {
      out.status = context.interruption();
      if (out.status != Status::done) break;
      context.report({.stage = "workspace", .fraction = static_cast<double>(n) / all});
    }
    out.place[n] = look_at(conditions, out.position(n));
  }
  return out;
}

SerialGrid whole_reach(const SerialPiArm& arm, double step) {
  LINKWRIGHT_REQUIRE(step > 0 && std::isfinite(step), "grid step {} m must be positive", step);
  const double half = step * std::ceil((arm.arm[0] + arm.arm[1]) / step);
  const math::Vec2 middle = arm.base + arm.offset, corner{half, half};
  return {.low = middle - corner, .high = middle + corner, .step = step};
}

}  // namespace linkwright::parallel
