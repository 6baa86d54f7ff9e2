// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "linkwright/core/check.h"
#include "planar/dyad_cases.h"
#include "support/allocations.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;
using linkwright::test::number_at;

double size_of(const GuidingDyad& dyad) { return 1 + std::abs(dyad.fixed) + std::abs(dyad.moving); }

TEST(SolveDyads, FindsTheDyadsOfTheStoredPosesAndNoOthers) {
  for (const char* id : {"MO-5-anchor", "MO-5-smooth-two-dyads", "MO-5-smooth-four-dyads",
                         "MO-5-no-real-dyad", "MO-5-slider-crank", "MO-5-inverted"}) {
    const std::vector<BodyPose> poses = stored_poses(id);
    const GuidingDyads dyads = solve_dyads(poses);
    const auto& listed = at(synthesis_case(id), "computed.dyads").as_array();
    EXPECT_EQ(dyads.status, Status::done) << id;
    EXPECT_EQ(dyads.solutions, 4) << id;
    ASSERT_EQ(dyads.real().size(), listed.size()) << id;
    for (const Value& value : listed) {
      // Printed with twelve digits, from poses that are printed with six or more.
      EXPECT_LT(nearest(dyads.real(), listed_dyad(value)).distance, 1e-8) << id;
    }
    for (const GuidingDyad& dyad : dyads.real()) EXPECT_LT(spread(dyad, poses), 1e-12 * size_of(dyad)) << id;
  }
}

TEST(SolveDyads, BurmesterPairsOfAKnownLinkage) {
  const Value& known = linkwright::test::published_case("path-synthesis.json", "MG-5-burmester");
  const std::vector<BodyPose> poses = poses_of(at(known, "inputs.poses"));
  const GuidingDyads dyads = solve_dyads(poses);
  const auto& listed = at(known, "computed.dyads").as_array();
  ASSERT_EQ(dyads.real().size(), listed.size());
  for (const Value& value : listed) {
    GuidingDyad wanted;
    wanted.fixed = complex_at(value, "fixed_pivot_m");
    wanted.moving = std::polar(1.0, -poses[0].angle) *
                    (complex_at(value, "moving_pivot_at_position_1_m") - poses[0].origin);
    wanted.length = number_at(value, "length_m");
    EXPECT_LT(nearest(dyads.real(), wanted).distance, 1e-8);
  }
}

TEST(SolveDyads, ThousandRandomSetsHaveAnEvenNumberOfDyadsThatHoldEveryPose) {
  std::map<int, int> sets;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const std::vector<BodyPose> poses = random_poses(5, i);
    const GuidingDyads dyads = solve_dyads(poses);
    EXPECT_EQ(dyads.solutions, 4) << i;
    EXPECT_EQ(dyads.count % 2, 0) << i;
    ++sets[dyads.count];
    for (const GuidingDyad& dyad : dyads.real())
      for (const BodyPose& pose : poses) EXPECT_LT(std::abs(gap(dyad, pose)), 1e-9 * size_of(dyad)) << i;
  }
  // 2000 sets of another generator: 9 %, 72 % and 18 %.
  EXPECT_NEAR(sets[0], 90, 40);
  EXPECT_NEAR(sets[2], 725, 60);
  EXPECT_NEAR(sets[4], 185, 50);
}

TEST(SolveDyads, DoNotDependOnPlaceTurnScaleOrOrder) {
  const Complex turn = std::polar(1.0, 0.7), shift(300, -120);
  const double scale = 1e-3;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const std::vector<BodyPose> poses = random_poses(5, i);
    const GuidingDyads dyads = solve_dyads(poses);
    std::vector<BodyPose> moved;
    for (const std::size_t j : {3, 0, 4, 2, 1})
      moved.push_back({scale * turn * (poses[j].origin + shift), poses[j].angle + 0.7});
    const GuidingDyads again = solve_dyads(moved);
    ASSERT_EQ(dyads.count, again.count) << i;
    for (const GuidingDyad& dyad : dyads.real()) {
      ASSERT_EQ(dyad.type, GuidingDyadType::rr);
      GuidingDyad back = dyad;
      double least = infinity;
      for (const GuidingDyad& other : again.real()) {
        back.fixed = other.fixed / (scale * turn) - shift;
        back.moving = other.moving / scale;
        back.length = other.length / scale;
        least = std::min(least, apart(dyad, back));
      }
      // The shift takes three digits; a distant pivot stands on the difference of nearly equal poses.
      EXPECT_LT(least, 1e-8 * size_of(dyad)) << i;
    }
  }
}

// The solutions in each row of the table of prescriptions, over 300 cases.
struct Counts {
  std::map<int, int> links;  // number of RR dyads: cases
  int others = 0;            // dyads of another type
};
template <class Prescribe>
Counts counts_of(int poses, Prescribe prescribe, std::uint32_t row) {
  Counts out;
  for (std::uint32_t i = 0; i < 300; ++i) {
    RandomStream random({.seed = row, .individual = i});
    const auto number = [&] {
      const double x = random.normal();
      return Complex(x, random.normal());
    };
    const std::vector<BodyPose> given = random_poses(poses, 1000 * row + i);
    const Prescription prescription = prescribe(number);
    const GuidingDyads dyads = solve_dyads(given, prescription);
    int links = 0;
    for (const GuidingDyad& dyad : dyads.real()) {
      dyad.type == GuidingDyadType::rr ? ++links : ++out.others;
      EXPECT_LT(spread(dyad, given), 1e-9 * size_of(dyad));
      const auto off = [](const PivotLine& line, Complex point) {
        return std::abs(std::imag(std::conj(line.direction) * (point - line.point))) /
               std::abs(line.direction);
      };
      if (prescription.fixed) {
        EXPECT_LT(std::abs(dyad.fixed - *prescription.fixed), 1e-9 * size_of(dyad));
      }
      if (prescription.moving) {
        EXPECT_LT(std::abs(dyad.moving - *prescription.moving), 1e-9 * size_of(dyad));
      }
      if (prescription.fixed_line) {
        EXPECT_LT(off(*prescription.fixed_line, dyad.fixed), 1e-9 * size_of(dyad));
      }
      if (prescription.moving_line) {
        EXPECT_LT(off(*prescription.moving_line, dyad.moving), 1e-9 * size_of(dyad));
      }
    }
    ++out.links[links];
  }
  return out;
}

TEST(SolveDyads, PivotsOnLinesLeaveOneOrThreeLinks) {
  for (const bool fixed : {true, false}) {
    const Counts counts = counts_of(
        4,
        [&](auto number) {
          Prescription p;
          const PivotLine line{number(), number()};
          (fixed ? p.fixed_line : p.moving_line) = line;
          return p;
        },
        fixed ? 1 : 2);
    EXPECT_EQ(counts.links.size(), 2u);
    EXPECT_EQ(counts.links.at(1) + counts.links.at(3), 300);
    EXPECT_EQ(counts.others, 0);
  }
}

TEST(SolveDyads, BothPivotsOnLinesLeaveNoneOrTwoLinks) {
  const Counts counts = counts_of(
      3,
      [](auto number) {
        return Prescription{{}, {}, PivotLine{number(), number()}, PivotLine{number(), number()}};
      },
      3);
  EXPECT_EQ(counts.links.size(), 2u);
  EXPECT_EQ(counts.links.at(0) + counts.links.at(2), 300);
  EXPECT_EQ(counts.others, 0);
}

TEST(SolveDyads, AGivenPivotLeavesOneLink) {
  const auto one = [](const Counts& counts) {
    EXPECT_EQ(counts.links.at(1), 300);
    EXPECT_EQ(counts.others, 0);
  };
  one(counts_of(
      3,
      [](auto number) {
        return Prescription{number(), {}, {}, {}};
      },
      4));
  one(counts_of(
      3,
      [](auto number) {
        return Prescription{{}, number(), {}, {}};
      },
      5));
  one(counts_of(
      2,
      [](auto number) {
        return Prescription{number(), {}, {}, PivotLine{number(), number()}};
      },
      6));
  one(counts_of(
      2,
      [](auto number) {
        return Prescription{{}, number(), PivotLine{number(), number()}, {}};
      },
      7));
}

TEST(SolveDyads, AGivenMovingPivotTurnsAboutTheCircumcentre) {
  const Value& known = linkwright::test::published_case("path-synthesis.json", "MG-3-circle-centres");
  const std::vector<BodyPose> poses = poses_of(at(known, "inputs.poses"));
  const auto& points = at(known, "inputs.moving_points_at_position_1_m").as_array();
  const auto& pivots = at(known, "computed.fixed_pivots_m").as_array();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto complex = [](const Value& v) {
      return Complex(v.as_array()[0].as_number(), v.as_array()[1].as_number());
    };
    Prescription p;
    p.moving = std::polar(1.0, -poses[0].angle) * (complex(points[k]) - poses[0].origin);
    const GuidingDyads dyads = solve_dyads(poses, p);
    ASSERT_EQ(dyads.count, 1);
    EXPECT_LT(std::abs(dyads.found[0].fixed - complex(pivots[k])), 1e-8);
  }
}

TEST(SolveDyads, FourPosesHaveOneSlideOfEachKind) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::vector<BodyPose> poses = random_poses(4, i);
    for (const GuidingDyadType type : {GuidingDyadType::pr, GuidingDyadType::rp}) {
      const std::optional<GuidingDyad> dyad = slide_dyad(poses, type);
      ASSERT_TRUE(dyad) << i;
      EXPECT_EQ(dyad->type, type) << i;
      EXPECT_LT(spread(*dyad, poses), 1e-9 * size_of(*dyad)) << i;
    }
  }
}

TEST(SolveDyads, SayWhenPosesDependOnEachOther) {
  std::vector<BodyPose> poses = random_poses(5, 1);
  poses[3] = poses[1];
  EXPECT_EQ(solve_dyads(poses).status, Status::singular);
  poses = random_poses(5, 1);
  for (BodyPose& pose : poses) pose.angle = 0.3;
  EXPECT_EQ(solve_dyads(poses).status, Status::singular);
  EXPECT_THROW((void)solve_dyads(random_poses(4, 1)), ContractError);
}

TEST(SolveDyads, TwoPosesMayDifferByATranslationOrAHalfTurn) {
  std::vector<BodyPose> poses = random_poses(5, 9);
  poses[2].angle = poses[0].angle;
  poses[4].angle = poses[1].angle + pi;
  const GuidingDyads dyads = solve_dyads(poses);
  EXPECT_EQ(dyads.status, Status::done);
  EXPECT_EQ(dyads.count % 2, 0);
  for (const GuidingDyad& dyad : dyads.real()) EXPECT_LT(spread(dyad, poses), 1e-9 * size_of(dyad));
}

TEST(SolveDyads, AllocateNothing) {
  const std::vector<BodyPose> poses = random_poses(5, 2);
  const std::size_t before = linkwright::test::allocations();
  const GuidingDyads dyads = solve_dyads(poses);
  EXPECT_EQ(linkwright::test::allocations(), before);
  EXPECT_EQ(dyads.solutions, 4);
}

// Points with crank angles: the crank is a body that holds its angle on a dyad, and with its rotation at each
// point the coupler is another one (exact synthesis of timed paths).
TEST(SolveDyads, GiveTheTwelveLinkagesThroughFiveTimedPoints) {
  const Value& stored = synthesis_case("TP-5-anchor");
  const std::vector<double> angles = linkwright::test::numbers(at(stored, "inputs.crank_angles_rad"));
  std::vector<BodyPose> cranks;
  for (const Value& p : at(stored, "inputs.points_m").as_array())
    cranks.push_back({{p.as_array()[0].as_number(), p.as_array()[1].as_number()}, angles[cranks.size()]});
  struct Timed {
    Complex pivot, crank;
    GuidingDyad other;
  };
  std::vector<Timed> found;
  const GuidingDyads crank_dyads = solve_dyads(cranks);
  for (const GuidingDyad& crank : crank_dyads.real()) {
    const Complex vector = -crank.moving;
    std::vector<BodyPose> coupler;
    for (const BodyPose& pose : cranks)
      coupler.push_back(
          {pose.origin, std::arg(pose.origin - crank.fixed - vector * std::polar(1.0, pose.angle))});
    const GuidingDyads coupler_dyads = solve_dyads(coupler);
    for (const GuidingDyad& other : coupler_dyads.real())
      if (std::abs(other.fixed - crank.fixed) > 1e-6) found.push_back({crank.fixed, vector, other});
  }
  const auto& listed = at(stored, "computed.designs").as_array();
  ASSERT_EQ(listed.size(), 12u);
  EXPECT_EQ(found.size(), 12u);
  for (const Value& value : listed) {
    double least = infinity;
    for (const Timed& t : found)
      least = std::min(least, std::abs(t.pivot - complex_at(value, "crank_pivot_m")) +
                                  std::abs(t.crank - complex_at(value, "crank_vector_at_angle_0_m")) +
                                  apart(t.other, listed_dyad(at(value, "other"))));
    // The points are printed with twelve digits.
    EXPECT_LT(least, 1e-8);
  }
}

// Poses of the anchor's coupler, between and beyond its five.
std::vector<BodyPose> coupler_poses(int count, double noise) {
  RandomStream random({.seed = 3});
  std::vector<BodyPose> out;
  for (int k = 0; k < count; ++k) {
    const Complex a = std::polar(0.42388, 0.3 + 0.25 * k), b0 = 1.05394;
    const double l3 = 0.91424, l4 = 0.59892, r = std::abs(b0 - a);
    const double c = (l3 * l3 + r * r - l4 * l4) / (2 * l3 * r);
    const double angle = std::arg((b0 - a) * Complex(c, std::sqrt(1 - c * c)));
    const double x = noise * random.normal(), y = noise * random.normal();
    out.push_back({a + Complex(x, y), angle + noise * random.normal()});
  }
  return out;
}

TEST(FitDyads, FindTheLinkageOfManyPoses) {
  const std::vector<BodyPose> poses = coupler_poses(12, 0);
  const DyadFit fit = fit_dyads(poses);
  ASSERT_GE(fit.dyads.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(spread(fit.dyads[k], poses), 1e-9);
  const GuidingDyad crank{GuidingDyadType::rr, 0, 0, 0.42388, 0, 0},
      rocker{GuidingDyadType::rr, 1.05394, 0.91424, 0.59892, 0, 0};
  EXPECT_LT(nearest(fit.dyads, crank).distance, 1e-9);
  EXPECT_LT(nearest(fit.dyads, rocker).distance, 1e-9);
  EXPECT_LT(fit.misfit[6], 1e-12);
  EXPECT_GT(fit.misfit[5], 1e-6);
}

TEST(FitDyads, ComeNearIt) {
  const std::vector<BodyPose> poses = coupler_poses(12, 1e-3);
  const DyadFit fit = fit_dyads(poses);
  const GuidingDyad crank{GuidingDyadType::rr, 0, 0, 0.42388, 0, 0},
      rocker{GuidingDyadType::rr, 1.05394, 0.91424, 0.59892, 0, 0};
  EXPECT_LT(nearest(fit.dyads, crank).distance, 0.03);
  EXPECT_LT(nearest(fit.dyads, rocker).distance, 0.03);
}

}  // namespace
}  // namespace linkwright::planar
