// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/four_bar.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/smooth_problem.h"

namespace linkwright::planar {
namespace {

constexpr std::array<std::string_view, four_bar_number_count> number_names = {"crank_m",
                                                                              "coupler_m",
                                                                              "rocker_m",
                                                                              "ground_m",
                                                                              "crank_centre_angle_rad",
                                                                              "coupler_centre_angle_rad",
                                                                              "rocker_centre_angle_rad",
                                                                              "crank_mass_kg",
                                                                              "coupler_mass_kg",
                                                                              "rocker_mass_kg",
                                                                              "crank_inertia_kg_m2",
                                                                              "coupler_inertia_kg_m2",
                                                                              "rocker_inertia_kg_m2",
                                                                              "crank_centre_distance_m",
                                                                              "coupler_centre_distance_m",
                                                                              "rocker_centre_distance_m"};

FourBarRow row_of(FourBarComponent component) {
  const auto first =
      component < FourBarComponent::drive_torque ? FourBarRow::ground_on_crank_x : FourBarRow::drive_torque;
  const auto from =
      component < FourBarComponent::drive_torque ? FourBarComponent::O1_x : FourBarComponent::drive_torque;
  return static_cast<FourBarRow>(static_cast<int>(first) + static_cast<int>(component) -
                                 static_cast<int>(from));
}

// Crank directions at which the crank pin comes nearest to and farthest from the rocker's pivot.
struct Diagonals {
  double cosine_nearest = 1, cosine_farthest = -1;
};
Diagonals diagonals(const FourBarBalancing& b) {
  const auto passes = [&](double angle) {
    return std::ceil((b.crank_from - angle) / (2 * pi)) * 2 * pi + angle <= b.crank_to;
  };
  const double from = std::cos(b.crank_from), to = std::cos(b.crank_to);
  return {passes(0) ? 1 : std::max(from, to), passes(pi) ? -1 : std::min(from, to)};
}
double diagonal_square(const FourBar& l, double cosine) {
  return l.ground * l.ground + l.crank * l.crank - 2 * l.ground * l.crank * cosine;
}

double rotation_margin(const FourBar& l) {
  const auto [least, most] = std::minmax({l.coupler, l.rocker, l.ground});
  return std::min((l.crank + l.coupler + l.rocker + l.ground) / 2 - l.crank - most, least - l.crank);
}
double assembly_margin(const FourBar& l, const Diagonals& d) {
  const double nearest = std::sqrt(diagonal_square(l, d.cosine_nearest)),
               farthest = std::sqrt(diagonal_square(l, d.cosine_farthest));
  return std::min(l.coupler + l.rocker - farthest, nearest - std::abs(l.coupler - l.rocker));
}

// Rocker angle when crank and coupler lie in line, stretched (+1) or folded (-1), without the sign of the
// branch. Beyond the triangle it continues linearly in the cosine, so that a search that strays finds back.
double rocker_angle_in_line(const FourBar& l, double stretched) {
  const double reach = l.coupler + stretched * l.crank;
  const double c = (l.ground * l.ground + l.rocker * l.rocker - reach * reach) / (2 * l.ground * l.rocker);
  return c > 1 ? 1 - c : c < -1 ? pi - 1 - c : std::acos(c);
}

// The part of a problem that is the same for all machines.
struct Layout {
  Diagonals diagonals;
  double size = 0;  // m, what lengths are compared with
  std::size_t width = 0;
  std::vector<double> angles;
};
Layout layout(const FourBarBalancing& b) {
  Layout out{.diagonals = diagonals(b)};
  for (const FourBarNumber n :
       {FourBarNumber::crank, FourBarNumber::coupler, FourBarNumber::rocker, FourBarNumber::ground})
    out.size += b.bounds[index(n)].upper;
  out.width = b.objectives.size() + 1 + (b.min_transmission_angle > 0 ? 2 : 0) + (b.rocker_swing ? 2 : 0);
  const auto last = static_cast<std::size_t>(b.samples - 1);
  for (std::size_t i = 0; i <= last; ++i)
    out.angles.push_back(b.crank_from +
                         (b.crank_to - b.crank_from) * static_cast<double>(i) / static_cast<double>(last));
  return out;
}

// The constraints of one machine; returns whether it can be swept.
bool constraints(const FourBarBalancing& b, const Layout& layout, const FourBar& l, double* g) {
  const double margin = b.crank_rotates_fully ? rotation_margin(l) : assembly_margin(l, layout.diagonals);
  *g++ = -margin / layout.size;
  if (b.min_transmission_angle > 0) {
    const double limit = std::cos(b.min_transmission_angle), both = 2 * l.coupler * l.rocker;
    const double squares = l.coupler * l.coupler + l.rocker * l.rocker;
    *g++ = (squares - diagonal_square(l, layout.diagonals.cosine_nearest)) / both - limit;
    *g++ = (diagonal_square(l, layout.diagonals.cosine_farthest) - squares) / both - limit;
  }
  if (b.rocker_swing) {
    const double swing = rocker_angle_in_line(l, 1) - rocker_angle_in_line(l, -1);
    *g++ = b.rocker_swing->lower - swing;
    *g++ = swing - b.rocker_swing->upper;
  }
  return margin >= 0;
}

// Sum over the samples, by eight sums that a register can hold.
template <class Term>
double total(std::span<const double> samples, Term&& term) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  std::size_t i = 0;
  for (; i + lanes <= samples.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += term(samples[i + k]);
  for (std::size_t k = 0; i < samples.size(); ++i, ++k) sums[k] += term(samples[i]);
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

double measure(const BalancingObjective& o, double softening, std::span<const double> samples) {
  const auto n = static_cast<double>(samples.size());
  const double s = softening * o.reference;
  switch (o.measure) {
    case Measure::rms:
      return std::sqrt(total(samples, [](double v) { return v * v; }) / n);
    case Measure::mean_abs:
      if (s > 0) return total(samples, [s](double v) { return std::sqrt(v * v + s * s); }) / n;
      return total(samples, [](double v) { return std::abs(v); }) / n;
    case Measure::max_abs: {
      const double most = max_abs(samples);
      if (s == 0 || std::isnan(most)) return most;
      return most + s * std::log(total(samples, [s, most](double v) {
                      return std::exp((v - most) / s) + std::exp((-v - most) / s);
                    }));
    }
    case Measure::rss_over_n:
      break;
    case Measure::maximum:
    case Measure::minimum:
    case Measure::range:
      break;  // refused by require_valid
  }
  return std::sqrt(total(samples, [](double v) { return v * v; })) / (n - 1);
}

// The scratch memory of a thread.
struct Memory {
  FourBarSweep sweep{{.directions = false, .rates = false, .forces = true, .shaking = true}};
  std::vector<FourBarMachine> machines;
};
Memory& memory() {
  thread_local Memory of_thread;
  return of_thread;
}

// One machine after the other, registers hold angles: a single candidate is as quick as one of many.
void evaluate(const FourBarBalancing& b, const Layout& layout, double softening,
              std::span<const FourBarMachine> machines, std::span<double> values) {
  FourBarSweep& sweep = memory().sweep;
  const std::size_t objectives = b.objectives.size();
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const FourBarMachine& m = machines[i];
    double* of = values.data() + i * layout.width;
    if (!constraints(b, layout, m.linkage, of + objectives)) {
      std::fill_n(of, objectives, nan);
      continue;
    }
    sweep.run(m.linkage, m.masses, b.gravity,
              {layout.angles, {&b.crank_speed, 1}, {&b.crank_acceleration, 1}});
    for (std::size_t k = 0; k < objectives; ++k) {
      const BalancingObjective& o = b.objectives[k];
      const std::span<const double> row = sweep.row(row_of(o.component));
      of[k] = measure(o, softening, row.first(counted(o.measure, row.size(), b.closes))) / o.reference;
    }
  }
}

}  // namespace

std::string_view name(FourBarNumber number) { return number_names[index(number)]; }

FourBarMachine four_bar_machine(std::span<const double, four_bar_number_count> x, Branch branch) {
  return {{.ground = x[3], .crank = x[0], .coupler = x[1], .rocker = x[2], .branch = branch},
          {.crank = {x[7], x[10], x[13], x[4]},
           .coupler = {x[8], x[11], x[14], x[5]},
           .rocker = {x[9], x[12], x[15], x[6]}}};
}

FourBarNumbers four_bar_numbers(const FourBarMachine& machine) {
  const FourBar& l = machine.linkage;
  const auto& [crank, coupler, rocker] = machine.masses;
  return {l.crank,
          l.coupler,
          l.rocker,
          l.ground,
          crank.centre_angle,
          coupler.centre_angle,
          rocker.centre_angle,
          crank.mass,
          coupler.mass,
          rocker.mass,
          crank.inertia,
          coupler.inertia,
          rocker.inertia,
          crank.centre_distance,
          coupler.centre_distance,
          rocker.centre_distance};
}

void require_valid(const FourBarBalancing& b) {
  for (std::size_t j = 0; j < four_bar_number_count; ++j) {
    const Range& r = b.bounds[j];
    LINKWRIGHT_REQUIRE(std::isfinite(r.lower) && std::isfinite(r.upper) && r.lower <= r.upper,
                       "bounds of {}: {} to {}", number_names[j], r.lower, r.upper);
    const bool length = j <= index(FourBarNumber::ground);
    const bool angle = !length && j <= index(FourBarNumber::rocker_centre_angle);
    LINKWRIGHT_REQUIRE(angle || r.lower > 0 || (!length && r.lower == 0), "{} must be {} 0, got {}",
                       number_names[j], length ? "more than" : "at least", r.lower);
  }
  LINKWRIGHT_REQUIRE(!b.objectives.empty(), "balancing needs objectives");
  for (const BalancingObjective& o : b.objectives) {
    LINKWRIGHT_REQUIRE(properties(o.measure).norm, "{} of {}: take rss_over_n, rms, mean_abs or max_abs",
                       name_of(o.measure), name_of(o.component));
    LINKWRIGHT_REQUIRE(o.reference > 0 && std::isfinite(o.reference),
                       "reference of {} must be more than 0, got {}", name_of(o.component), o.reference);
  }
  LINKWRIGHT_REQUIRE(b.samples >= 2, "needs 2 samples of the crank angle, got {}", b.samples);
  LINKWRIGHT_REQUIRE(std::isfinite(b.crank_from) && std::isfinite(b.crank_to) && b.crank_from < b.crank_to,
                     "crank angles from {} to {}", b.crank_from, b.crank_to);
  LINKWRIGHT_REQUIRE(
      std::isfinite(b.crank_speed) && std::isfinite(b.crank_acceleration) && std::isfinite(b.gravity),
      "crank speed {}, crank acceleration {} and gravity {} must be finite", b.crank_speed,
      b.crank_acceleration, b.gravity);
  LINKWRIGHT_REQUIRE(b.min_transmission_angle >= 0 && b.min_transmission_angle < pi / 2,
                     "minimum transmission angle must be in [0, pi/2), got {}", b.min_transmission_angle);
  if (b.rocker_swing) {
    LINKWRIGHT_REQUIRE(b.crank_rotates_fully, "a limit of the rocker's swing needs crank_rotates_fully");
    LINKWRIGHT_REQUIRE(b.rocker_swing->lower <= b.rocker_swing->upper, "rocker swing from {} to {}",
                       b.rocker_swing->lower, b.rocker_swing->upper);
  }
}

std::vector<std::string> balancing_constraints(const FourBarBalancing& b) {
  std::vector<std::string> out = {b.crank_rotates_fully ? "crank_rotates_fully" : "assembles"};
  if (b.min_transmission_angle > 0) out.insert(out.end(), 2, "transmission_angle");
  if (b.rocker_swing) out.insert(out.end(), 2, "rocker_swing");
  return out;
}

void balancing_values(const FourBarBalancing& b, std::span<const FourBarMachine> machines,
                      std::span<double> values, double softening) {
  require_valid(b);
  const Layout of = layout(b);
  LINKWRIGHT_REQUIRE(values.size() == machines.size() * of.width, "{} values for {} machines of {}",
                     values.size(), machines.size(), of.width);
  evaluate(b, of, softening, machines, values);
}

std::vector<double> balancing_measures(const FourBarBalancing& b, const FourBarMachine& machine) {
  std::vector<double> values(layout(b).width);
  balancing_values(b, {&machine, 1}, values);
  values.resize(b.objectives.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] *= b.objectives[k].reference;
  return values;
}

void set_references(FourBarBalancing& b, const FourBarMachine& machine) {
  const std::vector<double> measures = balancing_measures(b, machine);
  for (std::size_t k = 0; k < measures.size(); ++k) {
    LINKWRIGHT_REQUIRE(measures[k] > 0, "{} of the reference machine is {}: nothing can be relative to that",
                       name_of(b.objectives[k].component), measures[k]);
    b.objectives[k].reference = measures[k];
  }
}

optimise::SmoothProblem balancing_problem(const FourBarBalancing& b, double softening) {
  require_valid(b);
  LINKWRIGHT_REQUIRE(softening >= 0 && std::isfinite(softening), "softening {}", softening);
  optimise::SmoothProblem out;
  for (std::size_t j = 0; j < four_bar_number_count; ++j)
    out.variables.push_back({std::string(number_names[j]), b.bounds[j].lower, b.bounds[j].upper});
  const Layout of = layout(b);
  out.objectives = b.objectives.size();
  out.constraints = of.width - out.objectives;
  out.evaluate = [b, of, softening](const optimise::PopulationView& candidates, std::span<double> values) {
    std::vector<FourBarMachine>& machines = memory().machines;
    machines.resize(candidates.size);
    FourBarNumbers x;
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      machines[i] = four_bar_machine(x, b.branch);
    }
    evaluate(b, of, softening, machines, values);
  };
  return out;
}

}  // namespace linkwright::planar
