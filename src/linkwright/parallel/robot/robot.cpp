// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/robot.h"

#include <fmt/core.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {

Sentence coordinates_of(const Vec3& place) {
  return say("{}, {}, {}", at_place("x", metres(place.x)).sharing_unit(),
             at_place("y", metres(place.y)).sharing_unit(), at_place("z", metres(place.z)));
}

namespace {

// Unit and right angles may be wrong by rounding alone.
constexpr double robot_rounding = 1e-9;

Vec3 radial(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0}; }

std::optional<std::string> problem(const Robot& robot, int i) {
  const Leg& leg = robot.leg[i];
  const auto of_leg = [i](const std::string& text) { return fmt::format("leg {}: {}", i + 1, text); };
  if (!finite(leg.base) || !finite(leg.platform)) return of_leg("its joints are not finite");
  if (!(leg.arm > 0 && std::isfinite(leg.arm))) return of_leg(fmt::format("arm = {} m", leg.arm));
  if (!(leg.rod > 0 && std::isfinite(leg.rod))) return of_leg(fmt::format("rod = {} m", leg.rod));
  const bool units = std::abs(norm(leg.ahead) - 1) < robot_rounding &&
                     std::abs(norm(leg.aside) - 1) < robot_rounding &&
                     std::abs(dot(leg.ahead, leg.aside)) < robot_rounding;
  if (!units) return of_leg("the directions of its arm are not unit vectors at a right angle");
  if (robot.freedom == Freedom::plane_translation &&
      (leg.base.z != 0 || leg.platform.z != 0 || leg.ahead.z != 0 || leg.aside.z != 0))
    return of_leg("it leaves the plane z = 0");
  return {};
}

}  // namespace

Robot delta(const DeltaDimensions& d) {
  Robot out{.freedom = Freedom::space_translation};
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = radial(d.azimuth[i]);
    out.leg[i] = {.base = d.base_radius * e,
                  .ahead = e,
                  .aside = {0, 0, -1},
                  .arm = d.arm,
                  .rod = d.rod,
                  .platform = d.platform_radius * e};
  }
  return out;
}

Robot hexa(const HexaDimensions& d) {
  Robot out{.freedom = Freedom::space};
  for (int i = 0; i < 6; ++i) {
    const int pair = i / 2;
    const double azimuth = pair * 2 * pi / 3;
    const double side = i % 2 ? 1 : -1;
    const Vec3 e = radial(azimuth), across{-e.y, e.x, 0};
    out.leg[i] = {.base = d.base_radius * e + side * d.base_offset * across,
                  .ahead = e,
                  .aside = {0, 0, -1},
                  .arm = d.arm,
                  .rod = d.rod,
                  .platform = d.platform_radius * radial(azimuth + side * d.platform_angle)};
  }
  return out;
}

Robot planar(const PlanarLeg& first, const PlanarLeg& second) {
  Robot out{.freedom = Freedom::plane_translation};
  const auto leg = [](const PlanarLeg& l) {
    return Leg{.base = {l.base_x, l.base_y, 0},
               .arm = l.arm,
               .rod = l.rod,
               .platform = {l.platform_x, l.platform_y, 0}};
  };
  out.leg[0] = leg(first);
  out.leg[1] = leg(second);
  return out;
}

std::optional<std::string> problem(const Robot& robot) {
  for (int i = 0; i < robot.legs(); ++i)
    if (const auto found = problem(robot, i)) return found;
  return {};
}

}  // namespace linkwright::parallel
