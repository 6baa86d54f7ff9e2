// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkages.h"

// Linkages that tests of several units use.
namespace linkwright::planar {

using test::planned;

inline void add_bar(Linkage& l, const char* name, const char* from, const char* to, double length) {
  add_body(l, name, {{from, {0, 0}}, {to, {length, 0}}});
}

/// Crank O-A driven, coupler A-B, rocker B0-B; ground link along x.
inline Linkage four_bar_linkage(double ground, double crank, double coupler, double rocker) {
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {ground, 0}}});
  add_bar(l, "crank", "O", "A", crank);
  add_bar(l, "coupler", "A", "B", coupler);
  add_bar(l, "rocker", "B0", "B", rocker);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return l;
}

/// A row of n rods of length 1 on the ground, a distance 1 apart, their tips joined by couplers of length 1;
/// the first rod is driven. All lie in line when it is horizontal.
inline Linkage rod_row(int n) {
  std::vector<LinkagePoint> pivots;
  for (int i = 0; i < n; ++i) pivots.push_back({"P" + std::to_string(i), {static_cast<double>(i), 0}});
  Linkage l = grounded(pivots);
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i), rod = "rod" + k;
    add_body(l, rod, {{"foot", {0, 0}}, {"tip", {1, 0}}});
    add_pin(l, "pivot" + k, "ground.P" + k, rod + ".foot");
    if (i == 0) continue;
    const std::string before = "rod" + std::to_string(i - 1), coupler = "coupler" + k;
    add_body(l, coupler, {{"left", {0, 0}}, {"right", {1, 0}}});
    add_pin(l, "left" + k, before + ".tip", coupler + ".left");
    add_pin(l, "right" + k, coupler + ".right", rod + ".tip");
    set_mode(l, coupler, rod, AssemblyMode::plus);
  }
  add_drive(l, "pivot0");
  set_uniform_all(l, 1);
  return l;
}

inline Linkage jansen_leg() { return linkage_sample("jansen_leg").linkage; }

/// Crank that moves a plate on three legs, one from the crank and two from the ground: its four bodies are
/// one group without closed form (an Assur group of class III).
inline Linkage three_legged_plate() {
  Linkage l = grounded({{"O", {0, 0}}, {"G", {1.2, -0.2}}, {"H", {0.8, 1.1}}});
  add_bar(l, "crank", "O", "A", 0.2);
  add_bar(l, "leg1", "A", "P", 0.5);
  add_body(l, "plate", {{"P", {0, 0}}, {"Q", {0.5, 0}}, {"R", {0.25, 0.4}}});
  add_bar(l, "leg2", "G", "Q", 0.55);
  add_bar(l, "leg3", "H", "R", 0.6);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "leg1.A");
  add_pin(l, "P", "leg1.P", "plate.P");
  add_pin(l, "Q", "plate.Q", "leg2.Q");
  add_pin(l, "R", "plate.R", "leg3.R");
  add_pin(l, "G", "ground.G", "leg2.G");
  add_pin(l, "H", "ground.H", "leg3.H");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  return l;
}

}  // namespace linkwright::planar
