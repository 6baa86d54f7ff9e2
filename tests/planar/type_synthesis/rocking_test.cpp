// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/type_synthesis/atlas.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/layouts.h"
#include "linkwright/planar/type_synthesis/place.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"
#include "support/memory_checkpoint.h"

// Machines whose drive rocks over the part of its rotation that an open stroke takes.
namespace linkwright::planar {
namespace {

MotionTarget rocking(const Stroke& stroke) {
  MotionTarget target(sampled_stroke(stroke));
  let_drive_rock(target);
  return target;
}
MotionTarget rocking(const char* stroke) { return rocking(test::stroke_of(test::stroke_case(stroke))); }

TypeSearchAnswer search(const MotionTarget& target, const TypeSearchOptions& options, int threads = 1) {
  RunContext context;
  context.set_threads(threads);
  return search_types(target, options, context);
}

std::vector<double> angles_of(const CrankPart& part, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(part.from + part.range * k / (count - 1));
  return out;
}

/// Least quality of a shape at crank angles.
double least_quality(const MachineShape& shape, std::vector<double> angles) {
  angles.resize((angles.size() + 7) / 8 * 8, angles.back());
  std::vector<double> quality(angles.size()), worst(angles.size());
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angles.data(),
                 .count = angles.size(),
                 .quality = quality.data(),
                 .worst = worst.data()});
  return *std::min_element(quality.begin(), quality.end());
}

TEST(RockingDrives, AreForOpenStrokes) {
  MotionTarget closed(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  EXPECT_THROW(let_drive_rock(closed), ContractError);
  const MotionTarget open = rocking("step");
  EXPECT_FALSE(open.turns);
  // A degree more at both ends, in either sense.
  std::vector<double> sampled(stroke_samples), out(5);
  for (std::size_t k = 0; k < sampled.size(); ++k) sampled[k] = 1 - 0.01 * static_cast<double>(k);
  open.cover_used_part(sampled, out);
  EXPECT_NEAR(out[0], 1 + pi / 180, 1e-12);
  EXPECT_NEAR(out[2], 1 - 0.475, 1e-12);
  EXPECT_NEAR(out[4], 0.05 - pi / 180, 1e-12);
}

// Every type assembles over the part that it was drawn for, and some shapes do not turn.
TEST(RockingDrives, HaveShapesOfTheirOwn) {
  for (const PointProgram* p : test::all_programs()) {
    if (p->links > 6 && p->pairs.back()[0] != 1) continue;
    int drawn = 0, turning = 0;
    for (std::uint32_t k = 0; k < 4000 && drawn < 20; ++k) {
      RandomStream random({.seed = 3, .individual = k});
      const CrankPart part{.from = p->group < 0 ? 2.0 : -0.8, .range = 1.5, .rocks = true};
      MachineShape shape{.program = p};
      if (!draw_shape(shape, 0, random, part)) continue;
      ++drawn;
      EXPECT_GT(least_quality(shape, angles_of(part, 64)), 0.01) << p->name;
      if (least_quality(shape, angles_of({0, 2 * pi}, 360)) > 0) ++turning;
    }
    EXPECT_EQ(drawn, 20) << p->name;
    EXPECT_LT(turning, 19) << p->name;
  }
}

TEST(RockingDrives, AreBroughtOntoPartsOfTheirCurves) {
  RunContext context;
  const auto atlas = rocking_atlas(MachineFamily::four_bar, context);
  ASSERT_GT(atlas->entries.size(), 500U);
  int placed = 0;
  for (std::size_t i = 0; i < atlas->entries.size(); i += 97) {
    const CrankPart part = *atlas->part(i);
    const CrankPart inner{part.from + 0.2 * part.range, 0.55 * part.range};
    const MotionTarget target =
        rocking(Stroke{.points = test::traced(atlas->shape(i), angles_of(inner, 90))});
    for (const bool mirrored_part : {false, true}) {
      FittedMachine m{.shape = atlas->shape(i)};
      CrankPart given = part;
      if (mirrored_part) given = {part.from + part.range, -part.range};
      const double left = place_on(target, m, given);
      EXPECT_LT(left, 0.02) << i;
      if (left < 2e-4) ++placed;
      for (const double angle : m.angle) {
        EXPECT_GE(angle, part.from - 1e-9);
        EXPECT_LE(angle, part.from + part.range + 1e-9);
      }
      EXPECT_GT(m.sense * (m.angle.back() - m.angle.front()), 0);
    }
  }
  EXPECT_GT(placed, 12);
}

/// A four-bar that cannot turn by Grashof's rule, with pair angles of 23 degrees over a part of its rotation.
MachineShape some_rocker(std::uint32_t number, CrankPart& part) {
  for (std::uint32_t k = 0; k < 100'000; ++k) {
    RandomStream random({.seed = 41, .generation = number, .individual = k});
    part = {.from = random.uniform(0, 2 * pi), .range = random.uniform(0.8, 2.2), .rocks = true};
    MachineShape shape{.program = program_named("four_bar")};
    if (!draw_shape(shape, 0, random, part)) continue;
    std::vector<double> lengths{1, std::abs(shape.x[0]), shape.x[1], shape.x[2]};
    std::sort(lengths.begin(), lengths.end());
    if (!(lengths[0] + lengths[3] > 1.02 * (lengths[1] + lengths[2]))) continue;
    const CrankPart wider{part.from - 0.02, part.range + 0.04};
    const double sine = std::sin(23 * pi / 180);
    if (least_quality(shape, angles_of(wider, 200)) < sine * sine) continue;
    const Stroke stroke{.points = test::traced(shape, angles_of(part, 120))};
    const double size = sampled_stroke(stroke).size;
    // Lengths within the limits of the search, and a path that is no arc about a pivot.
    const double plate = lengths[0] * std::abs(std::complex<double>(shape.x[3], shape.x[4]));
    if (lengths[3] < 8 * size && lengths[0] > 0.06 * size && plate > 0.2 * size && plate < 6 * size)
      return shape;
  }
  ADD_FAILURE() << "no four-bar";
  return {};
}

TEST(RockingDrives, FindFourBarsThatDoNotTurnByTheirOwnCurves) {
  constexpr int count = 12;
  int found = 0, better = 0;
  for (std::uint32_t number = 0; number < count; ++number) {
    CrankPart part;
    const MachineShape shape = some_rocker(number, part);
    const Stroke stroke{.points = test::traced(shape, angles_of(part, 120))};
    const TypeSearchOptions options{.families = {MachineFamily::four_bar}, .max_curves = 100'000};
    const double error = search(rocking(stroke), options).families[0].error;
    if (error < 5e-4) ++found;
    if (error <= 1.02 * search(sampled_stroke(stroke), options).families[0].error + 1e-5) ++better;
  }
  EXPECT_GE(found, 11);
  EXPECT_GE(better, 11);
}

// Machines that turn may rock: a drive that rocks is not far behind at the same effort.
TEST(RockingDrives, AreAsGoodAsDrivesThatTurn) {
  for (const char* name : {"letter_s", "letter_u", "step"})
    for (const MachineFamily family :
         {MachineFamily::four_bar, MachineFamily::slider_crank, MachineFamily::inverted_slider}) {
      const TypeSearchOptions options{.families = {family}, .max_curves = 80'000};
      const MotionTarget target = rocking(name);
      const double rocks = search(target, options).families[0].error;
      EXPECT_LT(rocks, 1.05 * search(target.stroke, options).families[0].error + 1e-4)
          << name << ", " << name_of(family);
    }
}

TEST(RockingDrives, GiveTheSameBitsOnEveryNumberOfThreads) {
  const TypeSearchOptions options{.max_links = 8, .max_curves = 60'000};
  const MotionTarget target = rocking("letter_u");
  const auto one = search(target, options, 1), two = search(target, options, 2);
  ASSERT_EQ(one.machines.size(), two.machines.size());
  ASSERT_FALSE(one.machines.empty());
  EXPECT_EQ(one.curves, two.curves);
  for (std::size_t i = 0; i < one.machines.size(); ++i) {
    EXPECT_EQ(one.machines[i].machine.shape.x, two.machines[i].machine.shape.x);
    EXPECT_EQ(one.machines[i].measures.error, two.machines[i].measures.error);
  }
}

// A search that was stopped and goes on ends with the bits of one that was not, and not as one whose drives
// turn.
TEST(RockingDrives, ContinueFromACheckpoint) {
  const TypeSearchOptions options{.max_links = 6, .max_curves = 100'000};
  const MotionTarget target = rocking("step");
  const auto whole = search(target, options);
  linkwright::test::MemoryCheckpoint kept;
  RunContext stopped;
  stopped.set_checkpoint(&kept);
  int saves = 0;
  kept.kept = [&](std::string_view) {
    if (++saves == 4) stopped.cancel();
  };
  EXPECT_EQ(search_types(target, options, stopped).status, Status::cancelled);
  kept.kept = nullptr;
  RunContext turning;
  turning.set_checkpoint(&kept);
  EXPECT_THROW(search_types(target.stroke, options, turning), CheckpointError);
  RunContext resumed;
  resumed.set_checkpoint(&kept);
  const auto again = search_types(target, options, resumed);
  EXPECT_EQ(again.curves, whole.curves);
  ASSERT_EQ(again.machines.size(), whole.machines.size());
  for (std::size_t i = 0; i < whole.machines.size(); ++i)
    EXPECT_EQ(again.machines[i].machine.shape.x, whole.machines[i].machine.shape.x);
}

/// The machine by the solver of any linkage over the range of its drive.
void expect_as_told(const FoundMachine& answer, const MotionTarget& target) {
  const FittedMachine& m = answer.machine;
  const SampledStroke& stroke = target.stroke;
  const FoundLinkage found = found_linkage(m, stroke);
  const PlanResult planned = plan_linkage(found.linkage);
  ASSERT_TRUE(planned.problems.empty());
  LinkageMotion moving(planned.plan);
  const BodyPoint point = point_named(found.linkage, found.traced);
  const auto& local = found.linkage.bodies[static_cast<std::size_t>(point.body)]
                          .points[static_cast<std::size_t>(point.point)]
                          .at;
  double largest = 0, squares = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double before = m.angle[k > 0 ? k - 1 : 0];
    const int steps = 1 + static_cast<int>(std::abs(m.angle[k] - before) / (pi / 180));
    for (int i = 1; i <= steps; ++i) {
      const InputMotion input{before + (m.angle[k] - before) * i / steps + found.crank_angle, 0, 0};
      solve_position(planned.plan, std::span(&input, 1), moving);
      ASSERT_EQ(moving.status, Status::done);
    }
    const PartState<double> body = body_state(planned.plan, moving, point.body);
    const std::complex<double> at = std::complex<double>(body.origin.x, body.origin.y) +
                                    std::complex<double>(body.direction.x, body.direction.y) * local;
    const double apart =
        std::abs((at - stroke.centre) / stroke.size - std::complex(target.x[k], target.y[k]));
    largest = std::max(largest, apart), squares += apart * apart;
  }
  EXPECT_NEAR(largest, answer.measures.largest_deviation, 1e-6);
  EXPECT_NEAR(std::sqrt(squares / stroke_samples), answer.measures.distance, 1e-6);
  EXPECT_NEAR(answer.measures.span, std::abs(m.angle.back() - m.angle.front()), 1e-12);
  if (m.shape.program->group >= 0) return;  // the measure of a group of four links is one of its own
  std::vector<double> ends(2);
  target.cover_used_part(m.angle, ends);
  const double low = std::min(ends[0], ends[1]) + found.crank_angle,
               high = std::max(ends[0], ends[1]) + found.crank_angle;
  const std::vector<double> inputs{low};
  double least = pi / 2;
  for (const TransmissionRange& range :
       transmission_ranges(planned.plan, inputs, 0, low, high, 361, moving)) {
    EXPECT_EQ(range.missing, 0U);
    least = std::min(least, range.minimum);
  }
  // Beside the pair angle, a sleeve keeps the crank pin away from itself.
  if (m.shape.program->family != MachineFamily::inverted_slider) {
    EXPECT_NEAR(least, answer.measures.min_pair_angle, 0.1 * pi / 180);
  }
  EXPECT_GE(least, answer.measures.min_pair_angle - 0.1 * pi / 180);
}

TEST(RockingDrives, AreAsToldWhenTheyAreAnalysedAgain) {
  std::set<MachineFamily> families;
  int machines = 0, unable = 0;
  for (const char* name : {"letter_s", "letter_u", "step"}) {
    const MotionTarget target = rocking(name);
    for (const auto& family : names(MachineFamily{})) {
      if (programs_of(family.value).empty()) continue;
      const auto answer = search(target, {.families = {family.value}, .max_curves = 40'000});
      for (const FoundMachine& found : answer.machines) {
        SCOPED_TRACE(std::string(name) + ", " + found.machine.shape.program->name);
        expect_as_told(found, target);
        families.insert(found.machine.shape.program->family), ++machines;
        if (!(least_quality(found.machine.shape, angles_of({0, 2 * pi}, 720)) > 0)) ++unable;
      }
    }
  }
  EXPECT_EQ(families.size(), names(MachineFamily{}).size() - 2) << "all but ten-bars and Watt II";
  EXPECT_GE(machines, 25);
  EXPECT_GE(unable, 8) << "machines that cannot turn";
}

// Cognates are measured over the range of the drive.
TEST(RockingDrives, HaveCognates) {
  const MotionTarget target = rocking("step");
  const auto answer = search(target, {.families = {MachineFamily::four_bar}, .max_curves = 60'000});
  ASSERT_FALSE(answer.machines.empty());
  const FittedMachine& machine = answer.machines[0].machine;
  const auto layouts = layouts_of(machine, target.stroke, used_part(target, machine));
  ASSERT_EQ(layouts.size(), 2U);
  for (const MachineLayout& layout : layouts) EXPECT_LT(layout.apart, 1e-9 * layout.size);
  EXPECT_NEAR(layouts[1].min_pair_angle, answer.machines[0].measures.min_pair_angle, 1e-3);
}

TEST(RockingDrives, LeadBodiesThroughPoses) {
  const Stroke places{.points = {{0, 0}, {0.03, 0.005}, {0.062, 0.024}, {0.088, 0.052}, {0.104, 0.088}}};
  MotionTarget turns = pose_target(places, std::vector<double>{0, 0, 0.14, 0.44, 0.9}, 0.06);
  MotionTarget rocks = turns;
  let_drive_rock(rocks);
  const TypeSearchOptions options{.families = {MachineFamily::four_bar}, .max_curves = 60'000};
  const double by_rocking = search(rocks, options).families[0].error;
  EXPECT_LT(by_rocking, 1.02 * search(turns, options).families[0].error + 1e-5);
}

// Points of a path at rotations of a drive that need not turn.
TEST(RockingDrives, KeepAGivenTiming) {
  CrankPart part;
  const MachineShape shape = some_rocker(3, part);
  const std::vector<double> angles = angles_of(part, 40);
  MotionTarget target = timed_stroke({.points = test::traced(shape, angles)}, angles);
  let_drive_rock(target);
  const auto answer = search(target, {.families = {MachineFamily::four_bar}, .max_curves = 100'000});
  ASSERT_FALSE(answer.machines.empty());
  EXPECT_LT(answer.machines[0].measures.error, 1e-3);
  EXPECT_NEAR(answer.machines[0].measures.span, part.range, 1e-9);
}

}  // namespace
}  // namespace linkwright::planar
