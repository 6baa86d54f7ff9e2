// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/math/vector2.h"

/// The link as an elastica, without cells: the angle of its line against the hub is
/// phi(s, t) = sum over k of a_k(t) times the integral of Legendre's P_k from 0 to s, and X' = cos phi, Y' =
/// sin phi. Geometrically exact for inextensible links without shear, of spectral accuracy; another
/// formulation, and another integration in time, to check chains with. Uniform links by Euler and Bernoulli
/// or Rayleigh, without damping and gravity; anything else is a ContractError.
namespace linkwright::flexible {

struct ReferenceOptions {
  int degree = 10;  ///< degree of the polynomials of the curvature, 1 to 20
  int points = 32;  ///< Gauss points along the link, more than degree, up to 64
};

/// Shape at the tip under a load that keeps its direction in the axes of the hub.
struct ReferenceShape {
  Status status = Status::done;  ///< not_converged: the load is beyond what Newton's method follows
  math::Vec2 tip;                ///< from O1 (m)
  double angle = 0;              ///< rad
};
ReferenceShape reference_shape(const Beam& beam, math::Vec2 tip_force, const ReferenceOptions& options = {});

/// First frequencies (rad/s) in the plane about the straight link on a hub that is driven at a steady speed
/// (rad/s).
std::vector<double> reference_frequencies(const Beam& beam, int count, double speed,
                                          const ReferenceOptions& options = {});

struct ReferenceRun {
  double end = 0;                       ///< s, from 0
  double output_interval = 0;           ///< s
  double tolerance = 1e-9;              ///< relative, of a step of an explicit method of order 8
  std::span<const double> breaks = {};  ///< times (s) at which the drive jumps or kinks
  ReferenceOptions beam = {};
  const RunContext* context = nullptr;  ///< looked at after every step; receives the stage "integration"
};

struct ReferenceMotion {
  Status status = Status::done;
  std::string message;          ///< says why it is not `done`
  std::vector<Sample> samples;  ///< at 0 and after each interval
};

/// From rest, undeformed, under a given turn of the hub or a given torque.
ReferenceMotion reference_motion(const Beam& beam, AngleLaw law, const ReferenceRun& run);
ReferenceMotion reference_torque(const Beam& beam, TorqueLaw law, const ReferenceRun& run);

}  // namespace linkwright::flexible
