// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/constraint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/singular_values.h"

namespace linkwright::parallel {
namespace {

double determinant3(const std::array<Vec3, 3>& rows) { return dot(rows[0], cross(rows[1], rows[2])); }

Vec3 axis_of(const Leg& leg) { return cross(leg.ahead, leg.aside); }

std::string axis_text(const Vec3& axis) {
  constexpr double along = 0.9999;  // within 0.8 deg
  const std::array<std::pair<double, const char*>, 3> parts{{{axis.x, "x"}, {axis.y, "y"}, {axis.z, "z"}}};
  for (const auto& [part, name] : parts)
    if (std::abs(part) > along) return name;
  return fmt::format("the direction ({:.3g}, {:.3g}, {:.3g})", axis.x, axis.y, axis.z);
}

std::string legs_text(const std::vector<int>& legs) {
  std::string out = legs.size() == 1 ? "leg " : "legs ";
  for (std::size_t k = 0; k < legs.size(); ++k)
    out += fmt::format("{}{}", k == 0 ? "" : k + 1 == legs.size() ? " and " : ", ", legs[k] + 1);
  return out;
}

}  // namespace

Constraint constraint(const Robot& robot, const Jacobians& at) {
  LINKWRIGHT_REQUIRE(robot.freedom == Freedom::space_translation,
                     "only the legs of a DELTA are parallelograms");
  Constraint out;
  std::array<std::array<double, 3>, 3> rows;
  std::array<Vec3, 3> units;
  for (int i = 0; i < 3; ++i) {
    const Vec3 c = out.couple[i] = (1 / robot.leg[i].rod) * cross(axis_of(robot.leg[i]), at.rod[i]);
    rows[i] = {c.x, c.y, c.z};
    units[i] = unit(c);
  }
  out.determinant = determinant3(out.couple);
  out.unit_determinant = determinant3(units);
  const auto svd = math::singular_values<3>(rows);
  const auto least = std::min_element(svd.value.begin(), svd.value.end()) - svd.value.begin();
  out.index = svd.value[least];
  Vec3 axis{svd.right[0][least], svd.right[1][least], svd.right[2][least]};
  // One of the two directions: that whose largest part is positive.
  const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
  const double largest = x >= y && x >= z ? axis.x : y >= z ? axis.y : axis.z;
  out.free_axis = largest < 0 ? -axis : axis;
  return out;
}

std::string free_turn(const Robot& robot, const Jacobians& at) {
  constexpr double near = 5e-3;
  const Constraint here = constraint(robot, at);
  const std::string turn = fmt::format("the platform can turn about {}", axis_text(here.free_axis));
  std::vector<int> flat, level;
  for (int i = 0; i < 3; ++i) {
    const Vec3 rod = (1 / robot.leg[i].rod) * at.rod[i];
    if (norm(here.couple[i]) < near) flat.push_back(i);
    if (std::abs(dot(rod, robot.leg[i].aside)) < near) level.push_back(i);
  }
  if (!flat.empty()) return fmt::format("the parallelogram of {} is flat; {}", legs_text(flat), turn);
  double apart = 0;
  for (int i = 0; i < 3; ++i)
    apart = std::max(
        apart, norm(cross(at.rod[i], at.rod[(i + 1) % 3])) / (robot.leg[i].rod * robot.leg[(i + 1) % 3].rod));
  if (apart < near) return "the rods of all legs are parallel; the platform can turn and move across them";
  if (level.size() >= 2) return fmt::format("the rods of {} lie level; {}", legs_text(level), turn);
  return fmt::format("the three parallelograms together do not hold it; {}", turn);
}

}  // namespace linkwright::parallel
