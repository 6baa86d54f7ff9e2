// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/detail/parameters_kernel.h"
#include "suspension/pushrod_corner.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

/// Derivative at 0 by central differences of fourth order: (8 (f1 - f-1) - (f2 - f-2)) / 12 h.
template <class F>
WheelParameters differenced(F f, double h) {
  std::array<WheelParameters, 4> at{f(-2 * h), f(-h), f(h), f(2 * h)};
  WheelParameters out = at[0];
  const auto add = [&](int i, double by) {
    for_each_number(at[i], out, [&](double a, double& to) { to += by * a / (12 * h); });
  };
  for_each_number(at[0], out, [&](double a, double& to) { to = a / (12 * h); });
  add(1, -8);
  add(2, 8);
  add(3, -1);
  return out;
}

/// Largest difference of two sets, relative to numbers of at least 1; parameters of more than 5 (centres
/// far away) are left out, differences cannot give their derivatives.
double apart(const WheelParameters& a, const WheelParameters& b, const WheelParameters& values, int& count) {
  std::vector<double> sizes, first;
  WheelParameters scratch;
  for_each_number(values, scratch, [&](double v, double&) { sizes.push_back(v); });
  for_each_number(a, scratch, [&](double v, double&) { first.push_back(v); });
  double worst = 0;
  std::size_t i = 0;
  for_each_number(b, scratch, [&](double v, double&) {
    const double x = first[i], size = sizes[i++];
    if (std::isnan(size)) {
      EXPECT_TRUE(std::isnan(x));
      return;
    }
    if (!(std::abs(size) < 5)) return;
    ++count;
    const double off = std::abs(x - v) / std::max(1.0, std::abs(v));
    worst = std::isnan(off) ? 1e9 : std::max(worst, off);
  });
  EXPECT_EQ(i, first.size());
  return worst;
}

// Steps of 2e-5 m: the fourth power of their share in what changes most, a swing arm of some ten metres that
// turns round within millimetres, leaves 1e-8; rounding of 1e-15 over the step less.
constexpr double step = 2e-5, agreement = 1e-7;

WheelParameters solved(const Suspension& suspension, Driver driver, const CornerInput& input) {
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition at = solve_position(plan, driver, input, reference_position(plan, driver));
  EXPECT_EQ(at.status, Status::done);
  return wheel_parameters(plan, at);
}

struct Station {
  Driver driver;
  CornerInput input;
};

void expect_exact(const Suspension& suspension, const std::string& name,
                  const std::vector<Station>& stations) {
  std::vector<DesignNumber> numbers = hard_points(suspension);
  for (int axis = 0; axis < 3; ++axis) numbers.push_back({DesignKind::wheel_centre, 0, 0, axis});
  numbers.push_back({DesignKind::wheel_toe});
  numbers.push_back({DesignKind::wheel_camber});
  const DerivativePlan plan = prepare_derivatives(suspension, numbers);
  for (const auto& [driver, input] : stations) {
    const CornerPosition at = solve_position(plan.plan, driver, input, reference_position(plan.plan, driver));
    const WheelDerivatives exact = wheel_derivatives(plan, at);
    const WheelParameters values = wheel_parameters(plan.plan, at);
    ASSERT_EQ(exact.by.size(), numbers.size());
    int unused = 0;
    // The same formulas in another order of rounding.
    EXPECT_LT(apart(exact.parameters, values, values, unused), 1e-11);
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      int count = 0;
      const auto off = [&, driver = driver, input = input](double by_step) {
        const WheelParameters by = differenced(
            [&](double h) {
              Suspension other = suspension;
              suspension::design_value(other, numbers[j]) += h;
              return solved(other, driver, input);
            },
            by_step);
        count = 0;
        return apart(exact.by[j], by, values, count);
      };
      // A curve that bends more than the step was chosen for has a sixteenth of the truncation at half of it.
      double worst = off(step);
      if (!(worst < agreement)) worst = off(step / 2);
      EXPECT_LT(worst, agreement) << name << ": " << label(suspension, numbers[j]) << " at " << input.value
                                  << ", " << input.rack;
      EXPECT_GT(count, 30);
    }
  }
}

TEST(Derivatives, AgreeWithDifferencesOfSolvedDesigns) {
  for (const CornerSample& sample : corner_samples().first(12))
    expect_exact(sample.suspension, sample.name,
                 {{Driver::wheel_centre_z, {0.045, 0.02}}, {Driver::wheel_centre_z, {-0.06, 0}}});
}

TEST(Derivatives, HoldWhatDrives) {
  for (const char* name : {"2RS-US", "RS-SP-US", "RR-US"})
    expect_exact(corner_sample(name).suspension, name,
                 {{Driver::spring, {0.02, 0.01}}, {Driver::contact_z, {0.05, 0}}});
}

TEST(Derivatives, OfPrescribedLengthsAndCouplers) {
  Suspension lengths = corner_sample("5US").suspension;
  for (CornerLink& link : lengths.links) link.length = norm(link.carrier[0] - link.body[0]);
  *lengths.links[1].length += 0.003;
  expect_exact(lengths, "5US with lengths", {{Driver::wheel_centre_z, {0.03, 0.01}}});
  const Suspension coupled = corner_sample("interconnected").suspension;
  expect_exact(coupled, "interconnected", {{Driver::wheel_centre_z, {0.05, 0}}});
  Suspension right = mirrored(corner_sample("2RS-US").suspension);
  expect_exact(right, "right wheel", {{Driver::wheel_centre_z, {0.03, -0.02}}});
}

TEST(Derivatives, OfWhatIsFixedToARodOffItsLine) {
  for (const int link : {0, 2}) {
    Suspension suspension = corner_sample("5US").suspension;
    suspension.spring->link = link;
    expect_exact(suspension, "5US, spring on a rod", {{Driver::wheel_centre_z, {0.045, 0.02}}});
    suspension.links[link].cross_axis = Vec3{0.7, 0.5, -0.6};
    suspension.links[link].length =
        norm(suspension.links[link].carrier[0] - suspension.links[link].body[0]) + 0.004;
    expect_exact(suspension, "5US, spring on a rod of another length", {{Driver::spring, {0.01, -0.01}}});
  }
  Suspension coupled = corner_sample("interconnected").suspension;
  const CornerLink& rod = coupled.links[coupled.couplers[0].first];
  coupled.couplers[0].begin = rod.body[0] + 0.6 * (rod.carrier[0] - rod.body[0]) + Vec3{0.02, 0.005, -0.03};
  expect_exact(coupled, "coupler off the line", {{Driver::wheel_centre_z, {0.03, 0}}});
}

TEST(Derivatives, AlongTravelAndRackAgreeWithDifferences) {
  std::vector<CornerSample> samples(corner_samples().begin(), corner_samples().end());
  for (const bool unequal : {false, true})
    samples.push_back({.name = "2RS-US with a steering linkage",
                       .suspension = with_steering_linkage(corner_sample("2RS-US").suspension, unequal)});
  for (const CornerSample& sample : samples) {
    const DerivativePlan plan = prepare_derivatives(sample.suspension, {});
    const CornerPosition reference = reference_position(plan.plan);
    for (const CornerInput& input : {CornerInput{0.04, 0.015}, CornerInput{-0.05, 0}}) {
      const auto at = [&](double travel, double rack) {
        return solve_position(plan.plan, Driver::wheel_centre_z, {input.value + travel, input.rack + rack},
                              reference);
      };
      const InputDerivatives exact = input_derivatives(plan, at(0, 0));
      const WheelParameters values = wheel_parameters(plan.plan, at(0, 0));
      int count = 0;
      EXPECT_LT(apart(exact.parameters, values, values, count), 1e-11);
      const auto travel = differenced([&](double h) { return wheel_parameters(plan.plan, at(h, 0)); }, step);
      EXPECT_LT(apart(exact.by_travel, travel, values, count), agreement) << sample.name;
      const auto rack = differenced([&](double h) { return wheel_parameters(plan.plan, at(0, h)); }, step);
      EXPECT_LT(apart(exact.by_rack, rack, values, count), agreement) << sample.name;
      EXPECT_NEAR(exact.by_travel.angles.toe, values.toe_by_travel,
                  1e-11 * (1 + std::abs(values.toe_by_travel)));
    }
  }
}

TEST(Derivatives, AtRestAreTheSameWithoutRates) {
  const Suspension suspension = corner_sample("2RS-US").suspension;
  const DerivativePlan plan = prepare_derivatives(suspension, hard_points(suspension));
  const CornerPosition at =
      solve_position(plan.plan, Driver::wheel_centre_z, {0.03, 0.02}, reference_position(plan.plan));
  const WheelDerivatives all = wheel_derivatives(plan, at),
                         rest = wheel_derivatives(plan, at, Extent::at_rest);
  for (std::size_t j = 0; j < all.by.size(); ++j) {
    EXPECT_EQ(all.by[j].angles.toe, rest.by[j].angles.toe);
    EXPECT_EQ(all.by[j].spring_length, rest.by[j].spring_length);
    EXPECT_TRUE(std::isnan(rest.by[j].roll_centre_height));
  }
}

TEST(Derivatives, WhereLinksLoseRankThereAreNone) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links[4] = suspension.links[3];
  suspension.links[4].name = "double";
  const DerivativePlan plan = prepare_derivatives(suspension, hard_points(suspension));
  const CornerPosition at{.place = {{plan.plan.wheel.centre, {}}, 0}};
  const WheelDerivatives found = wheel_derivatives(plan, at);
  EXPECT_EQ(found.status, Status::singular);
  EXPECT_EQ(found.parameters.status, Status::singular);
  EXPECT_NEAR(found.parameters.angles.toe, suspension.wheel.toe, 1e-15);
  EXPECT_TRUE(std::isnan(found.by[0].angles.toe));
  EXPECT_EQ(input_derivatives(plan, at).status, Status::singular);
}

TEST(Derivatives, OfNumbersThatAreNotThereAreRefused) {
  EXPECT_THROW(prepare_derivatives(corner_sample("5US").suspension, {{DesignKind::length, 0}}),
               ContractError);
}

// Lengths between all kinds of parts and angles of all kinds, by either coordinate of the wheel.
TEST(CornerMotions, AreDifferencesOfPositions) {
  Suspension pushrod = pushrod_corner();
  pushrod.elements = {{.name = "damper",
                       .first = {{0.01, 0.2, 0.3}, {PartKind::link, 0}},
                       .second = {{0, 0.215, 0.53}, {PartKind::rocker, 0}}},
                      {.name = "carrier to rod",
                       .first = {{0, 0.5, 0.2}, {}},
                       .second = {{0.07, 0.4, 0.17}, {PartKind::link, 2}}},
                      {.name = "heave spring",
                       .first = {{0.02, -0.19, 0.5}},
                       .second = {{0.02, 0.19, 0.5}, {PartKind::rocker, 0}},
                       .across = true},
                      {.name = "wishbone", .turn = CornerPart{PartKind::link, 0}},
                      {.name = "bar", .turn = CornerPart{PartKind::rocker, 1}}};
  Suspension arm = corner_sample("RR-US").suspension;
  arm.elements = {{.name = "arm", .turn = CornerPart{PartKind::link, 0}},
                  {.name = "damper",
                   .first = {{0, 0.3, 0.5}, {PartKind::body}},
                   .second = {arm.links[0].carrier[0], {PartKind::link, 0}}}};
  Suspension hinge{.wheel = {{0, 0.8, 0}, 0, 0, 0.6}};
  hinge.links.push_back({.type = LinkType::R, .body = {{-0.1, 0.3, 0}, {0.1, 0.32, 0.01}}});
  hinge.elements = {{.name = "hinge", .turn = CornerPart{PartKind::link, 0}}};
  for (const Suspension& suspension : {pushrod, mirrored(pushrod), arm, hinge})
    for (const Driver driver : {Driver::wheel_centre_z, Driver::contact_z}) {
      const DerivativePlan plan = prepare_derivatives(suspension, {});
      const CornerPosition reference = reference_position(plan.plan);
      const auto at = [&](double z) {
        return corner_motions(plan, solve_position(plan.plan, driver, {0.01 + z, 0}, reference), driver);
      };
      const double step = 1e-3;
      const CornerMotions here = at(0), more = at(step), less = at(-step), more2 = at(2 * step),
                          less2 = at(-2 * step);
      ASSERT_EQ(here.elements.size(), suspension.elements.size());
      const auto compare = [&](const std::string& name, auto&& of) {
        SCOPED_TRACE(name);
        const auto slope = [&](double TravelRates::*member) {
          return (8 * (of(more).*member - of(less).*member) - (of(more2).*member - of(less2).*member)) /
                 (12 * step);
        };
        EXPECT_NEAR(of(here).ratio, slope(&TravelRates::value), 1e-8 * (1 + std::abs(of(here).ratio)));
        EXPECT_NEAR(of(here).by_travel, slope(&TravelRates::ratio),
                    2e-7 * (1 + std::abs(of(here).by_travel)));
      };
      for (std::size_t i = 0; i < here.elements.size(); ++i)
        compare(suspension.elements[i].name, [i](const CornerMotions& m) { return m.elements[i]; });
      for (std::size_t i = 0; i < here.rockers.size(); ++i)
        compare(suspension.rockers[i].name, [i](const CornerMotions& m) { return m.rockers[i]; });
      ASSERT_EQ(here.ends_across.size(), suspension.rockers.empty() ? 0U : 1U);
      for (std::size_t i = 0; i < 3 && !here.ends_across.empty(); ++i)
        compare("end across", [i](const CornerMotions& m) { return m.ends_across[0][i]; });
      if (here.spring) compare("spring", [](const CornerMotions& m) { return *m.spring; });
    }
}

// The points of rockers as design numbers: the spring's length and motion ratio by each of them.
TEST(WheelDerivatives, ByThePointsOfRockers) {
  Suspension suspension = pushrod_corner();
  suspension.rockers[0].length = 0.301;
  const DerivativePlan plan = prepare_derivatives(suspension, hard_points(suspension));
  const CornerInput input{0.02, 0};
  const auto solved = [&](const Suspension& at) {
    const CornerPlan own = prepare_suspension(at);
    return wheel_parameters(own, solve_position(own, Driver::wheel_centre_z, input, reference_position(own)));
  };
  const WheelDerivatives found = wheel_derivatives(
      plan, solve_position(plan.plan, Driver::wheel_centre_z, input, reference_position(plan.plan)));
  int compared = 0;
  for (std::size_t k = 0; k < plan.numbers.size(); ++k) {
    if (plan.numbers[k].kind != DesignKind::rocker_axis && plan.numbers[k].kind != DesignKind::rocker_rod &&
        plan.numbers[k].kind != DesignKind::rocker_length)
      continue;
    SCOPED_TRACE(label(suspension, plan.numbers[k]));
    const WheelParameters slope = differenced(
        [&](double change) {
          Suspension moved = suspension;
          design_value(moved, plan.numbers[k]) += change;
          return solved(moved);
        },
        1e-4);
    EXPECT_NEAR(found.by[k].spring_length, slope.spring_length, 1e-8);
    EXPECT_NEAR(found.by[k].motion_ratio, slope.motion_ratio, 1e-6);
    ++compared;
  }
  EXPECT_EQ(compared, 25);
}

// Length, ratio and its slope by travel of spring, rockers and elements, by every point of links, rockers and
// springs, against differences of `corner_motions` at designs nearby.
TEST(MotionDerivatives, AgreeWithDifferencesOfMotions) {
  Suspension suspension = pushrod_corner();
  suspension.rockers[0].length = 0.301;
  suspension.elements = {
      {.name = "damper",
       .first = {{0.01, 0.03, 0.48}, {PartKind::body}},
       .second = {{0.02, 0.21, 0.5}, {PartKind::rocker, 0}}},
      {.name = "torsion_bar", .first = {}, .second = {}, .turn = CornerPart{PartKind::link, 0}}};
  std::vector<DesignNumber> numbers = hard_points(suspension);
  for (const DesignKind kind : {DesignKind::element_first, DesignKind::element_second})
    for (int axis = 0; axis < 3; ++axis) numbers.push_back({kind, 0, 0, axis});
  const Driver driver = Driver::contact_z;  // held, while rates are by the height of the wheel centre
  const CornerInput input{0.02, 0.005};
  const auto position_of = [&](const CornerPlan& plan) {
    return solve_position(plan, driver, input, reference_position(plan, driver));
  };
  const auto motions_of = [&](const Suspension& at) {
    const DerivativePlan plan = prepare_derivatives(at, {});
    return corner_motions(plan, position_of(plan.plan));
  };
  const MotionPlan plan = prepare_motions(suspension, numbers);
  const MotionDerivatives found = motion_derivatives(plan, position_of(plan.plan));
  ASSERT_EQ(found.status, Status::done);
  ASSERT_EQ(found.by.size(), numbers.size());
  const CornerMotions here = motions_of(suspension);
  using Pick = std::function<TravelRates(const CornerMotions&)>;
  using Same = std::function<TravelRates(const MotionRates&)>;
  const std::vector<std::pair<Pick, Same>> parts{
      {[](const CornerMotions& m) { return *m.spring; }, [](const MotionRates& m) { return m.spring; }},
      {[](const CornerMotions& m) { return m.rockers[0]; },
       [](const MotionRates& m) { return m.rockers[0]; }},
      {[](const CornerMotions& m) { return m.rockers[1]; },
       [](const MotionRates& m) { return m.rockers[1]; }},
      {[](const CornerMotions& m) { return m.elements[0]; },
       [](const MotionRates& m) { return m.elements[0]; }},
      {[](const CornerMotions& m) { return m.elements[1]; },
       [](const MotionRates& m) { return m.elements[1]; }}};
  for (const auto& [pick, same] : parts)
    for (double TravelRates::*of : {&TravelRates::value, &TravelRates::ratio, &TravelRates::by_travel})
      EXPECT_NEAR(same(found.motions).*of, pick(here).*of, 1e-10 * (1 + std::abs(pick(here).*of)));
  EXPECT_NEAR(found.motions.spring_drawn, norm(suspension.spring->moving - suspension.spring->body), 1e-15);
  const double h = 1e-4;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    SCOPED_TRACE(label(suspension, numbers[k]));
    std::array<CornerMotions, 4> at;
    for (std::size_t i = 0; i < 4; ++i) {
      Suspension moved = suspension;
      design_value(moved, numbers[k]) += std::array{-2 * h, -h, h, 2 * h}[i];
      at[i] = motions_of(moved);
    }
    for (const auto& [pick, same] : parts)
      for (double TravelRates::*of : {&TravelRates::value, &TravelRates::ratio, &TravelRates::by_travel}) {
        const double slope =
            (8 * (pick(at[2]).*of - pick(at[1]).*of) - (pick(at[3]).*of - pick(at[0]).*of)) / (12 * h);
        EXPECT_NEAR(same(found.by[k]).*of, slope, 2e-6 * (1 + std::abs(slope)));
      }
  }
}

}  // namespace
}  // namespace linkwright::suspension
