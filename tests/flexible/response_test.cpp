// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/flexible/samples.h"
#include "linkwright/flexible/simulation.h"
#include "support/message.h"

namespace linkwright::flexible {
namespace {

std::vector<Sample> wave() {
  std::vector<Sample> out;
  for (int i = 0; i <= 100; ++i) out.push_back({.time = 0.1 * i, .tip_eta = std::sin(0.1 * i)});
  return out;
}

TEST(Response, ExtremesBetweenSamples) {
  const auto samples = wave();
  const Extreme high = largest(samples, &Sample::tip_eta, 0, 5),
                low = smallest(samples, &Sample::tip_eta, 0, 9);
  // A parabola through three samples of a sine: off by h^4 / 100 or so in value, h^3 / 20 in time.
  EXPECT_NEAR(high.value, 1, 2e-6);
  EXPECT_NEAR(high.time, std::acos(-1.0) / 2, 1e-4);
  EXPECT_NEAR(low.value, -1, 2e-6);
  EXPECT_NEAR(low.time, 1.5 * std::acos(-1.0), 1e-4);
  // On a slope the edge of the stretch is the extreme.
  const Extreme edge = largest(samples, &Sample::tip_eta, 2, 4);
  EXPECT_EQ(edge.time, samples[20].time);
  EXPECT_EQ(edge.value, samples[20].tip_eta);
  EXPECT_NE(test::message([&] {
              largest(samples, &Sample::tip_eta, 20, 30);
            }).find("no sample between 20 and 30 s"),
            std::string::npos);
}

TEST(Response, StressOfAStrip) {
  // 2.5 mm thick, 100 mm wide: 6 M / (b h^2).
  EXPECT_NEAR(bending_stress(torque_beam(), 5, 0.00125), 6 * 5 / (0.1 * 0.0025 * 0.0025), 3e3);
  EXPECT_NE(test::message([] { bending_stress(torque_beam(), 5, 0); }).find("the outer fibre at 0 m"),
            std::string::npos);
}

TEST(Response, Tables) {
  const std::vector<Sample> samples = {{.time = 0.5, .tip_eta = -2, .kinetic = 3, .work = 1},
                                       {.time = 0.6, .tip_eta = -3, .kinetic = 4, .work = 1.5}};
  const Table table = table_of(samples);
  EXPECT_EQ(table.rows(), 2);
  EXPECT_EQ(table.find("tip_eta_m")->values[0], -2);
  // 2 J at the start, 2.5 J later.
  EXPECT_EQ(table.find("energy_balance_J")->values, (std::vector<double>{0, 0.5}));
}

}  // namespace
}  // namespace linkwright::flexible
