// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::clearance {

/// The same four-bar as a linkage of planar/, without clearance: crank pin "A", "B", "O4"; driven at "O2".
inline planar::Linkage as_linkage(const ClearanceFourBar& m) {
  using namespace planar;
  const FourBar& l = m.linkage;
  const std::complex<double> pivot{l.pivot_x, l.pivot_y};
  Linkage out = grounded({{"O2", pivot}, {"O4", pivot + std::polar(l.ground, l.frame_angle)}});
  add_bar(out, "crank", "O2", "A", l.crank);
  add_body(out, "coupler", {{"A", {0, 0}}, {"B", {l.coupler, 0}}, {"P", {l.coupler_u, l.coupler_v}}});
  add_bar(out, "rocker", "O4", "B", l.rocker);
  add_pin(out, "O2", "ground.O2", "crank.O2");
  add_pin(out, "A", "crank.A", "coupler.A");
  add_pin(out, "B", "coupler.B", "rocker.B");
  add_pin(out, "O4", "ground.O4", "rocker.O4");
  add_drive(out, "O2");
  set_mode(out, "coupler", "rocker", l.branch == Branch::open ? AssemblyMode::plus : AssemblyMode::minus);
  out.bodies[1].mass = BodyMass{};
  out.bodies[2].mass = m.coupler;
  out.bodies[3].mass = m.rocker;
  out.gravity = m.gravity;
  if (m.coupler_damping > 0)
    out.torsion_springs.push_back({.name = "coupler", .first = 0, .second = 2, .damping = m.coupler_damping});
  if (m.rocker_damping > 0)
    out.torsion_springs.push_back({.name = "rocker", .first = 0, .second = 3, .damping = m.rocker_damping});
  return out;
}

inline std::vector<double> evenly_spaced(double from, double to, int samples) {
  std::vector<double> out;
  for (int k = 0; k < samples; ++k) out.push_back(from + (to - from) * k / (samples - 1));
  return out;
}

}  // namespace linkwright::clearance
