// Figures over seeds of the published method for the four-bar with clearance (Varedi et al. 2014), beside
// those of the methods that are recommended. Takes some minutes.

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "linkwright/clearance/published_clearance.h"
#include "linkwright/optimise/minimise.h"

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
void show(const char* what, const std::vector<double>& sorted, double unit, const char* name) {
  fmt::print("{:<44} best {:.6g}, median {:.6g}, worst {:.6g} {} ({} seeds)\n", what, sorted.front() * unit,
             sorted[sorted.size() / 2] * unit, sorted.back() * unit, name, sorted.size());
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
    show("  swarm of 20, 30 moves", swarm(clearance_mass_problem(mass), 20, 30, 5, false), 1, "rad");
    const ClearanceMassDesign design = synthesise_clearance_masses(mass, 12, {.seed = 1}, context);
    fmt::print(
        "  least squares on the orbit: one turn {:.6g} rad, orbit {:.6g} rad, least tension {:.4g} N\n",
        design.transient_error, design.orbit_error, design.least_tension);
  }
  const ClearanceMassProblem mass = published_mass_problem();
  const ClearanceDesign both =
      design_clearance_linkage(path, mass, path_variables(path, published_design_2().linkage),
                               std::vector<double>{0.2, 0, 0, 1e-6, 0.02, 0, 0, 1e-6}, context);
  fmt::print(
      "both stages at once: path on the orbit {:.6g} mm rms (design 2 with the wished lead: {:.6g} mm)\n",
      both.path_rms * 1e3,
      clearance_path_design(path, path_variables(path, published_design_2().linkage)).rms * 1e3);
}
