// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/function_starts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(FunctionPrograms, AreEachThereOnce) {
  std::set<std::string> known;
  std::array<int, 2> count{};
  for (const PointProgram* p : test::function_programs()) {
    EXPECT_TRUE(known.insert(p->name).second) << p->name;
    EXPECT_EQ(program_named(p->name), p);
    ++count[p->output == MachineOutput::slide];
    EXPECT_LT(static_cast<std::size_t>(p->traced_bar), p->bodies.size());
  }
  // Four-bar and sleeve, two six-bars and ten eight-bars; slider-crank, two six-bars and ten eight-bars.
  EXPECT_THAT(count, ::testing::ElementsAre(14, 13));
  EXPECT_TRUE(programs_of(MachineFamily::watt_2).empty()) << "it traces what its four-bar traces";
  EXPECT_EQ(links_of(MachineFamily::watt_2), 6);
}

/// Output of a machine in its own plane: the angle of its link, or the place of its slider.
double output_of(const MachineShape& shape, double angle, std::vector<double>* by = nullptr) {
  const bool slide = shape.program->output == MachineOutput::slide;
  std::array<double, 8> at, px, py, tx, ty, bx, by_y, rate, one{1, 1, 1, 1, 1, 1, 1, 1}, none{};
  at.fill(angle);
  std::vector<double> rows(8 * shape.x.size());
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = at.data(),
                 .count = 8,
                 .px = px.data(),
                 .py = py.data(),
                 .tx = tx.data(),
                 .ty = ty.data(),
                 .bx = bx.data(),
                 .by = by_y.data(),
                 .rate = rate.data(),
                 .nx = slide ? one.data() : none.data(),
                 .ny = none.data(),
                 .na = slide ? nullptr : one.data(),
                 .rows = rows.data(),
                 .stride = 8});
  if (by) {
    by->clear();
    for (std::size_t i = 0; i < shape.x.size(); ++i) by->push_back(rows[8 * i]);
    by->push_back(slide ? tx[0] : rate[0]);
  }
  return slide ? px[0] : std::atan2(by_y[0], bx[0]);
}

TEST(FunctionPrograms, HaveTheDerivativesOfTheirDifferences) {
  for (const PointProgram* p : test::function_programs()) {
    const MachineShape shape = test::some_shape(*p, 3);
    for (const double angle : {0.4, 2.9, 5.1}) {
      std::vector<double> by;
      output_of(shape, angle, &by);
      const auto slope = [&](auto&& moved) {
        constexpr double h = 1e-4;
        const auto part = [&](double step) { return std::remainder(moved(step) - moved(-step), 2 * pi); };
        return (8 * part(h) - part(2 * h)) / (12 * h);
      };
      for (std::size_t i = 0; i < shape.x.size(); ++i)
        EXPECT_NEAR(by[i], slope([&](double step) {
                      MachineShape other = shape;
                      other.x[i] += step;
                      return output_of(other, angle);
                    }),
                    1e-6 * (1 + std::abs(by[i])))
            << p->name << " parameter " << i;
      EXPECT_NEAR(by.back(), slope([&](double step) { return output_of(shape, angle + step); }),
                  1e-6 * (1 + std::abs(by.back())))
          << p->name;
    }
  }
}

// The solver of any linkage knows nothing of programs.
TEST(FunctionPrograms, MoveTheirOutputAsTheirLinkageDoes) {
  SampledStroke plain;
  for (const PointProgram* p : test::function_programs()) {
    FittedMachine m;
    m.shape = test::some_shape(*p, 11);
    double* x = m.shape.x.data() + p->place();
    x[0] = 0.4, x[1] = -0.2, x[2] = 0.3, x[3] = p->output == MachineOutput::slide ? 0 : -0.6;
    const FoundLinkage found = found_linkage(m, plain);
    const PlanResult planned = plan_linkage(found.linkage);
    ASSERT_TRUE(planned.problems.empty()) << p->name;
    LinkageMotion moving(planned.plan);
    const BodyPoint point = point_named(found.linkage, found.traced);
    for (int k = 0; k < 30; ++k) {
      const double angle = 0.2 * k;
      const InputMotion input{angle + found.crank_angle, 0, 0};
      solve_position(planned.plan, std::span(&input, 1), moving);
      ASSERT_EQ(moving.status, Status::done) << p->name;
      const PartState<double> body = body_state(planned.plan, moving, point.body);
      const double moved =
          p->output == MachineOutput::slide ? body.origin.x : std::atan2(body.direction.y, body.direction.x);
      EXPECT_LT(std::abs(std::remainder(moved - output_of(m.shape, angle), 2 * pi)), 1e-9) << p->name;
    }
  }
}

TEST(FunctionTargets, AreSampledOverTheirRange) {
  const auto square = [](double share) { return 0.3 * share * share; };
  const MotionTarget part = function_target({.output = MachineOutput::slide, .range = -2, .at = square});
  EXPECT_FALSE(part.turns);
  EXPECT_DOUBLE_EQ(part.turn[0], 0);
  EXPECT_DOUBLE_EQ(part.turn[stroke_samples - 1], -2);
  const double last = part.stroke.centre.real() + part.stroke.size * part.x[stroke_samples - 1];
  EXPECT_NEAR(last, 0.3, 1e-15);
  double squares = 0;
  for (const double x : part.x) squares += x * x;
  EXPECT_NEAR(squares, stroke_samples, 1e-9) << "the unit of lengths is the root mean square of the travel";
  const MotionTarget whole = function_target(
      {.at = [](double share) { return std::sin(2 * pi * share); }, .dwells = {{1.0, 2.0}, {3.0, 3.5}}});
  EXPECT_TRUE(whole.turns);
  EXPECT_DOUBLE_EQ(whole.turn[72], 1.5 * pi) << "without the end, which is the beginning";
  EXPECT_DOUBLE_EQ(whole.angle[72], -1);
  ASSERT_EQ(whole.rests.size(), 2u);
  EXPECT_EQ(whole.rests[0].first, 16u);
  EXPECT_EQ(whole.rests[0].end, 31u);
  EXPECT_EQ(whole.angle[30], whole.angle[16]) << "one value while it rests";
}

/// The function of a four-bar, as another one is to find it.
TEST(FunctionSearches, RecoverTheFunctionOfAFourBar) {
  const MachineShape own =
      test::some_shape(*programs_of(MachineFamily::four_bar, MachineOutput::angle)[0], 8);
  for (const double range : {2.0, -1.2, 2 * pi}) {
    std::vector<double> values;
    for (int k = 0; k <= 400; ++k) {
      const double next = output_of(own, 1.1 + range * k / 400);
      values.push_back(k == 0 ? next : values.back() + std::remainder(next - values.back(), 2 * pi));
    }
    const auto at = [&](double share) {
      const double next = output_of(own, 1.1 + range * share);
      const double near = values[static_cast<std::size_t>(std::lround(400 * share))];
      return near + std::remainder(next - near, 2 * pi);
    };
    RunContext context;
    const TypeSearchAnswer answer =
        search_types(function_target({.range = range, .at = at}),
                     {.families = {MachineFamily::four_bar},
                      .limits = {.min_pair_angle = 0.1, .min_length = 1e-3, .max_length = 1000},
                      .max_curves = 150'000},
                     context);
    ASSERT_FALSE(answer.machines.empty());
    EXPECT_LT(answer.machines[0].measures.error, 1e-6) << "over " << range;
  }
}

TEST(FunctionSearches, NeverDoWorseWithAParallelogramMore) {
  const auto at = [](double share) { return 0.8 * std::sqrt(1 + 3 * share); };
  const MotionTarget target = function_target({.range = 1.5, .at = at});
  RunContext context;
  const TypeSearchAnswer answer = search_types(
      target, {.families = {MachineFamily::four_bar, MachineFamily::watt_2}, .max_curves = 60'000}, context);
  MachineFitter fitter(target, {});
  int grown = 0;
  for (const FoundMachine& found : answer.machines) {
    if (found.machine.shape.program->family != MachineFamily::four_bar) continue;
    for (std::uint32_t k = 0; k < 20; ++k) {
      RandomStream random({.seed = 4, .individual = k});
      auto more = grown_by_parallelogram(found.machine, MachineFamily::watt_2, random);
      ASSERT_TRUE(more);
      EXPECT_FALSE(grown_by_parallelogram(found.machine, MachineFamily::stephenson_3, random));
      EXPECT_EQ(more->shape.program->name, "watt_2:angle");
      const double error = fitter.turn_body(*more);
      EXPECT_NEAR(error, found.machine.error, 1e-9);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto eight = grown_by_parallelogram(*more, MachineFamily::eight_bar, random);
        ASSERT_TRUE(eight);
        FittedMachine again = *eight;
        EXPECT_NEAR(fitter.turn_body(again), error, 1e-9) << eight->shape.program->name;
      }
      ++grown;
    }
  }
  EXPECT_GT(grown, 0);
  ASSERT_EQ(answer.families.size(), 2u);
  EXPECT_LE(answer.families[1].error, answer.families[0].error * (1 + 1e-9));
}

TEST(FunctionSearches, LeaveTheValueOfADwellFree) {
  // The level of the rest does not count, what happens beside it does.
  const auto with_level = [](double level) {
    return function_target({.output = MachineOutput::slide,
                            .range = 2 * pi,
                            .at =
                                [level](double share) {
                                  return share > 0.3 && share < 0.45 ? level
                                                                     : 0.05 * std::sin(2 * pi * share);
                                },
                            .dwells = {{0.3 * 2 * pi, 0.45 * 2 * pi}}});
  };
  const MotionTarget low = with_level(0.04), high = with_level(0.045);
  MachineFitter fitter(low, {}), other(high, {});
  FittedMachine m{.shape = test::some_shape(*program_named("slider_crank:slide"), 2)};
  const double error = begin_function(low, fitter, 0.3, m) * low.stroke.size;
  // The same machine in the unit of the other target.
  for (int i = 0; i < 4; ++i)
    m.shape.x[m.shape.x.size() - 4 + static_cast<std::size_t>(i)] *= low.stroke.size / high.stroke.size;
  m.shape.x[m.shape.x.size() - 4] +=
      (low.stroke.centre.real() - high.stroke.centre.real()) / high.stroke.size;
  EXPECT_NEAR(other.turn_body(m) * high.stroke.size, error, 1e-9 * error);
}

TEST(FunctionSearches, GiveTheSameBitsOnOneThreadAndTwo) {
  const MotionTarget target =
      function_target({.range = pi / 2, .at = [](double share) { return std::sin(0.5 * pi * share); }});
  std::vector<std::vector<double>> found;
  for (const int threads : {1, 2}) {
    RunContext context;
    context.set_threads(threads);
    const TypeSearchAnswer answer = search_types(target, {.max_links = 6, .max_curves = 60'000}, context);
    std::vector<double>& all = found.emplace_back();
    for (const FoundMachine& m : answer.machines)
      all.insert(all.end(), m.machine.shape.x.begin(), m.machine.shape.x.end());
  }
  ASSERT_FALSE(found[0].empty());
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace linkwright::planar
