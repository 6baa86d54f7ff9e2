// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

// Every answer of a search is analysed once more by the solver of any linkage, which knows nothing of it.
namespace linkwright::planar {
namespace {

constexpr double tenth_of_a_degree = 0.1 * pi / 180;

/// Traced point in the global frame at a crank angle of the linkage.
std::complex<double> traced_at(const FoundLinkage& found, const LinkagePlan& plan, double angle,
                               LinkageMotion& moving) {
  const BodyPoint point = point_named(found.linkage, found.traced);
  const InputMotion input{angle, 0, 0};
  solve_position(plan, std::span(&input, 1), moving);
  EXPECT_EQ(moving.status, Status::done);
  const PartState<double> body = body_state(plan, moving, point.body);
  const auto& local = found.linkage.bodies[static_cast<std::size_t>(point.body)]
                          .points[static_cast<std::size_t>(point.point)]
                          .at;
  return std::complex<double>(body.origin.x, body.origin.y) +
         std::complex<double>(body.direction.x, body.direction.y) * local;
}

void expect_as_told(const FoundMachine& answer, const SampledStroke& target) {
  const FittedMachine& m = answer.machine;
  const MachineMeasures& told = answer.measures;
  const FoundLinkage found = found_linkage(m, target);
  const PlanResult planned = plan_linkage(found.linkage);
  ASSERT_TRUE(planned.problems.empty());
  LinkageMotion moving(planned.plan);

  double largest = 0, squares = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    // A group of four links is followed in steps of a degree.
    const double before = k > 0 ? m.angle[k - 1] : m.angle[0];
    const int steps = m.shape.program->group < 0
                          ? 1
                          : 1 + static_cast<int>(std::abs(m.angle[k] - before) / math::radians(1.0));
    for (int i = 1; i < steps; ++i)
      traced_at(found, planned.plan, before + (m.angle[k] - before) * i / steps + found.crank_angle, moving);
    const std::complex<double> at = traced_at(found, planned.plan, m.angle[k] + found.crank_angle, moving);
    const double apart =
        std::abs((at - target.centre) / target.size - std::complex(target.x[k], target.y[k]));
    largest = std::max(largest, apart), squares += apart * apart;
    // The points of the stroke are met in their order, within one turn.
    if (k > 0) {
      EXPECT_GE(m.sense * (m.angle[k] - m.angle[k - 1]), -1e-12);
    }
  }
  EXPECT_NEAR(largest, told.largest_deviation, 1e-6);
  EXPECT_NEAR(std::sqrt(squares / stroke_samples), told.distance, 1e-6);
  EXPECT_LE(std::abs(m.angle[stroke_samples - 1] - m.angle[0]), 2 * pi + 1e-9);

  // One circuit and one branch: the groups assemble on their sides over the whole turn.
  // A group of four links is followed from where it is drawn, at the first point.
  double least = pi / 2;
  const bool of_four = m.shape.program->group >= 0;
  const double from = found.crank_angle + (of_four ? m.angle[0] : 0);
  const std::vector<double> inputs{from};
  LinkageMotion turning(planned.plan);
  for (const TransmissionRange& range :
       transmission_ranges(planned.plan, inputs, 0, from, from + 2 * pi, 361, turning)) {
    EXPECT_EQ(range.missing, 0U);
    least = std::min(least, range.minimum);
  }
  // The measure of a group of four links is one of its own.
  if (of_four) return;
  // Beside the pair angle, a sleeve keeps the crank pin away from itself.
  if (m.shape.program->family != MachineFamily::inverted_slider) {
    EXPECT_NEAR(least, told.min_pair_angle, tenth_of_a_degree);
  }
  EXPECT_GE(least, told.min_pair_angle - tenth_of_a_degree);
}

TEST(FoundMachines, AreAsToldWhenTheyAreAnalysedAgain) {
  std::set<MachineFamily> families;
  int machines = 0;
  for (const char* stroke : {"leg", "heart", "square", "letter_s", "step"}) {
    const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case(stroke)));
    for (const auto& family : names(MachineFamily{})) {
      if (programs_of(family.value).empty() && family.value != MachineFamily::ten_bar) continue;
      // Each family alone, so that none is left out of the list by another one.
      std::vector<MachineFamily> searched{family.value};
      if (family.value == MachineFamily::ten_bar) searched.push_back(MachineFamily::eight_bar);
      RunContext context;
      const auto answer =
          search_types(target, {.families = searched, .max_links = 10, .max_curves = 30'000}, context);
      for (const FoundMachine& found : answer.machines) {
        SCOPED_TRACE(std::string(stroke) + ", " + found.machine.shape.program->name);
        expect_as_told(found, target);
        families.insert(found.machine.shape.program->family), ++machines;
      }
    }
  }
  EXPECT_EQ(families.size(), names(MachineFamily{}).size() - 1) << "all but Watt II, for functions alone";
  EXPECT_GE(machines, 40);
}

}  // namespace
}  // namespace linkwright::planar
