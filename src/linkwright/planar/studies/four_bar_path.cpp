// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/four_bar_path.h"

#include <algorithm>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/path_families.h"
#include "linkwright/planar/studies/templates.h"

namespace linkwright::planar {
namespace {

// Lengths that never close: one link is longer than the others can be together.
void require_closing(study::ObjectReader& mechanism, const study::DisplayUnits& units, const PathProblem& p) {
  constexpr std::size_t lengths = 4;
  static_assert(index(FourBarParameter::rocker) == lengths - 1);
  double together = 0;
  for (std::size_t j = 0; j < lengths; ++j) together += p.bounds[j].upper;
  for (std::size_t j = 0; j < lengths; ++j)
    if (const double others = together - p.bounds[j].upper; p.bounds[j].lower > others)
      mechanism.error(
          "parameters",
          fmt::format("the bounds do not let the four-bar close: the {} is at least {} long, the other "
                      "links together at most {}",
                      name(FourBarParameter(j)), units.text(p.bounds[j].lower, Dimension::length),
                      units.text(others, Dimension::length)),
          "widen the bounds");
}

// A fixed number or a range for each coordinate of B0; one that is left out is free.
void set_rocker_pivot(FourBarPathStudy& s) {
  const std::optional<Range>&x = s.mechanism.parameters.rocker_pivot_x,
        &y = s.mechanism.parameters.rocker_pivot_y;
  if (!x && !y) return;
  constexpr double far = infinity;
  const Range anywhere{-far, far}, across = x.value_or(anywhere), up = y.value_or(anywhere);
  s.problem.rocker_pivot = PackagingBox{across.lower, across.upper, up.lower, up.upper};
}

}  // namespace

std::string_view FourBarPathKind::example() { return templates::synthesis_four_bar_path_points(); }
std::span<const study::Absent> FourBarPathKind::absent() { return absent_from_four_bar_paths(); }

void FourBarPathKind::set_limit(study::ObjectReader&, const TransmissionLimit& limit, PathProblem& p) {
  p.min_transmission_angle = std::max(p.min_transmission_angle, limit.min);
}
void FourBarPathKind::set_limit(study::ObjectReader& document, const PackagingLimit& limit, PathProblem& p) {
  if (limit.x.fixed() || limit.y.fixed())
    document.error("constraint", "the packaging box has no width", "write x_m = { min = ..., max = ... }");
  p.packaging = PackagingBox{limit.x.lower, limit.x.upper, limit.y.lower, limit.y.upper};
}

void FourBarPathKind::complete(study::ObjectReader& document, const study::DisplayUnits& units,
                               FourBarPathStudy& s) {
  if (s.objectives.size() > 1)
    document.error("objective", fmt::format("{} objectives, path synthesis has one", s.objectives.size()),
                   "keep one [[objective]]");
  if (auto mechanism = document.table("mechanism")) require_closing(*mechanism, units, s.problem);
  set_rocker_pivot(s);
  s.problem.search_open = s.mechanism.branch != BranchChoice::crossed;
  s.problem.search_crossed = s.mechanism.branch != BranchChoice::open;
}

study::Kind four_bar_path_kind() { return path_kind<FourBarPathKind>(); }

}  // namespace linkwright::planar
