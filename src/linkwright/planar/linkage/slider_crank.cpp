// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/slider_crank.h"

#include <fmt/core.h>

#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

/// The force of the gas on the slider, against the angle of the crank from the x axis.
PointForce gas_force(const SliderCrankMechanism& mechanism, const GasPressure& gas) {
  const bool forward = mechanism.branch == SliderSide::forward;
  const double outer = mechanism.parameters.guide_angle + (forward ? 0 : pi);
  PointForce out{
      .name = "gas", .point = {3, 0}, .force = -0.25 * pi * gas.bore * gas.bore * std::polar(1.0, outer)};
  out.factor = {LoadArgument::input, gas.crank, gas.pressure};
  for (double& angle : out.factor.argument) angle += outer;
  return out;
}

}  // namespace

Linkage slider_crank(const SliderCrankMechanism& mechanism) {
  const SliderCrankForm& s = mechanism.parameters;
  const std::optional<SliderCrankMasses>& masses = mechanism.masses;
  const std::complex<double> pivot(s.pivot_x, s.pivot_y), along = std::polar(1.0, s.guide_angle);
  Linkage l = grounded({{"O", pivot}, {"guide", pivot + std::complex<double>(0, s.offset) * along}});
  add_body(l, "crank", {{"O", {0, 0}}, {"A", {s.crank, 0}}});
  std::vector<LinkagePoint> rod{{"A", {0, 0}}, {"B", {s.rod, 0}}};
  if (s.rod_u != 0 || s.rod_v != 0) rod.push_back({"C", {s.rod_u, s.rod_v}});
  add_body(l, "rod", std::move(rod));
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.guide", "slider.B", s.guide_angle, 0);
  add_drive(l, "O");
  set_mode(l, "rod", "slider",
           mechanism.branch == SliderSide::forward ? AssemblyMode::plus : AssemblyMode::minus);
  if (masses) {
    const auto link = [](const SliderCrankMass& m) {
      return BodyMass{m.mass, m.inertia, m.centre_distance * std::polar(1.0, m.centre_angle)};
    };
    const auto set = [&](LinkageBody& body, const SliderCrankMass& m) {
      body.mass = link(m);
      for (const PointMass& a : m.attached)
        body.attached.push_back({fmt::format("{} mass {}", body.name, body.attached.size() + 1), a.mass,
                                 std::polar(1.0, a.angle) * a.distance});
    };
    set(l.bodies[1], masses->crank);
    set(l.bodies[2], masses->rod);
    l.bodies[3].mass = BodyMass{masses->slider, 0, 0};
  }
  if (mechanism.gas) l.forces.push_back(gas_force(mechanism, *mechanism.gas));
  return l;
}

}  // namespace linkwright::planar
