// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/stiffness_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using math::radians;
using test::number_at;

const AngleRange whole{radians(-60), radians(60)};

// The diagonal by the published mean, 3.5e4 N m/rad, depends on what else is assumed.
TEST(PiStiffnessSynthesis, DiagonalOfThePrototypeByItsPublishedMean) {
  const double mean = number_at(computed("pi-stiffness"), "mean_J2_m2");
  // The figures are by Simpson's rule, whose error is some 1e-10.
  expect_same(mean_stiffness(pi_prototype(), {.diagonal = 1}, whole, StiffnessMean::of_stiffness), mean,
              1e-9);
  expect_same(mean_stiffness(pi_prototype(), {.diagonal = 1}, whole, StiffnessMean::of_compliance),
              number_at(computed("pi-stiffness"), "harmonic_mean_J2_m2"), 1e-9);
  const double published = number_at(test::published_case("pi-joint-parallel-robots.json", "pi-stiffness"),
                                     "published.K_mean_Nm_rad");
  const auto implied = [&](StiffnessMean kind, const PiBars& others = {}, double share = 1) {
    return diagonal_for_mean(pi_prototype(), others, whole, kind, published, share).value_or(0);
  };
  const Value& expected = computed("pi-stiffness");
  expect_same(implied(StiffnessMean::of_stiffness), number_at(expected, "k_d_rigid_arms_N_m"), 1e-9);
  expect_same(implied(StiffnessMean::of_compliance), number_at(expected, "k_d_if_harmonic_mean_N_m"), 1e-9);
  expect_same(implied(StiffnessMean::at_zero), number_at(expected, "k_d_if_at_zero_N_m"), 1e-9);
  // Elastic arms, and a coupler of the same section, stiffer by a / b. These figures belong to the plain mean
  // over 241 angles, both ends included, which is some 0.3 % below that over the range; 0.7 % in k_d at most.
  const Value& elastic = test::at(expected, "implied_k_d_with_elastic_arms_N_m");
  int compared = 0;
  for (const auto& [share, word] : {std::pair{1.0, "wA=1.0"}, {0.5, "wA=0.5"}, {0.0, "wA=0.0"}})
    for (const auto& [arm, name] : {std::pair{3e7, "k_arm=3e+07"}, {1e8, "k_arm=1e+08"}}) {
      const double figure = elastic.find(std::string(word) + "," + name)->as_number();
      const PiBars bars{.arm = arm, .coupler = arm / pi_prototype().ratio, .diagonal = figure};
      double sum = 0;
      for (int i = 0; i <= 240; ++i) sum += stiffness(pi_prototype(), bars, radians(-60 + 0.5 * i), share);
      expect_same(sum / 241, published, 1e-9);
      const double found = implied(StiffnessMean::of_stiffness, bars, share);
      expect_same(found, figure, 0.007);
      expect_same(
          mean_stiffness(pi_prototype(), {.arm = bars.arm, .coupler = bars.coupler, .diagonal = found}, whole,
                         StiffnessMean::of_stiffness, share),
          published, 1e-12);
      ++compared;
    }
  EXPECT_EQ(compared, 6);
}

TEST(PiStiffnessSynthesis, MeansAreIntegrals) {
  const PiBars bars{.arm = 3e7, .coupler = 7.5e7, .diagonal = 1.6e7};
  // Simpson's rule over 2000 steps of 1 mrad: error 1e-12 of the values.
  const int steps = 2000;
  double stiff = 0, yielding = 0;
  for (int i = 0; i <= steps; ++i) {
    const double at = whole.from + (whole.to - whole.from) * i / steps;
    const double weight = (i == 0 || i == steps ? 1.0 : i % 2 ? 4.0 : 2.0) / (3.0 * steps);
    stiff += weight * stiffness(pi_prototype(), bars, at, 0.5);
    yielding += weight * compliance(pi_prototype(), bars, at, 0.5);
  }
  expect_same(mean_stiffness(pi_prototype(), bars, whole, StiffnessMean::of_stiffness, 0.5), stiff, 1e-11);
  expect_same(mean_stiffness(pi_prototype(), bars, whole, StiffnessMean::of_compliance, 0.5), 1 / yielding,
              1e-11);
}

TEST(PiStiffnessSynthesis, NoDiagonalMakesSoftArmsStiff) {
  EXPECT_EQ(diagonal_for_mean(pi_prototype(), {.arm = 1e6}, whole, StiffnessMean::of_stiffness, 3.5e4),
            std::nullopt);
  EXPECT_EQ(diagonal_for_mean(pi_prototype(), {.screw = 1e5}, whole, StiffnessMean::of_compliance, 3.5e4),
            std::nullopt);
}

std::vector<PiStiffnessSample> samples_of(const PiBars& bars, double share, double noise = 0) {
  RandomStream random({.seed = 7});
  std::vector<PiStiffnessSample> out;
  for (double at = -60; at <= 60; at += 10)
    out.push_back({radians(at), stiffness(pi_prototype(), bars, radians(at), share) *
                                    (1 + noise * random.uniform(-1, 1))});
  return out;
}

TEST(PiStiffnessSynthesis, FindsTheBarsOfAJointThatWasMeasured) {
  const PiBars bars{.arm = 5e7, .coupler = 1.2e8, .diagonal = 1.2e7};
  const PiStiffnessFit fit = fit_bars(pi_prototype(), samples_of(bars, 0.5),
                                      {.diagonal = true, .arm = true, .coupler = true}, {}, 0.5);
  EXPECT_EQ(fit.status, Status::done);
  EXPECT_LT(fit.error, 1e-14);
  EXPECT_LT(fit.condition, 1e3);
  // Rounding of the samples times the condition.
  const double tolerance = 1e-14 * fit.condition;
  expect_same(fit.bars.diagonal, 1.2e7, tolerance);
  expect_same(fit.bars.arm, 5e7, tolerance * 5);
  expect_same(fit.bars.coupler, 1.2e8, tolerance * 20);
  EXPECT_EQ(fit.bars.screw, INFINITY);
}

TEST(PiStiffnessSynthesis, ErrorsOfMeasurementGrowByTheCondition) {
  const PiBars bars{.arm = 5e7, .diagonal = 1.2e7};
  const auto noisy = samples_of(bars, 1, 0.01);
  const PiStiffnessFit all = fit_bars(pi_prototype(), noisy, {.diagonal = true, .arm = true});
  const PiStiffnessFit one = fit_bars(pi_prototype(), noisy, {}, {.arm = 5e7});
  EXPECT_LT(all.error, 0.01);
  EXPECT_LT(one.error, 0.01);
  expect_same(all.bars.diagonal, 1.2e7, 0.01 * all.condition);
  expect_same(one.bars.diagonal, 1.2e7, 0.01);
  EXPECT_EQ(one.bars.arm, 5e7);
  EXPECT_DOUBLE_EQ(one.condition, 1);
}

TEST(PiStiffnessSynthesis, ScrewThatYieldsWithItsLength) {
  const PiBars bars{.diagonal = 2e7, .screw = 3.7e6};
  const PiStiffnessFit fit = fit_bars(pi_prototype(), samples_of(bars, 1), {.diagonal = true, .screw = true});
  EXPECT_EQ(fit.status, Status::done);
  expect_same(fit.bars.diagonal, 2e7, 1e-12);
  expect_same(fit.bars.screw, 3.7e6, 1e-12);
}

TEST(PiStiffnessSynthesis, SaysWhatSamplesCannotTell) {
  // The coupler carries nothing when the torque acts at A.
  const auto samples = samples_of({.diagonal = 1e7}, 1);
  const PiStiffnessFit fit = fit_bars(pi_prototype(), samples, {.diagonal = true, .coupler = true});
  EXPECT_EQ(fit.status, Status::singular);
  EXPECT_EQ(fit.condition, INFINITY);
  EXPECT_EQ(fit.bars.coupler, INFINITY);
  expect_same(fit.bars.diagonal, 1e7, 1e-12);
  // A known arm softer than the joint: nothing is left for the diagonal, and the error says so.
  const PiStiffnessFit soft = fit_bars(pi_prototype(), samples, {}, {.arm = 1e6});
  EXPECT_EQ(soft.bars.diagonal, INFINITY);
  EXPECT_GT(soft.error, 1);
}

TEST(PiStiffnessSynthesis, BrokenContracts) {
  const std::vector<PiStiffnessSample> one{{0, 1e4}};
  const auto fit = [&](const std::vector<PiStiffnessSample>& samples, const PiBarsSought& sought) {
    return test::message([&] { fit_bars(pi_prototype(), samples, sought); });
  };
  EXPECT_NE(fit(one, {.diagonal = false}).find("no bar is sought"), std::string::npos);
  EXPECT_NE(fit(one, {.arm = true}).find("1 samples for 2 bars"), std::string::npos);
  EXPECT_NE(fit({{2, 1e4}}, {}).find("sample 1 at 2 rad"), std::string::npos);
  EXPECT_NE(fit({{0, 1e4}, {0, -1}}, {}).find("sample 2: -1 N m/rad"), std::string::npos);
  EXPECT_NE(test::message([] {
              mean_stiffness(pi_prototype(), {}, {1, 2}, StiffnessMean::at_zero);
            }).find("range from 1 to 2 rad"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::parallel
