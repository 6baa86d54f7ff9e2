// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/sweep.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkage_cases.h"
#include "tests/support/allocations.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

struct Inputs {
  std::vector<double> value, rate, acceleration;
  SweepInput view() const { return {value, rate, acceleration}; }
};
Inputs turn_of(std::size_t n, double from = 0, double to = 2 * pi) {
  Inputs in;
  for (std::size_t i = 0; i < n; ++i) {
    in.value.push_back(from + (to - from) * (static_cast<double>(i) + 0.3) / static_cast<double>(n));
    in.rate.push_back(3 + 0.01 * static_cast<double>(i));
    in.acceleration.push_back(-2 + 0.05 * static_cast<double>(i));
  }
  return in;
}

// Every number of a sweep beside the functions for one position.
void expect_same(const Linkage& linkage, const LinkagePlan& plan, const LinkageSweep& sweep,
                 const Inputs& in) {
  LinkageMotion m(plan);
  LinkageForces f;
  ASSERT_EQ(sweep.samples(), in.value.size());
  for (std::size_t i = 0; i < in.value.size(); ++i) {
    SCOPED_TRACE(in.value[i]);
    solve_motion(plan, std::vector<InputMotion>{{in.value[i], in.rate[i], in.acceleration[i]}}, m);
    solve_forces(linkage, plan, m, 0, in.value[i], f);
    ASSERT_EQ(sweep.status()[i], m.status);
    if (m.status != Status::done) {
      EXPECT_TRUE(std::isnan(sweep.joint(0, JointRow::force_x)[i]));
      EXPECT_TRUE(std::isnan(sweep.part(plan.groups.back().parts[0], PartRow::x)[i]));
      EXPECT_FALSE(std::isnan(sweep.part(1, PartRow::x)[i]));
      continue;
    }
    // Some tens of operations, the divisions by sines and roots magnify their rounding.
    double bad = 1, largest = 0, fastest = 0;
    for (std::size_t k = 0; k < plan.groups.size(); ++k)
      if (!plan.groups[k].as<Driver>()) bad = std::min(bad, std::abs(m.groups[k].sine));
    for (const JointReaction& r : f.joints) largest = std::max(largest, norm(r.force));
    const double eps = 1e-13 / (bad * bad);
    for (std::size_t p = 1; p < plan.parts.size(); ++p) {
      const PartState<double>& s = m.parts[p];
      fastest = std::max({fastest, norm(s.acceleration), std::abs(s.angular_acceleration)});
      const auto row = [&](PartRow r) { return sweep.part(static_cast<int>(p), r)[i]; };
      EXPECT_NEAR(row(PartRow::x), s.origin.x, eps);
      EXPECT_NEAR(row(PartRow::y), s.origin.y, eps);
      EXPECT_NEAR(row(PartRow::direction_x), s.direction.x, eps);
      EXPECT_NEAR(row(PartRow::direction_y), s.direction.y, eps);
      EXPECT_NEAR(row(PartRow::velocity_x), s.velocity.x, 10 * eps);
      EXPECT_NEAR(row(PartRow::velocity_y), s.velocity.y, 10 * eps);
      EXPECT_NEAR(row(PartRow::speed), s.speed, 100 * eps);
      EXPECT_NEAR(row(PartRow::acceleration_x), s.acceleration.x, 10 * eps * (fastest + 10));
      EXPECT_NEAR(row(PartRow::acceleration_y), s.acceleration.y, 10 * eps * (fastest + 10));
      EXPECT_NEAR(row(PartRow::angular_acceleration), s.angular_acceleration, 10 * eps * (fastest + 10));
    }
    for (std::size_t k = 0; k < plan.groups.size(); ++k) {
      if (!traits_of(plan.groups[k]).has_modes) continue;
      EXPECT_NEAR(sweep.group(static_cast<int>(k), GroupRow::sine)[i], m.groups[k].sine, eps);
      EXPECT_NEAR(sweep.group(static_cast<int>(k), GroupRow::radicand)[i], m.groups[k].radicand, eps);
    }
    const double force = 10 * eps * (largest + 1);
    for (std::size_t j = 0; j < linkage.joints.size(); ++j) {
      EXPECT_NEAR(sweep.joint(static_cast<int>(j), JointRow::force_x)[i], f.joints[j].force.x, force) << j;
      EXPECT_NEAR(sweep.joint(static_cast<int>(j), JointRow::force_y)[i], f.joints[j].force.y, force) << j;
      EXPECT_NEAR(sweep.joint(static_cast<int>(j), JointRow::moment)[i], f.joints[j].moment, force) << j;
    }
    EXPECT_NEAR(sweep.drive(0)[i], f.drives[0], force);
    EXPECT_NEAR(sweep.shaking(ShakingRow::force_x)[i], f.shaking_force.x, force);
    EXPECT_NEAR(sweep.shaking(ShakingRow::force_y)[i], f.shaking_force.y, force);
    EXPECT_NEAR(sweep.shaking(ShakingRow::moment_with_drive)[i], f.shaking_moment_with_drive, force);
  }
}

TEST(LinkageSweepTest, AgreesWithOnePositionAtATime) {
  int together = 0;
  std::vector<LinkageSample> samples(linkage_samples().begin(), linkage_samples().end());
  samples.push_back({"rod_row", "", rod_row(4), {0.1}, {3}, 1, {}});
  for (const LinkageSample& s : samples) {
    if (s.from.size() != 1) continue;
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageSweep sweep(s.linkage, p, {.rates = true, .forces = true});
    together += sweep.batched();
    // Without closed form there are several answers; the test of following is elsewhere.
    if (!p.closed_form()) continue;
    for (const std::size_t n : {1u, 3u, 8u, 61u}) {
      const Inputs in = turn_of(n, s.from[0], s.to[0]);
      sweep.run(std::vector<SweepInput>{in.view()});
      expect_same(s.linkage, p, sweep, in);
    }
  }
  EXPECT_GE(together, 10);
}

TEST(LinkageSweepTest, TellsWhereItDoesNotAssemble) {
  const Linkage l = four_bar_linkage(1, 1, 0.6, 0.7);
  const LinkagePlan p = planned(l);
  LinkageSweep sweep(l, p, {.rates = true, .forces = true});
  const Inputs in = turn_of(50);
  sweep.run(std::vector<SweepInput>{in.view()});
  expect_same(l, p, sweep, in);
  EXPECT_EQ(std::count(sweep.status().begin(), sweep.status().end(), Status::done), 20);
  // The dead point of a parallelogram is singular, not missing.
  const Linkage parallelogram = four_bar_linkage(2, 1, 2, 1);
  LinkageSweep flat(parallelogram, planned(parallelogram), {.rates = false, .forces = false});
  const std::vector<double> values{0.1, 0, pi};
  flat.run(std::vector<SweepInput>{{values, {}, {}}});
  EXPECT_EQ(flat.status()[0], Status::done);
  EXPECT_EQ(flat.status()[1], Status::singular);
  EXPECT_EQ(flat.status()[2], Status::singular);
}

TEST(LinkageSweepTest, EveryInstructionSetGivesTheSame) {
  const Linkage l = jansen_leg();
  const LinkagePlan p = planned(l);
  std::vector<double> modes;
  for (const Group& g : p.groups) modes.push_back(g.mode);
  SweepTask t;
  t.plan = &p;
  t.modes = modes.data();
  t.gravity = {0, -9.81};
  t.count = t.stride = 64;
  t.forces = true;
  std::size_t rows = 3;
  const auto take = [&](std::size_t& first, std::size_t count) { first = rows, rows += count; };
  take(t.parts, 10 * (p.parts.size() - 1));
  take(t.groups, 2 * p.groups.size());
  take(t.joints, 3 * l.joints.size());
  take(t.drives, 1);
  take(t.shaking, 3);
  take(t.good, 1);
  std::vector<std::vector<double>> all;
  for (const auto& [run, name] : runnable(sweep_kernels())) {
    std::vector<double> data(rows * t.stride, 0.0);
    for (std::size_t i = 0; i < t.count; ++i) {
      data[i] = 0.1 * static_cast<double>(i);
      data[t.stride + i] = 4;
      data[2 * t.stride + i] = 1;
    }
    t.data = data.data();
    run(t);
    all.push_back(std::move(data));
  }
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t i = 0; i < all[0].size(); ++i)
      // Fused operations round differently; numbers up to some hundred.
      EXPECT_NEAR(all[k][i], all[0][i], 1e-10);
}

TEST(LinkageSweepTest, ModesCanBeChosen) {
  const Linkage l = four_bar_linkage(0.6, 0.1, 0.4, 0.32);
  LinkageSweep sweep(l, planned(l), {.rates = false, .forces = false});
  const std::vector<double> values{1.0};
  sweep.set_modes(std::vector<double>{1, -1});
  sweep.run(std::vector<SweepInput>{{values, {}, {}}});
  EXPECT_LT(sweep.group(1, GroupRow::sine)[0], 0);
  sweep.set_modes(std::vector<double>{1, 1});
  sweep.run(std::vector<SweepInput>{{values, {}, {}}});
  EXPECT_GT(sweep.group(1, GroupRow::sine)[0], 0);
}

TEST(LinkageSweepTest, LoadsAndGeneralGroupsGoOneByOne) {
  Linkage l = four_bar_linkage(0.6, 0.1, 0.4, 0.32);
  l.torques.push_back({"load", body_index(l, "rocker"), 0, -2, {}});
  const LinkagePlan p = planned(l);
  LinkageSweep sweep(l, p, {.rates = true, .forces = true});
  EXPECT_FALSE(sweep.batched());
  const Inputs in = turn_of(20);
  sweep.run(std::vector<SweepInput>{in.view()});
  expect_same(l, p, sweep, in);
  EXPECT_TRUE(LinkageSweep(l, p, {.rates = true, .forces = false}).batched());

  // All at once, followed along its branch: the same numbers.
  const Linkage leg = jansen_leg();
  const LinkagePlan along = planned(leg);
  LinkageSweep closed(leg, along, {.rates = true, .forces = true});
  const Inputs turn = turn_of(40);
  closed.run(std::vector<SweepInput>{turn.view()});
  LinkagePlan at_once = planned(leg, PlanRoute::all_at_once);
  LinkageMotion m(along);
  solve_motion(along, std::vector<InputMotion>{{turn.value[0], 0, 0}}, m);
  for (std::size_t i = 0; i < at_once.groups[0].parts.size(); ++i) {
    const PartState<double>& s = m.parts[static_cast<std::size_t>(at_once.groups[0].parts[i])];
    std::vector<math::Pose>& start = std::get<GeneralGroup>(at_once.groups[0].kind).start;
    start.resize(at_once.groups[0].parts.size());
    start[i] = {s.origin.x, s.origin.y, angle_of(s.direction)};
  }
  LinkageSweep followed(leg, at_once, {.rates = true, .forces = true});
  EXPECT_FALSE(followed.batched());
  followed.run(std::vector<SweepInput>{turn.view()});
  for (std::size_t i = 0; i < 40; ++i) {
    ASSERT_EQ(followed.status()[i], Status::done);
    EXPECT_NEAR(followed.part(7, PartRow::x)[i], closed.part(7, PartRow::x)[i], 1e-12);
    EXPECT_NEAR(followed.drive(0)[i], closed.drive(0)[i], 1e-9);
  }
}

TEST(LinkageSweepTest, AllocatesNothingAfterTheFirstRun) {
  const Linkage l = jansen_leg();
  LinkageSweep sweep(l, planned(l), {.rates = true, .forces = true});
  const Inputs in = turn_of(100);
  const std::vector<SweepInput> inputs{in.view()};
  sweep.run(inputs);
  const std::size_t before = test::allocations();
  sweep.run(inputs);
  EXPECT_EQ(test::allocations(), before);
}

TEST(LinkageSweepTest, RejectsWhatDoesNotFit) {
  const Linkage l = four_bar_linkage(0.6, 0.1, 0.4, 0.32);
  const LinkagePlan p = planned(l);
  EXPECT_THROW(LinkageSweep(l, p, {.rates = false, .forces = true}), ContractError);
  LinkageSweep sweep(l, p, {.rates = false, .forces = false});
  const std::vector<double> values{1, 2, 3}, two{1, 2}, bad{1, std::nan(""), 3};
  EXPECT_THROW(sweep.run({}), ContractError);
  EXPECT_THROW(sweep.run(std::vector<SweepInput>{{values, two, {}}}), ContractError);
  EXPECT_THROW(sweep.run(std::vector<SweepInput>{{bad, {}, {}}}), ContractError);
  sweep.run(std::vector<SweepInput>{{values, {}, {}}});
  EXPECT_THROW(sweep.part(1, PartRow::speed), ContractError);
  EXPECT_THROW(sweep.drive(0), ContractError);
  EXPECT_EQ(sweep.part(1, PartRow::x).size(), 3u);
}

}  // namespace
}  // namespace linkwright::planar
