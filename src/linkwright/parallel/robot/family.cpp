// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/family.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::parallel {
namespace {

constexpr FamilyDimension arm{"arm", "length of the arms"}, rod{"rod", "length of the rods"},
    below{"offset", "distance of the region below the arms' pivots"},
    ahead{"offset", "distance of the region from the line of the arms' pivots"};

constexpr std::array delta_dimensions{
    FamilyDimension{"radius_difference", "radius of the base less that of the platform"}, arm, rod, below};
constexpr std::array hexa_dimensions{
    FamilyDimension{"base_radius", "axis of the robot to the middle of a pair's pivots"},
    FamilyDimension{"base_offset", "half the distance of a pair's pivots"},
    FamilyDimension{"platform_radius", "platform point to the rods' joints"},
    FamilyDimension{"platform_angle", "half the angle between a pair's joints at the platform", true},
    arm,
    rod,
    below};
constexpr std::array five_bar_dimensions{
    FamilyDimension{"half_base", "half the distance of the arms' pivots"}, arm, rod, ahead};

DesignedRobot designed_delta(std::span<const double> x) {
  DesignedRobot out{.robot = delta({.base_radius = x[0], .arm = x[1], .rod = x[2]}), .ahead = {0, 0, -1}};
  out.assembly = -1;
  for (int i = 0; i < 3; ++i) out.by[0][i].base = out.robot.leg[i].ahead;
  return out;
}

DesignedRobot designed_hexa(std::span<const double> x) {
  DesignedRobot out{.robot = hexa({.base_radius = x[0],
                                   .base_offset = x[1],
                                   .platform_radius = x[2],
                                   .platform_angle = x[3],
                                   .arm = x[4],
                                   .rod = x[5]}),
                    .ahead = {0, 0, -1}};
  for (int i = 0; i < 6; ++i) {
    const double side = i % 2 ? 1 : -1;
    const Vec3 e = out.robot.leg[i].ahead;
    const double at = std::atan2(e.y, e.x) + side * x[3];
    out.by[0][i].base = e;
    out.by[1][i].base = {-side * e.y, side * e.x, 0};
    out.by[2][i].platform = {std::cos(at), std::sin(at), 0};
    out.by[3][i].platform = {-side * x[2] * std::sin(at), side * x[2] * std::cos(at), 0};
  }
  return out;
}

DesignedRobot designed_five_bar(std::span<const double> x) {
  DesignedRobot out{.robot = planar({.base_x = -x[0], .arm = x[1], .rod = x[2]},
                                    {.base_x = x[0], .arm = x[1], .rod = x[2]}),
                    .ahead = {0, 1, 0}};
  out.by[0][0].base = {-1, 0, 0};
  out.by[0][1].base = {1, 0, 0};
  out.sense[0] = -1;
  return out;
}

}  // namespace

std::span<const FamilyDimension> dimensions(RobotFamily family) {
  switch (family) {
    case RobotFamily::hexa:
      return hexa_dimensions;
    case RobotFamily::five_bar:
      return five_bar_dimensions;
    case RobotFamily::delta:
      break;
  }
  return delta_dimensions;
}

DesignedRobot design(RobotFamily family, std::span<const double> values) {
  const std::size_t count = dimensions(family).size();
  LINKWRIGHT_REQUIRE(values.size() == count, "{} values for {} dimensions of a {}", values.size(), count,
                     name_of(family));
  DesignedRobot out = family == RobotFamily::hexa       ? designed_hexa(values)
                      : family == RobotFamily::five_bar ? designed_five_bar(values)
                                                        : designed_delta(values);
  out.count = static_cast<int>(count);
  out.offset = values.back();
  for (int i = 0; i < out.robot.legs(); ++i) {
    out.by[out.arm()][i].arm = 1;
    out.by[out.rod()][i].rod = 1;
  }
  return out;
}

WorkingMode elbows_out(RobotFamily family) {
  WorkingMode out = all_positive;
  if (family == RobotFamily::five_bar) out[0] = -1;
  return out;
}

double arm_angle_of(const DesignedRobot& designed, int leg, double outward) {
  return designed.sense[leg] > 0 ? math::wrap_angle(outward) : math::wrap_angle(pi - outward);
}

}  // namespace linkwright::parallel
