// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/assembly.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>

#include "linkwright/core/numbers.h"
#include "planar/linkage_sweeps.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// Random linkages, swept beyond the range of their drawing in a shuffled order: LINKWRIGHT_SWEEPS=100000 (and
// LINKWRIGHT_FIRST_SWEEP) in the environment makes it many.
TEST(LinkageAssembly, StaysOnTheModeOfTheDrawing) {
  const char* many = std::getenv("LINKWRIGHT_SWEEPS");
  const char* begin = std::getenv("LINKWRIGHT_FIRST_SWEEP");
  const long count = many ? std::atol(many) : 300, first = begin ? std::atol(begin) : 0;
  SweepFindings found;
  for (long i = first; i < first + count; ++i) {
    RandomStream random({.seed = 4711, .run = static_cast<std::uint32_t>(i)});
    const auto kind = static_cast<SweptKind>(i % swept_kinds);
    compare_sweep(swept_linkage(kind, random), static_cast<std::uint64_t>(i), i % 50 < 5 ? 10 : 0, found);
  }
  if (many)
    std::printf(
        "%ld sweeps, %ld rows, %ld without a place, %ld at dead points; on another mode %ld, missing %ld, "
        "invented %ld; curves lost %ld\n",
        found.sweeps, found.rows, found.beyond, found.singular, found.other_mode, found.missing,
        found.invented, found.lost);
  EXPECT_EQ(found.other_mode, 0) << found.faults;
  EXPECT_EQ(found.missing, 0) << found.faults;
  EXPECT_EQ(found.invented, 0) << found.faults;
  EXPECT_EQ(found.lost, 0) << found.faults;
  EXPECT_GT(found.beyond, found.rows / 10);
  EXPECT_GT(found.rows - found.beyond, found.rows / 10);
}

// Two dead points side by side, less than a step apart: the input goes back by a hundredth of a degree
// between them, and beyond both the curve goes on as before. The mode ends at the first.
TEST(LinkageAssembly, DoesNotLeapOverTwoDeadPointsSideBySide) {
  const long number = 3430;
  RandomStream random({.seed = 4711, .run = static_cast<std::uint32_t>(number)});
  const SweptLinkage s = swept_linkage(static_cast<SweptKind>(number % swept_kinds), random);
  const LinkagePlan p = planned(s.linkage);
  const LinkageAssembly assembly(p, {{s.from}, {s.to}});
  ASSERT_TRUE(assembly.limits());
  const InputRange& range = assembly.limits()->ranges.at(0);
  PlainFollower follower(p);
  ASSERT_TRUE(follower.solve(0));
  const double reached = follower.go(0, s.from, 0.01);
  EXPECT_GT(reached, s.from + 0.1);
  EXPECT_EQ(range.from.kind, EndKind::limit);
  EXPECT_NEAR(range.from.value, reached, 1e-8);
}

// A bicycle's rear linkage driven by its shock, drawn: at the input of the drawing it stands as drawn.
Linkage rear_linkage() {
  Linkage l = grounded({{"main pivot", {0, 0}}, {"rocker pivot", {0.02, 0.28}}});
  add_drawn(l, "chainstay",
            {{"main", {0, 0}}, {"link", {-0.05, 0.06}}, {"axle", {-0.43, 0.02}}, {"shock", {0.03, 0.09}}});
  add_drawn(l, "link", {{"lower", {-0.05, 0.06}}, {"upper", {-0.06, 0.25}}});
  add_drawn(l, "rocker", {{"pivot", {0.02, 0.28}}, {"link", {-0.06, 0.25}}, {"shock", {0.10, 0.27}}});
  add_drawn(l, "body", {{"eye", {0.03, 0.09}}});
  add_drawn(l, "shaft", {{"eye", {0.10, 0.27}}});
  add_pin(l, "main pivot", "ground.main pivot", "chainstay.main");
  add_pin(l, "lower", "chainstay.link", "link.lower");
  add_pin(l, "upper", "link.upper", "rocker.link");
  add_pin(l, "rocker pivot", "ground.rocker pivot", "rocker.pivot");
  add_pin(l, "lower eye", "chainstay.shock", "body.eye");
  add_pin(l, "upper eye", "rocker.shock", "shaft.eye");
  const double along = std::arg(std::complex<double>(0.07, 0.18));
  add_slide(l, "shock", "body.eye", "shaft.eye", along, along);
  add_drive(l, "shock");
  return l;
}

TEST(LinkageAssembly, StandsAsDrawnAtTheInputOfTheDrawing) {
  const Linkage l = rear_linkage();
  const LinkagePlan p = planned(l);
  ASSERT_FALSE(p.closed_form());
  const double drawn = std::hypot(0.07, 0.18);
  ASSERT_EQ(p.drawn_inputs.size(), 1u);
  EXPECT_NEAR(p.drawn_inputs[0], drawn, 1e-15);
  // The same for any range that is swept, and any start.
  for (const double from : {0.0, 0.15, 0.25, 0.5}) {
    LinkageAssembly assembly(p, {{std::min(from, drawn)}, {std::max(from, drawn)}});
    LinkageMotion m(p);
    assembly.place(std::vector<InputMotion>{{from, 1, 0}}, m);
    assembly.place(std::vector<InputMotion>{{drawn, 1, 0}}, m);
    ASSERT_EQ(m.status, Status::done);
    for (std::size_t k = 1; k < m.parts.size(); ++k) {
      EXPECT_LE(norm(m.parts[k].origin), 1e-12);
      EXPECT_NEAR(angle_of(m.parts[k].direction), 0, 1e-12);
    }
  }
}

TEST(LinkageAssembly, TellsTheRangeAndTheGapBeyondIt) {
  const Linkage l = rear_linkage();
  const LinkagePlan p = planned(l);
  LinkageAssembly assembly(p, {{0.0}, {0.5}});
  ASSERT_TRUE(assembly.limits());
  const InputRange& range = assembly.limits()->ranges.at(0);
  EXPECT_EQ(range.from.kind, EndKind::limit);
  EXPECT_EQ(range.to.kind, EndKind::limit);
  LinkageMotion m(p);
  for (const double inside : {1e-9, -1e-9}) {
    const double value = (inside > 0 ? range.from.value : range.to.value) + inside;
    assembly.place(std::vector<InputMotion>{{value, 1, 0}}, m);
    EXPECT_EQ(m.status, Status::done) << value;
    assembly.place(std::vector<InputMotion>{{value - 2 * inside, 1, 0}}, m);
    EXPECT_EQ(m.status, Status::no_assembly) << value;
    EXPECT_EQ(m.failed_group, 0);
  }
  assembly.place(std::vector<InputMotion>{{range.to.value + 0.01, 1, 0}}, m);
  EXPECT_GT(m.gap, 1e-4);
  EXPECT_LT(m.gap, 0.01);
}

// Two inputs: a five-bar whose coupler point carries a triad has its places from the drawing, in any order.
TEST(LinkageAssembly, SeveralInputsAreReachedFromTheDrawing) {
  Linkage l = grounded({{"O", {0, 0}}, {"G", {1.2, -0.2}}, {"H", {0.4, 1.1}}});
  add_drawn(l, "crank", {{"O", {0, 0}}, {"A", {0.2, 0}}});
  add_drawn(l, "barrel", {{"A", {0.2, 0}}});
  add_drawn(l, "rod", {{"P", {0.5, 0.3}}});
  add_drawn(l, "plate", {{"P", {0.5, 0.3}}, {"Q", {1.0, 0.25}}, {"R", {0.8, 0.6}}});
  add_drawn(l, "leg2", {{"G", {1.2, -0.2}}, {"Q", {1.0, 0.25}}});
  add_drawn(l, "leg3", {{"H", {0.4, 1.1}}, {"R", {0.8, 0.6}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "barrel.A");
  add_slide(l, "slide", "barrel.A", "rod.P", pi / 4, pi / 4);
  add_pin(l, "P", "rod.P", "plate.P");
  add_pin(l, "Q", "plate.Q", "leg2.Q");
  add_pin(l, "R", "plate.R", "leg3.R");
  add_pin(l, "G", "ground.G", "leg2.G");
  add_pin(l, "H", "ground.H", "leg3.H");
  add_drive(l, "O");
  add_drive(l, "slide");
  const LinkagePlan p = planned(l);
  const double length = 0.3 * std::sqrt(2.0);
  const InputReach reach{{-0.1, length - 0.02}, {0.1, length + 0.02}};
  LinkageAssembly one(p, reach), other(p, reach);
  LinkageMotion m(p), n(p);
  std::vector<std::vector<PartState<double>>> places;
  std::vector<std::vector<InputMotion>> rows;
  for (int i = -2; i <= 0; ++i)
    for (int k = -2; k <= 0; ++k) rows.push_back({{0.05 * i, 0, 0}, {length + 0.01 * k, 0, 0}});
  for (const auto& row : rows) {
    one.place(row, m);
    ASSERT_EQ(m.status, Status::done);
    places.push_back(m.parts);
  }
  for (std::size_t r = rows.size(); r-- > 0;) {
    other.place(rows[r], n);
    ASSERT_EQ(n.status, Status::done);
    EXPECT_LE(apart(n.parts, places[r], p.size), 1e-12);
  }
  EXPECT_LE(norm(places.back()[3].origin), 1e-12);  // the drawing
  // On the other side the mode ends at a fifth of the way, as Newton's method in the angles of barrel and
  // plate has it.
  one.place(std::vector<InputMotion>{{0.1, 0, 0}, {length + 0.02, 0, 0}}, m);
  EXPECT_EQ(m.status, Status::no_assembly);
}

// Crank and rocker of 0.25 m, coupler of 0.1 m, ground of 0.2 m: crank and coupler are in line where the
// cosine of the crank angle is (0.25^2 + 0.2^2 - (0.25 -+ 0.1)^2) / (2 0.25 0.2), that is 0.8 and -0.2.
TEST(AssembledRange, EndsAtTheDeadPoints) {
  const LinkagePlan p = planned(linkage_sample("chebyshev").linkage);
  const auto range = assembled_range(p, -full_turn, full_turn);
  ASSERT_TRUE(range);
  EXPECT_FALSE(range->full_turn);
  EXPECT_EQ(range->from.kind, EndKind::limit);
  EXPECT_EQ(range->to.kind, EndKind::limit);
  // An angle near a dead point is known to the root of the rounding of the lengths.
  EXPECT_NEAR(range->from.value, std::acos(0.8), 1e-7);
  EXPECT_NEAR(range->to.value, std::acos(-0.2), 1e-7);
  // The range of a pin whose linkage turns with it is whole, whatever is asked for.
  const auto narrow = assembled_range(p, 0, 1);
  ASSERT_TRUE(narrow);
  EXPECT_NEAR(narrow->to.value, std::acos(-0.2), 1e-7);
}

TEST(AssembledRange, IsATurnOfAnInputThatRotatesFully) {
  const auto range = assembled_range(planned(linkage_sample("hoeken").linkage), -full_turn, full_turn);
  ASSERT_TRUE(range);
  EXPECT_TRUE(range->full_turn);
  EXPECT_EQ(range->from.value, 0);
  EXPECT_EQ(range->to.value, full_turn);
  const auto triad = assembled_range(planned(linkage_sample("triad").linkage), -full_turn, full_turn);
  ASSERT_TRUE(triad);
  EXPECT_EQ(triad->full_turn, triad->to.value - triad->from.value == full_turn);
}

TEST(AssembledRange, DoesNotExistWhereNothingAssembles) {
  EXPECT_FALSE(assembled_range(planned(four_bar_linkage(4, 1, 1, 1)), -full_turn, full_turn));
  const LinkagePlan arm = planned(linkage_sample("arm").linkage);
  EXPECT_THROW(assembled_range(arm, -1, 1), ContractError);
  EXPECT_THROW(assembled_range(planned(four_bar_linkage(4, 2, 4, 3)), 1, 1), ContractError);
}

// Random linkages, with and without closed forms: each place within the range assembles, none right beyond a
// limit.
TEST(AssembledRange, HoldsWhatAssemblesOfRandomLinkages) {
  int limits = 0, general = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    RandomStream random({.seed = 815, .run = i});
    const SweptLinkage s = swept_linkage(static_cast<SweptKind>(i % swept_kinds), random);
    const LinkagePlan p = planned(s.linkage);
    const auto range = assembled_range(p, s.from, s.to);
    ASSERT_TRUE(range);
    general += !p.closed_form();
    LinkageAssembly assembly(p, {{range->from.value - 0.1}, {range->to.value + 0.1}});
    LinkageMotion motion(p);
    const auto status_at = [&](double value) {
      assembly.place(std::vector<InputMotion>{{value, 0, 0}}, motion);
      return motion.status;
    };
    const double width = range->to.value - range->from.value;
    for (int k = 0; k <= 50; ++k)
      EXPECT_EQ(status_at(range->from.value + width * (1e-6 + (1 - 2e-6) * k / 50)), Status::done) << k;
    for (const RangeEnd* end : {&range->from, &range->to})
      if (end->kind == EndKind::limit) {
        ++limits;
        EXPECT_NE(status_at(end->value + (end == &range->from ? -1e-6 : 1e-6)), Status::done) << end->value;
      }
  }
  EXPECT_GT(limits, 20);
  EXPECT_GT(general, 20);
}

}  // namespace
}  // namespace linkwright::planar
