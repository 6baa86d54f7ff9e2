// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <complex>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/linkages.h"

// The same linkage in another place, and other models as linkages.
namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// Mirrors at the x axis (if so), then turns, then shifts.
struct Change {
  double angle = 0;
  std::complex<double> shift;
  bool mirrored = false;

  std::complex<double> vector(std::complex<double> z) const {
    return std::polar(1.0, angle) * (mirrored ? std::conj(z) : z);
  }
  math::Vec2 vector(const math::Vec2& v) const { return math::vec(vector(number(v))); }
  math::Vec2 point(const math::Vec2& v) const { return math::vec(shift + vector(number(v))); }
  double sense() const { return mirrored ? -1 : 1; }
};

/// The linkage as it lies after the change. The frames of moving bodies are mirrored, not turned; the ground
/// frame stays the global one. Loads whose tables go by x or y are left out, on both sides of a comparison.
inline Linkage apply(const Change& c, const Linkage& original) {
  Linkage l = original;
  std::vector<std::pair<int, int>> three_pins;  // pairs whose sides the mirror swaps
  for (const Group& g : planned(original).groups)
    if (traits_of(g).name == "RRR") three_pins.emplace_back(g.parts[0], g.parts[1]);
  const LinkagePlan p = planned(original);
  for (std::size_t b = 0; b < l.bodies.size(); ++b) {
    LinkageBody& body = l.bodies[b];
    for (LinkagePoint& at : body.points)
      at.at = b == 0 ? c.shift + c.vector(at.at) : c.mirrored ? std::conj(at.at) : at.at;
    if (body.mass && c.mirrored) body.mass->centre = std::conj(body.mass->centre);
    if (c.mirrored)
      for (AttachedMass& a : body.attached) a.at = std::conj(a.at);
    if (body.start) {
      const std::complex<double> o = c.shift + c.vector(std::complex<double>(body.start->x, body.start->y));
      body.start = math::Pose{o.real(), o.imag(), c.angle + c.sense() * body.start->angle};
    }
  }
  for (LinkageJoint& j : l.joints) {
    j.slide_first = c.sense() * j.slide_first + (j.first.body == 0 ? c.angle : 0);
    j.slide_second = c.sense() * j.slide_second + (j.second.body == 0 ? c.angle : 0);
    // Bodies turn by `angle` against the ground, if the carrier is the ground.
    j.phase = c.sense() * j.phase + (j.carrier == 0 ? (1 - j.ratio) * c.angle : 0);
  }
  for (DyadMode& m : l.modes) {
    const int a = p.bodies[index(m.first)].part, b = p.bodies[index(m.second)].part;
    const bool swapped = std::any_of(three_pins.begin(), three_pins.end(), [&](const auto& pair) {
      return pair == std::pair{a, b} || pair == std::pair{b, a};
    });
    if (c.mirrored && swapped)
      m.mode = m.mode == AssemblyMode::plus ? AssemblyMode::minus : AssemblyMode::plus;
  }
  for (PointForce& f : l.forces) {
    f.force = f.turns_with_body ? (c.mirrored ? std::conj(f.force) : f.force) : c.vector(f.force);
  }
  for (BodyTorque& t : l.torques) t.torque *= c.sense();
  std::erase_if(l.forces, [](const PointForce& f) {
    return f.factor.against == LoadArgument::x || f.factor.against == LoadArgument::y;
  });
  l.gravity = c.vector(l.gravity);
  return l;
}
/// The inputs after the change: angles from the ground are turned, all angles mirrored.
inline std::vector<InputMotion> apply(const Change& c, const Linkage& original,
                                      std::vector<InputMotion> inputs) {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const LinkageJoint& j = original.joints[index(original.driven[k])];
    if (j.type != JointType::revolute) continue;
    const double turned = j.first.body == 0 ? c.angle : j.second.body == 0 ? -c.angle : 0.0;
    inputs[k] = {c.sense() * inputs[k].value + turned, c.sense() * inputs[k].rate,
                 c.sense() * inputs[k].acceleration};
  }
  return inputs;
}
inline LinkageSample apply(const Change& c, const LinkageSample& original) {
  LinkageSample s = original;
  s.linkage = apply(c, original.linkage);
  std::vector<InputMotion> ends[2];
  for (std::size_t k = 0; k < s.from.size(); ++k) {
    ends[0].push_back({s.from[k], 0, 0});
    ends[1].push_back({s.to[k], 0, 0});
  }
  for (auto& end : ends) end = apply(c, original.linkage, end);
  for (std::size_t k = 0; k < s.from.size(); ++k) s.from[k] = ends[0][k].value, s.to[k] = ends[1][k].value;
  return s;
}

/// A four-bar as a linkage: bodies crank, coupler, rocker; driven at its crank by the angle from the global x
/// axis.
inline Linkage linkage_of(const FourBar& b) {
  Linkage l = grounded({{"O", crank_pivot(b)}, {"B0", rocker_pivot(b)}});
  add_bar(l, "crank", "O", "A", b.crank);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {b.coupler, 0}}, {"C", {b.coupler_u, b.coupler_v}}});
  add_bar(l, "rocker", "B0", "B", b.rocker);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "rocker.B", "coupler.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", b.branch == Branch::open ? AssemblyMode::plus : AssemblyMode::minus);
  return l;
}

}  // namespace linkwright::planar::test
