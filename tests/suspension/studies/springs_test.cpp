// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "linkwright/suspension/wheel/axle.h"
#include "suspension/pushrod_corner.h"
#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::problems_of;
using test::pushrod_study;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

constexpr double degrees = 180 / std::numbers::pi;

// The figures of the corner itself are in WheelRate.PushrodAndRocker.
TEST(Springs, ColumnsOfAPushrodCorner) {
  for (const Side side : {Side::left, Side::right}) {
    const study::Result result = run_text(test::pushrod_text(side));
    ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
    const auto at = [&](std::string_view key, std::size_t row) { return column(result, key).at(row); };
    EXPECT_NEAR(at("rocker_angle_rad", 0) * degrees, 16.02459413, 5.1e-9);
    EXPECT_NEAR(at("rocker_by_travel_rad_per_m", 3) * degrees * 1e-3, -0.51380856, 5.1e-9);
    EXPECT_NEAR(at("anti_roll_bar_angle_rad", 4) * degrees, -5.29470877, 5.1e-9);
    EXPECT_NEAR(at("spring_length_by_travel", 1), -0.78527214, 5.1e-9);
    EXPECT_NEAR(at("travel_by_spring_length", 1), 1 / -0.78527214, 1e-8);
    EXPECT_NEAR(at("spring_force_N", 3), 1321.5350, 5.1e-5);
    EXPECT_NEAR(at("wheel_force_N", 4), 1437.820795, 5.1e-7);
    EXPECT_NEAR(at("wheel_rate_N_per_m", 0), 21296.8, 0.15);
    EXPECT_NEAR(at("motion_ratio", 2), 0.79637970, 5.1e-9);
    EXPECT_NEAR(at("toe_rad", 4) * degrees, -0.049677, 5.1e-7);
    EXPECT_NEAR(at("camber_rad", 4) * degrees, 0.463096, 5.1e-7);
    EXPECT_NEAR(at("anti_roll_bar_wheel_rate_N_per_m", 2), 17690.08, 0.0051);
    EXPECT_NEAR(at("wheel_damping_N_s_per_m", 2), 3000 * std::pow(0.79637970, 2), 1e-4);
    // The stop engages after 20 mm of compression.
    const double pressed = 0.19602295784 - 0.17174143566 - 0.02;
    EXPECT_EQ(at("bump_stop_force_N", 3), 0);
    EXPECT_NEAR(at("bump_stop_force_N", 4), 1e5 * pressed, 1e-5);
    EXPECT_NEAR(at("total_wheel_force_N", 4), 1437.820795 + 1e5 * pressed * 0.82168077, 1e-5);
    const double rate = at("total_wheel_rate_N_per_m", 2), ride = rate * 120e3 / (rate + 120e3);
    EXPECT_NEAR(at("ride_rate_N_per_m", 2), ride, 1e-9);
    EXPECT_NEAR(at("natural_frequency_Hz", 2), std::sqrt(ride / 70) / (2 * std::numbers::pi), 1e-12);
    EXPECT_NEAR(at("damping_ratio", 2), at("wheel_damping_N_s_per_m", 2) / (2 * std::sqrt(rate * 70)), 1e-12);
    EXPECT_NEAR(at("wheel_rate_force_share", 2),
                1 - 35e3 * std::pow(0.79637970, 2) / at("wheel_rate_N_per_m", 2), 1e-8);
  }
}

TEST(Springs, RowsDoNotDependOnTheirSpacing) {
  const study::Result coarse = run_text(pushrod_study),
                      fine = run_text(replaced(pushrod_study, "values_mm = [-30, -15, 0, 15, 30]",
                                               "from_mm = -30\nto_mm = 30\nstep_mm = 0.5"));
  for (const Column& c : coarse.tables.at(0).columns) {
    if (c.key == "closure_residual_m") continue;
    EXPECT_NEAR(c.values.at(4), column(fine, c.key).back(), 1e-9 * (1 + std::abs(c.values[4]))) << c.key;
  }
  EXPECT_EQ(test::fact(coarse, "bump stop engages at travel"),
            test::fact(fine, "bump stop engages at travel"));
}

TEST(Springs, TorsionBarWoundUpByEitherSense) {
  const auto text = [](const std::string& axis) {
    return replaced(
        replaced(pushrod_study, "[mechanism.bump_stop]",
                 "[mechanism.torsion_bar]\nattached_to = \"rocker\"\nstiffness_N_m_per_rad = 500\n"
                 "preload_N_m = 40\n[mechanism.bump_stop]"),
        "axis_mm   = [[40, 200, 430], [-40, 200, 430]]", axis);
  };
  const study::Result one = run_text(text("axis_mm = [[40, 200, 430], [-40, 200, 430]]")),
                      other = run_text(text("axis_mm = [[-40, 200, 430], [40, 200, 430]]"));
  ASSERT_EQ(one.status, Status::done);
  const double angle = column(one, "rocker_angle_rad").at(4),
               ratio = column(one, "rocker_by_travel_rad_per_m").at(4);
  EXPECT_NEAR(column(one, "torsion_bar_moment_N_m").at(4), 40 - 500 * angle, 1e-9);
  EXPECT_NEAR(column(one, "torsion_bar_wheel_force_N").at(4), -(40 - 500 * angle) * ratio, 1e-9);
  for (const char* key : {"torsion_bar_moment_N_m", "torsion_bar_wheel_force_N",
                          "torsion_bar_wheel_rate_N_per_m", "total_wheel_rate_N_per_m"})
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(column(one, key).at(i), column(other, key).at(i), 1e-8) << key;
  EXPECT_NEAR(column(one, "rocker_angle_rad").at(0), -column(other, "rocker_angle_rad").at(0), 1e-12);
}

// The body leans over a plane road and finds its height by its load; the load acts in the middle of the axle
// at the road.
TEST(Springs, RollRateByTheEnergyOfTheAxleHasTheJackingOfTheLoad) {
  const study::Result result = run_text(pushrod_study);
  const AxlePlan axle = prepare_axle(pushrod_corner());
  const AxlePosition reference = reference_position(axle);
  const auto contact = [](const CornerPlan& plan, const CornerPosition& position) {
    return wheel_parameters(plan, position).contact;
  };
  const double load = [&] {
    const AxlePosition up = solve_axle(axle, {Driver::contact_z, 1e-5, 1e-5, 0}, reference),
                       down = solve_axle(axle, {Driver::contact_z, -1e-5, -1e-5, 0}, reference);
    const auto length = [&](const AxlePosition& at) {
      return driver_value(axle.left, at.left.place, 0, Driver::spring);
    };
    return 2 * 900 * (length(down) - length(up)) / 2e-5;
  }();
  const auto energy = [&](double roll, double heave) {
    const AxlePosition at = solve_roll(axle, roll, heave, 0, reference);
    EXPECT_EQ(at.status, Status::done);
    double sum = 0, twist = 0;
    for (const auto& [plan, position, sign] :
         {std::tuple{&axle.left, &at.left, 1.0}, std::tuple{&axle.right, &at.right, -1.0}}) {
      const double force = 900 - 35e3 * driver_value(*plan, position->place, 0, Driver::spring);
      sum += force * force / (2 * 35e3);
      twist += sign * rocker_states(*plan, position->place, 0)[1].angle;
    }
    const Vec3 left = contact(axle.left, at.left);
    const double road = left.z - left.y * std::tan(roll);  // in the middle, in the frame of the body
    return sum + 1200 * twist * twist / 2 - load * (road - axle.left.contact.z) * std::cos(roll);
  };
  const auto least = [&](double roll) {  // of the parabola through three heaves
    const double h = 1e-3, a = energy(roll, -h), b = energy(roll, 0), c = energy(roll, h);
    return b - (c - a) * (c - a) / (8 * (a + c - 2 * b));
  };
  const double step = 4e-3, second = (16 * (least(step) + least(-step)) -
                                      (least(2 * step) + least(-2 * step)) - 30 * least(0)) /
                                     (12 * step * step);
  EXPECT_NEAR(test::value_of_fact(result, "roll rate by the energy of the axle, load held and track free"),
              second, 2e-4 * second);
  const double plain = test::value_of_fact(result, "roll rate of the springs") +
                       test::value_of_fact(result, "roll rate of the anti-roll bar");
  EXPECT_GT(std::abs(second - plain), 0.003 * plain);  // the jacking is no rounding
}

TEST(Springs, ContactHeightAsTheCoordinate) {
  const study::Result centre = run_text(pushrod_study),
                      contact = run_text(pushrod_study + "coordinate = \"contact_z\"\n");
  const auto at = [&](const study::Result& result, const char* key) { return column(result, key).at(4); };
  const double rise = at(centre, "spring_length_by_travel") / at(contact, "spring_length_by_travel");
  EXPECT_NEAR(rise, at(centre, "rocker_by_travel_rad_per_m") / at(contact, "rocker_by_travel_rad_per_m"),
              1e-12);
  EXPECT_GT(std::abs(rise - 1), 1e-6);
  EXPECT_NEAR(at(contact, "wheel_force_N") * rise, at(centre, "wheel_force_N"), 1e-8);
}

TEST(Springs, AntiRollBarBetweenWheelsThatTravelOppositely) {
  const study::Result result = run_text(pushrod_study + "[axle.opposite]\nvalues_mm = [-10, 0, 10]\n"),
                      right = run_text(test::pushrod_text(Side::right) +
                                       "[axle.opposite]\nvalues_mm = [-10, 0, 10]\n");
  const Table& table = *result.table("opposite");
  const auto at = [&](std::string_view key, std::size_t row) { return table.find(key)->values.at(row); };
  EXPECT_NEAR(at("left_rocker_angle_rad", 2) * degrees, -5.162367, 5.1e-7);
  EXPECT_NEAR(at("right_rocker_angle_rad", 2) * degrees, 5.220767, 5.1e-7);
  EXPECT_NEAR(at("twist_rad", 2) * degrees, -3.111654, 5.1e-7);
  EXPECT_NEAR(std::abs(at("twist_by_travel_rad_per_m", 1)) * 1e-3, 0.00542987, 5.1e-9);
  EXPECT_NEAR(at("anti_roll_bar_wheel_rate_N_per_m", 1) * 1e-3, 17.69008, 5.1e-6);
  EXPECT_NEAR(at("anti_roll_bar_geometric_rate_N_per_m", 1), 0, 1e-9);
  // The rates are half the slope of both forces, whose sum is that of the energy.
  const study::Result fine = run_text(pushrod_study + "[axle.opposite]\nvalues_mm = [9.9, 10, 10.1]\n");
  const auto force = [&](std::size_t row) {
    const Table& of = *fine.table("opposite");
    return of.find("left_anti_roll_bar_force_N")->values.at(row) -
           of.find("right_anti_roll_bar_force_N")->values.at(row);
  };
  EXPECT_NEAR(at("anti_roll_bar_wheel_rate_N_per_m", 2) + at("anti_roll_bar_geometric_rate_N_per_m", 2),
              (force(2) - force(0)) / 0.0002 / 2, 0.01);
  for (const Column& c : table.columns)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(c.values[i], right.table("opposite")->find(c.key)->values.at(i),
                  1e-9 * (1 + std::abs(c.values[i])))
          << c.key;
}

// By the energy of springs and bar as the body rolls over a plane road.
TEST(Springs, RollRatesAreSecondDifferencesOfTheEnergy) {
  const study::Result result = run_text(pushrod_study);
  const Suspension suspension = pushrod_corner();
  const AxlePlan axle = prepare_axle(suspension);
  const AxlePosition reference = reference_position(axle);
  struct Energy {
    double springs = 0, bar = 0;
  };
  const auto energy = [&](double roll) {
    const AxlePosition at = solve_roll(axle, roll, 0, 0, reference);
    EXPECT_EQ(at.status, Status::done);
    Energy out;
    double twist = 0;
    for (const auto& [plan, position, sign] :
         {std::tuple{&axle.left, &at.left, 1.0}, std::tuple{&axle.right, &at.right, -1.0}}) {
      const double force =
          900 - 35e3 * driver_value(*plan, position->place, position->input.rack, Driver::spring);
      out.springs += force * force / (2 * 35e3);
      twist += sign * rocker_states(*plan, position->place, position->input.rack)[1].angle;
    }
    out.bar = 1200 * twist * twist / 2;
    return out;
  };
  constexpr double step = 2e-3;
  const Energy none = energy(0), more = energy(step), less = energy(-step), more2 = energy(2 * step),
               less2 = energy(-2 * step);
  const auto second = [&](double Energy::*of) {
    return (16 * (more.*of + less.*of) - (more2.*of + less2.*of) - 30 * (none.*of)) / (12 * step * step);
  };
  EXPECT_NEAR(test::value_of_fact(result, "roll rate of the springs"), second(&Energy::springs),
              1e-6 * second(&Energy::springs));
  EXPECT_NEAR(test::value_of_fact(result, "roll rate of the anti-roll bar"), second(&Energy::bar),
              1e-6 * second(&Energy::bar));
}

// The end of the heave spring on the rocker, turned about its axis here, and the energy of the spring between
// both ends: the wheels travelling equally, oppositely, and on a plane road in roll.
TEST(Springs, HeaveSpringByItsEnergy) {
  const study::Result result = run_text(replaced(pushrod_study, "[mechanism.damper]",
                                                 "[mechanism.heave_spring]\nmoving_mm = [15, 190, 500]\n"
                                                 "attached_to = \"rocker\"\nstiffness_N_per_mm = 60\n"
                                                 "preload_N = 400\n[mechanism.damper]") +
                                        "[axle.opposite]\nvalues_mm = [-10, 0, 10]\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const AxlePlan axle = prepare_axle(pushrod_corner());
  const AxlePosition reference = reference_position(axle);
  const auto end = [](const CornerPlan& plan, const CornerPosition& position, double side) {
    const double w = rocker_states(plan, position.place, position.input.rack)[0].angle;
    const double y = 0.19 - 0.2, z = 0.5 - 0.43;  // from the axis, whose direction is -x
    return std::array{side * (0.2 + y * std::cos(w) + z * std::sin(w)),
                      0.43 - y * std::sin(w) + z * std::cos(w)};
  };
  const auto energy = [&](const AxlePosition& at) {
    EXPECT_EQ(at.status, Status::done);
    const auto l = end(axle.left, at.left, 1), r = end(axle.right, at.right, -1);
    const double force = 400 + 60e3 * (0.38 - std::hypot(l[0] - r[0], l[1] - r[1]));
    return force * force / (2 * 60e3);
  };
  const auto travelled = [&](double left, double right) {
    return energy(solve_axle(axle, {Driver::wheel_centre_z, left, right, 0}, reference));
  };
  const auto slope = [](double step, auto&& of) {
    return (8 * (of(step) - of(-step)) - (of(2 * step) - of(-2 * step))) / (12 * step);
  };
  const auto second = [](double step, auto&& of) {
    return (16 * (of(step) + of(-step)) - (of(2 * step) + of(-2 * step)) - 30 * of(0)) / (12 * step * step);
  };
  const auto equally = [&](double z) { return travelled(0.015 + z, 0.015 + z); };
  EXPECT_NEAR(column(result, "heave_spring_wheel_force_N").at(3), slope(4e-4, equally) / 2, 1e-6);
  EXPECT_NEAR(column(result, "heave_spring_wheel_rate_N_per_m").at(3), second(1e-3, equally) / 2, 0.02);
  EXPECT_NEAR(
      column(result, "total_wheel_rate_N_per_m").at(1),
      column(result, "wheel_rate_N_per_m").at(1) + column(result, "heave_spring_wheel_rate_N_per_m").at(1),
      1e-8);
  const Table& opposite = *result.table("opposite");
  const auto at = [&](const char* key) { return opposite.find(key)->values.at(2); };
  EXPECT_NEAR(at("left_heave_spring_force_N"),
              slope(4e-4, [&](double z) { return travelled(0.01 + z, -0.01); }), 1e-6);
  EXPECT_NEAR(at("right_heave_spring_force_N"),
              slope(4e-4, [&](double z) { return travelled(0.01, -0.01 + z); }), 1e-6);
  const double by_roll =
      second(2e-3, [&](double roll) { return energy(solve_roll(axle, roll, 0, 0, reference)); });
  EXPECT_NEAR(test::value_of_fact(result, "roll rate of the heave spring, by its force"), by_roll,
              1e-5 * std::abs(by_roll));
}

/// The corner of the other side as `[other_wheel]`.
std::string other_wheel() {
  std::string text = test::pushrod_text(Side::right);
  text.erase(text.find("[sweep.travel]"));
  text.erase(0, text.find("[mechanism]"));
  for (std::size_t at = 0; (at = text.find("[mechanism", at)) != std::string::npos;)
    text.replace(at, 10, "[other_wheel.mechanism"), at += 22;
  return text;
}

TEST(Springs, TheOtherWheelMayBeGiven) {
  const std::string opposite = "[axle.opposite]\nvalues_mm = [-10, 10]\n";
  const study::Result mirrored = run_text(pushrod_study + opposite),
                      given = run_text(pushrod_study + opposite + other_wheel()),
                      softer = run_text(
                          pushrod_study + opposite +
                          replaced(other_wheel(), "stiffness_N_per_mm = 35", "stiffness_N_per_mm = 30"));
  const auto at = [](const study::Result& r, const std::string& key, std::size_t row) {
    return r.table("opposite")->find(key)->values.at(row);
  };
  for (const Column& c : mirrored.table("opposite")->columns)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(at(given, c.key, i), c.values[i], 1e-9 * (1 + std::abs(c.values[i]))) << c.key;
  EXPECT_EQ(at(softer, "left_wheel_force_N", 0), at(given, "left_wheel_force_N", 0));
  EXPECT_GT(std::abs(at(softer, "right_wheel_force_N", 0) - at(given, "right_wheel_force_N", 0)), 10);
  EXPECT_EQ(test::fact(softer, "roll rate of the springs"), "no fact");  // of a symmetric axle
}

TEST(Springs, PartsBetweenTheWheelsAreTheSameForBoth) {
  const std::string bar = "stiffness_N_m_per_rad = 1200";
  EXPECT_THAT(
      problems_of(pushrod_study + replaced(other_wheel(), bar, "stiffness_N_m_per_rad = 1300")),
      HasSubstr(
          "other_wheel.mechanism: the anti-roll bar has another stiffness than at the first wheel; it is one "
          "bar: give the same stiffness for both wheels"));
  const std::string t_bar = "shape = \"T\"\naxis_mm = [[200, 0, 250], [20, 0, 260]]";
  EXPECT_THAT(
      problems_of(replaced(pushrod_study, "axis_mm     = [[120, 0, 250], [120, 100, 250]]", t_bar) +
                  other_wheel()),
      HasSubstr("other_wheel.mechanism: the anti-roll bar has another shape or post than at the first "
                "wheel; it is one bar"));
  const std::string heave =
      "heave_spring]\nmoving_mm = [15, 190, 500]\nattached_to = \"rocker\"\n"
      "stiffness_N_per_mm = 60\n";
  const std::string sprung =
      replaced(pushrod_study, "[mechanism.damper]", "[mechanism." + heave + "[mechanism.damper]");
  EXPECT_THAT(problems_of(sprung + other_wheel()),
              HasSubstr("other_wheel.mechanism: the heave spring has an end at one wheel alone; give "
                        "[mechanism.heave_spring] for both wheels"));
}

TEST(Springs, TogglesEndTheTravelAndAreReported) {
  const study::Result result =
      run_text(replaced(pushrod_study, "values_mm = [-30, -15, 0, 15, 30]", "values_mm = [-100, 0]"));
  EXPECT_EQ(result.status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(column(result, "rocker_angle_rad").at(0)));
  EXPECT_NEAR(result.table("limits")->find("lowest_travel_m")->values.at(0), -0.083386, 1e-6);
  EXPECT_THAT(to_string(result.diagnostics.at(0)),
              HasSubstr("the rod of rocker comes into line with its arm there (toggle"));
}

TEST(Springs, RideNeedsASpring) {
  EXPECT_THAT(
      problems_of(replaced(replaced(pushrod_study, "stiffness_N_per_mm = 35\npreload_N          = 900", ""),
                           "tyre_stiffness_N_per_mm = 120", "")),
      HasSubstr(
          "ride.sprung_mass_kg: there is no spring whose stiffness is known; write stiffness_N_per_mm in "
          "[mechanism.spring]"));
  EXPECT_THAT(
      problems_of(pushrod_study + "coordinate = \"spring\"\n"),
      HasSubstr("ride.coordinate: ratios and rates refer to a height of the wheel; take wheel_centre_z or "
                "contact_z"));
}

}  // namespace
}  // namespace linkwright::suspension
