// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "linkwright/math/function_ref.h"
#include "linkwright/parallel/robot/regular_ball.h"

/// Finds the first place that a platform led along a path cannot pass: by bounds over stretches, so that
/// nothing between two looks is stepped over, neither two crossings nor a touch.
namespace linkwright::parallel {

/// A path by one parameter that grows along it.
struct PlatformWay {
  math::FunctionRef<Pose(double)> at;
  /// Bound of how far the platform goes between two parameters; that of a straight line is its length.
  math::FunctionRef<Displaced(double, double)> between;
};

struct TroubleTask {
  Robot robot;
  WorkingMode mode = all_positive;
  double length = 1;            ///< characteristic one of a HEXA (m), see `quality`
  Marks home;                   ///< the path begins at a pose with these
  double least_constraint = 0;  ///< limit of the constraint index; the floor (constraint.h) holds always
};
/// ... of home; nothing where its legs do not reach.
std::optional<TroubleTask> trouble_task(const Robot& robot, const Pose& home, const WorkingMode& mode,
                                        double length, double least_constraint = 0);

enum class Trouble { reach, type1, type2, constraint };
constexpr std::array<EnumName<Trouble>, 4> names(Trouble) {
  return {{{Trouble::reach, "reach", "a leg cannot reach"},
           {Trouble::type1, "type_1", "arm and rod of a leg are aligned"},
           {Trouble::type2, "type_2", "the rods do not hold the platform"},
           {Trouble::constraint, "constraint", "the parallelograms do not keep the platform from turning"}}};
}

struct PathTrouble {
  Trouble kind = Trouble::reach;
  double from = 0, to = 0;  ///< stretch in which it was found; before it nothing is wrong
  /// Start of the trouble, to the last digit: a leg gives out, arm and rod are aligned, or the index falls to
  /// its limit or floor.
  double begin = 0;
  /// Place where the determinant changes its sign, if it does before the index rises again.
  std::optional<double> zero;
  int leg = -1;   ///< leg of a trouble of reach or type 1, from 0
  int looks = 0;  ///< poses that it took to find the stretch
};

/// The first trouble between a and b; nothing: no leg gives out, no arm and rod are aligned, the indices of
/// regular_ball.h stay above their limits less 5e-4, and the marks are home's.
std::optional<PathTrouble> first_trouble(const TroubleTask& task, const PlatformWay& way, double a, double b);
/// ... along stretches between increasing parameters, within which alone way.between needs to hold.
std::optional<PathTrouble> first_trouble(const TroubleTask& task, const PlatformWay& way,
                                         std::span<const double> breaks);

/// The straight path between two poses: the position linear, the rotation about one axis by the least angle.
std::optional<PathTrouble> first_trouble(const TroubleTask& task, const Pose& from, const Pose& to);
/// A pose on it, at a share of it in [0, 1].
Pose straight_between(const Pose& from, const Pose& to, double share);

/// Says in plain words what is wrong there: "leg 2 is at its full stretch", "the rods of legs 2 and 3 lie
/// level; the platform can turn about y".
std::string cause(const TroubleTask& task, const PlatformWay& way, const PathTrouble& trouble);

}  // namespace linkwright::parallel
