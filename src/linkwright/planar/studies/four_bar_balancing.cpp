// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/four_bar_balancing.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/studies/linkage.h"

namespace linkwright::planar {
namespace {

// The number among the sixteen that a designed one is.
std::optional<FourBarNumber> number_at(const std::vector<study::DesignedStep>& steps) {
  using N = FourBarNumber;
  if (steps.size() < 3 || steps[0].key != "mechanism") return std::nullopt;
  const std::string base = study::base_of(steps.back().key);
  if (steps[1].key == "parameters" && steps.size() == 3) {
    for (const auto& [key, number] : {std::pair{"crank", N::crank}, std::pair{"coupler", N::coupler},
                                      std::pair{"rocker", N::rocker}, std::pair{"ground", N::ground}})
      if (base == key) return number;
    return std::nullopt;
  }
  if (steps[1].key != "mass" || steps.size() != 4) return std::nullopt;
  constexpr std::array<std::string_view, 3> links = {"crank", "coupler", "rocker"};
  const auto link = std::find(links.begin(), links.end(), steps[2].key);
  if (link == links.end()) return std::nullopt;
  for (const auto& [key, first] :
       {std::pair{"centre_angle", N::crank_centre_angle}, std::pair{"mass", N::crank_mass},
        std::pair{"inertia", N::crank_inertia}, std::pair{"centre_distance", N::crank_centre_distance}})
    if (base == key) return FourBarNumber(index(first) + static_cast<std::size_t>(link - links.begin()));
  return std::nullopt;
}

// "O1_x" of "O1_x_N".
std::optional<FourBarComponent> component_of(const std::string& quantity) {
  const std::string base = study::base_of(quantity);
  for (const auto& name : names(FourBarComponent()))
    if (base == name.name) return name.value;
  return std::nullopt;
}

}  // namespace

std::optional<double> weight_along_y(const Linkage& l) {
  if (l.gravity.real() != 0 || l.gravity.imag() > 0) return std::nullopt;
  return -l.gravity.imag();
}

FourBarMechanism four_bar_of(const BalancingStudy& s, std::span<const double> x) {
  Value tables = s.designed.tables;
  study::put(tables, s.designed.numbers, x);
  Diagnostics problems;
  study::DocumentReader reader(tables, {}, problems);
  study::ObjectReader root = reader.root();
  return *read_linkage_study(root, {}, LinkageType::four_bar, nullptr)->four_bar;
}

std::optional<optimise::SmoothProblem> four_bar_problem(const BalancingStudy& s, const BalancingProblem& p) {
  if (s.mechanism->type != "planar.four_bar" || !s.constraints.empty()) return std::nullopt;
  FourBarBalancing b;
  b.crank_rotates_fully = false;
  for (std::size_t k = 0; k < p.task.objectives.size(); ++k) {
    const BalancingGoal& o = p.task.objectives[k];
    const auto component = component_of(o.quantity);
    if (!component || !properties(o.measure).norm) return std::nullopt;
    b.objectives.push_back({*component, o.measure, p.references[k]});
  }
  Diagnostics problems;
  study::DocumentReader reader(s.designed.tables, {}, problems);
  study::ObjectReader root = reader.root();
  const auto initial = read_linkage_study(root, {}, LinkageType::four_bar, nullptr);
  if (!initial || !std::holds_alternative<InputGrid>(initial->sweep)) return std::nullopt;
  const InputSamples& angles = std::get<InputGrid>(initial->sweep).inputs[0];
  const FourBar& l = initial->four_bar->linkage;
  const auto gravity = weight_along_y(initial->linkage);
  if (!(angles.from < angles.to) || l.frame_angle != 0 || !gravity) return std::nullopt;
  // Through a change point the general method follows the branch; the closed form would change it there.
  if (classify(l).type == FourBarType::change_point) return std::nullopt;
  b.branch = l.branch;
  b.crank_from = angles.from;
  b.crank_to = angles.to;
  b.samples = angles.samples;
  b.closes = p.task.closes;
  b.crank_speed = initial->drives[0].rate;
  b.crank_acceleration = initial->drives[0].acceleration;
  b.gravity = *gravity;

  struct Designed {
    std::size_t number;
    const Unit* unit;
  };
  std::vector<Designed> designed;
  const FourBarNumbers fixed = four_bar_numbers({l, *initial->four_bar->masses});
  for (std::size_t j = 0; j < fixed.size(); ++j) b.bounds[j] = {fixed[j], fixed[j]};
  for (const study::DesignVariable& n : s.designed.numbers) {
    const auto number = number_at(study::steps_to(s.designed.tables, n.place));
    if (!number || !n.unit.unit) return std::nullopt;
    designed.push_back({index(*number), n.unit.unit});
    b.bounds[index(*number)] = {n.unit.unit->to_si(n.lower), n.unit.unit->to_si(n.upper)};
  }
  optimise::SmoothProblem out;
  out.variables = p.problem.variables;
  out.objectives = b.objectives.size();
  out.constraints = balancing_constraints(b).size();
  out.evaluate = [b = std::move(b), designed = std::move(designed), fixed](
                     const optimise::PopulationView& candidates, std::span<double> values) {
    thread_local std::vector<FourBarMachine> machines;
    machines.resize(candidates.size);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      FourBarNumbers numbers = fixed;
      for (std::size_t j = 0; j < designed.size(); ++j)
        numbers[designed[j].number] = designed[j].unit->to_si(candidates(j, i));
      machines[i] = four_bar_machine(numbers, b.branch);
    }
    balancing_values(b, machines, values);
  };
  return out;
}

}  // namespace linkwright::planar
