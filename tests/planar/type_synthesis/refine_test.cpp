// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// A short list of four-bars and six-bars for the stroke of a leg.
struct FoundForLeg {
  MotionTarget target{sampled_stroke(test::stroke_of(test::stroke_case("leg")))};
  TypeSearchOptions search;
  std::vector<FoundMachine> machines;

  FoundForLeg() {
    search.families = {MachineFamily::four_bar, MachineFamily::slider_crank, MachineFamily::watt_1};
    search.max_curves = 40'000;
    RunContext context;
    machines = search_types(target, search, context).machines;
  }
  RefineOptions options(std::vector<MachineQuantity> quantities) const {
    RefineOptions out;
    for (const MachineQuantity q : quantities) out.objectives.push_back({.quantity = q});
    out.limits = search.limits;
    out.length_tolerance = 1e-3 * target.stroke.size;
    out.starts = 1;
    return out;
  }
};

const FoundForLeg& found_for_leg() {
  static const FoundForLeg all;
  return all;
}

RefineAnswer refined_leg(const RefineOptions& options, int threads = 1) {
  RunContext context;
  context.set_threads(threads);
  return refine_machines(found_for_leg().target, found_for_leg().machines, options, context);
}

double least_value(const std::vector<std::vector<double>>& values, std::size_t o) {
  double out = infinity;
  for (const auto& v : values) out = std::min(out, v[o]);
  return out;
}

TEST(Refinements, LowerEachObjectiveWithinTheErrorAndTheLimits) {
  for (const auto& word : names(MachineQuantity{})) {
    const RefineAnswer answer = refined_leg(found_for_leg().options({word.value}));
    ASSERT_FALSE(answer.machines.empty()) << word.name;
    EXPECT_GT(answer.steps, 0) << word.name;
    double now = infinity;
    for (const RefinedMachine& m : answer.machines) {
      now = std::min(now, m.values[0]);
      const MachineMeasures& before = found_for_leg().machines[m.from].measures;
      const MachineMeasures& after = m.found.measures;
      EXPECT_LE(after.error, before.error + std::max(0.1 * before.error, 1e-3)) << word.name;
      EXPECT_EQ(after.defect, MachineDefect::none) << word.name;
      EXPECT_GE(after.min_pair_angle, found_for_leg().search.limits.min_pair_angle) << word.name;
      if (m.aim) {
        EXPECT_LT(m.values[0], answer.as_found[m.from][0]) << word.name;
      }
    }
    EXPECT_LT(now, (word.value == MachineQuantity::tolerance_90 ? 1 : 0.99) * least_value(answer.as_found, 0))
        << word.name;
  }
}

TEST(Refinements, WeighSeveralObjectives) {
  const RefineAnswer answer =
      refined_leg(found_for_leg().options({MachineQuantity::peak_joint_force, MachineQuantity::size}));
  bool together = false;
  for (const RefinedMachine& m : answer.machines) {
    if (!m.aim || *m.aim != 2) continue;
    together = true;
    const std::vector<double>& before = answer.as_found[m.from];
    EXPECT_LT(m.values[0] / before[0] + m.values[1] / before[1], 2);
  }
  EXPECT_TRUE(together);
}

TEST(Refinements, KeepLimitsOfOtherObjectives) {
  RefineOptions options = found_for_leg().options({MachineQuantity::peak_joint_force, MachineQuantity::size});
  options.objectives[1].at_most = 1;
  const RefineAnswer answer = refined_leg(options);
  for (const RefinedMachine& m : answer.machines)
    EXPECT_LE(m.values[1], answer.as_found[m.from][1] * (1 + 1e-12));
}

TEST(Refinements, KeepGivenGroundPivots) {
  TypeSearchOptions search;
  search.families = {MachineFamily::four_bar, MachineFamily::watt_1};
  search.max_curves = 40'000;
  search.limits.ground_pivots = {{-1, -2}};
  search.limits.ground_box = PlaneBox{-4, 4, -4, 1};
  RunContext context;
  const auto list = search_types(found_for_leg().target, search, context).machines;
  ASSERT_FALSE(list.empty());
  RefineOptions options = found_for_leg().options({MachineQuantity::peak_joint_force});
  options.limits = search.limits;
  const RefineAnswer answer = refine_machines(found_for_leg().target, list, options, context);
  EXPECT_GT(answer.steps, 0);
  for (const RefinedMachine& m : answer.machines) {
    EXPECT_EQ(m.found.measures.defect, MachineDefect::none);
    double apart = infinity;
    const MachineShape& shape = m.found.machine.shape;
    for (const GroundPivot& pivot : ground_pivots(*shape.program))
      apart = std::min(apart,
                       std::abs(place_of(pivot, *shape.program, shape.x) - search.limits.ground_pivots[0]));
    EXPECT_LT(apart, 1e-9);
  }
}

TEST(Refinements, DoNotDependOnThreads) {
  RefineOptions options =
      found_for_leg().options({MachineQuantity::drive_torque, MachineQuantity::peak_acceleration});
  options.starts = 2;
  const RefineAnswer one = refined_leg(options, 1), two = refined_leg(options, 2);
  ASSERT_EQ(one.machines.size(), two.machines.size());
  EXPECT_EQ(one.steps, two.steps);
  for (std::size_t i = 0; i < one.machines.size(); ++i) {
    EXPECT_EQ(one.machines[i].values, two.machines[i].values);
    EXPECT_EQ(one.machines[i].found.machine.shape.x, two.machines[i].found.machine.shape.x);
  }
}

// The logarithm over a part of a turn, where forces, sizes and pair angles are those of the range alone.
TEST(Refinements, LowerEachObjectiveOfAFunction) {
  const MotionTarget target = function_target(
      {.range = 1.2, .at = [](double part) { return 1.1 * std::log10(1 + 9 * part); }, .size = 0.2});
  TypeSearchOptions search;
  search.families = {MachineFamily::four_bar, MachineFamily::stephenson_3};
  search.max_curves = 30'000;
  RunContext context;
  const std::vector<FoundMachine> list = search_types(target, search, context).machines;
  ASSERT_FALSE(list.empty());
  for (const bool greatest : {false, true})
    for (const auto& word : names(MachineQuantity{})) {
      RefineOptions options = found_for_leg().options({word.value});
      options.greatest = greatest;
      options.error_share = 0;
      options.length_tolerance = 1e-4;
      options.loads.torque = 1;
      const RefineAnswer answer = refine_machines(target, list, options, context);
      bool lower = false;
      for (const RefinedMachine& m : answer.machines) {
        const MachineMeasures &before = list[m.from].measures, &after = m.found.measures;
        EXPECT_LE(greatest ? after.largest_rotation : after.error,
                  1.1 * (greatest ? before.largest_rotation : before.error))
            << word.name;
        EXPECT_EQ(after.defect, MachineDefect::none) << word.name;
        lower = lower || (m.aim && m.values[0] < answer.as_found[m.from][0]);
      }
      EXPECT_TRUE(lower) << word.name << greatest;
    }
}

TEST(Refinements, EndEarlyWithTheMachinesAsFound) {
  RunContext context;
  context.cancel();
  const RefineAnswer answer = refine_machines(found_for_leg().target, found_for_leg().machines,
                                              found_for_leg().options({MachineQuantity::size}), context);
  EXPECT_EQ(answer.status, Status::cancelled);
  for (const RefinedMachine& m : answer.machines) EXPECT_FALSE(m.aim);
  EXPECT_FALSE(answer.machines.empty());
}

TEST(Refinements, RefuseToRefineForNothing) {
  EXPECT_THROW((void)refined_leg(found_for_leg().options({})), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
