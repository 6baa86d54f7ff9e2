// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/machine_objectives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/random.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(MachineObjectives, AgreeWithTheMeasuresOfTheSearch) {
  for (const char* name : {"four_bar", "slider_crank", "inverted_slider", "stephenson_3:a"}) {
    test::OwnCurve own(*program_named(name));
    MachineObjectives objectives(own.target, {MachineQuantity::size, MachineQuantity::peak_acceleration}, {},
                                 1e-4);
    std::vector<QuantityTerms> terms;
    ASSERT_TRUE(objectives.evaluate(own.machine, own.fitter, terms)) << name;
    EXPECT_NEAR(terms[0].largest() / own.target.stroke.size, own.measures.size, 1e-12) << name;
    EXPECT_NEAR(terms[1].largest(), own.measures.peak_acceleration, 1e-12) << name;
  }
}

// Random lengths and coordinates, each machine compared with the curve anew.
TEST(MachineObjectives, PredictTheErrorOfMachinesThatAreMade) {
  for (const char* name : {"four_bar", "slider_crank", "inverted_slider", "geared_five_bar:-1", "watt_1:a"}) {
    test::OwnCurve own(*program_named(name));
    const double tolerance = 3e-3;
    const double predicted =
        tolerance_90(own.machine.shape, own.fitter.error_model(own.machine, false), tolerance);
    const auto effects = dimension_effects(own.machine.shape);
    RandomStream random({.seed = 4});
    std::vector<double> errors;
    for (int k = 0; k < 2000; ++k) {
      FittedMachine made = own.machine;
      for (const auto& dimension : effects) {
        const double change = tolerance / 3 * random.normal();
        for (const auto& [i, by] : dimension) made.shape.x[i] += by * change;
      }
      errors.push_back(own.fitter.measure(made).error);
    }
    std::nth_element(errors.begin(), errors.begin() + 1800, errors.end());
    EXPECT_NEAR(predicted / errors[1800], 1, 0.06) << name;
  }
}

// A bar keeps the place of its other points when its length is made otherwise.
TEST(MachineObjectives, ChangeOneDimensionAtATime) {
  const test::OwnCurve own(*program_named("four_bar"));
  const auto effects = dimension_effects(own.machine.shape);
  const FoundLinkage before = found_linkage(own.machine, own.target.stroke);
  for (std::size_t d = 0; d < effects.size(); ++d) {
    FittedMachine made = own.machine;
    for (const auto& [i, by] : effects[d]) made.shape.x[i] += 1e-6 * by;
    const FoundLinkage after = found_linkage(made, own.target.stroke);
    double changed = 0;
    for (std::size_t b = 0; b < before.linkage.bodies.size(); ++b)
      for (std::size_t p = 0; p < before.linkage.bodies[b].points.size(); ++p)
        changed += std::abs(after.linkage.bodies[b].points[p].at - before.linkage.bodies[b].points[p].at);
    EXPECT_NEAR(changed / own.target.stroke.size, 1e-6, 1e-9) << d;
  }
}

}  // namespace
}  // namespace linkwright::planar
