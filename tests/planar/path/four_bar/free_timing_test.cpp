// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/free_timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/path/four_bar/fit.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// A curve with a loop and a crossing, and a target for every 10 degrees of it.
const FourBar looping{.ground = 2.2,
                      .crank = 0.75,
                      .coupler = 1.9,
                      .rocker = 1.6,
                      .coupler_u = 1.35,
                      .coupler_v = -1.05,
                      .pivot_x = 1,
                      .pivot_y = 2,
                      .frame_angle = 0.3};

PathProblem own_path(const FourBar& l, int count) {
  PathProblem p;
  for (int k = 0; k < count; ++k) {
    const auto c = position(l, 2 * pi * k / count).coupler_point;
    p.x.push_back(c.real());
    p.y.push_back(c.imag());
  }
  p.bounds = derive_bounds(p.x, p.y);
  return p;
}

// Crank angles that hurry past some targets and wait for others: a local search alone keeps the targets where
// they are, at the wrong side of the curve.
TEST(PolishFreeTiming, AssignsTheTargetsAnew) {
  const PathProblem p = own_path(looping, 36);
  std::vector<double> wrong;
  for (int k = 0; k < 36; ++k) wrong.push_back(2 * pi * (k / 36.0 + 0.28 * std::sin(2 * pi * k / 36.0) / 2));
  const PathDesign start = measure(p, looping, 1, wrong);
  ASSERT_THAT(start.violations, IsEmpty());
  ASSERT_GT(start.error, 1);
  std::int64_t evaluations = 0;
  const PathDesign polished = polish_free_timing(p, start, evaluations);
  EXPECT_LT(polished.error, 1e-18);
  EXPECT_THAT(polished.violations, IsEmpty());
  EXPECT_GT(evaluations, 0);
}

TEST(PolishFreeTiming, NeverReturnsAWorseDesign) {
  PathProblem p = printed_eighteen_points();
  p.timing = Timing::free;
  for (const char* id :
       {"P18-free-timing-mu-min-20", "P18-free-timing-mu-min-30", "P18-free-timing-mu-min-40"}) {
    const Value& stored = at(path_case(id), "computed.designs").as_array()[0];
    p.min_transmission_angle = 0;
    const PathDesign start = measure(p, four_bar(stored), 1, numbers(at(stored, "theta2_rad")));
    std::int64_t evaluations = 0;
    const PathDesign polished = polish_free_timing(p, start, evaluations);
    EXPECT_LE(polished.error, start.error) << id;  // the limit is gone
    EXPECT_THAT(polished.violations, IsEmpty());
  }
}

TEST(SearchFreeTiming, IsForFreeTimingOnly) {
  RunContext context;
  const PathProblem p = printed_eighteen_points();
  EXPECT_THAT([&] { search_free_timing(p, {}, context); },
              ThrowsMessage<ContractError>(HasSubstr("the timing is equal_steps")));
}

// ---- Smooth open paths

using Curve = std::complex<double> (*)(double);
struct Arc {
  const char* name;
  Curve at;  // t from 0 to 1
  int count;
  double reached;  // what every seed comes to (m2), next to the best of long searches
};
const Arc arcs[] = {
    {"parabola", [](double t) { return std::complex((2 * t - 1), (2 * t - 1) * (2 * t - 1)); }, 21, 2e-10},
    {"half sine", [](double t) { return std::complex(pi * t, std::sin(pi * t)); }, 25, 1.18e-7},
    {"S-curve", [](double t) { return std::complex(2 * t - 1, 0.4 * std::tanh(3 * (2 * t - 1))); }, 25,
     7.6e-6},
    {"half circle", [](double t) { return std::polar(1.0, pi * t); }, 24, 1e-20},
    {"flat half sine", [](double t) { return std::complex(t, 0.25 * std::sin(pi * t)); }, 13, 3.1e-8}};

PathProblem arc_problem(const Arc& arc) {
  PathProblem p;
  p.closed = false;
  p.crank_rotates_fully = false;
  p.search_negative = true;
  for (int k = 0; k < arc.count; ++k) {
    const auto c = arc.at(static_cast<double>(k) / (arc.count - 1));
    p.x.push_back(c.real());
    p.y.push_back(c.imag());
  }
  p.bounds = derive_bounds(p.x, p.y);
  return p;
}

double best_of(const PathProblem& p, std::uint64_t seed) {
  RunContext context;
  const PathSynthesis answer = synthesise_path(p, {.seed = seed}, context);
  EXPECT_EQ(answer.status, Status::done);
  EXPECT_THAT(answer.designs[0].violations, IsEmpty());
  return answer.designs[0].error;
}

TEST(SearchFreeTiming, DoesNotStopShortOnSmoothOpenPaths) {
  for (const Arc& arc : arcs)
    for (std::uint64_t seed : {1, 2})
      EXPECT_LE(best_of(arc_problem(arc), seed), arc.reached) << arc.name << " " << seed;
}

// What is found under a limit is allowed without it, and so it must be found. For the full turn of the crank
// and the usual transmission angle the search makes sure of it; for other limits it has to find what they
// find.
class LimitedArc : public ::testing::TestWithParam<Arc> {};

TEST_P(LimitedArc, ALimitNeverImprovesTheAnswer) {
  const PathProblem free = arc_problem(GetParam());
  const double zero = 1e-20 * path_size(free) * path_size(free);
  for (const std::uint64_t seed : {1, 3}) {
    const double unlimited = best_of(free, seed);
    PathProblem turning = free, transmitting = free;
    turning.crank_rotates_fully = true;
    const double turned = best_of(turning, seed);
    EXPECT_LE(unlimited, turned + zero) << "seed " << seed;
    transmitting.min_transmission_angle = pi / 6;
    EXPECT_LE(unlimited, best_of(transmitting, seed) + zero) << "seed " << seed;
    transmitting.crank_rotates_fully = true;
    const double both = best_of(transmitting, seed);
    EXPECT_LE(unlimited, both + zero) << "seed " << seed;
    EXPECT_LE(turned, both + zero) << "seed " << seed;
    PathProblem bounded = free;
    const double reach = 5 * path_size(free);
    for (std::size_t j = 0; j < 8; ++j) bounded.bounds[j] = {j < 4 ? free.bounds[j].lower : -reach, reach};
    EXPECT_LE(unlimited, 1.01 * best_of(bounded, seed) + zero) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Arcs, LimitedArc, ::testing::ValuesIn(arcs), [](const auto& tested) {
  std::string name = tested.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace linkwright::planar
