// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/guide/constructions.h"

#include <fmt/core.h>

namespace linkwright::suspension {

GuideConstruction construction_of(const WheelGuide& guide) { return kernel::construction_of(guide.links); }

std::string why_no_axis(const WheelGuide& guide) {
  const GuideConstruction found = construction_of(guide);
  if (found.has_axis()) return {};
  std::string which;
  for (const CarrierBall& ball : found.balls)
    which += (which.empty() ? "" : ", ") + link_label(guide, ball.link);
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

std::string why_no_planes(const WheelGuide& guide) {
  const GuideConstruction found = construction_of(guide);
  if (found.has_planes()) return {};
  std::string which;
  for (const Arm& arm : found.arms) which += (which.empty() ? "" : ", ") + link_label(guide, arm.link);
  const std::string count = found.arms.empty() ? "no link is an arm with a plane"
                            : found.arms.size() == 1
                                ? fmt::format("one arm has a plane ({})", which)
                                : fmt::format("{} arms have planes ({})", found.arms.size(), which);
  return count +
         ", the construction needs two (RS, SR or SP links, two rods off the rack that share an end) or an R "
         "hinge";
}

}  // namespace linkwright::suspension
