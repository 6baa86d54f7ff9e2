// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/smooth_problem.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/dyads/solve.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/sweep.h"
#include "linkwright/planar/path/four_bar/objective.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/path/slider_crank/objective.h"
#include "linkwright/planar/path/slider_crank/projection.h"
#include "linkwright/planar/path/slider_crank/samples.h"
#include "linkwright/planar/path/slider_crank/synthesis.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {
namespace {

// Boskovic 2018, Eqs. (4.28)-(4.30).
PathProblem eighteen_points() {
  PathProblem p;
  p.x = {0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.02, 0, 0, 0.03, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.6};
  p.y = {1.1, 1.1, 1.1, 1.0, 0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9, 1.0};
  p.timing = Timing::equal_steps;
  p.step = pi / 9;
  p.bounds = derive_bounds(p.x, p.y);
  for (std::size_t j = 0; j < 8; ++j) p.bounds[j] = j < 4 ? Range{0, 50} : Range{-50, 50};
  return p;
}

// Candidates near feasible crank-rockers, so that no early exit flatters the kernel.
optimise::Population candidates(std::size_t count) {
  optimise::Population out(four_bar_parameter_count, count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream s({.seed = 1, .individual = static_cast<std::uint32_t>(i)});
    const double x[] = {s.uniform(0.9, 1.2), s.uniform(0.3, 0.5), s.uniform(0.8, 1.0), s.uniform(0.5, 0.7),
                        s.uniform(-1, 1),    s.uniform(-1, 1),    s.uniform(-1, 1),    s.uniform(-1, 1),
                        s.uniform(0, 6.28),  s.uniform(0, 6.28)};
    out.set(i, x);
  }
  return out;
}

void eighteen_point_objective(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const optimise::Problem problem = path_population_problem(eighteen_points(), Branch::open, 1);
  const optimise::Population population = candidates(size);
  std::vector<double> cost(size), violation(size);
  for (auto _ : state) {
    problem.evaluate(population.view(), cost, violation);
    benchmark::DoNotOptimize(cost.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(size));
  state.SetLabel(kernel_name());
}
BENCHMARK(eighteen_point_objective)->Arg(1)->Arg(32)->Arg(1024);

void eighteen_point_slider_objective(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const SliderPathProblem p = eighteen_slider_points();
  const optimise::Problem problem = path_population_problem(p, SliderSide::forward, 1);
  optimise::Population population(slider_parameter_count, size);
  for (std::size_t i = 0; i < size; ++i) {
    RandomStream s({.seed = 1, .individual = static_cast<std::uint32_t>(i)});
    const double x[] = {s.uniform(0.2, 0.4), s.uniform(0.5, 0.8), s.uniform(0.2, 0.5),
                        s.uniform(0, 6.28),  s.uniform(0, 6.28),  s.uniform(-0.1, 0.1),
                        s.uniform(-1, 1),    s.uniform(-1, 1),    s.uniform(0, 6.28)};
    population.set(i, x);
  }
  std::vector<double> cost(size), violation(size);
  for (auto _ : state) {
    problem.evaluate(population.view(), cost, violation);
    benchmark::DoNotOptimize(cost.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(size));
  state.SetLabel(slider_path_kernel_name());
}
BENCHMARK(eighteen_point_slider_objective)->Arg(1)->Arg(32)->Arg(1024);

// Residuals and Jacobian of the three unknowns that the projection leaves.
void eighteen_point_slider_projection(benchmark::State& state) {
  SliderPathProjection projection(eighteen_slider_points(), SliderSide::forward, 1);
  projection.limit_stroke({0, 0.5});
  std::vector<double> residual(projection.residuals()), jacobian(3 * residual.size());
  const std::vector<double> q = {-1, 0.5, 2};
  for (auto _ : state) benchmark::DoNotOptimize(projection.evaluate(q, residual, jacobian));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(eighteen_point_slider_projection);

// The path alone, and fourteen points of its front against the stroke.
void eighteen_point_slider_synthesis(benchmark::State& state) {
  const SliderPathProblem p = eighteen_slider_points();
  std::vector<double> strokes;
  for (int i = 1; i <= state.range(0); ++i) strokes.push_back(0.72 - 0.03 * i);
  for (auto _ : state) {
    RunContext context;
    benchmark::DoNotOptimize(strokes.empty()
                                 ? synthesise_path(p, {.progress = false}, context)
                                 : synthesise_slider_front(p, strokes, {.progress = false}, context));
  }
}
BENCHMARK(eighteen_point_slider_synthesis)->Arg(0)->Arg(14)->Unit(benchmark::kMillisecond);

// The textbook form that most published programs use: angles by acos and atan2 at every point.
void textbook_objective(benchmark::State& state) {
  const PathProblem p = eighteen_points();
  const optimise::Population population = candidates(64);
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % 64;
    double sum = 0;
    for (std::size_t k = 0; k < p.x.size(); ++k) {
      const double t2 = population(9, i) + p.step * static_cast<double>(k);
      const double ax = population(1, i) * std::cos(t2), ay = population(1, i) * std::sin(t2);
      const double dx = population(0, i) - ax, dy = -ay, d = std::sqrt(dx * dx + dy * dy);
      const double c = (population(2, i) * population(2, i) + d * d - population(3, i) * population(3, i)) /
                       (2 * population(2, i) * d);
      const double t3 = std::atan2(dy, dx) + std::acos(std::fmin(1, std::fmax(-1, c))), t0 = population(8, i);
      const double x = population(6, i) + population(1, i) * std::cos(t0 + t2) +
                       population(4, i) * std::cos(t0 + t3) - population(5, i) * std::sin(t0 + t3);
      const double y = population(7, i) + population(1, i) * std::sin(t0 + t2) +
                       population(4, i) * std::sin(t0 + t3) + population(5, i) * std::cos(t0 + t3);
      sum += (x - p.x[k]) * (x - p.x[k]) + (y - p.y[k]) * (y - p.y[k]);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(textbook_objective);

void four_bar_position(benchmark::State& state) {
  const FourBar linkage{
      .ground = 1.05, .crank = 0.42, .coupler = 0.91, .rocker = 0.6, .coupler_u = 0.37, .coupler_v = 0.4};
  double angle = 0;
  for (auto _ : state) benchmark::DoNotOptimize(position(linkage, angle += 0.01));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(four_bar_position);

// One position of a crank turn with everything: motion, four joint forces, drive torque, shaking force and
// moments.
template <decltype(reactions_newton_euler) reactions_by>
void four_bar_reactions(benchmark::State& state) {
  const FourBar linkage{.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32};
  const FourBarMasses masses{{0.36, 4.13e-4, 0.05, 0}, {1.296, 1.87e-2, 0.2, 0.1}, {1.046, 9.85e-3, 0.16, 3}};
  double angle = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(reactions_by(linkage, masses, rates(linkage, angle += 0.01, 31.4), 9.81));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(four_bar_reactions<reactions>)->Name("four_bar_reactions/closed_form");
BENCHMARK(four_bar_reactions<reactions_newton_euler>)->Name("four_bar_reactions/newton_euler");

// The same through SIMD registers: many angles of one four-bar, and 201 angles of many. The target with all
// rows is 10 ns a position on 8 lanes.
constexpr FourBarWanted directions_only{.rates = false, .forces = false, .shaking = false},
    shaking_only{.directions = false, .rates = false, .forces = false}, everything{};
std::vector<double> full_turn(std::size_t count) {
  std::vector<double> angle(count);
  for (std::size_t i = 0; i < count; ++i)
    angle[i] = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
  return angle;
}
constexpr FourBarMachine swept{
    {.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32},
    {{0.36, 4.13e-4, 0.05, 0}, {1.296, 1.87e-2, 0.2, 0.1}, {1.046, 9.85e-3, 0.16, 3}}};
constexpr double crank_speed = 31.4;

void four_bar_sweep(benchmark::State& state, const FourBarWanted& wanted) {
  const std::vector<double> angle = full_turn(static_cast<std::size_t>(state.range(0)));
  FourBarSweep sweep(wanted);
  for (auto _ : state) {
    sweep.run(swept.linkage, swept.masses, 9.81, {angle, {&crank_speed, 1}, {}});
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetLabel(four_bar_sweep_kernel_name());
}
BENCHMARK_CAPTURE(four_bar_sweep, directions, directions_only)->Arg(360);
BENCHMARK_CAPTURE(four_bar_sweep, shaking, shaking_only)->Arg(360);
BENCHMARK_CAPTURE(four_bar_sweep, everything, everything)->Arg(360)->Arg(3600);

void four_bar_population_sweep(benchmark::State& state, const FourBarWanted& wanted) {
  const std::vector<double> angle = full_turn(201);
  std::vector<FourBarMachine> machines(static_cast<std::size_t>(state.range(0)), swept);
  for (std::size_t i = 0; i < machines.size(); ++i)
    machines[i].masses.crank.centre_distance += 0.001 * static_cast<double>(i);
  FourBarSweep sweep(wanted);
  for (auto _ : state) {
    sweep.run(machines, 9.81, {angle, {&crank_speed, 1}, {}});
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * 201);
  state.SetLabel(four_bar_sweep_kernel_name());
}
BENCHMARK_CAPTURE(four_bar_population_sweep, shaking, shaking_only)->Arg(32);
BENCHMARK_CAPTURE(four_bar_population_sweep, everything, everything)->Arg(8)->Arg(32);

// All objectives of machines near a published design over a turn of 201 positions.
void balancing_objectives(benchmark::State& state, std::string_view name) {
  const PublishedBalancing p = published_balancing(name);
  const optimise::SmoothProblem problem = balancing_problem(p.problem);
  const auto size = static_cast<std::size_t>(state.range(0));
  optimise::Population population(four_bar_number_count, size);
  for (std::size_t i = 0; i < size; ++i) {
    RandomStream random({.seed = 1, .individual = static_cast<std::uint32_t>(i)});
    FourBarNumbers x = four_bar_numbers(p.published);
    for (double& v : x) v *= random.uniform(0.99, 1.01);
    population.set(i, x);
  }
  std::vector<double> values(size * problem.values());
  for (auto _ : state) {
    problem.evaluate(population.view(), values);
    benchmark::DoNotOptimize(values.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(size));
}
BENCHMARK_CAPTURE(balancing_objectives, eight, "sp-fa")->Arg(1)->Arg(33)->Arg(1024);
BENCHMARK_CAPTURE(balancing_objectives, three, "case3")->Arg(1)->Arg(1024);

// One position of an arm of n links with everything: motion, joint forces, torques of both kinds.
void serial_arm_reactions(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  SerialArm arm;
  for (std::size_t k = 0; k < n; ++k) arm.links.push_back({0.5, {6, 0.125, 0.25, 0.1}, {{1, -0.2, 0}}});
  const std::vector<ArmElement> e = elements(arm);
  std::vector<math::Motion> motion(n, math::Motion{0.3, 2, -5, 0});
  std::vector<ArmLinkRates> r(n);
  std::vector<ArmJointLoads> loads(n);
  for (auto _ : state) {
    for (std::size_t k = 0; k < n; ++k) motion[k].value += 0.01 * static_cast<double>(k + 1);
    rates(e, arm.base, motion, r);
    reactions(e, r, 9.81, loads);
    benchmark::DoNotOptimize(loads.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(serial_arm_reactions)->Arg(2)->Arg(10);

void two_rods_redundant_coordinates(benchmark::State& state) {
  const TwoRods arm{{TwoRods::Rod{0.5, 12, 0.25}, {0.5, 6, 0.125}}, 4};
  std::array<math::Motion, 2> motion = {math::Motion{0.3, 2, -5, 0}, math::Motion{0.8, -1, 3, 0}};
  for (auto _ : state) {
    motion[0].value += 0.01, motion[1].value += 0.02;
    benchmark::DoNotOptimize(reactions_redundant(arm, motion));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(two_rods_redundant_coordinates);

// The published ten-unknown problem as a population method sees it, all included: 100 000 evaluations.
void differential_evolution_100k(benchmark::State& state) {
  const optimise::Problem problem = path_population_problem(eighteen_points(), Branch::open, 1);
  optimise::OptimiserOptions method;
  method.differential_evolution.population = 100;
  method.differential_evolution.generations = 1000;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    RunContext context;
    context.set_threads(1);
    benchmark::DoNotOptimize(optimise::minimise(problem, method, {.log = false}, {.seed = ++seed}, context));
  }
  state.SetItemsProcessed(state.iterations() * 100000);
}
BENCHMARK(differential_evolution_100k)->Unit(benchmark::kMillisecond);

void recommended_eighteen_points(benchmark::State& state) {
  const PathProblem problem = eighteen_points();
  std::uint64_t seed = 0;
  for (auto _ : state) {
    RunContext context;
    benchmark::DoNotOptimize(synthesise_path(problem, {.seed = ++seed}, context));
  }
}
BENCHMARK(recommended_eighteen_points)->Unit(benchmark::kMillisecond);

void recommended_free_timing(benchmark::State& state) {
  PathProblem problem = eighteen_points();
  problem.timing = Timing::free;
  problem.search_negative = true;
  problem.min_transmission_angle = pi / 6;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    RunContext context;
    benchmark::DoNotOptimize(synthesise_path(problem, {.seed = ++seed}, context));
  }
}
BENCHMARK(recommended_free_timing)->Unit(benchmark::kMillisecond);

// A closed path of many points, no limit but the full turn of the crank, both senses and branches; the
// argument is the number of points.
void recommended_free_timing_many_points(benchmark::State& state) {
  PathProblem problem;
  const auto count = static_cast<std::size_t>(state.range(0));
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
    problem.x.push_back(1.5 * std::cos(t) + 0.2 * std::cos(2 * t));
    problem.y.push_back(0.8 * std::sin(t) + 0.1 * std::sin(3 * t));
  }
  problem.bounds = derive_bounds(problem.x, problem.y);
  problem.search_negative = true;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    RunContext context;
    benchmark::DoNotOptimize(synthesise_path(problem, {.seed = ++seed}, context));
  }
}
BENCHMARK(recommended_free_timing_many_points)->Arg(18)->Arg(140)->Arg(300)->Unit(benchmark::kMillisecond);

// All dyads through five poses, of a hundred sets in turn: at most 20 us a set.
void five_poses(benchmark::State& state) {
  std::vector<std::array<BodyPose, 5>> sets(100);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    RandomStream random({.seed = 1, .individual = static_cast<std::uint32_t>(i)});
    for (BodyPose& pose : sets[i]) {
      const double x = random.normal(), y = random.normal();
      pose = {{x, y}, random.uniform(-pi, pi)};
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const GuidingDyads dyads = solve_dyads(sets[i]);
    benchmark::DoNotOptimize(dyads.count);
    i = (i + 1) % sets.size();
  }
}
BENCHMARK(five_poses)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linkwright::planar
