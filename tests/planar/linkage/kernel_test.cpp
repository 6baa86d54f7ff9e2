// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/math/simd.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// A dyad between two points of the ground, the first named "first" and "second".
std::vector<PartState<double>> placed(const Linkage& l, double mode, DyadType type) {
  const PlanResult r = plan_linkage(l);
  for (const Diagnostic& d : r.problems) ADD_FAILURE() << to_string(d);
  const Group& g = r.plan.groups.at(0);
  const Dyad& dyad = std::get<Dyad>(g.kind);
  EXPECT_EQ(dyad.type, type);
  std::vector<PartState<double>> parts(r.plan.parts.size());
  parts[0] = {{0, 0}, {1, 0}, {0, 0}, 0, {0, 0}, 0};
  GroupState<double> state;
  for_dyad(type, [&](auto tag) { place_dyad(tag, g, dyad, mode, parts.data(), state); });
  return parts;
}

// Path synthesis, section 5: the five dyads between A and B.
TEST(LinkageKernel, MeetsThePublishedDyads) {
  using linkwright::test::at;
  using linkwright::test::numbers;
  const Value& entry = linkwright::test::published_case("path-synthesis.json", "DYADS");
  const std::complex<double> a(0.2, 0.1), b(1.7, -0.4);
  const auto expected = [&](const std::string& key) { return numbers(at(entry, "computed." + key)); };

  Linkage rrr = grounded({{"A", a}, {"B", b}});
  add_bar(rrr, "first", "A", "C", 1.2);
  add_bar(rrr, "second", "B", "C", 0.9);
  add_pin(rrr, "A", "ground.A", "first.A");
  add_pin(rrr, "C", "first.C", "second.C");
  add_pin(rrr, "B", "ground.B", "second.B");
  Linkage rrp = grounded({{"A", a}, {"Q", {0.5, -0.3}}});
  add_bar(rrp, "first", "A", "C", 1.2);
  add_body(rrp, "second", {{"C", {0, 0}}, {"on line", {0, -0.25}}});
  add_pin(rrp, "A", "ground.A", "first.A");
  add_pin(rrp, "C", "first.C", "second.C");
  add_slide(rrp, "guide", "ground.Q", "second.on line", 0.7);
  Linkage rpr = grounded({{"A", a}, {"B", b}});
  add_body(rpr, "first", {{"A", {0, 0}}, {"slide", {0, 0.3}}});
  add_body(rpr, "second", {{"B", {0, 0}}});
  add_pin(rpr, "A", "ground.A", "first.A");
  add_slide(rpr, "slide", "first.slide", "second.B");
  add_pin(rpr, "B", "ground.B", "second.B");
  for (const auto& [mode, sign] : {std::pair{1.0, "+1"}, {-1.0, "-1"}}) {
    std::vector<double> e = expected(std::string("RRR") + sign);
    std::vector<PartState<double>> parts = placed(rrr, mode, DyadType::rrr);
    math::Vec2 c = point_on(parts[1], {1.2, 0});
    EXPECT_NEAR(c.x, e[0], 1e-10);
    EXPECT_NEAR(c.y, e[1], 1e-10);
    EXPECT_LE(norm(point_on(parts[2], {0.9, 0}) - c), 1e-15);
    e = expected(std::string("RRP") + sign);
    parts = placed(rrp, mode, DyadType::rrp);
    c = point_on(parts[1], {1.2, 0});
    EXPECT_NEAR(c.x, e[0], 1e-10);
    EXPECT_NEAR(c.y, e[1], 1e-10);
    EXPECT_NEAR(dot(math::unit(0.7), c - math::Vec2{0.5, -0.3}), e[2], 1e-10);
    e = expected(std::string("RPR") + sign);
    parts = placed(rpr, mode, DyadType::rpr);
    EXPECT_NEAR(std::remainder(angle_of(parts[1].direction) - e[0], 2 * std::acos(-1.0)), 0, 1e-10);
    EXPECT_NEAR(dot(parts[1].direction, math::vec(b - a)), e[1], 1e-10);
  }

  Linkage prp = grounded({{"A", a}, {"B", b}});
  add_body(prp, "first", {{"C", {0, 0}}});
  add_body(prp, "second", {{"C", {0, 0}}});
  add_slide(prp, "A", "ground.A", "first.C", 0.3);
  add_pin(prp, "C", "first.C", "second.C");
  add_slide(prp, "B", "ground.B", "second.C", 1.9);
  std::vector<double> e = expected("PRP");
  std::vector<PartState<double>> parts = placed(prp, 1, DyadType::prp);
  EXPECT_NEAR(parts[1].origin.x, e[0], 1e-10);
  EXPECT_NEAR(parts[1].origin.y, e[1], 1e-10);
  EXPECT_LE(norm(parts[1].origin - parts[2].origin), 1e-15);

  // The second body slides along the guide through B and carries a slide at 0.9 rad, on which the first,
  // pinned at A, runs: A = Q + t e_q + s e_a.
  Linkage rpp = grounded({{"A", a}, {"B", b}});
  add_body(rpp, "first", {{"A", {0, 0}}});
  add_body(rpp, "second", {{"P", {0, 0}}});
  add_pin(rpp, "A", "ground.A", "first.A");
  add_slide(rpp, "inner", "first.A", "second.P", 0.9, 0.9);
  add_slide(rpp, "guide", "ground.B", "second.P", 2.4, 2.4);
  e = expected("RPP");
  parts = placed(rpp, 1, DyadType::rpp);
  const math::Vec2 p = parts[2].origin;
  EXPECT_NEAR(dot(math::unit(2.4), p - math::vec(b)), e[0], 1e-10);
  EXPECT_NEAR(cross(math::unit(2.4), p - math::vec(b)), 0, 1e-15);
  EXPECT_NEAR(dot(math::unit(0.9), math::vec(a) - p), e[1], 1e-10);
}

// One batch of positions in the place of single ones: motion and joint forces of every sample in closed form.
TEST(LinkageKernel, IsTheSameForBatches) {
  using B = xsimd::batch<double>;
  constexpr std::size_t lanes = B::size;
  for (const LinkageSample& s : linkage_samples()) {
    const LinkagePlan p = planned(s.linkage);
    const bool plain = std::all_of(p.groups.begin(), p.groups.end(),
                                   [](const Group& g) { return g.as<Driver>() || g.as<Dyad>(); });
    if (!plain || !s.linkage.springs.empty() || !s.linkage.torques.empty() || !s.linkage.forces.empty())
      continue;
    SCOPED_TRACE(s.name);
    const math::Vec2 gravity = math::vec(s.linkage.gravity);
    std::vector<PartState<B>> parts(p.parts.size());
    const B zero(0.0), one(1.0);
    parts[0] = {{zero, zero}, {one, zero}, {zero, zero}, zero, {zero, zero}, zero};
    std::vector<GroupState<B>> states(p.groups.size());
    std::vector<Wrench<B>> needed(p.parts.size(), {{zero, zero}, zero}), drives;
    std::vector<std::array<Wrench<B>, 3>> joints(p.groups.size());
    for (std::size_t k = 0; k < p.groups.size(); ++k) {
      const Group& g = p.groups[k];
      const Dyad* dyad = g.as<Dyad>();
      if (!dyad) {
        const std::size_t input = index(g.joints[0].input);
        alignas(64) double values[lanes];
        for (std::size_t i = 0; i < lanes; ++i)
          values[i] = inputs_at(s, (static_cast<double>(i) + 0.5) / lanes, 2, 3)[input].value;
        const InputMotion in = inputs_at(s, 0, 2, 3)[input];
        place_driver(g, B::load_unaligned(values), parts.data());
        drive_velocity(g, B(in.rate), parts.data());
        drive_acceleration(g, B(in.rate), B(in.acceleration), parts.data());
      } else {
        for_dyad(dyad->type, [&](auto type) {
          place_dyad(type, g, *dyad, B(g.mode), parts.data(), states[k]);
          dyad_velocity(type, g, parts.data(), states[k]);
          dyad_acceleration(type, g, parts.data(), states[k]);
        });
      }
    }
    for (std::size_t k = 1; k < parts.size(); ++k)
      needed[k] = needed_wrench(p.masses[k], parts[k], math::broadcast<B>(gravity));
    std::vector<Wrench<B>> torque(p.inputs());
    for (std::size_t k = p.groups.size(); k-- > 0;) {
      const Group& g = p.groups[k];
      const Dyad* dyad = g.as<Dyad>();
      if (!dyad)
        torque[index(g.joints[0].input)] = driver_force(g, parts.data(), needed.data());
      else
        for_dyad(dyad->type, [&](auto type) {
          dyad_forces(type, g, parts.data(), states[k], needed.data(), joints[k].data());
        });
    }
    LinkageMotion m(p);
    LinkageForces f;
    for (std::size_t i = 0; i < lanes; ++i) {
      solve_motion(p, inputs_at(s, (static_cast<double>(i) + 0.5) / lanes, 2, 3), m);
      ASSERT_EQ(m.status, Status::done);
      solve_forces(s.linkage, p, m, 0, 0, f);
      // Batches may fuse multiplications and additions: rounding only, over the sine of the transmission.
      double worst = 1;
      for (const Group& g : p.groups)
        if (g.as<Dyad>())
          worst = std::min(worst, std::abs(m.groups[static_cast<std::size_t>(&g - p.groups.data())].sine));
      const double near = 1e-13 / (worst * worst * worst), largest = largest_force(f);
      for (std::size_t k = 1; k < parts.size(); ++k) {
        EXPECT_NEAR(parts[k].origin.x.get(i), m.parts[k].origin.x, near);
        EXPECT_NEAR(parts[k].direction.y.get(i), m.parts[k].direction.y, near);
        EXPECT_NEAR(parts[k].velocity.y.get(i), m.parts[k].velocity.y, near * 10);
        EXPECT_NEAR(parts[k].speed.get(i), m.parts[k].speed, near * 10);
        EXPECT_NEAR(parts[k].acceleration.x.get(i), m.parts[k].acceleration.x, near * 1000);
        EXPECT_NEAR(parts[k].angular_acceleration.get(i), m.parts[k].angular_acceleration, near * 1000);
      }
      for (std::size_t d = 0; d < p.inputs(); ++d)
        EXPECT_NEAR(torque[d].moment.get(i), f.drives[d], near * (1 + largest) * 100);
      EXPECT_NEAR(-needed[0].force.x.get(i), f.shaking_force.x, near * (1 + largest) * 100);
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
