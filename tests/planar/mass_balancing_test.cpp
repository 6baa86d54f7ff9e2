#include "linkwright/planar/mass_balancing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "planar/reactions_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using linkwright::test::message;
using testing::at;
using testing::dynamics_case;
using ::testing::HasSubstr;
using testing::number_at;

constexpr double pi = std::numbers::pi;

// The published machine at 300 rpm over one turn, 201 samples (Boskovic 2018, section 2.4).
FourBarMachine original() {
  return {{.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32},
          {{0.36, 4.13e-4, 0.05, 0}, {1.296, 1.87e-2, 0.2, 0}, {1.046, 9.85e-3, 0.16, 0}}};
}
LinearForces turn_of(const FourBarMachine& machine) {
  std::vector<double> angle;
  for (int i = 0; i <= 200; ++i) angle.push_back(2 * pi * i / 200);
  const double speed[] = {10 * pi};
  return linear_forces(machine, 9.81, {.value = angle, .rate = speed});
}
std::vector<OpenLink> published_bounds() {  // Table 2.4
  return {{.link = 0, .mass = {0.01, 3}, .centre_distance = {0.001, 0.1}, .inertia = {2e-4, 60e-4}},
          {.link = 1, .mass = {0.8, 1.6}, .centre_distance = {0.001, 0.4}, .inertia = {2e-2, 7e-2}},
          {.link = 2, .mass = {0.5, 1.5}, .centre_distance = {0.001, 0.32}, .inertia = {8e-3, 18e-3}}};
}

std::string column(const std::string& published) {
  if (published == "M_1") return "drive_torque_N_m";
  if (published == "F_shx") return "shaking_force_x_N";
  if (published == "F_shy") return "shaking_force_y_N";
  if (published == "M_sh") return "shaking_moment_with_drive_N_m";
  return published.substr(2) + (published[0] == 'X' ? "_x_N" : "_y_N");
}

struct Published {
  const char *problem, *mode;
  double value;  // of the table of best-known values
};

MassBalancing task(const std::string& problem, const std::string& mode) {
  MassBalancing b{.forces = turn_of(original()), .links = published_bounds()};
  const Value& published = dynamics_case("published-" + problem + "-H-CS-FA");
  const Value::Array& names =
      at(dynamics_case("best-known-" + problem + "-rms-mean-fixed-lengths"), "computed.objectives")
          .as_array();
  for (const Value& name : names) {
    ForceObjective o{.quantity = column(name.as_string()), .measure = Measure::rss_over_n};
    if (mode == "minimax_pub")
      o.reference = number_at(published, "computed.f_2_80_delta200." + name.as_string());
    if (mode == "mean") o.weight = 1 / static_cast<double>(names.size());
    b.objectives.push_back(o);
  }
  b.cost = mode == "mean" ? ForceCost::sum : ForceCost::largest;
  return b;
}

class FixedLengths : public ::testing::TestWithParam<Published> {};

TEST_P(FixedLengths, ReachTheBestKnownValueWithProof) {
  const Published& p = GetParam();
  RunContext context;
  const MassBalancing b = task(p.problem, p.mode);
  const BalancedMasses r = balance(b, context);
  ASSERT_EQ(r.status, Status::done);
  EXPECT_NEAR(r.cost, p.value, 1e-5 * p.value);
  EXPECT_TRUE(r.global()) << ::testing::PrintToString(r.broken);
  EXPECT_LT(r.gap, 1e-9);
  EXPECT_LE(r.lower_bound, r.cost * (1 + 1e-12));

  // The design itself: measures by the plain functions, and within the published bounds.
  FourBarMachine m = original();
  m.masses = {r.links[0], r.links[1], r.links[2]};
  const std::vector<OpenLink> bounds = published_bounds();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto inside = [&](double value, const Range& range) {
      EXPECT_GE(value, range.lower * (1 - 1e-6)) << k;
      EXPECT_LE(value, range.upper * (1 + 1e-6)) << k;
    };
    inside(r.links[k].mass, bounds[k].mass);
    inside(r.links[k].centre_distance, bounds[k].centre_distance);
    inside(r.links[k].inertia, bounds[k].inertia);
  }
  double cost = 0;
  for (std::size_t k = 0; k < b.objectives.size(); ++k) {
    std::vector<double> samples;
    for (int i = 0; i <= 200; ++i) {
      const auto q = testing::quantities(
          reactions(m.linkage, m.masses, rates(m.linkage, 2 * pi * i / 200, 10 * pi, 0), 9.81));
      for (std::size_t c = 0; c < q.size(); ++c)
        if (c < 12 && column(std::string(testing::quantity_names[c])) == b.objectives[k].quantity)
          samples.push_back(q[c]);
    }
    const double reference = b.objectives[k].reference.value_or(r.before[k]);
    const double share = b.objectives[k].weight * rss_over_n(samples) / reference;
    cost = b.cost == ForceCost::sum ? cost + share : std::max(cost, share);
  }
  EXPECT_NEAR(cost, r.cost, 1e-9 * r.cost);
}

INSTANTIATE_TEST_SUITE_P(
    Table, FixedLengths,
    ::testing::Values(Published{"case1", "minimax_orig", 0.537435}, Published{"case1", "mean", 0.292867},
                      Published{"case1", "minimax_pub", 1.848316},
                      Published{"case2", "minimax_orig", 0.537435}, Published{"case2", "mean", 0.274609},
                      Published{"case2", "minimax_pub", 1.939154},
                      Published{"case3", "minimax_orig", 0.159972}, Published{"case3", "mean", 0.112136},
                      Published{"case3", "minimax_pub", 0.830661}),
    [](const auto& tested) { return std::string(tested.param.problem) + "_" + tested.param.mode; });

}  // namespace
}  // namespace linkwright::planar
