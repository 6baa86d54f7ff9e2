// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/found_linkage.h"

#include <gtest/gtest.h>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

// The solver of any linkage knows nothing of programs.
TEST(FoundLinkages, TraceTheCurveOfTheirProgram) {
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  for (const PointProgram* p : test::all_programs()) {
    FittedMachine m;
    m.shape = test::some_shape(*p, 11);
    double* x = m.shape.x.data() + m.shape.x.size() - 4;
    x[0] = 0.4, x[1] = -0.2, x[2] = 0.3, x[3] = -0.6;
    const FoundLinkage found = found_linkage(m, target);
    const PlanResult planned = plan_linkage(found.linkage);
    ASSERT_TRUE(planned.problems.empty())
        << p->name << ": " << linkwright::to_string(planned.problems[0].message);
    LinkageMotion moving(planned.plan);
    std::vector<double> angles;
    for (int k = 0; k < 40; ++k) angles.push_back(0.16 * k);
    const auto curve = test::traced(m.shape, angles);
    const BodyPoint point = point_named(found.linkage, found.traced);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const InputMotion input{angles[k] + found.crank_angle, 0, 0};
      solve_position(planned.plan, std::span(&input, 1), moving);
      ASSERT_EQ(moving.status, Status::done) << p->name << " at " << k;
      const PartState<double> body = body_state(planned.plan, moving, point.body);
      const std::complex<double> local = found.linkage.bodies[static_cast<std::size_t>(point.body)]
                                             .points[static_cast<std::size_t>(point.point)]
                                             .at;
      const std::complex<double> place = std::complex<double>(body.origin.x, body.origin.y) +
                                         std::complex<double>(body.direction.x, body.direction.y) * local;
      EXPECT_LT(std::abs((place - target.centre) / target.size - curve[k]), 1e-6) << p->name << " at " << k;
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
