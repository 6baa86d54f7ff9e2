// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/link_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// A machine that another program found for a stroke, and what it says of it. `places` are O, T1, T2, S1, S2
/// at crank angle zero and the traced point from the crank pin, in cranks.
struct FoundElsewhere {
  const char* stroke;
  std::array<double, 12> places;
  std::array<double, 2> place, scale;
  double error, pair_angle_deg;
};
constexpr std::array<FoundElsewhere, 3> found_elsewhere{
    {{"d_shape",
      {-3.10927135, -3.97717626, 13.7739087, 0.165299482, 2.4545473, 1.03729629, -0.188228906, -0.307378798,
       7.77872694, 14.1131772, -0.490119785, 1.59873937},
      {0.0077643988, -0.280135948},
      {0.275568684, -0.306069638},
      0.00861,
      20.2},
     {"leg",
      {-2.53451947, 0.0328122433, 0.447321013, -12.6440543, -2.10568644, 0.223555148, -0.513589112,
       0.247384432, -1.42763097, -0.271828693, 1.93592539, 1.77423554},
      {0.711583209, -0.902743354},
      {0.181936918, 0.520701502},
      0.00788,
      20.3},
     {"letter_s",
      {3.64713918, 0.404171115, 0.527953728, 0.765821801, 1.44448126, 1.34508404, 1.75745529, 1.18300236,
       2.11649815, 2.26516443, 0.376154177, 2.10512418},
      {-0.309166706, -2.10825783},
      {0.791843763, 0.601786045},
      0.00774,
      20.0}}};

MachineShape shape_of(const FoundElsewhere& f) {
  MachineShape out{.program = program_named("stephenson_2:a")};
  out.x.assign(f.places.begin(), f.places.end());
  for (std::size_t i = 2; i < 6; ++i) out.x[i] -= f.places[i % 2];
  out.x[6] -= 1, out.x[8] -= 1;
  out.x.insert(out.x.end(), {f.place[0], f.place[1], f.scale[0], f.scale[1]});
  return out;
}

std::vector<double> turn_of_crank(std::size_t count) {
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(2 * pi * static_cast<double>(k) / static_cast<double>(count));
  return out;
}

struct Turn {
  std::vector<double> quality, points;
};
Turn turn_of(const MachineShape& shape, const std::vector<double>& angles) {
  Turn out{std::vector<double>(angles.size()),
           std::vector<double>(2 * shape.program->steps.size() * angles.size())};
  std::vector<double> worst(angles.size());
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angles.data(),
                 .count = angles.size(),
                 .quality = out.quality.data(),
                 .worst = worst.data(),
                 .points = out.points.data()});
  return out;
}

// Another program, which follows the group in small steps, gives the least angle at which the curves of both
// bars cross in the plane of the two rotations, and the error against the points of the stroke.
TEST(LinkGroups, AgreeWithAnotherProgram) {
  for (const FoundElsewhere& f : found_elsewhere) {
    const MachineShape shape = shape_of(f);
    const std::vector<double> angles = turn_of_crank(7200);
    const Turn turn = turn_of(shape, angles);
    const double least = *std::min_element(turn.quality.begin(), turn.quality.end());
    EXPECT_NEAR(std::asin(std::sqrt(least)) * 180 / pi, f.pair_angle_deg, 0.05) << f.stroke;
    const auto curve = test::traced(shape, angles);
    const Stroke stroke = test::stroke_of(test::stroke_case(f.stroke));
    std::complex<double> mean{};
    const auto n = static_cast<double>(stroke.points.size());
    for (const auto& point : stroke.points) mean += point / n;
    double squares = 0, size = 0;
    for (const auto& point : stroke.points) {
      double nearest = infinity;
      for (const auto& c : curve) nearest = std::min(nearest, std::norm(c - point));
      squares += nearest, size += std::norm(point - mean);
    }
    EXPECT_NEAR(std::sqrt(squares / size), f.error, 0.02 * f.error) << f.stroke;
  }
}

// The bars keep their lengths, pins their distances from the hinges, and a turn ends where it began.
TEST(LinkGroups, KeepTheirLengthsOverTheTurn) {
  const PointProgram& p = *program_named("stephenson_2:a");
  std::vector<double> angles = turn_of_crank(96);
  for (double& angle : angles) angle += 3.7;  // into the next turn
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const MachineShape shape = test::some_shape(p, seed);
    const Turn turn = turn_of(shape, angles);
    const auto at = [&](int point, std::size_t k) {
      const std::size_t row = 2 * static_cast<std::size_t>(point) * angles.size();
      return std::complex<double>(turn.points[row + k], turn.points[row + angles.size() + k]);
    };
    const auto parameter = [&](int i) {
      return std::complex<double>(shape.x[static_cast<std::size_t>(i)],
                                  shape.x[static_cast<std::size_t>(i) + 1]);
    };
    const std::complex<double> pivot = parameter(0);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      EXPECT_LT(std::abs(at(0, k) - std::polar(1.0, angles[k])), 1e-12);
      std::array<std::complex<double>, 2> moments;  // of the bars about both hinges
      for (int i = 0; i < 2; ++i) {
        const std::complex<double> t = at(p.group + i, k), s = at(p.group + 2 + i, k);
        const std::complex<double> arm = parameter(2 + 2 * i), on_crank = parameter(6 + 2 * i);
        const double length = std::abs(pivot + arm - 1.0 - on_crank);
        EXPECT_NEAR(std::abs(t - s), length, 1e-10 * length) << seed;
        EXPECT_NEAR(std::abs(t - pivot), std::abs(arm), 1e-11 * std::abs(arm)) << seed;
        EXPECT_NEAR(std::abs(s - at(0, k)), std::abs(on_crank), 1e-11 * std::abs(on_crank)) << seed;
        moments[static_cast<std::size_t>(i)] = {std::imag(std::conj(t - pivot) * (t - s)),
                                                std::imag(std::conj(t - s) * (s - at(0, k)))};
      }
      const double sine =
          std::imag(std::conj(moments[0]) * moments[1]) / (std::abs(moments[0]) * std::abs(moments[1]));
      EXPECT_NEAR(turn.quality[k], sine * sine, 1e-9) << seed;
    }
  }
}

// Where the ground pivot is too far from the crank pin for bars and arms, the machine has no position.
TEST(LinkGroups, SayWhereThereIsNoPosition) {
  MachineShape shape{.program = program_named("stephenson_2:a"),
                     .x = {3, 0, 0, 0.2, 0.1, -0.2, 0.05, 0.2, 0, -0.3, 0.5, 0.5, 0, 0, 1, 0}};
  const Turn turn = turn_of(shape, turn_of_crank(64));
  EXPECT_GT(turn.quality[0], 0);
  EXPECT_LT(turn.quality[32], 0);
  for (const double v : turn.points) EXPECT_TRUE(std::isfinite(v));
  const link_group::GroupTurn followed = link_group::follow_turn(shape.x.data());
  EXPECT_FALSE(followed.closes());
  const MotionTarget target(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  MachineFitter fitter(target, {});
  FittedMachine machine{.shape = shape};
  for (std::size_t k = 0; k < stroke_samples; ++k)
    machine.angle[k] = 2 * pi * static_cast<double>(k) / stroke_samples;
  EXPECT_EQ(fitter.measure(machine).defect, MachineDefect::no_turn);
}

// As a linkage it starts at the first crank angle of the stroke, wherever that is, and is followed from
// there.
TEST(LinkGroups, AreLinkagesThatStartAnywhere) {
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  for (const PointProgram* p : programs_of(MachineFamily::stephenson_2))
    for (std::uint64_t seed = 21; seed <= 26; ++seed) {
      FittedMachine machine{.shape = test::some_shape(*p, seed)};
      machine.angle.fill(0.9 * static_cast<double>(seed) - 20);
      const FoundLinkage found = found_linkage(machine, target);
      const PlanResult planned = plan_linkage(found.linkage);
      ASSERT_TRUE(planned.problems.empty()) << p->name;
      std::vector<double> angles;
      for (int k = 0; k < 16; ++k) angles.push_back(2.4 * k);
      const auto curve = test::traced(machine.shape, angles);
      LinkageAssembly assembly(planned.plan, {{found.crank_angle}, {found.crank_angle + 2.4 * 16}});
      LinkageMotion moving(planned.plan);
      const BodyPoint point = point_named(found.linkage, found.traced);
      const std::complex<double> local = found.linkage.bodies[static_cast<std::size_t>(point.body)]
                                             .points[static_cast<std::size_t>(point.point)]
                                             .at;
      for (std::size_t k = 0; k < angles.size(); ++k) {
        const InputMotion input{angles[k] + found.crank_angle, 0, 0};
        assembly.place(std::span(&input, 1), moving);
        ASSERT_EQ(moving.status, Status::done) << p->name << " at " << k;
        const math::Vec2 place = point_motion(planned.plan, moving, point.body, local).position;
        EXPECT_LT(std::abs((std::complex<double>(place.x, place.y) - target.centre) / target.size - curve[k]),
                  1e-6)
            << p->name << ' ' << seed << " at " << k;
      }
    }
}

// The curve of a random machine within the limits is found again.
TEST(LinkGroups, AreRecoveredFromTheirCurve) {
  for (const std::uint64_t seed : {2, 9}) {
    MachineShape shape;
    for (std::uint64_t k = 0;; ++k) {
      shape = test::some_shape(*program_named("stephenson_2:a"), 1000 * seed + k);
      const Turn turn = turn_of(shape, turn_of_crank(720));
      const bool is_short =
          std::all_of(shape.x.begin(), shape.x.end(), [](double v) { return std::abs(v) < 5; });
      if (is_short && *std::min_element(turn.quality.begin(), turn.quality.end()) > 0.16) break;
    }
    const Stroke stroke{.points = test::traced(shape, turn_of_crank(360)), .closed = true};
    RunContext context;
    const auto answer = search_types(
        sampled_stroke(stroke), {.families = {MachineFamily::stephenson_2}, .max_curves = 300'000}, context);
    EXPECT_LT(answer.families[0].error, 5e-4) << seed;
  }
}

}  // namespace
}  // namespace linkwright::planar
