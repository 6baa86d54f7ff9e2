// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// A double wishbone with a pushrod from its upper wishbone, a rocker, a spring on the rocker and an
/// anti-roll bar that a droplink joins to the rocker.
inline Suspension pushrod_corner() {
  const auto mm = [](double x, double y, double z) { return Vec3{1e-3 * x, 1e-3 * y, 1e-3 * z}; };
  Suspension out;
  out.wheel = {mm(0, 600, 203), 0, 1.5 * std::numbers::pi / 180, 0.406};
  out.links = {{.name = "lower wishbone",
                .type = LinkType::RS,
                .body = {mm(150, 220, 120), mm(-160, 230, 118)},
                .carrier = {mm(5, 560, 115)}},
               {.name = "upper wishbone",
                .type = LinkType::RS,
                .body = {mm(140, 260, 270), mm(-150, 265, 262)},
                .carrier = {mm(-12, 535, 290)}},
               {.name = "tie rod",
                .type = LinkType::US,
                .body = {mm(60, 225, 160)},
                .carrier = {mm(75, 550, 165)},
                .moved_by_rack = true}};
  out.rockers = {{.name = "rocker",
                  .axis = {mm(40, 200, 430), mm(-40, 200, 430)},
                  .rod = mm(0, 260, 460),
                  .driven_by = {mm(3, 500, 280), {PartKind::link, 1}}},
                 {.name = "anti-roll bar",
                  .axis = {mm(120, 0, 250), mm(120, 100, 250)},
                  .rod = mm(20, 170, 250),
                  .driven_by = {mm(20, 170, 470), {PartKind::rocker, 0}}}};
  out.spring = CornerSpring{.body = mm(0, 20, 500), .moving = mm(0, 215, 520), .rocker = 0};
  return out;
}

}  // namespace linkwright::suspension
