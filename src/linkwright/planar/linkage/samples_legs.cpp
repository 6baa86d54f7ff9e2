// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::planar {
namespace {

// The third corner of a triangle on the base (0,0)-(base,0), to its left.
std::complex<double> corner(double base, double from_start, double from_end) {
  const double x = (base * base + from_start * from_start - from_end * from_end) / (2 * base);
  return {x, std::sqrt(from_start * from_start - x * x)};
}

}  // namespace

LinkageSample klann_leg_sample() {
  // Drawn with the crank to the left; joint numbers are those of the patent.
  const std::complex<double> upper_axle(1.366, 1.366), lower_axle(1.009, 0.574), shaft(1.599, 0.750);
  const std::complex<double> crank_pin(1.331, 0.750), elbow(0.741, 0.750), knee(0.232, 0.866),
      hip(0.866, 1.5), foot(0, 0);
  Linkage l = grounded({{"P15", shaft}, {"P9", upper_axle}, {"P11", lower_axle}});
  add_bar(l, "crank", "P15", "P29", std::abs(crank_pin - shaft));
  set_start(l, "crank", shaft, pi);
  add_drawn(l, "rod", {{"P29", crank_pin}, {"P27", elbow}, {"P35", knee}});
  add_drawn(l, "lower rocker", {{"P11", lower_axle}, {"P27", elbow}});
  add_drawn(l, "leg", {{"P35", knee}, {"P37", hip}, {"foot", foot}});
  add_drawn(l, "upper rocker", {{"P9", upper_axle}, {"P37", hip}});
  add_pin(l, "P15", "ground.P15", "crank.P15");
  add_pin(l, "P29", "crank.P29", "rod.P29");
  add_pin(l, "P27", "rod.P27", "lower rocker.P27");
  add_pin(l, "P11", "ground.P11", "lower rocker.P11");
  add_pin(l, "P35", "rod.P35", "leg.P35");
  add_pin(l, "P37", "leg.P37", "upper rocker.P37");
  add_pin(l, "P9", "ground.P9", "upper rocker.P9");
  add_drive(l, "P15");
  set_uniform_all(l, 2);
  const std::vector<BodyPoint> traces = points_named(l, {"leg.foot"});
  return {"klann_leg",  "A walking leg: the foot runs almost straight over half a turn.",
          std::move(l), {pi},
          {3 * pi},     2 * pi,
          traces};
}

LinkageSample jansen_leg_sample() {
  constexpr double unit = 0.01;  // m
  constexpr double a = 38 * unit, b = 41.5 * unit, c = 39.3 * unit, d = 40.1 * unit, e = 55.8 * unit,
                   f = 39.4 * unit, g = 36.7 * unit, h = 65.7 * unit, i = 49 * unit, j = 50 * unit,
                   k = 61.9 * unit, drop = 7.8 * unit, m = 15 * unit;
  Linkage l = grounded({{"O", {0, 0}}, {"G", {-a, -drop}}});
  add_bar(l, "crank", "O", "A", m);
  add_bar(l, "upper rod", "A", "U", j);
  add_body(l, "upper plate", {{"G", {0, 0}}, {"U", {b, 0}}, {"L", corner(b, d, e)}});
  add_bar(l, "lower rod", "A", "W", k);
  add_bar(l, "lower rocker", "G", "W", c);
  add_bar(l, "side rod", "L", "V", f);
  add_body(l, "foot plate", {{"W", {0, 0}}, {"V", {g, 0}}, {"foot", corner(g, i, h)}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A upper", "crank.A", "upper rod.A");
  add_pin(l, "A lower", "crank.A", "lower rod.A");
  add_pin(l, "U", "upper rod.U", "upper plate.U");
  add_pin(l, "G upper", "ground.G", "upper plate.G");
  add_pin(l, "W", "lower rod.W", "lower rocker.W");
  add_pin(l, "G lower", "ground.G", "lower rocker.G");
  add_pin(l, "L", "upper plate.L", "side rod.L");
  add_pin(l, "V", "side rod.V", "foot plate.V");
  add_pin(l, "W foot", "lower rocker.W", "foot plate.W");
  add_drive(l, "O");
  set_mode(l, "upper rod", "upper plate", AssemblyMode::minus);
  set_mode(l, "lower rod", "lower rocker", AssemblyMode::plus);
  set_mode(l, "side rod", "foot plate", AssemblyMode::minus);
  set_uniform_all(l, 2);
  const std::vector<BodyPoint> traces = points_named(l, {"foot plate.foot"});
  return {"jansen_leg", "A leg of the Strandbeest: the foot stays level on the ground.",
          std::move(l), {0},
          {2 * pi},     2 * pi,
          traces};
}

LinkageSample peaucellier_sample() {
  constexpr double crank = 0.1, arm = 0.3, side = 0.15, start = -1.3;
  Linkage l = grounded({{"Q", {crank, 0}}, {"O", {0, 0}}});
  add_bar(l, "crank", "Q", "P", crank);
  add_bar(l, "arm 1", "O", "A", arm);
  add_bar(l, "arm 2", "O", "B", arm);
  add_bar(l, "side 1", "P", "A", side);
  add_bar(l, "side 2", "P", "B", side);
  add_bar(l, "side 3", "A", "pen", side);
  add_bar(l, "side 4", "B", "pen", side);
  add_pin(l, "Q", "ground.Q", "crank.Q");
  add_pin(l, "O1", "ground.O", "arm 1.O");
  add_pin(l, "O2", "ground.O", "arm 2.O");
  add_pin(l, "P1", "crank.P", "side 1.P");
  add_pin(l, "P2", "crank.P", "side 2.P");
  add_pin(l, "A1", "arm 1.A", "side 1.A");
  add_pin(l, "B1", "arm 2.B", "side 2.B");
  add_pin(l, "A2", "arm 1.A", "side 3.A");
  add_pin(l, "B2", "arm 2.B", "side 4.B");
  add_pin(l, "pen", "side 3.pen", "side 4.pen");
  add_drive(l, "Q");
  // A to the left of O -> P, B to the right; the pen beyond both.
  set_mode(l, "arm 1", "side 1", AssemblyMode::plus);
  set_mode(l, "arm 2", "side 2", AssemblyMode::minus);
  set_mode(l, "side 3", "side 4", AssemblyMode::plus);
  set_uniform_all(l, 2);
  const std::vector<BodyPoint> traces = points_named(l, {"side 3.pen", "crank.P"});
  return {"peaucellier", "An inversor: it turns the circle of P through O into a straight line.",
          std::move(l),  {start},
          {-start},      2,
          traces};
}

LinkageSample pantograph_sample() {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "arm", {{"O", {0, 0}}, {"A", {0.2, 0}}, {"B", {0.4, 0}}});
  add_bar(l, "inner", "A", "T", 0.15);
  add_body(l, "outer", {{"B", {0, 0}}, {"D", {0.15, 0}}, {"pen", {0.3, 0}}});
  add_bar(l, "link", "T", "D", 0.2);
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "A", "arm.A", "inner.A");
  add_pin(l, "B", "arm.B", "outer.B");
  add_pin(l, "T", "inner.T", "link.T");
  add_pin(l, "D", "outer.D", "link.D");
  add_drive(l, "O");
  add_drive(l, "A");
  // The parallelogram A B D T: D lies to the left of B -> T when `inner` is turned clockwise from `arm`.
  set_mode(l, "outer", "link", AssemblyMode::plus);
  set_uniform_all(l, 2);
  const std::vector<BodyPoint> traces = points_named(l, {"inner.T", "outer.pen"});
  return {
      "pantograph", "The pen copies the tracer T, twice as large.", std::move(l), {1.9, -0.6}, {0.9, -2.1}, 1,
      traces};
}

LinkageSample andrews_squeezer_sample() {
  constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035,
                   sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04,
                   ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
  const std::complex<double> o(0, 0), a(-0.06934, -0.00227), b(-0.03635, 0.03273), c(0.014, 0.072);
  // Start angles beta, theta, gamma, phi, delta, Omega, epsilon.
  constexpr std::array<double, 7> q{-0.0617138900142764496358948458001, 0,
                                    0.455279819163070380255912382449,   0.222668390165885884674473185609,
                                    0.487364979543842550225598953530,   -0.222668390165885884674473185609,
                                    1.23054744454982119249735015568};
  Linkage l = grounded({{"O", o}, {"A", a}, {"B", b}, {"C", c}});
  l.gravity = 0;
  add_bar(l, "K1", "O", "F", rr);
  add_body(l, "K2", {{"F", {0, 0}}, {"E", {-d, 0}}});
  add_body(l, "K3", {{"B", {0, 0}}, {"E", {0, -ss}}, {"D", {sd, -sc}}});
  add_body(l, "K4", {{"G", {0, 0}}, {"E", {0, -e}}});
  add_bar(l, "K5", "A", "G", zt);
  add_bar(l, "K6", "H", "E", zf);
  add_body(l, "K7", {{"A", {0, 0}}, {"H", {0, -u}}});
  const auto mass = [&](const char* name, double m, double inertia, std::complex<double> centre) {
    l.bodies[static_cast<std::size_t>(body_index(l, name))].mass = BodyMass{m, inertia, centre};
  };
  mass("K1", 0.04325, 2.194e-6, {ra, 0});
  mass("K2", 0.00365, 4.410e-7, {-da, 0});
  mass("K3", 0.02373, 5.255e-6, {sb, -sa});
  mass("K4", 0.00706, 5.667e-7, {0, ea - e});
  mass("K5", 0.07050, 1.169e-5, {ta, tb});
  mass("K6", 0.00706, 5.667e-7, {zf - fa, 0});
  mass("K7", 0.05498, 1.912e-5, {-ub, -ua});
  const std::complex<double> f = o + std::polar(rr, q[0]), g = a + std::polar(zt, q[4]),
                             h = a + std::polar(u, q[6] - pi / 2);
  set_start(l, "K1", o, q[0]);
  set_start(l, "K2", f, q[0] + q[1]);
  set_start(l, "K3", b, q[2]);
  set_start(l, "K4", g, q[3] + q[4]);
  set_start(l, "K5", a, q[4]);
  set_start(l, "K6", h, q[5] + q[6]);
  set_start(l, "K7", a, q[6]);
  add_pin(l, "O", "ground.O", "K1.O");
  add_pin(l, "F", "K1.F", "K2.F");
  add_pin(l, "B", "ground.B", "K3.B");
  add_pin(l, "E2", "K3.E", "K2.E");
  add_pin(l, "E4", "K3.E", "K4.E");
  add_pin(l, "E6", "K3.E", "K6.E");
  add_pin(l, "G", "K5.G", "K4.G");
  add_pin(l, "A5", "ground.A", "K5.A");
  add_pin(l, "H", "K7.H", "K6.H");
  add_pin(l, "A7", "ground.A", "K7.A");
  add_drive(l, "O");
  l.springs.push_back({"DC", point_named(l, "K3.D"), point_named(l, "ground.C"), 4530, 0.07785, 0});
  l.torques.push_back({.name = "motor", .body = body_index(l, "K1"), .from = 0, .torque = 0.033});
  const std::vector<BodyPoint> traces = points_named(l, {"K3.E", "K5.G", "K7.H"});
  return {"andrews_squeezer",
          "Seven bodies, a stiff spring and a small fast crank.",
          std::move(l),
          {q[0]},
          {q[0] + 2 * pi},
          100,
          traces};
}

LinkageSample arm_sample(int links) {
  LINKWRIGHT_REQUIRE(links >= 1, "an arm has at least 1 link, got {}", links);
  Linkage l = grounded({{"base", {0, 0}}});
  LinkageSample s{"arm", "Bars in a row, each driven against the one before.", {}, {}, {}, 1, {}};
  std::string last = "ground.base";
  for (int k = 1; k <= links; ++k) {
    const std::string name = "link " + std::to_string(k);
    add_bar(l, name, "from", "to", 0.4);
    add_pin(l, "joint " + std::to_string(k), last, name + ".from");
    add_drive(l, "joint " + std::to_string(k));
    last = name + ".to";
    s.from.push_back(k == 1 ? 0.4 : 0.3);
    s.to.push_back(k == 1 ? 1.8 : -1.2 / k);
  }
  set_uniform_all(l, 2);
  s.traces = points_named(l, {last});
  s.linkage = std::move(l);
  return s;
}

LinkageSample four_bar_chain_sample(int loops) {
  LINKWRIGHT_REQUIRE(loops >= 1, "a chain has at least 1 loop, got {}", loops);
  std::vector<LinkagePoint> pivots;
  for (int k = 0; k <= loops; ++k) pivots.push_back({"P" + std::to_string(k), {1.0 * k, 0}});
  Linkage l = grounded(pivots);
  const double start = pi / 2 - 1.2;
  const std::complex<double> up = std::polar(1.0, start);
  for (int k = 0; k <= loops; ++k) {
    const std::string n = std::to_string(k), before = std::to_string(k - 1);
    add_bar(l, "rocker " + n, "P", "B", 1);
    set_start(l, "rocker " + n, 1.0 * k, start);
    add_pin(l, "P" + n, "ground.P" + n, "rocker " + n + ".P");
    if (k == 0) continue;
    add_bar(l, "coupler " + n, "A", "B", 1);
    set_start(l, "coupler " + n, 1.0 * (k - 1) + up, 0);
    add_pin(l, "A" + n, "rocker " + before + ".B", "coupler " + n + ".A");
    add_pin(l, "B" + n, "coupler " + n + ".B", "rocker " + n + ".B");
  }
  add_drive(l, "P0");
  set_uniform_all(l, 1);
  const std::vector<BodyPoint> traces = points_named(l, {"rocker 0.B"});
  return {"four_bar_chain",
          "Parallelograms in a row: all rockers stay parallel.",
          std::move(l),
          {start},
          {pi / 2 + 1.2},
          1,
          traces};
}

}  // namespace linkwright::planar
