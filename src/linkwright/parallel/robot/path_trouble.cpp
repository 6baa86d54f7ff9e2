// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/path_trouble.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/math/zero.h"
#include "linkwright/parallel/robot/constraint.h"

namespace linkwright::parallel {
namespace {

constexpr double slack = 5e-4;     // margin of the indices, so that a path along a limit ends, too
constexpr double shortest = 1e-9;  // m, or rad: closer to full stretch nothing is proven

struct Stretch {
  double from, to;
};

class Look {
 public:
  Look(const TroubleTask& task, const PlatformWay& way)
      : task_(task), way_(way), min_(std::max(task.least_constraint, constraint_floor)) {}

  std::optional<PathTrouble> run(std::span<const double> breaks) {
    std::vector<Stretch> open;
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      open.assign(1, {breaks[k - 1], breaks[k]});
      while (!open.empty()) {
        const Stretch here = open.back();
        open.pop_back();
        if (auto found = look(here, open)) {
          found->looks = looks_;
          refine(*found, breaks);
          return found;
        }
      }
    }
    return {};
  }

 private:
  RegularAt at(double t) const { return regular_at(task_.robot, way_.at(t), task_.mode, task_.length); }

  // Either trouble, or nothing in the whole stretch, or both halves join the open ones, the first on top.
  std::optional<PathTrouble> look(const Stretch& here, std::vector<Stretch>& open) {
    const double middle = here.from + (here.to - here.from) / 2;
    const Displaced left = way_.between(here.from, middle), right = way_.between(middle, here.to);
    const Displaced by{std::max(left.shift, right.shift), std::max(left.turn, right.turn)};
    const RegularAt there = at(middle);
    ++looks_;
    const auto change = change_within(task_.robot, there, by, task_.length);
    if (change && there.marks == task_.home && there.constraint - *change >= min_ - slack &&
        there.rods - *change >= rods_floor - slack)
      return {};
    PathTrouble out{.from = here.from, .to = here.to};
    if (!change) {
      if (2 * std::max(by.shift, by.turn) < shortest) {
        out.kind = there.reached ? Trouble::type1 : Trouble::reach;
        out.leg = there.reached ? nearest_to_stretch(there) : there.leg;
        return out;
      }
    } else if (*change <= slack) {
      const bool turned = there.marks.constraint != task_.home.constraint || there.constraint < min_;
      const bool crossed = there.marks.assembly != task_.home.assembly || there.rods < rods_floor;
      out.kind = crossed ? Trouble::type2 : Trouble::constraint;
      if (turned || crossed) return out;
    }
    open.push_back({middle, here.to});
    open.push_back({here.from, middle});
    return {};
  }

  int nearest_to_stretch(const RegularAt& there) const {
    int out = 0;
    const auto share = [&](int i) {
      return there.legs[i].square / (task_.robot.leg[i].rod * task_.robot.leg[i].rod);
    };
    for (int i = 1; i < task_.robot.legs(); ++i)
      if (share(i) < share(out)) out = i;
    return out;
  }

  // The index of the trouble with the sign of the determinant relative to home, less what it falls to: smooth
  // through its zero. NaN beyond reach.
  double index(Trouble kind, double t) const {
    const RegularAt there = at(t);
    if (kind == Trouble::reach || kind == Trouble::type1) return there.reach;
    if (!there.reached) return std::nan("");
    return kind == Trouble::type2 ? there.rods * there.marks.assembly * task_.home.assembly
                                  : there.constraint * there.marks.constraint * task_.home.constraint;
  }

  void refine(PathTrouble& trouble, std::span<const double> breaks) const {
    const double a = breaks.front(), b = breaks.back();
    const bool of_reach = trouble.kind == Trouble::reach || trouble.kind == Trouble::type1;
    const double limit = of_reach ? 0 : trouble.kind == Trouble::type2 ? rods_floor : min_;
    const auto excess = [&](double t) { return index(trouble.kind, t) - limit; };
    double inside = trouble.from, beyond = trouble.from + (trouble.to - trouble.from) / 2;
    double step = std::max(trouble.to - trouble.from, 1e-12 * (b - a));
    trouble.begin = beyond;
    // The stretch may end short of a place that it vouches against.
    for (int k = 0; of_reach && excess(beyond) > 0 && k < 8 && beyond < b; ++k, step *= 2)
      beyond = std::min(b, beyond + step);
    if (excess(beyond) > 0) return;  // only touched
    if (of_reach) {
      trouble.kind = Trouble::reach;
      trouble.leg = std::max(at(beyond).leg, 0);
    }
    for (step = beyond - inside; !(excess(inside) > 0) && inside > a; step *= 2)
      inside = std::max(a, inside - step);
    trouble.begin = excess(inside) > 0 ? math::zero_between(excess, inside, beyond) : a;
    if (!of_reach) trouble.zero = zero_after(trouble.kind, beyond, breaks, limit);
  }

  // Steps as long as the index cannot fall to zero within.
  std::optional<double> zero_after(Trouble kind, double t, std::span<const double> breaks,
                                   double limit) const {
    const double b = breaks.back();
    constexpr int max_steps = 20000;
    constexpr double least_way = 1e-7;
    double before = t, step = (b - t) / 64;
    for (int k = 0; k < max_steps; ++k) {
      const RegularAt there = at(t);
      const double value = index(kind, t);
      if (!there.reached || value > limit) return {};
      if (value <= 0)
        return t == before ? t : math::zero_between([&](double x) { return index(kind, x); }, before, t);
      if (t >= b) return {};
      before = t;
      // Half of what the bound allows.
      const auto allowed = [&](double to) {
        const Displaced by = way_.between(before, to);
        if (by.shift < least_way && by.turn < least_way) return true;
        const auto change = change_within(task_.robot, there, by, task_.length);
        return change && *change <= 0.9 * value;
      };
      const double next = *std::upper_bound(breaks.begin(), breaks.end() - 1, t);
      step *= 4;
      while (!allowed(std::min(next, t + step))) step /= 2;
      t = std::min(next, t + step);
    }
    return {};
  }

  const TroubleTask& task_;
  const PlatformWay& way_;
  double min_;
  int looks_ = 0;
};

struct Straight {
  Pose start;
  Vec3 shift, turn;  // seen from the base

  Straight(const Pose& from, const Pose& to)
      : start(from),
        shift(to.position - from.position),
        turn(to.rotation == from.rotation ? Vec3{} : math::turn_of(to.rotation * transposed(from.rotation))) {
  }
  Pose at(double share) const {
    if (turn == Vec3{}) return {start.position + share * shift, start.rotation};
    return {start.position + share * shift, math::turn_about(share * turn) * start.rotation};
  }
};

}  // namespace

std::optional<TroubleTask> trouble_task(const Robot& robot, const Pose& home, const WorkingMode& mode,
                                        double length, double least_constraint) {
  const RegularAt there = regular_at(robot, home, mode, length);
  if (!there.reached) return {};
  return TroubleTask{robot, mode, length, there.marks, least_constraint};
}

std::optional<PathTrouble> first_trouble(const TroubleTask& task, const PlatformWay& way, double a,
                                         double b) {
  const std::array<double, 2> ends{a, b};
  return Look(task, way).run(ends);
}

std::optional<PathTrouble> first_trouble(const TroubleTask& task, const PlatformWay& way,
                                         std::span<const double> breaks) {
  return Look(task, way).run(breaks);
}

Pose straight_between(const Pose& from, const Pose& to, double share) { return Straight(from, to).at(share); }

std::optional<PathTrouble> first_trouble(const TroubleTask& task, const Pose& from, const Pose& to) {
  const Straight line(from, to);
  const double shift = norm(line.shift), turn = norm(line.turn);
  const auto pose = [&](double t) { return line.at(t); };
  const auto between = [&](double a, double b) { return Displaced{(b - a) * shift, (b - a) * turn}; };
  return first_trouble(task, {pose, between}, 0, 1);
}

std::string cause(const TroubleTask& task, const PlatformWay& way, const PathTrouble& trouble) {
  switch (trouble.kind) {
    case Trouble::reach: {
      // At the very edge a leg is straight, or folded.
      const RegularAt there = regular_at(task.robot, way.at(trouble.begin), task.mode, task.length);
      const RegularAt::Leg& leg = there.legs[trouble.leg];
      const bool straight = leg.c > 0 && leg.rho > task.robot.leg[trouble.leg].arm;
      return fmt::format("leg {} is {} and reaches no {}", trouble.leg + 1, straight ? "straight" : "folded",
                         straight ? "farther" : "nearer");
    }
    case Trouble::type1:
      return fmt::format("arm and rod of leg {} are aligned", trouble.leg + 1);
    case Trouble::type2:
      return "the rods do not hold the platform";
    case Trouble::constraint:
      break;
  }
  const Pose pose = way.at(trouble.zero.value_or(trouble.begin));
  const ArmAngles arms = inverse(task.robot, pose, task.mode);
  return free_turn(task.robot, jacobians(task.robot, pose, arms.angle));
}

}  // namespace linkwright::parallel
