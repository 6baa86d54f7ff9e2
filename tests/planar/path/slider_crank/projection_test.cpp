// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/projection.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "planar/slider_crank_path_cases.h"
#include "support/allocations.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using SP = SliderParameter;

struct ProjectionCase {
  bool turning, limited_angle, pivot_fixed, guide_fixed, start_fixed;
  SliderSide side;
  double sense;
};
std::vector<ProjectionCase> projection_cases() {
  std::vector<ProjectionCase> out;
  for (bool turning : {true, false})
    for (bool limited : {false, true})
      for (bool pivot : {false, true})
        for (bool guide : {false, true})
          for (bool start : {false, true})
            for (SliderSide side : {SliderSide::forward, SliderSide::backward})
              for (double sense : {1.0, -1.0})
                if (turning || !limited) out.push_back({turning, limited, pivot, guide, start, side, sense});
  return out;
}
SliderPathProblem projection_problem(const ProjectionCase& c) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.bounds = derive_slider_bounds(p.x, p.y);
  p.crank_rotates_fully = p.closed = c.turning;
  if (!c.turning)
    for (double& offset : p.angles) offset *= 0.2;
  if (c.limited_angle) p.max_pressure_angle = 0.7;
  if (c.pivot_fixed) p.bounds[index(SP::pivot_x)] = {0.3, 0.3}, p.bounds[index(SP::pivot_y)] = {-0.2, -0.2};
  if (c.guide_fixed) p.bounds[index(SP::guide_angle)] = {0.6, 0.6};
  if (c.start_fixed) p.bounds[index(SP::start_angle)] = {0.9, 0.9};
  return p;
}

// Limits of the stroke: none, one that holds the crank short, one that holds it long.
const Range strokes[] = {{0, infinity}, {0, 0.3}, {1.5, 3}};

template <class Body>
int with_random_unknowns(int count, Body&& body) {
  int used = 0;
  for (const ProjectionCase& c : projection_cases()) {
    const SliderPathProblem free = projection_problem(c);
    for (const Range& stroke : strokes) {
      if (!c.turning && stroke.upper < 10) continue;
      SliderPathProblem p = free;
      p.stroke = stroke;
      SliderPathProjection projection(p, c.side, c.sense);
      RandomStream stream({.seed = 11});
      std::vector<double> r(projection.residuals());
      for (int i = 0; i < count; ++i) {
        const auto q = projection.random(stream);
        if (!projection.evaluate(q, r, {})) continue;
        body(c, p, projection, q, r);
        ++used;
      }
    }
  }
  return used;
}

// Acceptance of the projection: 1e-12 relative, times the conditioning of the recovered lengths.
TEST(SliderPathProjection, ResidualsAreThoseOfTheRecoveredDesign) {
  const int compared =
      with_random_unknowns(20, [](const ProjectionCase& c, const SliderPathProblem& p,
                                  SliderPathProjection& projection, const auto& q, const auto& r) {
        const SliderPathDesign design = projection.design(p, q);
        const SliderCrankForm& f = design.linkage.parameters;
        const double projected = test::sum_of_squares(r);
        double steepest = 1;
        for (const double angle : design.angles)
          steepest = std::min(steepest, std::cos(slider_crank_pose(design.linkage, angle).pressure_angle));
        if (steepest < 0.02) return;
        const double size = f.crank + std::hypot(f.rod_u, f.rod_v);
        EXPECT_NEAR(design.error, projected, 1e-12 * projected * (1 + size * size) / steepest);
        EXPECT_EQ(design.linkage.branch, c.side);
        if (c.turning) {
          EXPECT_GE(rotation_margin(f), -1e-14 * (f.crank + f.rod));
          EXPECT_LE((f.crank + std::abs(f.offset)) / f.rod, std::sin(p.max_pressure_angle) * (1 + 1e-12));
          EXPECT_LE(design.stroke, p.stroke.upper * (1 + 1e-12));
          EXPECT_GE(design.stroke, p.stroke.lower * (1 - 1e-12));
        }
        if (c.guide_fixed) {
          EXPECT_EQ(f.guide_angle, 0.6);
        }
        if (c.start_fixed) {
          EXPECT_EQ(design.angles[0], 0.9 + c.sense * p.angles[0]);
        }
        if (c.pivot_fixed) {
          EXPECT_EQ(f.pivot_x, 0.3);
        }
      });
  EXPECT_GT(compared, 2000);
}

// The linear unknowns are the best that the limits allow: every other one within them does worse.
TEST(SliderPathProjection, LinearUnknownsAreOptimal) {
  int moved_back = 0;
  with_random_unknowns(3, [&](const ProjectionCase& c, const SliderPathProblem& p,
                              SliderPathProjection& projection, const auto& q, const auto&) {
    const SliderPathDesign best = projection.design(p, q);
    const SliderCrankForm f = best.linkage.parameters;
    for (const double delta : {-1e-3, 1e-3}) {
      std::vector<SliderCrankForm> others(6, f);
      others[0].rod_u += delta;
      others[1].rod_v += delta;
      others[2].pivot_x += c.pivot_fixed ? 0 : delta;
      others[3].pivot_y += c.pivot_fixed ? 0 : delta;
      for (double SliderCrankForm::*length :
           {&SliderCrankForm::crank, &SliderCrankForm::rod, &SliderCrankForm::offset})
        others[4].*length *= 1 + delta;
      for (std::size_t i = 0; i < 5; ++i) {
        if ((i == 2 || i == 3) && c.pivot_fixed) continue;
        SliderCrankMechanism m = best.linkage;
        m.parameters = others[i];
        const SliderPathDesign other = measure(p, m, c.sense, best.angles);
        if (i == 4 && !other.violations.empty()) {
          ++moved_back;
          continue;
        }
        EXPECT_GE(other.error, best.error * (1 - 1e-12));
      }
    }
  });
  EXPECT_GT(moved_back, 100);
}

TEST(SliderPathProjection, GradientAgreesWithDifferences) {
  int compared = 0, held = 0;
  with_random_unknowns(6, [&](const ProjectionCase&, const SliderPathProblem& p,
                              SliderPathProjection& projection, const auto& q, auto r) {
    const std::size_t n = projection.variables(), m = projection.residuals();
    const SliderPathDesign design = projection.design(p, q);
    for (const double angle : design.angles)
      if (slider_crank_pose(design.linkage, angle).pressure_angle > 1.4) return;
    std::vector<double> jacobian(n * m), gradient(n), difference(n);
    ASSERT_TRUE(projection.evaluate(q, r, jacobian));
    const double f = test::sum_of_squares(r);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < m; ++k) gradient[i] += 2 * jacobian[i * m + k] * r[k];
      largest = std::max(largest, std::abs(gradient[i]));
    }
    const auto error = [&](std::span<const double> at) {
      std::vector<double> s(m);
      return projection.evaluate(at, s, {}) ? test::sum_of_squares(s) : nan;
    };
    if (math::central_gradient(error, q, difference) != Status::done) return;
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(gradient[i], difference[i], 1e-6 * (largest + f)) << "variable " << i;
    ++compared;
    if (p.stroke.upper < 10 &&
        (std::abs(design.stroke - p.stroke.upper) < 1e-9 || std::abs(design.stroke - p.stroke.lower) < 1e-9))
      ++held;
  });
  EXPECT_GT(compared, 400);
  EXPECT_GT(held, 100);
}

// Every stored point of the front from its three unknowns, by the clip (acceptance: 1e-9).
TEST(SliderPathProjection, ClippingReproducesTheStoredFront) {
  SliderPathProblem p = printed_eighteen_slider_points();
  SliderPathProjection projection(p, SliderSide::forward, 1), other(p, SliderSide::forward, -1);
  int clipped = 0;
  for (const Value& point : at(path_case("SC18-pareto-front"), "computed.front").as_array()) {
    const SliderCrankMechanism m = slider_crank(point);
    const double limit = number_at(point, "stroke_full_turn_m"), start = number_at(point, "theta2_first_rad");
    double best = 1;
    for (SliderPathProjection* sense : {&projection, &other}) {
      sense->limit_stroke({0, limit});
      std::vector<double> r(sense->residuals());
      if (sense->evaluate(sense->unknowns(m.parameters, start), r, {}))
        best = std::min(best, test::sum_of_squares(r));
    }
    EXPECT_NEAR(best, number_at(point, "sse_m2"), 1e-9);
    ++clipped;
  }
  EXPECT_EQ(clipped, 30);
}

TEST(SliderPathProjection, BoundsOfTheLengthsAreKept) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.bounds[index(SP::crank)] = {0.1, 0.3};
  p.bounds[index(SP::rod)] = {0.4, 0.9};
  p.bounds[index(SP::offset)] = {-0.2, -0.05};
  SliderPathProjection projection(p, SliderSide::forward, 1);
  std::vector<double> r(projection.residuals());
  RandomStream stream({.seed = 3});
  int kept = 0, none = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto q = projection.random(stream);
    if (!projection.evaluate(q, r, {})) {
      ++none;
      continue;
    }
    const SliderCrankForm f = projection.recover(q).linkage.parameters;
    const double slack = 1e-14;
    EXPECT_TRUE(f.crank >= 0.1 - slack && f.crank <= 0.3 + slack);
    EXPECT_TRUE(f.rod >= 0.4 - slack && f.rod <= 0.9 + slack);
    EXPECT_TRUE(f.offset >= -0.2 - slack && f.offset <= -0.05 + slack);
    ++kept;
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(none, 100);
}

TEST(SliderPathProjection, UnknownsOfADesignGiveTheDesign) {
  with_random_unknowns(3, [](const ProjectionCase&, const SliderPathProblem& p,
                             SliderPathProjection& projection, const auto& q, const auto&) {
    const SliderPathDesign design = projection.design(p, q);
    const auto again =
        projection.unknowns(design.linkage.parameters, design.angles[0] - design.sense * p.angles[0]);
    const SliderPathDesign back = projection.design(p, again);
    if (!(design.error < 1e3)) return;
    EXPECT_TRUE(same_linkage(back.linkage, design.linkage));
  });
}

TEST(SliderPathProjection, AppliesWhenTheUnknownsAreFree) {
  SliderPathProblem p = printed_eighteen_slider_points();
  EXPECT_TRUE(SliderPathProjection::applies(p));
  const auto with = [&](std::initializer_list<SP> parameters, Range range) {
    SliderPathProblem out = p;
    for (SP j : parameters) out.bounds[index(j)] = range;
    return SliderPathProjection::applies(out);
  };
  const Range fixed{0.5, 0.5};
  for (SP j : {SP::rod, SP::offset, SP::point_distance, SP::point_angle, SP::pivot_x, SP::pivot_y})
    EXPECT_FALSE(with({j}, fixed)) << name(j);
  for (SP j : {SP::crank, SP::guide_angle, SP::start_angle}) EXPECT_TRUE(with({j}, fixed)) << name(j);
  EXPECT_TRUE(with({SP::pivot_x, SP::pivot_y}, fixed));
  EXPECT_FALSE(with({SP::guide_angle}, {0, 1}));
  p.timing = Timing::free;
  EXPECT_FALSE(SliderPathProjection::applies(p));
  EXPECT_THAT([&] { SliderPathProjection(p, SliderSide::forward, 1); },
              ThrowsMessage<ContractError>(HasSubstr("the unknowns of this problem are not free")));
  p.timing = Timing::increments;
  SliderPathProjection projection(p, SliderSide::forward, 1);
  EXPECT_THAT(
      [&] {
        projection.limit_stroke({2, 1});
      },
      ThrowsMessage<ContractError>(HasSubstr("the stroke is limited to 2 to 1")));
}

TEST(SliderPathProjection, AllocatesNothing) {
  SliderPathProjection projection(printed_eighteen_slider_points(), SliderSide::forward, 1);
  std::vector<double> r(projection.residuals()), j(3 * r.size());
  const std::vector<double> q = {0.1, 0.2, 0.3};
  projection.evaluate(q, r, j);
  const std::size_t before = linkwright::test::allocations();
  EXPECT_TRUE(projection.evaluate(q, r, j));
  projection.limit_stroke({0, 0.4});
  EXPECT_TRUE(projection.evaluate(q, r, j));
  EXPECT_EQ(linkwright::test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::planar
