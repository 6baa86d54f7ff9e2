// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/corner_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/indirect/link_fit.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

struct Case {
  test::Example example;
  CarrierTargets open;  ///< without carrier pitches
  std::vector<LinkTask> links;
  std::vector<CouplerTask> couplers;
};

Case make_case(const char* id, double edge = 0.05) {
  Case c{.example = test::published_example(id)};
  c.open = c.example.targets;
  for (CarrierTarget& pose : c.open.poses) pose.angles.carrier_pitch = nan;
  RandomStream random({3, 17});
  for (const CornerLink& link : c.example.links) c.links.push_back(test::random_task(link, edge, random));
  for (const Coupler& k : c.example.suspension.couplers)
    c.couplers.push_back({.name = "coupler",
                          .first = k.first,
                          .second = k.second,
                          .min_offset = 0.1,
                          .point = box_around(k.point, edge)});
  return c;
}

TEST(CornerErrors, VanishForTheMechanismItself) {
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "mechanism-RR-US", "mechanism-S-2US",
                         "mechanism-R", "mechanism-RS-SR-US"}) {
    const Case c = make_case(id);
    CornerErrors errors(c.example.targets, c.links, c.couplers);
    std::vector<double> x(errors.unknowns()), rows(errors.rows());
    errors.start_from(c.example.links, c.example.suspension.couplers, x);
    ASSERT_TRUE(errors.evaluate(x, rows, {})) << id;
    EXPECT_LT(errors.totals(rows).largest, 1e-14) << id;
    for (std::size_t l = 0; l < c.links.size(); ++l)
      EXPECT_LT(largest_distance(errors.links()[l], c.example.links[l]), 1e-15);
    for (std::size_t k = 0; k < c.couplers.size(); ++k)
      EXPECT_NEAR(errors.couplers()[k].fraction, c.example.suspension.couplers[k].fraction, 1e-15);
  }
}

TEST(CornerErrors, AreThoseOfTheLinksOneByOne) {
  const Case c = make_case("ex2-forward");
  CornerErrors errors(c.example.targets, c.links);
  std::vector<double> x(errors.unknowns()), rows(errors.rows());
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = 0.5 * (errors.lower()[j] + errors.upper()[j]);
  ASSERT_TRUE(errors.evaluate(x, rows, {}));
  ErrorTotals all;
  RunContext context;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const LinkFit as_it_is = fit_link(c.example.targets, given_link(errors.links()[l]), {}, {}, 1, context);
    EXPECT_NEAR(errors.link_totals(l, rows).rms(), as_it_is.rms, 1e-15);
    all.add(errors.link_totals(l, rows));
  }
  EXPECT_EQ(all.count, 4 * 14);
  EXPECT_EQ(all.rms(), errors.totals(rows).rms());
  EXPECT_EQ(all.mean(), errors.totals(rows).sum / (4 * 14));
}

/// Derivatives against central differences: an error of step^2 times third derivatives of some 10 / m^2 - a
/// hundred times that for a dyad, which may be near the end of its reach - and rounding, 1e-16 over the step.
void expect_derivatives(CornerErrors& errors, std::uint64_t seed, const char* what, double step = 1e-5) {
  std::vector<double> x(errors.unknowns()), rows(errors.rows()), jacobian(x.size() * rows.size());
  RandomStream random({seed, 5});
  for (int tries = 0; tries < 1000; ++tries) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double middle = 0.5 * (errors.lower()[j] + errors.upper()[j]),
                   half = 0.1 * (errors.upper()[j] - errors.lower()[j]);
      x[j] = random.uniform(middle - half, middle + half);
    }
    if (errors.evaluate(x, rows, {})) break;
  }
  ASSERT_TRUE(errors.evaluate(x, rows, jacobian)) << what;
  std::vector<double> below(rows.size()), above(rows.size());
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double at = x[j];
    x[j] = at - step;
    ASSERT_TRUE(errors.evaluate(x, below, {}));
    x[j] = at + step;
    ASSERT_TRUE(errors.evaluate(x, above, {}));
    x[j] = at;
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_NEAR(jacobian[j * rows.size() + i], (above[i] - below[i]) / (2 * step), 2e-8)
          << what << ", " << errors.unknown_names()[j] << ", row " << i;
  }
}

TEST(CornerErrors, DerivativesAgainstDifferences) {
  for (const char* id : {"ex2-forward", "ex3-forward", "mechanism-RR-US", "mechanism-S-2US", "mechanism-R",
                         "mechanism-RS-SR-US"}) {
    const Case c = make_case(id);
    CornerErrors given(c.example.targets, c.links, c.couplers);
    expect_derivatives(given, 1, id);
    CornerErrors each(c.open, c.links, c.couplers, CarrierPitchTechnique::each);
    EXPECT_EQ(each.carrier_pitch_unknowns(), c.open.poses.size() - 1);
    expect_derivatives(each, 2, id);
  }
  for (const char* id : {"ex3-forward", "ex4-forward"}) {
    const Case c = make_case(id);
    CornerErrors quadratic(c.open, c.links, c.couplers, CarrierPitchTechnique::quadratic);
    EXPECT_EQ(quadratic.carrier_pitch_unknowns(), 3u);
    expect_derivatives(quadratic, 3, id);
  }
  for (const char* id : {"ex1-forward", "ex4-forward"}) {
    const Case c = make_case(id);
    CornerErrors dyad(c.open, c.links, c.couplers, CarrierPitchTechnique::dyad);
    EXPECT_EQ(dyad.carrier_pitch_unknowns(), 0u);
    expect_derivatives(dyad, 4, id, 1e-6);
  }
}

TEST(CornerErrors, TechniquesGiveTheCarrierPitchesBack) {
  const Case c = make_case("ex4-forward");
  CornerErrors dyad(c.open, c.links, {}, CarrierPitchTechnique::dyad);
  std::vector<double> x(dyad.unknowns()), rows(dyad.rows());
  dyad.start_from(c.example.links, {}, x);
  ASSERT_TRUE(dyad.evaluate(x, rows, {}));
  EXPECT_LT(dyad.totals(rows).largest, 1e-13);
  for (std::size_t i = 0; i < c.open.poses.size(); ++i)
    EXPECT_NEAR(dyad.targets().poses[i].angles.carrier_pitch, c.example.targets.poses[i].angles.carrier_pitch,
                1e-12);

  CornerErrors quadratic(c.open, c.links, {}, CarrierPitchTechnique::quadratic);
  x.assign(quadratic.unknowns(), 0);
  quadratic.start_from(c.example.links, {}, x);
  x[30] = 0.2, x[31] = 0.3, x[32] = -0.7;
  ASSERT_TRUE(quadratic.evaluate(x, rows, {}));
  const auto carrier_pitch = [&](std::size_t i) { return quadratic.targets().poses[i].angles.carrier_pitch; };
  EXPECT_EQ(carrier_pitch(6), 0);
  EXPECT_NEAR(carrier_pitch(12), 0.2 * 0.15 + 0.3 * 0.0225, 1e-15);
  EXPECT_NEAR(carrier_pitch(0), -0.2 * 0.15 - 0.7 * 0.0225, 1e-15);
}

TEST(CornerErrors, ADyadThatDoesNotReachTellsByHowMuch) {
  Case c = make_case("ex4-forward", 0.02);
  for (PointBox& box : c.links[0].body) box.lower.y -= 1, box.upper.y -= 1;  // the rod is a metre longer
  CornerErrors dyad(c.open, c.links, {}, CarrierPitchTechnique::dyad);
  std::vector<double> x(dyad.unknowns()), rows(dyad.rows());
  std::size_t apart = 0;
  RandomStream random({1});
  for (int i = 0; i < 50; ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = random.uniform(dyad.lower()[j], dyad.upper()[j]);
    if (dyad.evaluate(x, rows, {})) continue;
    ++apart;
    EXPECT_GT(dyad.shortfall(), 0);
    EXPECT_LT(dyad.shortfall(), 1);
  }
  EXPECT_GT(apart, 10u);
}

TEST(CornerErrors, WhatIsRefused) {
  Case c = make_case("ex3-forward");
  const auto told = [&](CarrierPitchTechnique technique) {
    return message([&] { CornerErrors(c.open, c.links, c.couplers, technique); });
  };
  c.couplers[0].second = 1;
  EXPECT_THAT(told(CarrierPitchTechnique::each),
              HasSubstr("coupler 'coupler': from a link of type US to one of type "
                        "US, needs US and SR"));
  c.couplers[0].second = 4;
  EXPECT_THAT(told(CarrierPitchTechnique::each), HasSubstr("coupler 'coupler': link 4 of 3"));
  c.couplers.clear();
  c.links.erase(c.links.begin(), c.links.begin() + 2);
  EXPECT_THAT(told(CarrierPitchTechnique::dyad), HasSubstr("no US link makes a dyad with the carrier"));
  const Case steered = make_case("ex1-forward");
  EXPECT_THAT(
      message([&] { CornerErrors(steered.open, steered.links, {}, CarrierPitchTechnique::quadratic); }),
      HasSubstr("position 10 has the rack at -0.075 m: a quadratic of the travel does not know the "
                "rack"));
}

}  // namespace
}  // namespace linkwright::suspension
