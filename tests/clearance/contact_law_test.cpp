// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/math/ode.h"
#include "support/message.h"
#include "support/published.h"

namespace linkwright::clearance {
namespace {

const Value& restitution_case() {
  return test::published_case("clearance-joint.json", "contact-restitution");
}

TEST(ContactLaw, EffectiveRestitutionAsComputedElsewhere) {
  int compared = 0;
  for (const auto& [key, damping] : {std::pair{"LN", ContactDamping::lankarani_nikravesh},
                                     std::pair{"flores2011", ContactDamping::flores_2011}})
    for (const auto& member : test::at(restitution_case(), std::string("computed.") + key).as_object()) {
      const ContactLaw law{.stiffness = 1, .restitution = std::stod(member.key), .damping = damping};
      // Found there by impacts integrated to about 1e-7.
      EXPECT_NEAR(effective_restitution(law), member.value.as_number(), 1e-6) << key << member.key;
      ++compared;
    }
  EXPECT_EQ(compared, 12);
  EXPECT_EQ(effective_restitution({.stiffness = 1, .restitution = 1}), 1);
}

struct Impact {
  double restitution, depth, force, duration;
};
Impact impact(const ContactLaw& law, double mass, double speed) {
  std::array<double, 2> y{0, speed};
  math::OdeWorkspace workspace;
  Impact out{};
  const std::array<math::OdeEvent, 1> events{{{math::OdeCrossing::falling, true}}};
  math::OdeHooks hooks{.events = events};
  hooks.event_values = [](double, std::span<const double> s, std::span<double> v) { v[0] = s[0]; };
  hooks.event = [](double, std::span<const std::size_t>, std::span<double>) { return math::OdeAction::stop; };
  hooks.step = [&](double, std::span<const double> s) {
    out.depth = std::max(out.depth, s[0]);
    out.force = std::max(out.force, normal_force(law, s[0], s[1], speed));
    return true;
  };
  const double time = contact_time(law, mass, speed);
  const math::OdeReport ode = math::integrate(
      [&](double, std::span<const double> s, std::span<double> r) {
        r[0] = s[1];
        r[1] = -normal_force(law, s[0], s[1], speed) / mass;
        return true;
      },
      y, 0, 10 * time, {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-16, .max_step = time / 20000},
      hooks, workspace);
  out.restitution = -y[1] / speed;
  out.duration = ode.t;
  return out;
}

TEST(ContactLaw, AnImpactAsComputedElsewhere) {
  const Value& example = test::at(restitution_case(), "computed.example");
  const ContactLaw law{.stiffness = test::number_at(example, "K"),
                       .restitution = test::number_at(example, "cr"),
                       .damping = ContactDamping::lankarani_nikravesh};
  const Impact hit = impact(law, test::number_at(example, "m_kg"), test::number_at(example, "v_m_s"));
  // Steps of 1/20000 of the time see the largest values to 1e-8.
  EXPECT_NEAR(hit.depth / test::number_at(example, "delta_max_m"), 1, 1e-7);
  EXPECT_NEAR(hit.force / test::number_at(example, "F_max_N"), 1, 1e-7);
  EXPECT_NEAR(hit.duration / test::number_at(example, "duration_s"), 1, 1e-6);
  EXPECT_NEAR(hit.restitution, test::number_at(example, "e"), 1e-7);
}

TEST(ContactLaw, RestitutionDoesNotDependOnMassSpeedStiffnessOrExponent) {
  const ContactLaw law{.stiffness = 1e9, .exponent = 2, .restitution = 0.4};
  EXPECT_NEAR(impact(law, 3, 0.2).restitution, effective_restitution(law), 1e-7);
  EXPECT_NEAR(impact({.stiffness = 1e7, .exponent = 1.2, .restitution = 0.4}, 0.1, 20).restitution,
              effective_restitution(law), 1e-7);
}

// Against the impact integrated in time.
TEST(ContactLaw, ShapeOfAnImpactAgainstAnElasticOne) {
  const double mass = 0.14, speed = 0.5;
  for (const auto& [damping, c] :
       {std::pair{ContactDamping::lankarani_nikravesh, 0.9},
        std::pair{ContactDamping::lankarani_nikravesh, 0.3}, std::pair{ContactDamping::flores_2011, 0.5},
        std::pair{ContactDamping::flores_2011, 0.05}}) {
    const ContactLaw law{.stiffness = 6.61e10, .restitution = c, .damping = damping};
    const ContactLaw elastic{.stiffness = 6.61e10, .restitution = 1, .damping = damping};
    const Impact lossy = impact(law, mass, speed), whole = impact(elastic, mass, speed);
    const ImpactShape shape = impact_shape(law);
    EXPECT_EQ(shape.restitution, effective_restitution(law));
    // Largest values at the steps, 20000 an impact, and of 1000 places.
    EXPECT_NEAR(shape.depth, lossy.depth / whole.depth, 1e-6) << c;
    EXPECT_NEAR(shape.force, lossy.force / whole.force, 1e-4 * shape.force) << c;
  }
  const ImpactShape same = impact_shape({.stiffness = 1, .restitution = 1});
  EXPECT_EQ(same.force, 1);
  EXPECT_EQ(same.depth, 1);
  // Nearly without loss, on both sides of the switch to the series.
  for (const double c : {1 - 1e-4, 1 - 1e-3}) {
    const ImpactShape near = impact_shape({.stiffness = 1, .restitution = c});
    EXPECT_NEAR(near.force, 1, 1 - c);
    EXPECT_NEAR(near.depth, 1, 1 - c);
  }
}

TEST(ContactLaw, KnowsFromWhereOnItIsTrue) {
  for (const ContactDamping damping : {ContactDamping::lankarani_nikravesh, ContactDamping::flores_2011}) {
    const double least = min_restitution(damping, 0.25);
    const auto off = [&](double c) {
      return std::abs(effective_restitution({.stiffness = 1, .restitution = c, .damping = damping}) / c - 1);
    };
    EXPECT_LE(off(least), 0.25);
    EXPECT_GT(off(least - 0.01), 0.25);
  }
}

TEST(ContactLaw, TimeOfAnElasticImpact) {
  for (const double exponent : {1.0, 1.5, 2.2}) {
    const ContactLaw law{.stiffness = 1e8, .exponent = exponent, .restitution = 1};
    EXPECT_NEAR(impact(law, 2, 0.7).duration / contact_time(law, 2, 0.7), 1, 1e-7) << exponent;
  }
  const ContactLaw hertz{.stiffness = 6.61e10, .restitution = 1};
  EXPECT_NEAR(contact_time(hertz, 0.14, 0.5) / (3.2 * std::pow(0.14 * 0.14 / (6.61e10 * 6.61e10 * 0.5), 0.2)),
              1,
              0.01);  // 3.2 is rounded
}

TEST(ContactLaw, StiffnessOfAPinInABush) {
  EXPECT_NEAR(
      pin_stiffness(0.01, 0.0095),
      test::number_at(test::published_case("clearance-joint.json", "slider-crank-contact"), "computed.K"),
      1);  // relative to 6.6e10
  EXPECT_THAT(test::message([] { pin_stiffness(0.01, 0.01); }),
              ::testing::HasSubstr("a pin of radius 0.01 m in a bush of 0.01 m"));
}

TEST(ContactLaw, NeverPullsAndFrictionComesInSmoothly) {
  const ContactLaw law{.stiffness = 1e9, .restitution = 0.3, .friction = 0.2};
  EXPECT_EQ(normal_force(law, -1e-6, 1, 1), 0);
  EXPECT_EQ(normal_force(law, 1e-6, -1, 1), 0);  // 1 - 3.7
  EXPECT_DOUBLE_EQ(normal_force(law, 1e-6, 0, 1), 1);
  EXPECT_EQ(friction_force(law, 10, 0.5e-4), 0);
  EXPECT_DOUBLE_EQ(friction_force(law, 10, 5.5e-4), 1);
  EXPECT_EQ(friction_force(law, 10, -1), -2);
  // Work of the elastic part.
  double work = 0;
  for (int k = 0; k < 1000; ++k) work += elastic_force(law, (k + 0.5) * 1e-9) * 1e-9;
  EXPECT_NEAR(elastic_energy(law, 1e-6) / work, 1, 1e-6);
}

TEST(ContactLaw, RefusesNumbersOutOfRange) {
  const auto text = [](const ContactLaw& law) { return test::message([&] { require_valid(law); }); };
  EXPECT_THAT(text({}), ::testing::HasSubstr("contact: stiffness 0 must be positive"));
  EXPECT_THAT(text({.stiffness = 1, .restitution = 0}),
              ::testing::HasSubstr("coefficient of restitution 0 must be more than 0"));
  EXPECT_THAT(text({.stiffness = 1, .friction = -1}), ::testing::HasSubstr("friction -1"));
  EXPECT_THAT(text({.stiffness = 1, .exponent = 0.5}), ::testing::HasSubstr("exponent 0.5"));
}

}  // namespace
}  // namespace linkwright::clearance
