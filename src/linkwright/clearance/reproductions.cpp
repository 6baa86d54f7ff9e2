// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/reproductions.h"

#include <cmath>
#include <string>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/path_synthesis.h"
#include "linkwright/clearance/studies/published.h"
#include "linkwright/core/numbers.h"

namespace linkwright::clearance {
namespace {

study::Comparisons tables(const std::string&, RunContext&) {
  const ClearanceFourBar first = published_design_1(), second = published_design_2();
  ClearancePathProblem path = published_path_problem();
  const std::vector<double> x = path_variables(path, second.linkage);
  const double with = clearance_path_design(path, x).rms;
  const EquivalentCrank crank = equivalent_crank(first.linkage.crank, path.clearance, path.phase);
  path.clearance = 0;
  const double without = clearance_path_design(path, x).rms;
  // Half the length of the uniform bar that has this mass and inertia.
  const auto bar = [](const planar::BodyMass& m) { return std::sqrt(12 * m.inertia / m.mass) / 2; };
  const std::string source = "Varedi et al. 2014, ";
  return {
      {"crank rotates fully wherever the pin lies, design 1 (1 = yes)", source + "Table 1", 1,
       turns_fully(first) ? 1.0 : 0.0, turns_fully(first) ? "reproduced" : "not reproduced", ""},
      {"crank rotates fully wherever the pin lies, design 2 (1 = yes)", source + "Table 1", 1,
       turns_fully(second) ? 1.0 : 0.0, turns_fully(second) ? "reproduced" : "not reproduced", ""},
      {"crank of design 2, mm", source + "Table 1", 1e3 * second.linkage.crank, 1e3 * crank.length,
       "improved",
       "under the assumptions of the source (phase 10 degrees; clearance 1 mm inferred) design 1 with this "
       "crank "
       "alone changed keeps its path exactly"},
      {"design 2 from the path of design 1, root mean square in mm", source + "Table 1", nan, 1e3 * with,
       "not printed", "clearance 1 mm, phase 10 degrees, 36 points"},
      {"the same if the clearance were 0", source + "Table 1", nan, 1e3 * without, "not printed",
       "much more: so the clearance, which is not printed, is about 1 mm"},
      {"mass centre of the coupler from its end, m", source + "Table 2", first.coupler.centre.real(),
       bar(first.coupler), "corrected",
       "0.09 mm is printed; that of a uniform bar with the printed mass and inertia lies there within 1 %, "
       "so the "
       "unit is taken as m"},
      {"mass centre of the rocker from its end, m", source + "Table 2", first.rocker.centre.real(),
       bar(first.rocker), "corrected",
       "0.06 mm is printed; likewise within 3 %, with the same mass per length"},
  };
}

study::Comparisons claims(const std::string&, RunContext&) {
  study::Comparisons out;
  for (const ClearanceComparison& c : compare_with_published_clearance())
    out.push_back({c.quantity, "Varedi et al. 2014", nan, c.ours, c.verdict,
                   c.published + (c.note.empty() ? "" : "; " + c.note)});
  return out;
}

}  // namespace

std::vector<study::Reproduction> reproductions() {
  return study::reproductions_of(published::reproductions(),
                                 {{"varedi-2014-tables", tables}, {"varedi-2014-claims", claims}});
}

}  // namespace linkwright::clearance
