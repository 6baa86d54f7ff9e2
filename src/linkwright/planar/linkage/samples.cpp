// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/samples.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using std::complex;

// A crank OA along its own x axis, pinned at ground.O and driven.
Linkage crank(std::vector<LinkagePoint> ground, double length) {
  Linkage l = grounded(std::move(ground));
  add_bar(l, "crank", "O", "A", length);
  add_pin(l, "O", "ground.O", "crank.O");
  add_drive(l, "O");
  return l;
}

Linkage slider_crank(double crank_length, double rod, double offset, double direction) {
  const complex<double> e = std::polar(1.0, direction);
  Linkage l = crank({{"O", {0, 0}}, {"guide", complex<double>(0, offset) * e}}, crank_length);
  add_bar(l, "rod", "A", "B", rod);
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.guide", "slider.B", direction);
  set_mode(l, "rod", "slider", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return l;
}

}  // namespace

LinkageSample turning_sample(std::string name, std::string summary, Linkage linkage,
                             std::initializer_list<std::string_view> traces) {
  std::vector<BodyPoint> points = points_named(linkage, traces);
  return {std::move(name), std::move(summary), std::move(linkage), {0}, {2 * pi}, 2 * pi, std::move(points)};
}

LinkageSample four_bar_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"B0", {0.6, 0}}}, 0.1);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {0.4, 0}}, {"C", {0.25, 0.15}}});
  add_bar(l, "rocker", "B0", "B", 0.32);
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("four_bar", "A crank-rocker with a coupler point.", std::move(l), {"coupler.C"});
}

LinkageSample slider_crank_sample() {
  return turning_sample("slider_crank",
                        "An engine in line: the slider's acceleration is larger at the far dead centre.",
                        slider_crank(0.05, 0.15, 0, 0), {"rod.B"});
}

LinkageSample offset_slider_crank_sample() {
  return turning_sample("offset_slider_crank",
                        "Offset and inclined guide: the slider takes longer one way than the other.",
                        slider_crank(0.05, 0.16, 0.03, 0.25), {"slider.B"});
}

LinkageSample inverted_slider_crank_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"B0", {0.14, 0}}}, 0.05);
  add_body(l, "rod", {{"A", {0, 0}}, {"end", {0.2, 0}}});
  add_body(l, "sleeve", {{"B0", {0, 0}}, {"slide", {0, 0.02}}});
  add_pin(l, "A", "crank.A", "rod.A");
  add_slide(l, "sleeve", "rod.A", "sleeve.slide");
  add_pin(l, "B0", "ground.B0", "sleeve.B0");
  set_mode(l, "rod", "sleeve", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("inverted_slider_crank", "A rod through a swinging sleeve.", std::move(l),
                        {"rod.end"});
}

LinkageSample scotch_yoke_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"guide", {0.1, 0}}}, 0.05);
  add_body(l, "yoke", {{"slot", {0, 0}}, {"end", {0.12, 0}}});
  add_slot(l, "pin", "yoke.slot", "crank.A", pi / 2);
  add_slide(l, "guide", "ground.guide", "yoke.end");
  set_uniform_all(l, 2);
  return turning_sample("scotch_yoke", "The yoke moves as the cosine of the crank angle, exactly.",
                        std::move(l), {"yoke.end"});
}

LinkageSample whitworth_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"P", {0, -0.08}}, {"guide", {0, 0.22}}}, 0.05);
  add_body(l, "lever", {{"P", {0, 0}}, {"end", {0.25, 0}}});
  add_bar(l, "link", "E", "F", 0.12);
  add_body(l, "ram", {{"F", {0, 0}}, {"tool", {-0.1, 0}}});
  add_slot(l, "slot", "lever.P", "crank.A", 0);
  add_pin(l, "P", "ground.P", "lever.P");
  add_pin(l, "E", "lever.end", "link.E");
  add_pin(l, "F", "link.F", "ram.F");
  add_slide(l, "guide", "ground.guide", "ram.F");
  set_mode(l, "lever", "lever", AssemblyMode::plus);
  set_mode(l, "link", "ram", AssemblyMode::minus);
  set_uniform_all(l, 2);
  return turning_sample("whitworth", "A quick-return shaper: slow stroke one way, quick return.",
                        std::move(l), {"ram.tool"});
}

LinkageSample toggle_press_sample() {
  Linkage l = crank({{"O", {0.3, 0.27}}, {"P", {0, 0.5}}, {"guide", {0, 0}}}, 0.04);
  add_bar(l, "rod", "A", "K", 0.25);
  add_bar(l, "upper", "P", "K", 0.24);
  add_bar(l, "lower", "K", "R", 0.24);
  add_body(l, "ram", {{"R", {0, 0}}, {"tool", {0, -0.05}}});
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "P", "ground.P", "upper.P");
  add_pin(l, "K", "rod.K", "upper.K");
  add_pin(l, "K lower", "upper.K", "lower.K");
  add_pin(l, "R", "lower.R", "ram.R");
  add_slide(l, "guide", "ground.guide", "ram.R", -pi / 2, -pi / 2);
  set_mode(l, "rod", "upper", AssemblyMode::plus);
  set_mode(l, "lower", "ram", AssemblyMode::plus);
  set_uniform_all(l, 20);
  set_uniform(l, "ram", 25);
  // Nothing until the tool meets the work 8 mm above the end of the stroke, then up to 20 kN.
  l.forces.push_back({.name = "work",
                      .point = point_named(l, "ram.tool"),
                      .force = {0, 20000},
                      .factor = {LoadArgument::y, {-0.030, -0.028, -0.022}, {1, 0.6, 0}}});
  return turning_sample("toggle_press",
                        "A knee between crank and ram: the torque stays small where the force is large.",
                        std::move(l), {"ram.tool", "upper.K"});
}

LinkageSample hoeken_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"B0", {0.2, 0}}}, 0.1);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {0.25, 0}}, {"pen", {0.5, 0}}});
  add_bar(l, "rocker", "B0", "B", 0.25);
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return turning_sample("hoeken",
                        "The pen runs straight while the crank turns through the half away from B0.",
                        std::move(l), {"coupler.pen"});
}

LinkageSample chebyshev_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"B0", {0.2, 0}}}, 0.25);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {0.1, 0}}, {"pen", {0.05, 0}}});
  add_bar(l, "rocker", "B0", "B", 0.25);
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  set_mode(l, "coupler", "rocker", AssemblyMode::minus);
  set_uniform_all(l, 2);
  LinkageSample s = turning_sample("chebyshev", "The middle of the coupler runs on a line at 0.2 m, almost.",
                                   std::move(l), {"coupler.pen"});
  // The dead points are at acos(0.8) and acos(-0.2).
  s.from = {0.66};
  s.to = {1.76};
  return s;
}

std::span<const LinkageSample> linkage_samples() {
  static const std::vector<LinkageSample> all = [] {
    std::vector<LinkageSample> out{four_bar_sample(),
                                   slider_crank_sample(),
                                   offset_slider_crank_sample(),
                                   inverted_slider_crank_sample(),
                                   scotch_yoke_sample(),
                                   whitworth_sample(),
                                   toggle_press_sample(),
                                   hoeken_sample(),
                                   chebyshev_sample(),
                                   watt_1_sample(),
                                   watt_2_sample(),
                                   stephenson_2_sample(),
                                   stephenson_3_sample(),
                                   triad_sample(),
                                   klann_leg_sample(),
                                   jansen_leg_sample(),
                                   peaucellier_sample(),
                                   pantograph_sample(),
                                   geared_five_bar_sample(),
                                   andrews_squeezer_sample(),
                                   arm_sample(3),
                                   four_bar_chain_sample(4)};
    return out;
  }();
  return all;
}

const LinkageSample& linkage_sample(std::string_view name) {
  const std::span<const LinkageSample> all = linkage_samples();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const LinkageSample& s) { return s.name == name; });
  LINKWRIGHT_REQUIRE(found != all.end(), "there is no sample '{}'", name);
  return *found;
}

}  // namespace linkwright::planar
