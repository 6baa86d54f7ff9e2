// SPDX-License-Identifier: BSD-3-Clause

// Figures over seeds of the published method for the four-bar with clearance (Varedi et al. 2014), beside
// those of the methods that are recommended. Takes some minutes.

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/studies/design.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/statistics.h"

using namespace linkwright;
using namespace linkwright::clearance;

namespace {

std::vector<double> swarm(const optimise::Problem& problem, int particles, int moves, int seeds,
                          bool penalty) {
  std::vector<double> found;
  RunContext context;
  for (int seed = 1; seed <= seeds; ++seed)
    found.push_back(optimise::minimise(problem,
                                       {.method = optimise::Method::particle_swarm,
                                        .particle_swarm = {.population = particles, .generations = moves}},
                                       {.constraints = penalty ? optimise::Constraints::penalty
                                                               : optimise::Constraints::feasibility_rules,
                                        .penalty_weight = 1},
                                       {.seed = static_cast<std::uint64_t>(seed)}, context)
                        .cost);
  std::sort(found.begin(), found.end());
  return found;
}
const std::vector<double> at_the_pin{0.2, 0, 0, 1e-6, 0.02, 0, 0, 1e-6},
    table_3{0.0654, 0.00038, 0, 0.0000145, 0.052, 0.00435, 0, 0.0000245};

void show(const char* what, const std::vector<double>& sorted, double unit, const char* name) {
  fmt::print("{:<44} best {:.6g}, median {:.6g}, worst {:.6g} {} ({} seeds)\n", what, sorted.front() * unit,
             optimise::quantile(sorted, 0.5) * unit, sorted.back() * unit, name, sorted.size());
}

}  // namespace

int main() {
  const ClearancePathProblem path = published_path_problem();
  const optimise::Problem lengths = clearance_path_problem(path);
  show("path, swarm of 40, 400 moves", swarm(lengths, 40, 400, 10, true), 1e3, "mm");
  show("path, swarm of 60, 1500 moves", swarm(lengths, 60, 1500, 5, true), 1e3, "mm");
  RunContext context;
  std::vector<double> found;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    found.push_back(synthesise_clearance_path(path, 12, {.seed = seed}, context).design.objective);
  std::sort(found.begin(), found.end());
  show("path, least squares from 12 starts", found, 1e3, "mm");

  for (const double phase : {published_mass_problem().phase, 0.0}) {
    ClearanceMassProblem mass = published_mass_problem();
    mass.phase = phase;
    fmt::print("masses for a phase of {:.3g} rad\n", phase);
    const auto plain = [&](const char* what, std::vector<double> x) {
      const ClearanceMassDesign d = clearance_mass_design(mass, std::move(x));
      fmt::print("  {:<42} first turn {:.6g}, orbit {:.6g} rad, least tension {:.4g} N\n", what,
                 d.transient_error, d.orbit_error, d.min_tension);
    };
    plain("masses of Table 3", table_3);
    plain("all mass at the pin", at_the_pin);
    const std::vector<double> turns = swarm(clearance_mass_problem(mass), 20, 30, 20, false);
    show("  swarm of 20, 30 moves, first turn", turns, 1, "rad");
    fmt::print("    all:");
    for (const double cost : turns) fmt::print(" {:.5f}", cost);
    fmt::print("\n");
    std::vector<double> orbits, first_turns;
    double tension = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const ClearanceMassDesign design = synthesise_clearance_masses(mass, 6, {.seed = seed}, context);
      orbits.push_back(design.orbit_error);
      first_turns.push_back(design.transient_error);
      tension = design.min_tension;
    }
    std::sort(orbits.begin(), orbits.end());
    std::sort(first_turns.begin(), first_turns.end());
    show("  least squares from 6 starts, orbit", orbits, 1, "rad");
    show("  the same, first turn", first_turns, 1, "rad");
    fmt::print("    least tension {:.4g} N\n", tension);
  }
  fmt::print("path of both stages, presumed and on the orbit\n");
  ClearanceDesignStudy study;
  study.mass = published_mass_problem();
  study.samples = 361;
  const auto tell = [&](const char* what, const std::vector<double>& nine, const std::vector<double>& eight) {
    const DesignMeasures d = measure_design(study, {nine, eight});
    fmt::print("  {:<42} presumed {:.6g} mm, orbit {:.6g} mm rms, least tension {:.4g} N\n", what,
               d.presumed.rms * 1e3, d.rms * 1e3, d.run.min_tension);
  };
  for (const double phase : {path.phase, 0.0}) {
    study.path = path;
    study.path.phase = study.mass.phase = phase;
    if (phase > 0) tell("design 2 as published", path_variables(path, published_design_2().linkage), table_3);
    const ClearancePathSynthesis first = synthesise_clearance_path(study.path, 12, {.seed = 1}, context);
    study.mass.model.linkage = first.design.model.linkage;
    const ClearanceMassDesign second =
        synthesise_clearance_masses(study.mass, 6, {.seed = 1, .run = 1}, context);
    tell(phase > 0 ? "in turn, phase of 10 degrees" : "in turn, phase of 0", first.x, second.x);
    const ClearanceDesign both = design_clearance_linkage(study.path, study.mass, first.x, second.x, context);
    const auto split = both.x.begin() + clearance_length_count;
    tell("at once from there", {both.x.begin(), split}, {split, both.x.end()});
  }
}
