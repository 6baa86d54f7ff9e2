// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/usability.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// A limit that the usable problem meets is met to rounding, with a design measured another way.
constexpr double slack = 1e-6;
constexpr std::array<double FourBar::*, 4> lengths = {&FourBar::ground, &FourBar::crank, &FourBar::coupler,
                                                      &FourBar::rocker};
constexpr std::size_t links = lengths.size();

bool derived(const PathProblem& problem, std::size_t j) {
  return problem.bounds[j] == derive_bounds(problem.x, problem.y)[j];
}

void add_locks(const PathDesign& design, const FourBarClass& type, std::vector<Weakness>& out) {
  const auto [low, high] = std::minmax_element(design.angles.begin(), design.angles.end());
  for (const AngleInterval& interval : type.inputs) {
    const double middle = 0.5 * (*low + *high);
    const double shift = 2 * pi * std::round((0.5 * (interval.from + interval.to) - middle) / (2 * pi));
    if (middle + shift < interval.from || middle + shift > interval.to) continue;
    double before = *low + shift - interval.from, beyond = interval.to - (*high + shift);
    if (design.angles.front() > design.angles.back()) std::swap(before, beyond);
    out.push_back(
        {DrawbackKind::locks,
         say("its crank cannot rotate fully and locks {} before the first point and {} beyond the last",
             degrees_of(std::max(0.0, before)).fixed(1), degrees_of(std::max(0.0, beyond)).fixed(1))});
    return;
  }
}

}  // namespace

PathTransmission path_transmission(const PathProblem& problem, const PathDesign& design) {
  const double whole = transmission_angles(design.linkage).minimum;
  if (problem.closed || design.angles.empty()) return {whole, whole};
  const auto [low, high] = std::minmax_element(design.angles.begin(), design.angles.end());
  return {transmission_angles(design.linkage, *low, *high).minimum, whole};
}

double min_usable_step(const PathProblem& problem) {
  return std::min(pi / 180, 0.2 * pi / static_cast<double>(problem.x.size()));
}

std::vector<Weakness> weaknesses(const PathProblem& problem, const PathDesign& design) {
  std::vector<Weakness> out;
  const double mu = path_transmission(problem, design).used;
  if (mu < min_usable_transmission - slack)
    out.push_back({DrawbackKind::transmission,
                   say("its transmission angle falls to {} on the path", degrees_of(mu).fixed(1))});
  if (problem.timing == Timing::free && design.angles.size() > 1) {
    const std::size_t n = design.angles.size(), steps = problem.closed ? n : n - 1;
    double least = 2 * pi;
    std::size_t at = 0;
    for (std::size_t k = 0; k < steps; ++k) {
      double step = design.sense * (design.angles[(k + 1) % n] - design.angles[k]);
      if (k + 1 == n) step += 2 * pi;
      if (step < least) least = step, at = k;
    }
    if (least < min_usable_step(problem) - slack)
      out.push_back(
          {DrawbackKind::crowded, say("{} of crank rotation lie between points {} and {}",
                                      degrees_of(std::max(0.0, least), 2), at + 1, (at + 1) % n + 1)});
  }
  for (std::size_t j = 0; j < links; ++j) {
    const std::string_view link = name(FourBarParameter(j));
    const double length = design.linkage.*lengths[j];
    if (derived(problem, j) && std::find(design.active_bounds.begin(), design.active_bounds.end(), link) !=
                                   design.active_bounds.end())
      out.push_back({DrawbackKind::bound, say("its {} link is as {} as the search allows", link,
                                              length > path_size(problem) ? "long" : "short")});
  }
  const FourBarClass type = classify(design.linkage);
  const FourBar& l = design.linkage;
  if (type.crank_margin < -tolerance::feasibility * (l.ground + l.crank + l.coupler + l.rocker))
    add_locks(design, type, out);
  return out;
}

PathProblem usable_problem(PathProblem p) {
  p.crank_rotates_fully = true;
  p.min_transmission_angle = std::max(p.min_transmission_angle, min_usable_transmission);
  p.min_step = std::max(p.min_step, min_usable_step(p));
  for (std::size_t j = 0; j < links; ++j)
    if (derived(p, j)) p.bounds[j] = {2 * p.bounds[j].lower, 0.5 * p.bounds[j].upper};
  return p;
}

void keep_first(const PathProblem& problem, std::vector<PathDesign>& ranked, std::size_t most) {
  if (ranked.size() <= most) return;
  const auto usable = [&](const PathDesign& d) {
    return d.violations.empty() && weaknesses(problem, d).empty();
  };
  const auto end = ranked.begin() + static_cast<std::ptrdiff_t>(most);
  if (most > 1 && std::none_of(ranked.begin(), end, usable)) {
    const auto other = std::find_if(end, ranked.end(), usable);
    if (other != ranked.end()) std::swap(*(end - 1), *other);
  }
  ranked.erase(end, ranked.end());
}

}  // namespace linkwright::planar
