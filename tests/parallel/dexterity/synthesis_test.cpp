// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/dexterity/synthesis_samples.h"
#include "parallel/dexterity_cases.h"
#include "parallel/robots.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

TEST(DexteritySynthesis, IsTheSameForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    RunContext context;
    context.set_threads(threads);
    return synthesise(dexterity_benchmark(DexterityGoal::worst), {}, 7, context);
  };
  const DexteritySynthesis one = run(1), three = run(3);
  EXPECT_EQ(one.best.x, three.best.x);
  EXPECT_EQ(one.evaluations, three.evaluations);
  EXPECT_EQ(one.poses, three.poses);
}

// Few nodes overlook a little; kept to between them, the index costs that much.
TEST(DexteritySynthesis, LooksBetweenTheNodes) {
  DexterityTask task = dexterity_benchmark(DexterityGoal::worst);
  task.limits.constraint = 0;
  RunContext context;
  const DexteritySynthesis nodes = synthesise(task, {}, 1, context);
  EXPECT_LT(nodes.worst_between_nodes, nodes.best.worst - 1e-6);
  DexterityOptions options;
  options.between_nodes = true;
  const DexteritySynthesis between = synthesise(task, options, 1, context);
  EXPECT_GT(between.worst_between_nodes, nodes.worst_between_nodes + 1e-7);
  EXPECT_LT(between.best.worst, nodes.best.worst + 1e-9);
  // On a grid that is finer eight times in every direction.
  DexterityTask fine = task;
  fine.region.nodes = {33, 481, 33};
  EXPECT_GT(assess(fine, between.best.x).worst, between.worst_between_nodes - 1e-8);
}

// Robot and Pi-joints, designed together for the transmission angle that the joint has when it is designed
// after the robot, are the same: B3 and its Pi-joints of the reference. With less they find a smaller robot.
TEST(DexteritySynthesis, DesignsRobotAndPiJointsTogether) {
  const Value& joint = test::at(computed("synth-B3"), "pi_joint");
  const double sequential = computed_number("synth-B3", "best_La_plus_Lf_m");
  RunContext context;
  const DexteritySynthesis same =
      synthesise(dexterity_benchmark_with_pi_joints(test::number_at(joint, "mu_min_rad")), {}, 1, context);
  ASSERT_EQ(same.status, Status::done) << to_string(same.reason);
  EXPECT_NEAR(same.best.size, sequential, 1e-8);
  // A vertex: all of it is determined as well as the limits are kept to.
  EXPECT_NEAR(same.best.x[4], test::number_at(joint, "eps_rad"), 1e-6);
  EXPECT_NEAR(same.best.x[5], test::number_at(joint, "k"), 1e-6);
  const Drive& drive = same.best.drives[0];
  EXPECT_EQ(drive.type, DriveType::pi_joint);
  EXPECT_NEAR(drive.lowest, test::number_at(joint, "theta_lo_rad"), 1e-6);
  EXPECT_NEAR(drive.highest, test::number_at(joint, "theta_hi_rad"), 1e-6);
  const PiJoint pi_joint{same.best.robot.leg[0].arm, drive.ratio};
  EXPECT_NEAR(diagonal(pi_joint, drive.lowest), test::number_at(joint, "d_min_m"), 1e-6);
  EXPECT_NEAR(diagonal(pi_joint, drive.highest), test::number_at(joint, "d_max_m"), 1e-6);

  const DexteritySynthesis smaller =
      synthesise(dexterity_benchmark_with_pi_joints(math::radians(6)), {}, 1, context);
  EXPECT_EQ(smaller.status, Status::done);
  EXPECT_LT(smaller.best.size, 0.975 * sequential);
  EXPECT_TRUE(stand_of(smaller.best, DexterityLimit::telescoping)->active);
  EXPECT_TRUE(stand_of(smaller.best, DexterityLimit::pi_transmission)->active);
}

// The mirror image of a joint serves as well: theta runs the other way round.
TEST(DexteritySynthesis, MirroredPiJointsServeMirroredTravel) {
  DexterityTask task = dexterity_benchmark_with_pi_joints(math::radians(8));
  RunContext context;
  const DexteritySynthesis plain = synthesise(task, {}, 1, context);
  task.pi_joint->mirror = -1;
  const DexteritySynthesis mirrored = synthesise(task, {}, 1, context);
  ASSERT_EQ(mirrored.status, Status::done) << to_string(mirrored.reason);
  EXPECT_NEAR(mirrored.best.size, plain.best.size, 1e-8);
  EXPECT_NEAR(mirrored.best.drives[0].lowest, plain.best.drives[0].lowest, 1e-6);
  // Every pose of the region is one of the drives.
  const Pose pose{mirrored.best.origin + Vec3{0.1, 0.2, -0.1}};
  const ArmAngles arms = inverse(mirrored.best.robot, pose);
  EXPECT_EQ(drives_at(mirrored.best.robot, mirrored.best.drives, arms.angle).status, Status::done);
}

// Designs of a program that leaves the constraint out: none of it can be built, and all of it is refused.
TEST(DexteritySynthesis, RefusesDesignsWhosePlatformTurns) {
  for (const auto& [goal, id] : {std::pair{DexterityGoal::worst, "synth-B1"},
                                 {DexterityGoal::mean, "synth-B2"},
                                 {DexterityGoal::size, "synth-B3"}}) {
    const Value& former = test::at(computed(id), "without_constraint");
    DexterityTask task = dexterity_benchmark(goal);
    for (const double least : {0.2, 0.0}) {
      task.limits.constraint = least;
      const DexterityDesign found = assess(task, test::numbers(test::at(former, "x_R_La_Lf_zt")));
      EXPECT_EQ(found.status, Status::infeasible);
      EXPECT_NE(to_string(found.reason).find("constraint is -0."), std::string::npos)
          << to_string(found.reason);
      const DexterityStand* stand = stand_of(found, DexterityLimit::constraint);
      ASSERT_NE(stand, nullptr);
      EXPECT_NEAR(stand->value, test::number_at(former, "index_signed_min_on_E"), 1e-7) << id;
      EXPECT_FALSE(prove_region(task, found).proven);
    }
  }
}

// Each least index has its best design; with the sign alone the floor remains.
TEST(DexteritySynthesis, TheLeastIndexCostsDexterity) {
  RunContext context;
  for (const auto& [goal, id, key] : {std::tuple{DexterityGoal::worst, "synth-B1", "best_min_lci"},
                                      {DexterityGoal::mean, "synth-B2", "best_gci"},
                                      {DexterityGoal::size, "synth-B3", "best_La_plus_Lf_m"}})
    for (const auto& [asked, least] : {std::pair{"0.1", 0.1}, {"0.3", 0.3}}) {
      DexterityTask task = dexterity_benchmark(goal);
      task.limits.constraint = least;
      const Value& row = *test::at(computed(id), "by_least_index").find(asked);
      const double best = test::number_at(row, key);
      EXPECT_NEAR(assess(task, test::numbers(test::at(row, "x_R_La_Lf_zt"))).objective, best, 1e-9);
      const DexteritySynthesis found = synthesise(task, {}, 1, context);
      ASSERT_EQ(found.status, Status::done) << to_string(found.reason);
      EXPECT_NEAR(found.best.objective, best, 2e-8) << id << asked;
      EXPECT_TRUE(stand_of(found.best, DexterityLimit::constraint)->active);
    }
}

TEST(DexteritySynthesis, DesignsFiveBars) {
  DexterityTask task{
      .family = RobotFamily::five_bar,
      .dimensions = {{0, 0.5}, {0.05, 1}, {0.05, 1}, {0.02, 1}},
      .mode = elbows_out(RobotFamily::five_bar),
      .region = {.shape = RegionShape::rectangle, .width = 0.4, .height = 0.2, .nodes = {21, 21, 2}},
      .limits = {.size = 0.8}};
  RunContext context;
  const DexteritySynthesis half = synthesise(task, {}, 1, context);
  ASSERT_EQ(half.status, Status::done) << to_string(half.reason);
  EXPECT_GE(half.reached_best, 3);
  EXPECT_GT(half.best.worst, 0.3);
  // The whole rectangle of the mirrored robot has the same least index.
  task.region.symmetric = false;
  task.region.nodes[0] = 41;
  EXPECT_NEAR(assess(task, half.best.x).worst, half.best.worst, 1e-12);
  // A second way to the same number.
  const Pose pose{half.best.worst_place};
  const ArmAngles arms = inverse(half.best.robot, pose, task.mode);
  const Quality there = quality(half.best.robot, jacobians(half.best.robot, pose, arms.angle), 1);
  EXPECT_NEAR(1 / there.condition, half.best.worst, 1e-12);
}

TEST(DexteritySynthesis, DesignsHexasThatTilt) {
  const double tilt = math::radians(10);
  DexterityTask task{
      .family = RobotFamily::hexa,
      .dimensions = {{0.1, 0.4}, {0.02, 0.15}, {0.09, 0.09}, {0.2, 0.9}, {0.1, 0.5}, {0.2, 0.9}, {0.1, 0.8}},
      .length = 0.09,
      .region = {.width = 0.3, .height = 0.1, .symmetric = false, .nodes = {3, 13, 3}},
      .orientations = {{}, math::turn_x(tilt), math::turn_x(-tilt), math::turn_y(tilt), math::turn_y(-tilt)},
      .limits = {.transmission = 0.3, .size = 0.9}};
  RunContext context;
  const DexteritySynthesis found = synthesise(task, {.starts = 4}, 1, context);
  ASSERT_EQ(found.status, Status::done) << to_string(found.reason);
  EXPECT_GT(found.best.worst, 0.2);
  EXPECT_EQ(found.best.bounds[2], BoundState::fixed);
  // Every node holds in the sense of jacobians.h, with one sign of det Jx.
  double least = 1;
  for (const RegionPoint& point : region_nodes(task.region))
    for (const Mat3& rotation : task.orientations) {
      const Pose pose{found.best.origin + point.place, rotation};
      const ArmAngles arms = inverse(found.best.robot, pose);
      ASSERT_EQ(arms.status, Status::done);
      const Jacobians at = jacobians(found.best.robot, pose, arms.angle);
      const Quality there = quality(found.best.robot, at, 0.09);
      EXPECT_GT(there.transmission, 0.3 - 1e-8);
      EXPECT_GT(determinant(found.best.robot, at), 0);
      least = std::min(least, 1 / there.condition);
    }
  EXPECT_NEAR(least, found.best.worst, 1e-11);
}

TEST(DexteritySynthesis, PopulationMethodsMinimiseTheSameProblem) {
  optimise::OptimiserOptions method;
  method.differential_evolution.generations = 60;
  RunContext context;
  for (const DexterityGoal goal : {DexterityGoal::worst, DexterityGoal::mean, DexterityGoal::size}) {
    const DexterityTask task = dexterity_benchmark(goal);
    const DexterityEvolution found = evolve(task, method, {}, 1, context);
    EXPECT_EQ(found.best.status, Status::done) << to_string(found.best.reason);
    const DexteritySynthesis exact = synthesise(task, {}, 1, context);
    const double sign = goal == DexterityGoal::size ? 1 : -1;
    EXPECT_GT(sign * found.best.objective, sign * exact.best.objective - 1e-8);
    EXPECT_NEAR(found.report.cost, sign * found.best.objective, 1e-12);
    EXPECT_GT(found.poses, exact.poses);
  }
}

TEST(DexteritySynthesis, TellsWhatIsMissed) {
  DexterityTask task = dexterity_benchmark(DexterityGoal::size);
  task.limits.size = 0.7;
  RunContext context;
  const DexteritySynthesis found = synthesise(task, {.starts = 4}, 1, context);
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_GT(found.best.violation, 0);
  EXPECT_FALSE(found.reason.empty());
  task.limits.size = infinity;
  const DexterityDesign short_arms = assess(task, std::vector{0.1, 0.2, 0.3, 0.3});
  EXPECT_EQ(short_arms.status, Status::infeasible);
  EXPECT_NE(to_string(short_arms.reason).find("is required"), std::string::npos)
      << to_string(short_arms.reason);
}

TEST(DexteritySynthesis, EndsWhenCancelled) {
  RunContext context;
  context.cancel();
  const DexteritySynthesis found = synthesise(dexterity_benchmark(DexterityGoal::worst), {}, 1, context);
  EXPECT_EQ(found.status, Status::cancelled);
  EXPECT_EQ(found.best.x.size(), 4u);
}

// Many nodes: one look at all of them is what a run can be interrupted in.
TEST(DexteritySynthesis, LooksAtAPartOfTheNodesWhenItIsToStop) {
  const auto fine = [](DexterityGoal goal) {
    DexterityTask task = dexterity_benchmark(goal);
    task.region.nodes = {60, 61, 60};
    task.region.cells = {60, 60, 60};
    return task;
  };
  constexpr std::int64_t nodes = 59 * 61 * 60 + 60;
  for (const DexterityGoal goal : {DexterityGoal::worst, DexterityGoal::mean, DexterityGoal::size}) {
    const DexterityTask task = fine(goal);
    RunContext context;
    context.cancel();
    const DexteritySynthesis nothing = synthesise(task, {}, 1, context);
    EXPECT_EQ(nothing.status, Status::cancelled);
    EXPECT_TRUE(nothing.best.x.empty());
    EXPECT_LT(nothing.poses, nodes / 10);
    const DexterityEvolution evolved = evolve(task, {.method = optimise::Method::grey_wolf}, {}, 1, context);
    EXPECT_EQ(evolved.report.status, Status::cancelled);
    EXPECT_TRUE(evolved.best.x.empty());
    EXPECT_EQ(evolved.report.evaluations, 0);
  }
  // In the middle: what was looked at as a whole is kept, and no further pass is made over all nodes.
  const DexterityTask task = fine(DexterityGoal::size);
  RunContext context;
  context.set_threads(1);
  context.set_progress([&](const Progress&) { context.cancel(); });
  const DexteritySynthesis found = synthesise(task, {.draws = 32, .confirmations = 0}, 1, context);
  EXPECT_EQ(found.status, Status::cancelled);
  EXPECT_EQ(found.starts.size(), 4u);
  ASSERT_EQ(found.best.x.size(), 4u);
  EXPECT_TRUE(std::isnan(found.best.mean));
  EXPECT_EQ(found.best.violation, assess(task, found.best.x).violation);
}

TEST(DexteritySynthesis, SaysWhatIsWrongWithATask) {
  const DexterityTask good = dexterity_benchmark(DexterityGoal::worst);
  EXPECT_EQ(problem(good), std::nullopt);
  const auto wrong = [&](auto&& change) {
    DexterityTask task = good;
    change(task);
    return problem(task).value_or("");
  };
  EXPECT_EQ(wrong([](auto& t) { t.dimensions.pop_back(); }), "3 ranges for 4 dimensions of a delta");
  EXPECT_EQ(wrong([](auto& t) { t.dimensions[1] = {0.5, 0.2}; }), "arm: 0.5 to 0.2");
  EXPECT_EQ(wrong([](auto& t) { t.dimensions[2].lower = 0; }), "rod: 0 to 1.6");
  EXPECT_EQ(wrong([](auto& t) { t.region.shape = RegionShape::circle; }), "a delta cannot serve a circle");
  EXPECT_EQ(wrong([](auto& t) { t.orientations[0] = math::turn_z(1); }),
            "the platform of a delta does not turn");
  EXPECT_EQ(wrong([](auto& t) { t.limits.constraint = -1; }), "limit of constraint: -1 is not in [0, 1]");
  EXPECT_EQ(wrong([](auto& t) { t.goal = DexterityGoal::size; }).substr(0, 45),
            "the smallest robot without limits is singular");
  EXPECT_EQ(wrong([](auto& t) {
              t.goal = DexterityGoal::size;
              t.limits.transmission = 0.3;
            }),
            "");
  EXPECT_EQ(wrong([](auto& t) { t.limits.input = 1.5; }), "limit of input: 1.5 is not in [0, 1]");
  EXPECT_EQ(wrong([](auto& t) { t.pi_joint = PiTravelTask{.mirror = 0}; }), "mirror is 1 or -1, not 0");
  EXPECT_EQ(wrong([](auto& t) { t.pi_joint = PiTravelTask{.limits = {.telescoping = 1}}; }),
            "limit of telescoping: 1 is not above 1");
  EXPECT_EQ(test::message([&] { assess(good, std::vector<double>(3)); }),
            "assess: 3 values for 4 design variables [x.size() == count]");
}

}  // namespace
}  // namespace linkwright::parallel
