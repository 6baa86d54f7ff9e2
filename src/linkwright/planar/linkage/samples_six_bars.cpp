// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

// A four-bar O A B B0 with a point C of the coupler and a point D of the rocker, driven at its crank.
Linkage four_bar_with_points(std::vector<LinkagePoint> more_ground) {
  std::vector<LinkagePoint> ground{{"O", {0, 0}}, {"B0", {0.14, 0}}};
  ground.insert(ground.end(), more_ground.begin(), more_ground.end());
  Linkage l = grounded(std::move(ground));
  add_bar(l, "crank", "O", "A", 0.05);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {0.13, 0}}, {"C", {0.08, 0.06}}});
  add_body(l, "rocker", {{"B0", {0, 0}}, {"B", {0.1, 0}}, {"D", {0.07, -0.04}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  return l;
}

}  // namespace

LinkageSample watt_1_sample() {
  Linkage l = four_bar_with_points({});
  add_bar(l, "link 1", "C", "E", 0.12);
  add_bar(l, "link 2", "D", "E", 0.16);
  add_pin(l, "C", "coupler.C", "link 1.C");
  add_pin(l, "D", "rocker.D", "link 2.D");
  add_pin(l, "E", "link 1.E", "link 2.E");
  set_mode(l, "link 1", "link 2", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("watt_1", "A six-bar whose second loop rides on coupler and rocker.", std::move(l),
                        {"link 1.E"});
}

LinkageSample watt_2_sample() {
  Linkage l = four_bar_with_points({{"H0", {0.26, -0.02}}});
  add_bar(l, "link", "D", "H", 0.13);
  add_bar(l, "output", "H0", "H", 0.12);
  add_pin(l, "D", "rocker.D", "link.D");
  add_pin(l, "H", "link.H", "output.H");
  add_pin(l, "H0", "ground.H0", "output.H0");
  set_mode(l, "link", "output", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("watt_2", "Two four-bars in a row: the rocker of the first drives the second.",
                        std::move(l), {"output.H"});
}

LinkageSample stephenson_3_sample() {
  Linkage l = four_bar_with_points({{"E0", {0.23, 0.09}}});
  add_bar(l, "link", "C", "E", 0.14);
  add_bar(l, "output", "E0", "E", 0.13);
  add_pin(l, "C", "coupler.C", "link.C");
  add_pin(l, "E", "link.E", "output.E");
  add_pin(l, "E0", "ground.E0", "output.E0");
  set_mode(l, "link", "output", AssemblyMode::minus);
  set_uniform_all(l, 2);
  return turning_sample("stephenson_3", "A point of the coupler drives a third bar: this gives dwells.",
                        std::move(l), {"link.E"});
}

LinkageSample stephenson_2_sample() {
  const std::complex<double> a(0.06, 0), q1(0.18, 0.27), q2(0.06, 0.39), p0(0.38, 0.07), p1(0.47, 0.13),
      p2(0.27, 0.42);
  Linkage l = grounded({{"O", {0, 0}}, {"P0", p0}});
  add_bar(l, "crank", "O", "A", 0.06);
  set_start(l, "crank", 0, 0);
  add_drawn(l, "plate", {{"A", a}, {"Q1", q1}, {"Q2", q2}});
  add_drawn(l, "rocker", {{"P0", p0}, {"P1", p1}, {"P2", p2}});
  add_drawn(l, "bar 1", {{"Q1", q1}, {"P1", p1}});
  add_drawn(l, "bar 2", {{"Q2", q2}, {"P2", p2}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "plate.A");
  add_pin(l, "P0", "ground.P0", "rocker.P0");
  add_pin(l, "Q1", "plate.Q1", "bar 1.Q1");
  add_pin(l, "P1", "bar 1.P1", "rocker.P1");
  add_pin(l, "Q2", "plate.Q2", "bar 2.Q2");
  add_pin(l, "P2", "bar 2.P2", "rocker.P2");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  return turning_sample("stephenson_2",
                        "A six-bar that does not fall into dyads: four bodies are solved at once.",
                        std::move(l), {"plate.Q2"});
}

LinkageSample triad_sample() {
  const std::complex<double> a(0.05, 0), d(0.27, 0.18), e(0.27, 0.29), f(0.45, 0.26), e0(0.12, 0.49),
      f0(0.5, 0.03);
  Linkage l = grounded({{"O", {0, 0}}, {"E0", e0}, {"F0", f0}});
  add_bar(l, "crank", "O", "A", 0.05);
  set_start(l, "crank", 0, 0);
  add_drawn(l, "rod", {{"A", a}, {"D", d}});
  add_drawn(l, "plate", {{"D", d}, {"E", e}, {"F", f}});
  add_drawn(l, "bar 1", {{"E0", e0}, {"E", e}});
  add_drawn(l, "bar 2", {{"F0", f0}, {"F", f}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "D", "rod.D", "plate.D");
  add_pin(l, "E", "bar 1.E", "plate.E");
  add_pin(l, "E0", "ground.E0", "bar 1.E0");
  add_pin(l, "F", "bar 2.F", "plate.F");
  add_pin(l, "F0", "ground.F0", "bar 2.F0");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  return turning_sample("triad",
                        "A plate on three bars, one of them on a crank: a group without closed form.",
                        std::move(l), {"plate.F"});
}

LinkageSample geared_five_bar_sample() {
  Linkage l = grounded({{"O", {0, 0}}, {"D0", {0.12, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "second crank", "D0", "D", 0.07);
  add_bar(l, "link 1", "A", "P", 0.15);
  add_bar(l, "link 2", "D", "P", 0.14);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "D0", "ground.D0", "second crank.D0");
  add_pin(l, "A", "crank.A", "link 1.A");
  add_pin(l, "D", "second crank.D", "link 2.D");
  add_pin(l, "P", "link 1.P", "link 2.P");
  add_gear(l, "gear", "crank", "second crank", -2, 0.4);
  add_drive(l, "O");
  set_mode(l, "link 1", "link 2", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("geared_five_bar", "The second crank turns twice as fast, the other way.",
                        std::move(l), {"link 1.P"});
}

}  // namespace linkwright::planar
