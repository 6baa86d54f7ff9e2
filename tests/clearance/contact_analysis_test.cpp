// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

TEST(ContactAnalysis, SpectrumFindsAmplitudes) {
  for (const std::size_t n : {360u, 361u, 512u}) {
    const double interval = 1e-3, duration = interval * static_cast<double>(n);
    std::vector<double> samples;
    for (std::size_t k = 0; k < n; ++k) {
      const double t = interval * static_cast<double>(k) / duration;
      samples.push_back(2 + 3 * std::sin(full_turn * 5 * t + 1) + 0.5 * std::cos(full_turn * 40 * t));
    }
    const Spectrum s = amplitude_spectrum(samples, interval);
    ASSERT_EQ(s.amplitude.size(), n / 2 + 1);
    EXPECT_NEAR(s.frequency[5], 5 / duration, 1e-12);
    // Rounding of sums of some hundred terms.
    EXPECT_NEAR(s.amplitude[0], 2, 1e-12);
    EXPECT_NEAR(s.amplitude[5], 3, 1e-12);
    EXPECT_NEAR(s.amplitude[40], 0.5, 1e-12);
    EXPECT_NEAR(s.amplitude[17], 0, 1e-12);
    const Spectrum w = amplitude_spectrum(samples, interval, true);
    EXPECT_NEAR(w.amplitude[5], 3, 1e-12);
    EXPECT_NEAR(w.amplitude[6], 1.5, 1e-12);  // Hann's window spreads a line to its neighbours
    EXPECT_NEAR(w.amplitude[17], 0, 1e-12);
  }
  const std::vector<double> fastest{1, -1, 1, -1};
  EXPECT_NEAR(amplitude_spectrum(fastest, 1).amplitude[2], 1, 1e-15);
}

TEST(ContactAnalysis, SpectrumRefusesWhatIsNoSignal) {
  EXPECT_THAT(test::message([] { amplitude_spectrum(std::vector{1.0}, 1); }),
              ::testing::HasSubstr("needs 2 samples at least, got 1"));
  EXPECT_THAT(test::message([] {
                amplitude_spectrum(std::vector<double>{1, NAN}, 1);
              }),
              ::testing::HasSubstr("sample 1 is nan"));
  EXPECT_THAT(test::message([] {
                amplitude_spectrum(std::vector{1.0, 2.0}, 0);
              }),
              ::testing::HasSubstr("interval 0 s must be positive"));
}

// Pressed contact settles to one point of the section; impacts without end do not.
TEST(ContactAnalysis, SectionOfPeriodicAndOfRestlessMotion) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  model.coupler_damping = 1e-4;
  model.rocker_damping = 1e-4;
  const planar::Linkage l = as_linkage(model);
  ContactJoint joint{.joint = planar::joint_index(l, "A"),
                     .clearance = 1e-3,
                     .bush_radius = 0.01,
                     .law = {.stiffness = 1e8, .restitution = 0.3, .friction = 0.05}};
  joint.start.eccentricity = -1e-3;
  const planar::InputDrive crank = uniform_crank(10);
  const PoincareSection calm =
      poincare_section(l, std::span(&joint, 1), std::span(&crank, 1), 0, full_turn / 10, 5, 7);
  ASSERT_EQ(calm.run.status, Status::done) << calm.run.message;
  ASSERT_EQ(calm.joints[0].size(), 3u);
  EXPECT_NEAR(calm.joints[0][2].time, 7 * full_turn / 10, 1e-12);
  EXPECT_LT(std::abs(calm.joints[0][2].eccentricity - calm.joints[0][1].eccentricity), 2e-6);

  const planar::Linkage slider = contact_slider_crank();
  const ContactJoint loose = slider_crank_joint(slider);
  const planar::InputDrive fast = uniform_crank(slider_crank_speed);
  const PoincareSection wild =
      poincare_section(slider, std::span(&loose, 1), std::span(&fast, 1), 0, 0.012, 0, 4);
  ASSERT_EQ(wild.joints[0].size(), 5u);
  EXPECT_EQ(wild.joints[0][0].eccentricity, 0.0);
  EXPECT_GT(std::abs(wild.joints[0][4].eccentricity - wild.joints[0][3].eccentricity), 1e-5);
  EXPECT_THAT(test::message([&] {
                poincare_section(slider, std::span(&loose, 1), std::span(&fast, 1), 0, 0.012, 4, 4);
              }),
              ::testing::HasSubstr("periods from 4 to 4"));
}

}  // namespace
}  // namespace linkwright::clearance
