// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/sweep.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/detail/sweep_kernel.h"
#include "planar/reactions_cases.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::any_angle;
using test::between;
using ::testing::HasSubstr;

// Row r of the plain functions, in the order of FourBarRow.
std::vector<double> plain(const FourBarRates& r, const FourBarReactions& f) {
  std::vector<double> out;
  for (const auto& z : {r.crank_direction, r.coupler_direction, r.rocker_direction})
    out.insert(out.end(), {z.real(), z.imag()});
  out.insert(out.end(), {r.transmission_sine, r.coupler_speed, r.rocker_speed, r.coupler_acceleration,
                         r.rocker_acceleration});
  for (const auto& z : {f.ground_on_crank, f.crank_on_coupler, f.rocker_on_coupler, f.ground_on_rocker})
    out.insert(out.end(), {z.real(), z.imag()});
  out.insert(out.end(), {f.drive_torque, f.shaking_force.real(), f.shaking_force.imag(), f.shaking_moment,
                         f.shaking_moment_with_drive});
  return out;
}

// Sample k of a sweep at row `angle` against the plain functions.
void compare(const FourBarSweep& sweep, const FourBarMachine& m, double gravity, double crank, double speed,
             double acceleration, std::size_t k, std::size_t angle) {
  const FourBar& l = m.linkage;
  const FourBarRates r = rates(l, crank, speed, acceleration);
  const FourBarReactions f = reactions(l, m.masses, r, gravity);
  const std::vector<double> expected = plain(r, f);
  // Both ways round some hundred times; positions feel it by the lengths over the sine, speeds once more,
  // accelerations and forces twice.
  const double lengths =
      (l.ground + l.crank + l.coupler + l.rocker) / std::min({l.crank, l.coupler, l.rocker});
  const double sine = std::abs(r.transmission_sine);
  RC_PRE(r.status != Status::done || sine > 1e-3);  // nearer the status itself is a matter of rounding
  RC_ASSERT(sweep.status(angle)[k] == r.status);
  const double place = 2e-15 * lengths * lengths / sine;
  const double fast = std::abs(speed) * lengths / sine + 1;
  const double faster = fast * fast + std::abs(acceleration) * lengths / sine + gravity;
  const double mass = m.masses.crank.mass + m.masses.coupler.mass + m.masses.rocker.mass + 6, arm = 3;
  const double reach = l.ground + l.crank + l.coupler + l.rocker + arm;
  const double shortest = std::min({l.crank, l.coupler, l.rocker});
  const double force = mass * reach * (1 + reach / shortest) * faster / sine;
  for (std::size_t row = 0; row < four_bar_row_count; ++row) {
    const double value = sweep.row(static_cast<FourBarRow>(row), angle)[k];
    if (std::isnan(expected[row])) {
      RC_ASSERT(std::isnan(value));
      continue;
    }
    const bool moment = row == 19 || row >= 22;
    const double size = r.status != Status::done ? 0
                        : row < 7                ? 1
                        : row < 9                ? fast
                        : row < 11               ? faster
                        : moment                 ? force * reach
                                                 : force;
    RC_ASSERT(std::abs(value - expected[row]) <= (size == 0 ? 0 : place / sine * size));
  }
}

RC_GTEST_PROP(FourBarSweepProperty, OverAnglesEqualsThePlainFunctions, ()) {
  const FourBarMachine m{*test::any_four_bar(), *test::any_masses()};
  const auto n = *rc::gen::inRange<std::size_t>(1, 40);
  const double gravity = *between(0, 20);
  std::vector<double> angle(n), speed(n), acceleration(n);
  for (std::size_t i = 0; i < n; ++i)
    angle[i] = *any_angle(), speed[i] = *between(-40, 40), acceleration[i] = *between(-300, 300);
  FourBarSweep sweep({});
  sweep.run(m.linkage, m.masses, gravity, {angle, speed, acceleration});
  RC_ASSERT(sweep.status().size() == n);
  for (std::size_t i = 0; i < n; ++i) compare(sweep, m, gravity, angle[i], speed[i], acceleration[i], i, 0);
}

RC_GTEST_PROP(FourBarSweepProperty, OverMachinesEqualsThePlainFunctions, ()) {
  std::vector<FourBarMachine> machines(*rc::gen::inRange<std::size_t>(1, 20));
  for (FourBarMachine& m : machines) m = {*test::any_four_bar(), *test::any_masses()};
  const double gravity = *between(0, 20), speed = *between(-40, 40), acceleration = *between(-300, 300);
  const std::vector<double> angle = {*any_angle(), *any_angle(), *any_angle()};
  FourBarSweep sweep({});
  sweep.run(machines, gravity, {angle, {&speed, 1}, {&acceleration, 1}});
  for (std::size_t i = 0; i < angle.size(); ++i)
    for (std::size_t k = 0; k < machines.size(); ++k)
      compare(sweep, machines[k], gravity, angle[i], speed, acceleration, k, i);
}

const FourBarMachine crank_rocker{
    {.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32},
    {{0.36, 4.13e-4, 0.05, 0}, {1.296, 1.87e-2, 0.2, 0.1}, {1.046, 9.85e-3, 0.16, 3}}};

TEST(FourBarSweep, NamesWhatKeepsASampleFromBeingComputed) {
  const FourBar rocker{.ground = 2, .crank = 1.5, .coupler = 1, .rocker = 1};
  const double dead = std::acos((1.5 * 1.5 + 4 - 4) / (2 * 1.5 * 2));
  const std::vector<double> angle = {0.3, dead, pi, -0.3};
  FourBarSweep sweep({});
  sweep.run(rocker, crank_rocker.masses, 9.81, {angle, {}, {}});
  EXPECT_THAT(sweep.status(),
              ::testing::ElementsAre(Status::done, Status::singular, Status::no_assembly, Status::done));
  // Directions are known at a dead point, what depends on its sine is not; apart, the crank alone is known.
  EXPECT_FALSE(std::isnan(sweep.row(FourBarRow::rocker_x)[1]));
  EXPECT_TRUE(std::isnan(sweep.row(FourBarRow::drive_torque)[1]));
  EXPECT_EQ(sweep.row(FourBarRow::crank_x)[2], rates(rocker, angle[2], 0).crank_direction.real());
  EXPECT_TRUE(std::isnan(sweep.row(FourBarRow::coupler_x)[2]));
}

TEST(FourBarSweep, TakesAnglesOfManyTurns) {
  const std::vector<double> angle = {1.0, 1e5, 3e7};
  const double speed = 3;
  FourBarSweep sweep({});
  sweep.run(crank_rocker.linkage, crank_rocker.masses, 9.81, {angle, {&speed, 1}, {}});
  const FourBarRates far = rates(crank_rocker.linkage, 3e7, 3);
  EXPECT_EQ(sweep.row(FourBarRow::rocker_speed)[2], far.rocker_speed);  // the plain function itself
}

TEST(FourBarSweep, KeepsWhatIsWantedWithTheSameBits) {
  std::vector<double> angle(50);
  for (std::size_t i = 0; i < angle.size(); ++i) angle[i] = 0.1 * static_cast<double>(i);
  const double speed = 31.4;
  const SweepInput crank{angle, {&speed, 1}, {}};
  FourBarSweep all({}), some({.directions = false, .rates = false, .forces = false});
  all.run(crank_rocker.linkage, crank_rocker.masses, 9.81, crank);
  some.run(crank_rocker.linkage, crank_rocker.masses, 9.81, crank);
  const auto a = all.row(FourBarRow::shaking_moment), b = some.row(FourBarRow::shaking_moment);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  EXPECT_THAT(test::message([&] { some.row(FourBarRow::coupler_speed); }),
              HasSubstr("row 7 is not wanted of this sweep"));
}

// The rows of `four_bar_constants` of a crank-rocker: ground direction, lengths, branch; base parameters of
// crank, coupler and rocker.
constexpr double crank_rocker_rows[] = {1,    0,     0.6,  0.1,  0.4, 0.32, 1,  //
                                        0.36, 0.018, 0,    1e-3,                //
                                        1.3,  0.26,  0.02, 0.07,                //
                                        1,    -0.17, 0.02, 0.04};
static_assert(std::size(crank_rocker_rows) == four_bar_constants);

TEST(FourBarSweep, EveryInstructionSetGivesTheSameUpToRounding) {
  // The chosen kernel is compared above; the baseline runs everywhere.
  std::vector<double> rows(four_bar_constants * 8), angle(8), ones(8, 31.4), zeros(8, 0.0), good(8);
  std::vector<double> data(four_bar_row_count * 8), other(four_bar_row_count * 8);
  for (std::size_t i = 0; i < four_bar_constants; ++i) rows[8 * i] = crank_rocker_rows[i];
  for (std::size_t i = 0; i < 8; ++i) angle[i] = 0.7 * static_cast<double>(i);
  FourBarSweepTask task{.gravity = 9.81, .constants = rows.data(), .lanes = 8, .angles = 1};
  task.angle = angle.data(), task.rate = ones.data(), task.acceleration = zeros.data();
  task.rows = four_bar_row_count, task.good = good.data();
  for (std::size_t r = 0; r < four_bar_row_count; ++r) task.first[r] = r;
  task.data = data.data();
  EXPECT_TRUE(four_bar_sweep_baseline(task));
  for (const auto& [run, name] : runnable(four_bar_sweep_kernels())) {
    task.data = other.data();
    EXPECT_TRUE(run(task));
    // Forces of some hundred newtons, rates of some hundred rad/s2.
    for (std::size_t i = 0; i < data.size(); ++i) EXPECT_NEAR(other[i], data[i], 1e-11) << name << ' ' << i;
  }
}

TEST(FourBarSweep, OfNothingIsEmpty) {
  const double speed = 3, angle = 1;
  FourBarSweep sweep({});
  sweep.run(crank_rocker.linkage, crank_rocker.masses, 9.81, {{}, {&speed, 1}, {}});
  EXPECT_TRUE(sweep.row(FourBarRow::drive_torque).empty());
  sweep.run({}, 9.81, {{&angle, 1}, {&speed, 1}, {}});
  EXPECT_TRUE(sweep.status().empty());
}

TEST(FourBarSweep, AllocatesNothingTheSecondTime) {
  const std::vector<double> angle(100, 0.3);
  const std::vector<FourBarMachine> machines(10, crank_rocker);
  FourBarSweep sweep({});
  sweep.run(machines, 9.81, {angle, {}, {}});
  const std::size_t before = test::allocations();
  sweep.run(machines, 9.81, {angle, {}, {}});
  EXPECT_EQ(test::allocations(), before);
}

TEST(FourBarSweep, RejectsWhatThePlainFunctionsReject) {
  const std::vector<double> angle(3), two(2), bad = {0, std::nan(""), 0};
  FourBarSweep sweep({});
  const auto run = [&](const FourBarMachine& m, const SweepInput& crank) {
    return test::message([&] { sweep.run(m.linkage, m.masses, 9.81, crank); });
  };
  EXPECT_THAT(run(crank_rocker, {angle, two, {}}),
              HasSubstr("3 crank angles need as many rates and accelerations, one or none, got 2 and 0"));
  EXPECT_THAT(run(crank_rocker, {bad, {}, {}}), HasSubstr("of 3 samples must be finite"));
  FourBarMachine m = crank_rocker;
  m.masses.coupler.mass = -1;
  EXPECT_THAT(run(m, {angle, {}, {}}), HasSubstr("base_parameters: mass -1, inertia "));
  m = crank_rocker;
  m.linkage.coupler = 0;
  EXPECT_THAT(run(m, {angle, {}, {}}), HasSubstr("link lengths must be positive"));
  EXPECT_EQ(four_bar_sweep_kernel_name()[0] != '\0', true);
}

}  // namespace
}  // namespace linkwright::planar
