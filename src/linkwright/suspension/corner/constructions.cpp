// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <string>

#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {

CornerConstruction construction_of(const Suspension& suspension) {
  return kernel::construction_of(suspension.links);
}

std::string why_no_axis(const Suspension& suspension) {
  const CornerConstruction found = construction_of(suspension);
  if (found.has_axis()) return {};
  std::string which;
  for (const CarrierBall& ball : found.balls)
    which += (which.empty() ? "" : ", ") + link_label(suspension, ball.link);
  const std::string count =
      found.balls.empty() ? "no ball joint holds the carrier"
      : found.balls.size() == 1
          ? fmt::format("one ball joint holds the carrier ({})", which)
          : fmt::format("{} ball joints hold the carrier ({})", found.balls.size(), which);
  return count +
         ", a geometric steering axis passes through two (of RS, SR, SP, S links, or of two rods off the "
         "rack "
         "that share their carrier point)";
}

std::string why_no_planes(const Suspension& suspension) {
  const CornerConstruction found = construction_of(suspension);
  if (found.has_planes()) return {};
  std::string which;
  for (const Arm& arm : found.arms) which += (which.empty() ? "" : ", ") + link_label(suspension, arm.link);
  const std::string count = found.arms.empty() ? "no link is an arm with a plane"
                            : found.arms.size() == 1
                                ? fmt::format("one arm has a plane ({})", which)
                                : fmt::format("{} arms have planes ({})", found.arms.size(), which);
  return count +
         ", the construction needs two (RS, SR or SP links, two rods off the rack that share an end) or an R "
         "hinge";
}

}  // namespace linkwright::suspension
