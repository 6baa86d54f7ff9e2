// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "linkwright/clearance/automatic_contact.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/joint_orbit.h"
#include "linkwright/clearance/mass_synthesis.h"
#include "linkwright/clearance/sensitivity.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::clearance {
namespace {

// Position, rates and forces at one instant.
void clearance_four_bar_instant(benchmark::State& state) {
  const ClearanceFourBar model = published_design_2();
  double angle = 0;
  for (auto _ : state) {
    angle += 1e-3;
    benchmark::DoNotOptimize(clearance_instant(model, angle, 10, 0, {angle + 0.1, 12}));
  }
}
BENCHMARK(clearance_four_bar_instant);

// One turn of the crank at tolerances of 10^-range.
void clearance_four_bar_turn(benchmark::State& state) {
  const ClearanceFourBar model = published_design_2();
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(phase_error(model, {0, 10}, {0.17, 10}, 0.17, 72, {tolerance, tolerance / 100}));
}
BENCHMARK(clearance_four_bar_turn)->Arg(8)->Arg(10)->Unit(benchmark::kMicrosecond);

void clearance_four_bar_orbit(benchmark::State& state) {
  const ClearanceFourBar model = published_design_2();
  for (auto _ : state) benchmark::DoNotOptimize(find_orbit(model, {0, 10}, 0.15, -0.3));
}
BENCHMARK(clearance_four_bar_orbit)->Unit(benchmark::kMillisecond);

// Slider-crank of the literature, one turn at 5000 rpm: some 28 contacts.
planar::Linkage slider_crank() {
  using namespace planar;
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "B", 0.12);
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.O", "slider.B");
  add_drive(l, "O");
  set_start(l, "rod", {0.05, 0}, 0);
  set_start(l, "slider", {0.17, 0}, 0);
  l.bodies[1].mass = BodyMass{0.3, 1e-4, {0.025, 0}};
  l.bodies[2].mass = BodyMass{0.21, 2.5e-4, {0.06, 0}};
  l.bodies[3].mass = BodyMass{0.14, 0, {0, 0}};
  l.gravity = 0;
  return l;
}
void clearance_contact_slider_crank(benchmark::State& state) {
  const planar::Linkage l = slider_crank();
  const ContactJoint joint{.joint = planar::joint_index(l, "B"),
                           .clearance = 5e-4,
                           .bush_radius = 0.01,
                           .law = {.stiffness = pin_stiffness(0.01, 0.0095),
                                   .restitution = 0.9,
                                   .damping = ContactDamping::lankarani_nikravesh}};
  const planar::InputDrive crank{math::ConstantSpeed{0, 5000 * full_turn / 60}, 0, 0};
  const std::vector<double> times{0, 0.012};
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  std::size_t contacts = 0;
  long steps = 0, evaluations = 0;
  for (auto _ : state) {
    const ContactRun run =
        simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), times, {.tolerance = tolerance});
    contacts = run.events.size();
    steps = run.steps;
    evaluations = run.evaluations;
  }
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["steps"] = static_cast<double>(steps);
  state.counters["evaluations"] = static_cast<double>(evaluations);
}
BENCHMARK(clearance_contact_slider_crank)->Arg(7)->Arg(9)->Unit(benchmark::kMillisecond);

// The limit of the one before: its equations of motion once, which every step needs six times.
void clearance_contact_equations(benchmark::State& state) {
  const planar::Linkage l = slider_crank();
  OpenLinkage open = open_linkage(l, std::vector{planar::joint_index(l, "B")}, std::vector{0.0});
  std::vector<bool> free(open.plan.inputs(), true);
  free[0] = false;
  planar::LinkageDynamics dynamics(open.linkage, open.plan, free);
  std::vector<planar::InputMotion> inputs;
  for (const double value : open.start) inputs.push_back({value, 1, 0});
  for (auto _ : state) {
    inputs[0].value += 1e-3;
    benchmark::DoNotOptimize(dynamics.solve(0, inputs));
  }
}
BENCHMARK(clearance_contact_equations);

// A turn of the design that loses contact: continuous contact, the loss, five impacts.
planar::Linkage loose_four_bar(const ClearanceFourBar& m) {
  using namespace planar;
  const FourBar& f = m.linkage;
  Linkage l = grounded({{"O2", {0, 0}}, {"O4", std::polar(f.ground, f.frame_angle)}});
  add_bar(l, "crank", "O2", "A", f.crank);
  add_bar(l, "coupler", "A", "B", f.coupler);
  add_bar(l, "rocker", "O4", "B", f.rocker);
  add_pin(l, "O2", "ground.O2", "crank.O2");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "O4", "ground.O4", "rocker.O4");
  add_drive(l, "O2");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  l.bodies[1].mass = BodyMass{};
  l.bodies[2].mass = m.coupler;
  l.bodies[3].mass = m.rocker;
  l.gravity = 0;
  return l;
}
void clearance_automatic_four_bar(benchmark::State& state) {
  ClearanceFourBar design = published_design_1();
  const planar::Linkage l = loose_four_bar(design);
  const AutomaticPin pin{.contact = {.joint = planar::joint_index(l, "A"),
                                     .clearance = 1e-3,
                                     .bush_radius = 0.01,
                                     .law = {.stiffness = pin_stiffness(0.01, 0.009, {2e9, 0.4}, {2e9, 0.4}),
                                             .restitution = 0.5}},
                         .angle = full_turn / 36,
                         .rate = 10};
  const planar::InputDrive crank{math::ConstantSpeed{0, 10}, 0, 0};
  AutomaticContactRun run;
  for (auto _ : state)
    run = simulate_automatic_contact(l, std::span(&pin, 1), std::span(&crank, 1),
                                     std::vector{0.0, full_turn / 10});
  state.counters["contacts"] = static_cast<double>(run.contact.events.size());
  state.counters["evaluations"] = static_cast<double>(run.evaluations);
}
BENCHMARK(clearance_automatic_four_bar)->Unit(benchmark::kMillisecond);

// The periodic motion of clearance_four_bar_orbit by the general model.
void clearance_joint_orbit(benchmark::State& state) {
  const planar::Linkage l = loose_four_bar(published_design_2());
  const JointClearance pin{.joint = planar::joint_index(l, "A"), .clearance = 1e-3, .angle = 0.15, .rate = 7};
  const planar::InputDrive crank{math::ConstantSpeed{0, 10}, 0, 0};
  long evaluations = 0;
  for (auto _ : state)
    evaluations = find_joint_orbit(l, std::span(&pin, 1), std::span(&crank, 1), 0, full_turn / 10,
                                   {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12})
                      .evaluations;
  state.counters["evaluations"] = static_cast<double>(evaluations);
}
BENCHMARK(clearance_joint_orbit)->Unit(benchmark::kMillisecond);

void clearance_path_synthesis(benchmark::State& state) {
  const ClearancePathProblem p = published_path_problem();
  RunContext context;
  double objective = 0;
  for (auto _ : state) objective = synthesise_clearance_path(p, 12, {.seed = 1}, context).design.objective;
  state.counters["objective_mm"] = objective * 1e3;
}
BENCHMARK(clearance_path_synthesis)->Unit(benchmark::kMillisecond);

void clearance_mass_synthesis(benchmark::State& state) {
  ClearanceMassProblem p = published_mass_problem();
  p.phase = 0;
  RunContext context;
  ClearanceMassDesign design;
  for (auto _ : state) design = synthesise_clearance_masses(p, 6, {.seed = 1}, context);
  state.counters["objective_rad"] = design.transient_error;
  state.counters["orbit_error_rad"] = design.orbit_error;
}
BENCHMARK(clearance_mass_synthesis)->Unit(benchmark::kMillisecond);

// All pins of a walking leg, 72 positions.
void clearance_sensitivity_leg(benchmark::State& state) {
  const planar::LinkageSample leg = planar::jansen_leg_sample();
  LinkageTolerances tolerances;
  for (std::size_t j = 0; j < leg.linkage.joints.size(); ++j)
    tolerances.pins.push_back({static_cast<int>(j), 1e-4});
  std::vector<planar::InputMotion> samples;
  for (int k = 0; k < 72; ++k) samples.push_back({leg.from[0] + full_turn * k / 72, 0, 0});
  for (auto _ : state)
    benchmark::DoNotOptimize(
        clearance_sensitivity(leg.linkage, tolerances, {.points = {leg.traces[0]}}, samples));
}
BENCHMARK(clearance_sensitivity_leg)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linkwright::clearance
