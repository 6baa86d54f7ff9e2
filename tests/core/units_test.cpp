// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string_view>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

double si(Dimension dimension, std::string_view suffix, double value) {
  const Unit* unit = find_unit(dimension, suffix);
  return unit ? unit->to_si(value) : std::nan("");
}

// Decimal factors must give the double nearest to the exact result, so that 60 mm is the 0.06 that people
// write.
TEST(Units, DecimalUnitsRoundOnce) {
  for (int mm = -1000; mm <= 1000; ++mm) {
    EXPECT_EQ(si(Dimension::length, "mm", mm), mm / 1000.0);
    EXPECT_EQ(find_unit(Dimension::length, "mm")->from_si(mm / 1000.0), mm);
  }
  EXPECT_EQ(si(Dimension::length, "in", 1), 0.0254);
  // By definition: 0.45359237 kg and 1 kg under 9.80665 m/s2.
  EXPECT_DOUBLE_EQ(si(Dimension::force, "lbf", 1), 0.45359237 * 9.80665);
  EXPECT_EQ(si(Dimension::force, "kgf", 1), 9.80665);
  EXPECT_EQ(si(Dimension::inertia, "g_mm2", 1), 1e-9);
}

TEST(Units, AnglesAndSpeeds) {
  EXPECT_EQ(si(Dimension::angle, "deg", 360), 2 * pi);
  EXPECT_EQ(si(Dimension::speed_angular, "rpm", 300), 10 * pi);
  EXPECT_EQ(si(Dimension::torque, "N_mm", 1500), 1.5);
  EXPECT_EQ(si(Dimension::frequency, "per_min", 90), 1.5);
  EXPECT_EQ(si(Dimension::jerk_angular, "deg_per_s3", 180), pi);
  EXPECT_EQ(si(Dimension::power, "kW", 0.5), 500);
}

TEST(Units, KeysTakeTheLongestSuffix) {
  const auto dimension = [](std::string_view key) {
    const auto parts = split_unit(key);
    return parts ? std::string(parts->base) + "|" + std::string(parts->unit->suffix) : "none";
  };
  EXPECT_EQ(dimension("toe_deg"), "toe|deg");
  EXPECT_EQ(dimension("drive_torque_N_m"), "drive_torque|N_m");
  EXPECT_EQ(dimension("inertia_kg_m2"), "inertia|kg_m2");
  EXPECT_EQ(dimension("path_error_sum_sq_m2"), "path_error_sum_sq|m2");
  EXPECT_EQ(dimension("gravity_m_per_s2"), "gravity|m_per_s2");
  EXPECT_EQ(dimension("rocker_acceleration_rad_per_s2"), "rocker_acceleration|rad_per_s2");
  EXPECT_EQ(dimension("start_jerk_mm_per_s3"), "start_jerk|mm_per_s3");
  EXPECT_EQ(dimension("energy_J"), "energy|J");
  EXPECT_EQ(dimension("samples"), "none");
  EXPECT_EQ(dimension("_m"), "none");
}

// A key must mean one unit: split_unit looks at its end alone.
TEST(Units, EveryDimensionHasUnitsAndWordsOfItsOwn) {
  std::set<std::string_view> suffixes, words;
  for (const Dimension dimension : all_dimensions()) {
    EXPECT_TRUE(words.insert(describe(dimension)).second) << describe(dimension);
    ASSERT_FALSE(units(dimension).empty()) << describe(dimension);
    EXPECT_EQ(units(dimension).front().to_si(1), 1) << describe(dimension);
    for (const Unit& unit : units(dimension)) {
      EXPECT_TRUE(suffixes.insert(unit.suffix).second) << unit.suffix;
      EXPECT_EQ(find_unit(dimension, unit.suffix), &unit);
    }
  }
  EXPECT_TRUE(units(Dimension::none).empty());
  EXPECT_EQ(units(Dimension::length).size(), 5u);
  EXPECT_EQ(units(Dimension::second_moment_of_area).size(), 3u);
}

TEST(Units, NamesForKeysAndPeople) {
  EXPECT_EQ(si_key("crank", Dimension::length), "crank_m");
  EXPECT_EQ(si_key("weight", Dimension::none), "weight");
  EXPECT_EQ(find_unit(Dimension::length, "deg"), nullptr);
  EXPECT_EQ(readable_unit("m_per_s2"), "m/s2");
  EXPECT_EQ(readable_unit("N_m"), "N m");
  EXPECT_EQ(readable_unit("N_m_s_per_rad"), "N m s/rad");
}

}  // namespace
}  // namespace linkwright
