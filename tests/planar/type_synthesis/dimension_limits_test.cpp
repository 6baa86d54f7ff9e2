// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// A box that no pivot is in, and a given pivot, for a machine with pivots of every sort.
MachineLimits far_limits() {
  return {.min_length = 3,
          .max_length = 4,
          .ground_box = PlaneBox{5, 6, 7, 8},
          .ground_pivots = {{4.0, 5.0}, {-3.0, 2.0}}};
}

std::vector<double> numbers_of(const PointProgram& program) {
  std::vector<double> x;
  for (int i = 0; i < program.parameters; ++i) x.push_back(0.4 + 0.3 * i - 0.02 * i * i);
  return x;
}

TEST(DimensionLimits, HaveTheGradientsOfTheirDifferences) {
  for (const char* name : {"four_bar", "inverted_slider", "geared_five_bar:2", "stephenson_3:a",
                           "stephenson_2:a", "stephenson_2:b"}) {
    const PointProgram& program = *program_named(name);
    DimensionLimits limits(far_limits());
    limits.set_program(program);
    const std::vector<double> x = numbers_of(program);
    const auto rows_at = [&](const std::vector<double>& at) {
      std::array<LimitRows, 2> rows;
      for (LimitRows& r : rows) r.clear(true);
      limits.add_lengths(at, 2, rows[0]), limits.add_pivots(at, 2, rows[1]);
      return rows;
    };
    const auto here = rows_at(x);
    EXPECT_GT(here[0].count, 0u);
    EXPECT_GE(here[1].count, 6u) << name;
    for (std::size_t i = 0; i < x.size(); ++i) {
      constexpr double h = 1e-6;
      std::vector<double> up = x, down = x;
      up[i] += h, down[i] -= h;
      const auto above = rows_at(up), below = rows_at(down);
      for (std::size_t part = 0; part < 2; ++part) {
        ASSERT_EQ(above[part].count, here[part].count);
        for (std::size_t r = 0; r < here[part].count; ++r)
          EXPECT_NEAR(here[part].rows[r].gradient[i],
                      (above[part].rows[r].value - below[part].rows[r].value) / (2 * h), 1e-6)
              << name << ' ' << r << ' ' << i;
      }
    }
  }
}

TEST(DimensionLimits, SayWhatIsMissingWithGradientsOfDifferences) {
  for (const char* name : {"four_bar", "geared_five_bar:2", "stephenson_2:a", "watt_2:slide"}) {
    const PointProgram& program = *program_named(name);
    DimensionLimits limits(far_limits());
    limits.set_program(program);
    const std::vector<double> x = numbers_of(program);
    const std::size_t n = x.size(), count = limits.count();
    std::vector<double> values(count), above(count), below(count), gradients(count * n);
    limits.missing(x, values, gradients);
    LimitRows rows;
    rows.clear(false);
    limits.add_lengths(x, 1, rows);
    double squares = 0;
    const std::size_t of_lengths = count - 4 * ground_pivots(program).size();
    for (std::size_t k = 0; k < of_lengths; ++k) squares += values[k] > 0 ? values[k] * values[k] : 0;
    EXPECT_NEAR(squares, rows.squares, 1e-12 * rows.squares) << name;
    for (std::size_t i = 0; i < n; ++i) {
      constexpr double h = 1e-6;
      std::vector<double> moved = x;
      moved[i] = x[i] + h, limits.missing(moved, above, {});
      moved[i] = x[i] - h, limits.missing(moved, below, {});
      for (std::size_t k = 0; k < count; ++k)
        EXPECT_NEAR(gradients[k * n + i], (above[k] - below[k]) / (2 * h), 1e-6) << name << k << ' ' << i;
    }
  }
}

TEST(DimensionLimits, MovePivotsOntoTheGivenOnes) {
  for (const char* name : {"four_bar", "inverted_slider", "geared_five_bar:2", "stephenson_3:a",
                           "stephenson_2:a", "stephenson_2:b"}) {
    const PointProgram& program = *program_named(name);
    for (const std::size_t count : {1, 2}) {
      MachineLimits given;
      given.ground_pivots = {{4.0, 5.0}, {-3.0, 2.0}};
      given.ground_pivots.resize(count);
      DimensionLimits limits(given);
      limits.set_program(program);
      std::vector<double> x = numbers_of(program);
      EXPECT_FALSE(limits.pivots_as_given(x)) << name;
      limits.meet_pivots(x);
      EXPECT_TRUE(limits.pivots_as_given(x)) << name;
    }
  }
}

// The box lies above the path of the leg, whose machines without it have pivots anywhere.
TEST(TypeSearches, KeepPivotsWhereTheyAreAllowed) {
  const auto target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  const TypeSearchOptions boxed{
      .max_links = 6, .limits = {.ground_box = PlaneBox{-3, 3, 1.5, 4}}, .max_curves = 60'000};
  RunContext context;
  const auto answer = search_types(target, boxed, context);
  ASSERT_GE(answer.machines.size(), 2u);
  for (const FoundMachine& found : answer.machines) {
    const MachineShape& shape = found.machine.shape;
    for (const GroundPivot& pivot : ground_pivots(*shape.program)) {
      const std::complex<double> at = place_of(pivot, *shape.program, shape.x);
      EXPECT_TRUE(std::abs(at.real()) <= 3 && at.imag() >= 1.5 && at.imag() <= 4) << shape.program->name;
    }
  }
}

// A slider-crank has one pivot on the ground, and is no answer where two are given.
TEST(TypeSearches, MeetGivenPivots) {
  const auto target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  const std::vector<std::complex<double>> given{{0.5, 2.0}, {2.5, 2.5}};
  const TypeSearchOptions options{
      .families = {MachineFamily::four_bar, MachineFamily::slider_crank, MachineFamily::stephenson_3},
      .limits = {.ground_pivots = given},
      .max_curves = 150'000};
  RunContext context;
  const auto answer = search_types(target, options, context);
  ASSERT_FALSE(answer.machines.empty());
  for (const FoundMachine& found : answer.machines) {
    const MachineShape& shape = found.machine.shape;
    EXPECT_NE(shape.program->family, MachineFamily::slider_crank);
    for (const std::complex<double>& wanted : given) {
      double nearest = infinity;
      for (const GroundPivot& pivot : ground_pivots(*shape.program))
        nearest = std::min(nearest, std::abs(place_of(pivot, *shape.program, shape.x) - wanted));
      EXPECT_LT(nearest, 1e-9) << shape.program->name;
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
