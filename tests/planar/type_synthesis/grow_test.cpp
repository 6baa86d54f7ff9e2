// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/grow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(GrownMachines, TraceTheSameCurveWithTheirPointOnThePin) {
  std::vector<double> angles;
  for (int k = 0; k < 40; ++k) angles.push_back(0.16 * k);
  for (const char* name : {"four_bar", "watt_1:b", "stephenson_1:a", "stephenson_3:a", "eight_bar:1315b"}) {
    FittedMachine from{.shape = test::some_shape(*program_named(name), 3)};
    std::copy_n(std::vector{0.2, -0.4, 0.7, 0.3}.begin(), 4, from.shape.x.end() - 4);
    const auto curve = test::traced(from.shape, angles);
    int grown = 0;
    for (std::uint32_t k = 0; k < 40; ++k) {
      RandomStream random({.seed = 1, .individual = k});
      auto machine = grown_machine(
          from, [](MachineFamily) { return true; }, random);
      if (!machine) continue;
      ++grown;
      EXPECT_EQ(machine->shape.program->links, from.shape.program->links + 2);
      trace_first_pin(*machine);
      EXPECT_EQ(test::traced(machine->shape, angles), curve) << machine->shape.program->name;
    }
    EXPECT_GT(grown, 10) << name;
  }
}

TEST(GrownMachines, AreOfTheWantedFamilies) {
  const FittedMachine from{.shape = test::some_shape(*program_named("four_bar"), 3)};
  std::set<MachineFamily> found;
  for (std::uint32_t k = 0; k < 60; ++k) {
    RandomStream random({.seed = 1, .individual = k});
    if (auto machine = grown_machine(
            from, [](MachineFamily) { return true; }, random))
      found.insert(machine->shape.program->family);
    for (const MachineFamily family : {MachineFamily::watt_1, MachineFamily::stephenson_3})
      if (auto machine = grown_machine(
              from, [&](MachineFamily f) { return f == family; }, random)) {
        EXPECT_EQ(machine->shape.program->family, family);
      }
    EXPECT_FALSE(grown_machine(
        from, [](MachineFamily f) { return f == MachineFamily::stephenson_1; }, random));
  }
  EXPECT_EQ(found, (std::set{MachineFamily::watt_1, MachineFamily::stephenson_3}));
}

/// Least error of the machines of pairs with so many links.
double least_error(const TypeSearchAnswer& answer, int links) {
  double least = infinity;
  for (const FamilyReport& f : answer.families)
    if (links_of(f.family) == links &&
        (f.family == MachineFamily::ten_bar || !programs_of(f.family).front()->pairs.empty()))
      least = std::min(least, f.error);
  return least;
}

// Few curves, so that larger machines are behind until they are grown at the end.
TEST(GrownMachines, AreNotWorseThanSmallerOnes) {
  const std::vector<MachineFamily> six_bars{MachineFamily::four_bar, MachineFamily::watt_1,
                                            MachineFamily::eight_bar},
      without{MachineFamily::four_bar, MachineFamily::eight_bar};
  for (const char* stroke : {"heart", "square", "spiral", "letter_u", "line_return"})
    for (const auto& families : {std::vector<MachineFamily>{}, six_bars, without}) {
      TypeSearchOptions options{
          .families = families, .max_links = families.empty() ? 10 : 8, .max_curves = 40'000};
      RunContext context;
      const auto answer =
          search_types(sampled_stroke(test::stroke_of(test::stroke_case(stroke))), options, context);
      double least = infinity;
      for (const int links : {4, 6, 8, 10}) {
        const double error = least_error(answer, links);
        if (std::isfinite(least) && links <= options.max_links && (links != 6 || families != without)) {
          EXPECT_LE(error, least) << stroke << ", " << links << " links of " << families.size()
                                  << " families";
        }
        least = std::min(least, error);
      }
      for (const FoundMachine& found : answer.machines)
        EXPECT_TRUE(families.empty() ||
                    std::count(families.begin(), families.end(), found.machine.shape.program->family) > 0)
            << found.machine.shape.program->name;
    }
}

TEST(GrownMachines, HaveNoShortLinkWhereTheTracedPointIsAPin) {
  const MotionTarget target(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  MachineFitter fitter(target, {.min_length = 0.05});
  FittedMachine machine{.shape = test::some_shape(*program_named("stephenson_3:a"), 3)};
  const double other = fitter.measure(machine).min_length;
  trace_first_pin(machine);
  EXPECT_GE(fitter.measure(machine).min_length, other);
  machine.shape.x[static_cast<std::size_t>(machine.shape.program->steps.back().parameter)] = 1e-6;
  EXPECT_LT(fitter.measure(machine).min_length, 1e-3);
}

}  // namespace
}  // namespace linkwright::planar
