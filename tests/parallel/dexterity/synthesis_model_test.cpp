// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/detail/synthesis_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/math/angles.h"
#include "linkwright/parallel/dexterity/synthesis_samples.h"

namespace linkwright::parallel {
namespace {

/// All limits there are.
DexterityTask everything(int mirror) {
  DexterityTask task = dexterity_benchmark(DexterityGoal::size);
  task.limits.output = 0.3;
  task.limits.size = 1.5;
  task.pi_joint = PiTravelTask{.mirror = mirror,
                               .limits = {.torque = 10,
                                          .force_limit = 100,
                                          .speed = 2,
                                          .rate_limit = 0.3,
                                          .quantum = 1e-5,
                                          .resolution = 1e-3,
                                          .transmission = 0.1,
                                          .stroke = 0.3,
                                          .telescoping = 2}};
  return task;
}

constexpr double h = 1e-6;

TEST(DexteritySynthesisModel, LimitsOfTheWholeHaveTheirDerivatives) {
  for (const int mirror : {1, -1}) {
    const DexterityModel model(everything(mirror));
    const std::vector<double> u{0.1, 0.4, 0.65, 0.35, -0.7, 1.2, mirror * 0.3, 0.4};
    ASSERT_EQ(u.size(), static_cast<std::size_t>(model.unknowns()));
    std::vector<DexterityModel::Whole> at, up, down;
    std::vector<double> by;
    model.whole(u, at, &by);
    // Size, travel, both ends, telescoping, stroke, transmission and least rate at both ends, largest rate.
    ASSERT_EQ(at.size(), 11u);
    for (std::size_t j = 0; j < u.size(); ++j) {
      auto more = u, less = u;
      more[j] += h;
      less[j] -= h;
      model.whole(more, up, nullptr);
      model.whole(less, down, nullptr);
      // Central differences: h^2/6 and eps/h.
      for (std::size_t k = 0; k < at.size(); ++k)
        EXPECT_NEAR(by[k * u.size() + j], (up[k].excess - down[k].excess) / (2 * h), 1e-8)
            << name_of(at[k].limit) << " by " << j << " mirror " << mirror;
    }
  }
}

TEST(DexteritySynthesisModel, LimitsOfPosesHaveTheirDerivatives) {
  const DexterityModel model(everything(1));
  const std::vector<double> u{0.1, 0.4, 0.65, 0.35, -0.7, 1.2, 0.3, 0.4};
  const auto value = [&](const PoseLimit& which, const std::vector<double>& at, std::span<double> by) {
    PoseDexterity<double> there;
    measure(model.designed(at), all_positive, model.measures(), model.at(which.pose).place, {}, there);
    return model.limit(which, there, at, by);
  };
  for (int kind = 0; kind < pose_limit_kinds; ++kind) {
    const PoseLimit which{static_cast<PoseLimit::Kind>(kind), 1, 700};
    std::vector<double> by(u.size());
    value(which, u, by);
    for (std::size_t j = 0; j < u.size(); ++j) {
      auto more = u, less = u;
      more[j] += h;
      less[j] -= h;
      EXPECT_NEAR(by[j], (value(which, more, {}) - value(which, less, {})) / (2 * h), 1e-8) << kind << j;
    }
  }
}

TEST(DexteritySynthesisModel, MeanHasItsDerivatives) {
  const DexterityModel model(dexterity_benchmark(DexterityGoal::mean));
  DexterityModel::Work work;
  const std::vector<double> x{0.1, 0.45, 0.72, 0.35};
  std::vector<double> by(4);
  model.mean(model.designed(x), work, by);
  for (std::size_t j = 0; j < x.size(); ++j) {
    auto more = x, less = x;
    more[j] += h;
    less[j] -= h;
    const double difference =
        (model.mean(model.designed(more), work, {}) - model.mean(model.designed(less), work, {})) / (2 * h);
    // A pose whose singular values cross within the difference changes it by a share of its weight, 1/480.
    EXPECT_NEAR(by[j], difference, 1e-7);
  }
}

// The few poses that choose starts are nodes, the same for both.
TEST(DexteritySynthesisModel, FewPosesAreNodes) {
  const DexterityModel model(dexterity_benchmark(DexterityGoal::worst));
  EXPECT_EQ(model.nodes(), 1225u);
  // 3 on the axis, 2 radii of 3 azimuths of 3 heights.
  ASSERT_EQ(model.few().size(), 3u + 2 * 3 * 3);
  const DesignedRobot designed = model.designed(std::vector{0.2423, 0.4160, 0.7840, 0.4611});
  DexterityModel::Work work;
  const Extremes few = model.extremes(designed, work, true), all = model.extremes(designed, work);
  EXPECT_GE(few.conditioning.value, all.conditioning.value);
  EXPECT_NEAR(few.highest[0].value, all.highest[0].value, 1e-2);
  PoseDexterity<double> there;
  measure(designed, all_positive, model.measures(), model.at(all.conditioning.pose).place, {}, there);
  EXPECT_NEAR(there.conditioning, all.conditioning.value, 1e-12);
}

}  // namespace
}  // namespace linkwright::parallel
