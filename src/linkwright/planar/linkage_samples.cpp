#include "linkwright/planar/linkage_samples.h"

#include <cmath>
#include <numbers>

#include "linkwright/planar/linkage_build.h"

namespace linkwright::planar {
namespace {

constexpr double pi = std::numbers::pi;
using std::complex;

// A crank OA along its own x axis, pinned at ground.O and driven.
Linkage crank(std::vector<LinkagePoint> ground, double length) {
  Linkage l = grounded(std::move(ground));
  add_body(l, "crank", {{"O", {0, 0}}, {"A", {length, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_drive(l, "O");
  return l;
}
void add_bar(Linkage& l, const char* name, const char* from, const char* to, double length) {
  add_body(l, name, {{from, {0, 0}}, {to, {length, 0}}});
}
LinkageSample full_turn(std::string name, std::string summary, Linkage linkage,
                        std::vector<std::string_view> traces) {
  LinkageSample s{std::move(name), std::move(summary), std::move(linkage), {0}, {2 * pi}, 2 * pi, {}};
  for (std::string_view t : traces) s.traces.push_back(point_named(s.linkage, t));
  return s;
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

LinkageSample four_bar_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"B0", {0.6, 0}}}, 0.1);
  add_body(l, "coupler", {{"A", {0, 0}}, {"B", {0.4, 0}}, {"C", {0.25, 0.15}}});
  add_bar(l, "rocker", "B0", "B", 0.32);
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 2);
  return full_turn("four_bar", "A crank-rocker with a coupler point.", std::move(l), {"coupler.C"});
}

LinkageSample slider_crank_sample() {
  return full_turn("slider_crank",
                   "An engine in line: the slider's acceleration is larger at the far dead centre.",
                   slider_crank(0.05, 0.15, 0, 0), {"rod.B"});
}

LinkageSample offset_slider_crank_sample() {
  return full_turn("offset_slider_crank",
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
  return full_turn("inverted_slider_crank", "A rod through a swinging sleeve.", std::move(l), {"rod.end"});
}

LinkageSample scotch_yoke_sample() {
  Linkage l = crank({{"O", {0, 0}}, {"guide", {0.1, 0}}}, 0.05);
  add_body(l, "yoke", {{"slot", {0, 0}}, {"end", {0.12, 0}}});
  add_slot(l, "pin", "yoke.slot", "crank.A", pi / 2);
  add_slide(l, "guide", "ground.guide", "yoke.end");
  set_uniform_all(l, 2);
  return full_turn("scotch_yoke", "The yoke moves as the cosine of the crank angle, exactly.", std::move(l),
                   {"yoke.end"});
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
  return full_turn("whitworth", "A quick-return shaper: slow stroke one way, quick return.", std::move(l),
                   {"ram.tool"});
}

std::vector<LinkageSample> linkage_samples() {
  return {four_bar_sample(),
          slider_crank_sample(),
          offset_slider_crank_sample(),
          inverted_slider_crank_sample(),
          scotch_yoke_sample(),
          whitworth_sample()};
}

}  // namespace linkwright::planar
