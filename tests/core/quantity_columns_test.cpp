// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/quantity_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/core/csv.h"
#include "support/message.h"

namespace linkwright {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Table table_of(const std::string& text) {
  Diagnostics diagnostics;
  return read_csv(text, "t.csv", diagnostics).value();
}

TEST(QuantityColumns, AreInSIWhateverTheirUnit) {
  const Table table = table_of("x_mm,count,angle_deg,x_s\n100,3,180,7\n,4,90,8\n");
  EXPECT_THAT(quantity(table, "x", Dimension::length).value(), ElementsAre(0.1, ::testing::IsNan()));
  EXPECT_THAT(quantity(table, "x", Dimension::time).value(), ElementsAre(7, 8));
  EXPECT_THAT(quantity(table, "count", Dimension::none).value(), ElementsAre(3, 4));
  EXPECT_FALSE(quantity(table, "y", Dimension::length));
  EXPECT_FALSE(quantity(table, "angle", Dimension::length));
  EXPECT_FALSE(quantity(table, "angle", Dimension::none));
}

constexpr QuantityColumn known[] = {
    {"x", Dimension::length}, {"tilt", Dimension::angle, "spin"}, {"load", Dimension::force}};

TEST(QuantityColumns, StandInTheOrderAskedFor) {
  Diagnostics diagnostics;
  const Quantities found =
      read_quantities(table_of("spin_deg,x_cm\n180,10\n"), known, "x, tilt and load", "t.csv", diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  EXPECT_THAT(found.keys, ElementsAre("x_cm", "spin_deg", ""));
  EXPECT_THAT(found.values,
              ElementsAre(ElementsAre(0.1), ElementsAre(::testing::DoubleEq(3.141592653589793)), IsEmpty()));
}

TEST(QuantityColumns, EachFaultIsReportedOnce) {
  Diagnostics diagnostics;
  const Quantities found = read_quantities(table_of("x,tilt_mm,load_N,load_kN,mass_kg\n1,2,3,4,5\n"), known,
                                           "x, tilt and load", "t.csv", diagnostics);
  report_missing({"time", Dimension::time}, "t.csv", diagnostics);
  EXPECT_EQ(test::lines_of(diagnostics),
            "t.csv: error: x: needs the unit of a length; write x_m\n"
            "t.csv: error: tilt_mm: needs the unit of an angle; write tilt_rad\n"
            "t.csv: error: load_kN: load is given twice\n"
            "t.csv: error: mass_kg: unknown column; columns are x, tilt and load, each with its unit\n"
            "t.csv: error: time: column is missing; add time_s\n");
  // A column without its unit is not missing.
  EXPECT_THAT(found.keys, ElementsAre("x", "tilt_mm", "load_N"));
  EXPECT_THAT(found.values, ElementsAre(IsEmpty(), IsEmpty(), ElementsAre(3)));
}

}  // namespace
}  // namespace linkwright
