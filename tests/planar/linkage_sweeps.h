// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/general.h"
#include "linkwright/planar/linkage/modes.h"
#include "linkwright/planar/linkage/scan.h"

// Random drawn linkages whose modes have no names, swept beyond the range of the mode that the drawing shows,
// and what another way of following finds.
namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

enum class SweptKind { plate_on_legs, cylinder_in_a_loop, inner_drive, floating_shock, raised_arm };
constexpr int swept_kinds = 5;

struct SweptLinkage {
  Linkage linkage;
  double from = 0, to = 0;  ///< range of the sweep
};

/// A linkage drawn at random; points lie in a square of 1 m, none nearer than 0.1 m to the next.
inline SweptLinkage swept_linkage(SweptKind kind, RandomStream& random) {
  std::vector<std::complex<double>> at;
  while (at.size() < 8) {
    const std::complex<double> p{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    if (std::all_of(at.begin(), at.end(), [&](auto q) { return std::abs(p - q) > 0.1; })) at.push_back(p);
  }
  SweptLinkage out;
  Linkage& l = out.linkage;
  const auto bar = [&](const char* name, const char* first, int a, const char* second, int b) {
    add_drawn(l, name, {{first, at[static_cast<std::size_t>(a)]}, {second, at[static_cast<std::size_t>(b)]}});
  };
  const auto pin = [&](const char* name, const char* first, const char* second) {
    add_pin(l, name, first, second);
  };
  // A cylinder between two points, or two bars with a pin between them.
  const auto driven_leg = [&](bool slide, int foot, int tip, int knee) {
    const auto a = at[static_cast<std::size_t>(foot)], b = at[static_cast<std::size_t>(tip)],
               k = at[static_cast<std::size_t>(knee)];
    add_drawn(l, "barrel", {{"foot", a}, {"knee", k}});
    add_drawn(l, "rod", {{"tip", b}, {"knee", k}});
    if (slide)
      add_slide(l, "drive", "barrel.foot", "rod.tip", std::arg(b - a), std::arg(b - a));
    else
      add_pin(l, "drive", "barrel.knee", "rod.knee");
    add_drive(l, "drive");
  };
  const auto legs = [&] {
    add_drawn(l, "plate", {{"P", at[3]}, {"Q", at[4]}, {"R", at[5]}});
    bar("leg2", "G", 1, "Q", 4), bar("leg3", "H", 2, "R", 5);
    pin("Q", "plate.Q", "leg2.Q"), pin("R", "plate.R", "leg3.R");
    pin("G", "ground.G", "leg2.G"), pin("H", "ground.H", "leg3.H");
  };
  l = grounded({{"O", at[0]}, {"G", at[1]}, {"H", at[2]}});
  double drawn = 0, swing = random.uniform(0.3, 3.0);
  switch (kind) {
    case SweptKind::plate_on_legs:
      bar("crank", "O", 0, "A", 6), bar("leg1", "A", 6, "P", 3);
      legs();
      pin("O", "ground.O", "crank.O"), pin("A", "crank.A", "leg1.A"), pin("P", "leg1.P", "plate.P");
      add_drive(l, "O");
      break;
    case SweptKind::cylinder_in_a_loop:
    case SweptKind::inner_drive: {
      const bool slide = kind == SweptKind::cylinder_in_a_loop;
      driven_leg(slide, 0, 3, 6);
      legs();
      pin("O", "ground.O", "barrel.foot"), pin("P", "rod.tip", "plate.P");
      if (slide) drawn = std::abs(at[3] - at[0]), swing = random.uniform(0.02, 0.5);
      break;
    }
    case SweptKind::floating_shock:
      // Swing arm and rocker on the ground, a link between them, the shock from one to the other.
      add_drawn(l, "swing arm", {{"O", at[0]}, {"L", at[3]}, {"S", at[4]}});
      add_drawn(l, "rocker", {{"G", at[1]}, {"M", at[5]}, {"T", at[6]}});
      bar("link", "L", 3, "M", 5);
      driven_leg(true, 4, 6, 7);
      pin("O", "ground.O", "swing arm.O"), pin("G", "ground.G", "rocker.G");
      pin("L", "swing arm.L", "link.L"), pin("M", "link.M", "rocker.M");
      pin("S", "swing arm.S", "barrel.foot"), pin("T", "rod.tip", "rocker.T");
      drawn = std::abs(at[6] - at[4]), swing = random.uniform(0.02, 0.5);
      break;
    case SweptKind::raised_arm:
      bar("arm", "G", 1, "P", 3);
      driven_leg(true, 0, 3, 6);
      pin("O", "ground.O", "barrel.foot"), pin("P", "rod.tip", "arm.P"), pin("G", "ground.G", "arm.G");
      drawn = std::abs(at[3] - at[0]), swing = random.uniform(0.02, 0.8);
      break;
  }
  const double middle = drawn + random.uniform(-1, 1) * swing;
  out.from = middle - swing, out.to = middle + swing;
  return out;
}

/// Finds the mode of a place by steps of the input that shorten until nothing unexpected happens: Newton's
/// method from what the rates foretell must hardly correct it, and the determinants must keep their signs.
class PlainFollower {
 public:
  explicit PlainFollower(const LinkagePlan& plan) : plan_(plan), motion_(plan) {}

  LinkageMotion& motion() { return motion_; }
  bool solve(double value) {
    const std::vector<InputMotion> in{{value, 1, 0}};
    solve_position(plan_, in, motion_);
    if (motion_.status != Status::done) return false;
    solve_velocity(plan_, in, motion_);
    return true;
  }
  /// From `from`, where the motion stands, to `to`: the last value that was reached.
  double go(double from, double to, double first_step) {
    double here = from, step = first_step;
    const double sense = to > from ? 1 : -1;
    std::vector<double> sides = signs();
    std::vector<PartState<double>> good = motion_.parts;
    while ((to - here) * sense > 0) {
      const double next = (to - here) * sense <= step ? to : here + sense * step, way = next - here;
      double travel = 0;
      for (std::size_t p = 1; p < good.size(); ++p) {
        PartState<double>& part = motion_.parts[p];
        part.origin = good[p].origin + way * good[p].velocity;
        part.direction = rotate(good[p].direction, math::unit(way * good[p].speed));
        travel = std::max(
            {travel, std::abs(way) * norm(good[p].velocity) / plan_.size, std::abs(way * good[p].speed)});
      }
      const std::vector<PartState<double>> foretold = motion_.parts;
      bool fine = travel < 0.1 && solve(next) && signs() == sides;
      for (std::size_t p = 1; p < good.size() && fine; ++p)
        fine = norm(motion_.parts[p].origin - foretold[p].origin) <= 0.05 * travel * plan_.size + 1e-9 &&
               norm(motion_.parts[p].direction - foretold[p].direction) <= 0.05 * travel + 1e-9;
      if (fine) {
        here = next;
        good = motion_.parts;
        step = std::min(1.5 * step, first_step);
      } else {
        motion_.parts = good;
        step *= 0.5;
        if (step < 1e-10) break;
      }
    }
    motion_.parts = good;
    return here;
  }

 private:
  std::vector<double> signs() const {
    std::vector<double> out;
    for (std::size_t k = 0; k < plan_.groups.size(); ++k)
      out.push_back(traits_of(plan_.groups[k]).has_modes ? motion_.modes[k]
                    : plan_.groups[k].as<GeneralGroup>() ? determinant_sign(*motion_.general[k])
                                                         : 1.0);
    return out;
  }
  const LinkagePlan& plan_;
  LinkageMotion motion_;
};

struct SweepFindings {
  long sweeps = 0, rows = 0, beyond = 0;
  long other_mode = 0;  ///< rows that stand elsewhere than the other way of following says
  long missing = 0;     ///< rows without a place that the other way has, or that another start finds
  long invented = 0;    ///< rows with a place beyond the end that the other way finds
  long lost = 0;        ///< curves whose steps became too short
  long singular = 0;
  std::string faults;  ///< the first ten
};

inline double apart(const std::vector<PartState<double>>& a, const std::vector<PartState<double>>& b,
                    double size) {
  double most = 0;
  for (std::size_t p = 1; p < a.size(); ++p)
    most = std::max({most, norm(a[p].origin - b[p].origin) / size, norm(a[p].direction - b[p].direction)});
  return most;
}

/// Sweeps one linkage over 12 rows, in an order of its own, and compares. `starts`: random starts at rows
/// that have no place.
inline void compare_sweep(const SweptLinkage& s, std::uint64_t number, int starts, SweepFindings& out) {
  const PlanResult planned = plan_linkage(s.linkage);
  const LinkagePlan& p = planned.plan;
  constexpr int rows = 12;
  const bool general = !p.closed_form();
  LinkageAssembly assembly(p, {{s.from}, {s.to}});
  ++out.sweeps;
  out.lost += assembly.curve() && assembly.curve()->lost();
  const double drawn = p.drawn_inputs[0], width = s.to - s.from;
  const auto fault = [&](const char* what, double value) {
    if (std::count(out.faults.begin(), out.faults.end(), '\n') < 10)
      out.faults += "linkage " + std::to_string(number) + ": " + what + " at " + std::to_string(value) +
                    ", drawn at " + std::to_string(drawn) + "\n";
  };
  // The other way: from the drawing to both sides.
  PlainFollower follower(p);
  for (std::size_t k = 1; k < p.parts.size(); ++k)
    follower.motion().parts[k].origin = {0, 0}, follower.motion().parts[k].direction = {1, 0};
  if (!follower.solve(drawn)) return;
  const std::vector<PartState<double>> start = follower.motion().parts;
  const double first_step = width / 100;
  const bool turns = general && periodic(p, 0);
  LinkageMotion motion(p);
  for (int i = 0; i < rows; ++i) {
    const int r = (5 * i + 3) % rows;
    const double value = s.from + width * r / (rows - 1);
    ++out.rows;
    const std::vector<InputMotion> in{{value, 1, 0}};
    assembly.place(in, motion);
    if (motion.status == Status::singular) {
      ++out.singular;
      continue;
    }
    // Whole turns away is the same place of the drive, and the mode may be had there only.
    bool there = false, same = false;
    for (const int turn : {0, 1, -1}) {
      if (turn != 0 && !turns) continue;
      const double goal = value + turn * 2 * pi;
      follower.motion().parts = start;
      follower.solve(drawn);
      const double reached = drawn == goal ? goal : follower.go(drawn, goal, first_step);
      if (reached != goal) continue;
      there = true;
      same = same || apart(follower.motion().parts, motion.parts, p.size) < 1e-5;
      if (same) break;
    }
    // A drawing that stands at a dead point, to rounding, cannot be left by the other way, but it can be
    // reached.
    if (motion.status == Status::done && !there) {
      follower.motion().parts.assign(motion.parts.begin(), motion.parts.end());
      if (follower.solve(value) && std::abs(follower.go(value, drawn, first_step) - drawn) <= 1e-8 * width &&
          apart(follower.motion().parts, start, p.size) < 1e-3) {
        ++out.singular;
        continue;
      }
    }
    if (motion.status == Status::done) {
      // Closed forms keep their sign beyond a gap in the range of the input.
      if (!there && general) ++out.invented, fault("a place that the other way does not have", value);
      if (there && !same) ++out.other_mode, fault("another mode", value);
      continue;
    }
    ++out.beyond;
    if (there) ++out.missing, fault("no place", value);
    // Places that other starts find, followed to the drawing's input.
    RandomStream random({.seed = 77, .run = static_cast<std::uint32_t>(number), .individual = 1});
    for (int k = 0; k < starts && !there; ++k) {
      for (std::size_t part = 1; part < p.parts.size(); ++part) {
        follower.motion().parts[part].origin = {random.uniform(-1, 1), random.uniform(-1, 1)};
        follower.motion().parts[part].direction = math::unit(random.uniform(-3.2, 3.2));
      }
      if (!follower.solve(value) || follower.go(value, drawn, first_step) != drawn) continue;
      if (apart(follower.motion().parts, start, p.size) < 1e-5) {
        ++out.missing, fault("no place, though another start finds one", value);
        break;
      }
    }
  }
}

}  // namespace linkwright::planar::test
