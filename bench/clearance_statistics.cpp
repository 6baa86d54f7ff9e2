// Figures over seeds of the published method for the four-bar with clearance (Varedi et al. 2014), beside
// those of the methods that are recommended. Takes some minutes.

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "linkwright/clearance/published_clearance.h"
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
const std::vector<double> at_the_pin{0.2, 0, 0, 1e-6, 0.02, 0, 0, 1e-6};

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

  for (const double lead : {published_mass_problem().lead, 0.0}) {
    ClearanceMassProblem mass = published_mass_problem();
    mass.lead = lead;
    fmt::print("masses for a lead of {:.3g} rad\n", lead);
    const auto plain = [&](const char* what, std::vector<double> x) {
      const ClearanceMassDesign d = clearance_mass_design(mass, std::move(x));
      fmt::print("  {:<42} first turn {:.6g}, orbit {:.6g} rad, least tension {:.4g} N\n", what,
                 d.transient_error, d.orbit_error, d.least_tension);
    };
    plain("masses of Table 3", {0.0654, 0.00038, 0, 0.0000145, 0.052, 0.00435, 0, 0.0000245});
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
      tension = design.least_tension;
    }
    std::sort(orbits.begin(), orbits.end());
    std::sort(first_turns.begin(), first_turns.end());
    show("  least squares from 6 starts, orbit", orbits, 1, "rad");
    show("  the same, first turn", first_turns, 1, "rad");
    fmt::print("    least tension {:.4g} N\n", tension);
  }
  const ClearanceMassProblem mass = published_mass_problem();
  const ClearanceDesign both = design_clearance_linkage(
      path, mass, path_variables(path, published_design_2().linkage), at_the_pin, context);
  fmt::print(
      "both stages at once: path on the orbit {:.6g} mm rms (design 2 with the wished lead: {:.6g} mm)\n",
      both.path_rms * 1e3,
      clearance_path_design(path, path_variables(path, published_design_2().linkage)).rms * 1e3);
}
