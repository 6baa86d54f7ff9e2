// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/modes.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

TEST(LinkageModes, EnumeratesTheModesOfDyads) {
  const Linkage leg = jansen_leg();
  const LinkagePlan p = planned(leg);
  const std::vector<double> inputs{1};
  const AssemblyModes m = assembly_modes(p, inputs);
  EXPECT_EQ(m.starts, 0);
  EXPECT_EQ(to_string(m.text), std::to_string(m.found.size()) + " modes");
  ASSERT_GE(m.found.size(), 4u);
  for (std::size_t i = 0; i < m.found.size(); ++i) {
    EXPECT_LE(m.found[i].closure_residual, 64 * 2.3e-16);
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(m.found[i].modes, m.found[k].modes);
  }
  EXPECT_EQ(m.found.front().modes[1], 1);
}

TEST(LinkageModes, CountsWhatDoesNotAssemble) {
  const LinkagePlan p = planned(four_bar_linkage(1, 1, 0.6, 0.7));
  EXPECT_EQ(to_string(assembly_modes(p, std::vector<double>{1}).text), "2 modes");
  EXPECT_EQ(to_string(assembly_modes(p, std::vector<double>{2}).text), "0 modes");
  ModeSearch one;
  one.most = 1;
  EXPECT_EQ(to_string(assembly_modes(p, std::vector<double>{1}, one).text), "1 mode, there may be more");
}

TEST(LinkageModes, SearchFindsTheModesThatClosedFormsHave) {
  // The same linkage all at once, as one general group.
  const Linkage leg = jansen_leg();
  const std::vector<double> inputs{1};
  const AssemblyModes closed = assembly_modes(planned(leg), inputs);
  ModeSearch search;
  search.starts = 3000;
  const LinkagePlan at_once = planned(leg, PlanRoute::all_at_once);
  const AssemblyModes found = assembly_modes(at_once, inputs, search);
  EXPECT_EQ(found.starts, 3000);
  ASSERT_EQ(found.found.size(), closed.found.size());
  for (const AssembledMode& a : found.found) {
    int same = 0;
    for (const AssembledMode& b : closed.found) {
      double apart = 0;
      for (std::size_t i = 0; i < a.parts.size(); ++i)
        apart = std::max({apart, norm(a.parts[i].origin - b.parts[i].origin),
                          norm(a.parts[i].direction - b.parts[i].direction)});
      same += apart < 1e-12;  // some times the rounding of Newton's method
    }
    EXPECT_EQ(same, 1);
  }
}

TEST(LinkageModes, OfAGroupWithoutClosedFormAreAnEvenNumberUpToSix) {
  const LinkagePlan p = planned(three_legged_plate());
  ASSERT_FALSE(p.closed_form());
  const AssemblyModes m = assembly_modes(p, std::vector<double>{0.5});
  EXPECT_EQ(m.starts, 200);
  EXPECT_EQ(m.found.size() % 2, 0u);
  EXPECT_GE(m.found.size(), 2u);
  EXPECT_LE(m.found.size(), 6u);  // a sextic (Innocenti 1992 and others)
  EXPECT_EQ(to_string(m.text), std::to_string(m.found.size()) + " modes from 200 starts");
  const AssemblyModes again = assembly_modes(p, std::vector<double>{0.5});
  EXPECT_EQ(again.found.size(), m.found.size());
  EXPECT_THROW(assembly_modes(p, std::vector<double>{}), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
