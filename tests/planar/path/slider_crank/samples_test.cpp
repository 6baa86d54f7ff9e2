// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/samples.h"

#include <gtest/gtest.h>

#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

TEST(SliderCrankSamples, AreThoseOfTheReference) {
  const SliderPathProblem p = eighteen_slider_points();
  require_valid(p);
  const char* ids[] = {"T4.2", "T4.3-1", "T4.3-2", "T4.3-3", "T4.3-4"};
  const auto designs = published_slider_cranks();
  ASSERT_EQ(designs.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const Value& entry = test::path_case(ids[i]);
    const SliderCrankForm& f = designs[i].linkage.parameters;
    EXPECT_EQ(f.crank, test::number_at(entry, "inputs.design.L2_m"));
    EXPECT_EQ(f.offset, -test::number_at(entry, "inputs.design.H_m"));
    EXPECT_EQ(designs[i].published_error, test::number_at(entry, "published.sse_m2"));
    EXPECT_EQ(designs[i].published_stroke, test::number_at(entry, "published.stroke_m"));
    std::vector<double> angles;
    for (const double offset : p.angles) angles.push_back(designs[i].start_angle + offset);
    EXPECT_NEAR(measure(p, designs[i].linkage, 1, angles).error, test::number_at(entry, "computed.sse_m2"),
                1e-10);
  }
}

}  // namespace
}  // namespace linkwright::planar
