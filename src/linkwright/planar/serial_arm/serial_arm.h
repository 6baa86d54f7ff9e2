// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "linkwright/math/motion_law.h"
#include "linkwright/planar/link_mass.h"

/// @file
/// Open chains of links joined by revolute joints: model, positions and rates. Link k = 0, 1, ... has its own
/// joint O_k+1 (O1 joins the first link to the ground) and carries the next one, or the tip, at the end of
/// its line. Angles of links are absolute: counter-clockwise from the x axis, not from the link before.
namespace linkwright::planar {

/// One link of an arm with the masses fixed to it.
struct ArmLink {
  double length = 0;                ///< m, own joint to next joint or tip, > 0
  LinkMass body;                    ///< the link itself
  std::vector<PointMass> attached;  ///< masses fixed to it
};

/// An open chain of links.
struct SerialArm {
  std::complex<double> base{0};  ///< joint O1 (m)
  std::vector<ArmLink> links;    ///< from the base outwards
};

/// A link as the equations of motion see it.
struct ArmElement {
  double length = 0;    ///< m
  BaseParameters base;  ///< base parameters of the link with the masses fixed to it
};

/// The links of an arm as the equations of motion need them.
///
/// @param arm the arm
/// @returns one element for each link
/// @throws ContractError if there is no link, a length is not positive and finite, or a mass is wrong (see
///   base_parameters)
std::vector<ArmElement> elements(const SerialArm& arm);

/// A point in motion, global frame: m, m/s, m/s2.
struct ArmPointMotion {
  std::complex<double> position{0},  ///< m
      velocity{0},                   ///< m/s
      acceleration{0};               ///< m/s2
};

/// A link in motion.
struct ArmLinkRates {
  std::complex<double> direction;  ///< e^(i angle) of the link line
  double speed = 0,                ///< absolute, rad/s
      acceleration = 0;            ///< absolute, rad/s2
  ArmPointMotion joint;            ///< the link's own joint
};

/// The motion of a point of a link.
///
/// @param link the link in motion
/// @param place the point in the frame of the link (m): own joint in the origin, link line along x
/// @returns its motion in the global frame
ArmPointMotion point(const ArmLinkRates& link, std::complex<double> place);

/// Rates of all links from their absolute angles, outwards from the base. The tip is point(rates.back(),
/// length of the last link). Allocates nothing.
///
/// @param arm the links, from the base outwards
/// @param base position of the joint O1, global (m)
/// @param motion absolute angle, rate and acceleration of each link (rad, rad/s, rad/s2); the jerk is not
///   used
/// @param rates receives the rates, one a link
/// @throws ContractError unless there are as many motions and rates as elements
void rates(std::span<const ArmElement> arm, std::complex<double> base, std::span<const math::Motion> motion,
           std::span<ArmLinkRates> rates);

}  // namespace linkwright::planar
