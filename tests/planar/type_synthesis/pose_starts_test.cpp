// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/pose_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/search.h"

namespace linkwright::planar {
namespace {

struct KnownMachine {
  const char* program;
  std::vector<double> x;
};

/// Machines that turn, somewhere in the plane; the second parameter of a sign is the other branch.
std::vector<KnownMachine> known_machines() {
  return {{"four_bar", {2.6, 2.4, 2.1, 0.7, 0.9, 0.3, -0.2, 0.8, 0.5}},
          {"slider_crank", {3.1, 0.4, 0.8, -0.6, -0.1, 0.2, 0.6, -0.3}},
          {"inverted_slider", {2.7, 0.3, 1.2, 0.5, 0.4, 0.1, 0.5, 0.6}}};
}

/// So many poses of the traced bar over three quarters of a turn, clockwise.
MotionTarget poses_of(const KnownMachine& known, unsigned signs, std::size_t count) {
  const PointProgram& program = *program_named(known.program);
  std::vector<double> angle(16), x(16), y(16), bx(16), by(16);
  for (std::size_t k = 0; k < angle.size(); ++k)
    angle[k] = 0.4 - 1.5 * pi * static_cast<double>(std::min(k, count - 1)) / static_cast<double>(count - 1);
  compute_curve({.program = &program,
                 .x = known.x.data(),
                 .signs = signs,
                 .angle = angle.data(),
                 .count = angle.size(),
                 .px = x.data(),
                 .py = y.data(),
                 .bx = bx.data(),
                 .by = by.data()});
  Stroke places;
  std::vector<double> angles;
  for (std::size_t k = 0; k < count; ++k) {
    places.points.emplace_back(x[k], y[k]);
    angles.push_back(std::atan2(by[k], bx[k]) + 0.3);
  }
  return pose_target(places, angles, std::nullopt);
}

// Five poses of a machine, and more, give that machine again: exactly, on its branch and in its sense.
TEST(PoseStarts, HaveTheMachineThatThePosesComeFrom) {
  for (const KnownMachine& known : known_machines())
    for (const unsigned signs : {0u, 1u})
      for (const std::size_t count : {5u, 9u}) {
        const PointProgram& program = *program_named(known.program);
        if (signs >= (1u << program.signs)) continue;
        const MotionTarget target = poses_of(known, signs, count);
        RunContext context;
        const std::vector<FittedMachine> found = pose_starts(target, {}, program.family, 20, context);
        MachineFitter fitter(target, {});
        const bool there = std::any_of(found.begin(), found.end(), [&](const FittedMachine& m) {
          FittedMachine start = m;
          const double ground = m.shape.x[0];
          // A rod through a sleeve is the same one in the other direction.
          const bool on_branch = program.family == MachineFamily::inverted_slider || m.shape.signs == signs;
          return fitter.turn_body(start) < 1e-8 && std::abs(ground - known.x[0]) < 1e-6 && on_branch &&
                 m.sense == -1;
        });
        EXPECT_TRUE(there) << known.program << ' ' << signs << ' ' << count << ' ' << found.size();
      }
}

// Four poses and three are met by all of their dyads.
TEST(PoseStarts, MeetFewPosesExactly) {
  for (const KnownMachine& known : known_machines())
    for (const std::size_t count : {3u, 4u}) {
      const MotionTarget target = poses_of(known, 0, count);
      const MachineFamily family = program_named(known.program)->family;
      RunContext context;
      std::vector<FittedMachine> found = pose_starts(target, {}, family, 20, context);
      ASSERT_FALSE(found.empty()) << known.program << ' ' << count;
      MachineFitter fitter(target, {});
      EXPECT_LT(fitter.turn_body(found.front()), 1e-8) << known.program << ' ' << count;
      EXPECT_LE(found.size(), 20U);
    }
}

TEST(PoseStarts, AreNoneOfOtherFamiliesAndOfTwoPoses) {
  const MotionTarget target = poses_of(known_machines()[0], 0, 5), two = poses_of(known_machines()[0], 0, 2);
  RunContext context;
  EXPECT_TRUE(pose_starts(two, {}, MachineFamily::four_bar, 20, context).empty());
  EXPECT_TRUE(pose_starts(target, {}, MachineFamily::watt_1, 20, context).empty());
}

// The machine of five poses is found at once, although no shape of the atlas is near it.
TEST(PoseStarts, LetASearchBeginWithTheExactMachine) {
  const MotionTarget target = poses_of(known_machines()[0], 0, 5);
  RunContext context;
  const TypeSearchAnswer answer =
      search_types(target, {.families = {MachineFamily::four_bar}, .max_curves = 5000}, context);
  ASSERT_FALSE(answer.machines.empty());
  EXPECT_LT(answer.machines[0].measures.error, 1e-7);
}

}  // namespace
}  // namespace linkwright::planar
