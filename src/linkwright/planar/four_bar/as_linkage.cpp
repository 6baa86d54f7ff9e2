// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/as_linkage.h"

#include <complex>
#include <vector>

#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {

Linkage linkage_of(const FourBarMechanism& mechanism) {
  const FourBar& f = mechanism.linkage;
  const std::complex<double> frame = std::polar(1.0, f.frame_angle), point(f.coupler_u, f.coupler_v);
  Linkage l = grounded({{"O1", crank_pivot(f)}, {"O4", rocker_pivot(f)}});
  add_body(l, "crank", {{"O1", 0}, {"O2", f.crank * frame}});
  std::vector<LinkagePoint> coupler{{"O2", 0}, {"O3", f.coupler * frame}};
  if (point != std::complex<double>()) coupler.push_back({"C", point * frame});
  add_body(l, "coupler", std::move(coupler));
  add_body(l, "rocker", {{"O4", 0}, {"O3", f.rocker * frame}});
  add_pin(l, "O1", "ground.O1", "crank.O1");
  add_pin(l, "O2", "crank.O2", "coupler.O2");
  add_pin(l, "O3", "rocker.O3", "coupler.O3");
  add_pin(l, "O4", "ground.O4", "rocker.O4");
  add_drive(l, "O1");
  set_mode(l, "coupler", "rocker", f.branch == Branch::open ? AssemblyMode::plus : AssemblyMode::minus);
  l.moment_centre = crank_pivot(f);
  if (!mechanism.masses) return l;
  const auto set = [&](LinkageBody& body, const LinkMass& m) {
    body.mass = BodyMass{m.mass, m.inertia, m.centre_distance * std::polar(1.0, m.centre_angle) * frame};
  };
  set(l.bodies[1], mechanism.masses->crank);
  set(l.bodies[2], mechanism.masses->coupler);
  set(l.bodies[3], mechanism.masses->rocker);
  return l;
}

}  // namespace linkwright::planar
