// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "linkwright/math/motion_law.h"
#include "linkwright/planar/link_mass.h"

// Open chains of links joined by revolute joints: model, positions and rates. Link k = 0, 1, ... has its own
// joint O_k+1 (O1 joins the first link to the ground) and carries the next one, or the tip, at the end of its
// line. Angles of links are absolute: counter-clockwise from the x axis, not from the link before.
namespace linkwright::planar {

struct ArmLink {
  double length = 0;                ///< m, own joint to next joint or tip, > 0
  LinkMass body;                    ///< the link itself
  std::vector<PointMass> attached;  ///< masses fixed to it
};

struct SerialArm {
  std::complex<double> base{0};  ///< joint O1 (m)
  std::vector<ArmLink> links;
};

/// A link as the equations of motion see it.
struct ArmElement {
  double length = 0;  ///< m
  BaseParameters base;
};

/// One element for each link. Throws ContractError if there is no link, a length is not positive and finite,
/// or a mass is wrong (see base_parameters).
std::vector<ArmElement> elements(const SerialArm& arm);

/// A point in motion, global frame: m, m/s, m/s2.
struct ArmPointMotion {
  std::complex<double> position{0}, velocity{0}, acceleration{0};
};

/// A link in motion.
struct ArmLinkRates {
  std::complex<double> direction;      ///< e^(i angle) of the link line
  double speed = 0, acceleration = 0;  ///< rad/s, rad/s2, absolute
  ArmPointMotion joint;                ///< the link's own joint
};

/// A point of a link, given in its frame (m): own joint in the origin, link line along x.
ArmPointMotion point(const ArmLinkRates& link, std::complex<double> place);

/// Rates of all links from their absolute angles (motion[k].value, .rate, .acceleration; the jerk is not
/// used), outwards from the base. The tip is point(rates.back(), length of the last link). Allocates nothing.
///
/// Throws ContractError unless there are as many motions and rates as elements.
void rates(std::span<const ArmElement> arm, std::complex<double> base, std::span<const math::Motion> motion,
           std::span<ArmLinkRates> rates);

}  // namespace linkwright::planar
