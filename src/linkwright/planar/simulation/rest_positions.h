// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/linkage/limits.h"

namespace linkwright::planar {

/// The behaviour of a linkage in a rest position after a small displacement.
enum class RestKind {
  stable,    ///< it returns: the stiffness is positive
  unstable,  ///< it leaves: the stiffness is negative
  marginal,  ///< the force touches zero without changing its sign: it leaves to one side
  at_end,    ///< the force presses it outwards against the end of the range, of a stroke, or a stop
  flutter    ///< of several free inputs: small motions swing and grow
};
constexpr std::array<EnumName<RestKind>, 5> names(RestKind) {
  return {{{RestKind::stable, "stable"},
           {RestKind::unstable, "unstable"},
           {RestKind::marginal, "marginal"},
           {RestKind::at_end, "at_end"},
           {RestKind::flutter, "flutter"}}};
}

/// A rest position of a linkage with one free input.
struct RestPosition {
  RestKind kind = RestKind::stable;  ///< its stability
  double value = 0;                  ///< of the free input, rad or m
  double force = 0;                  ///< generalised force there, N m or N: zero but for that at an end
  double stiffness = 0;              ///< -dQ/dq, N m/rad or N/m; NaN at an end
  double mass = 0;                   ///< reduced to the input, kg m2 or kg
  double damping = 0;                ///< N m s/rad or N s/m
  double potential = 0;              ///< of weight, springs and struts, J
  std::size_t range = 0;             ///< index into RestPositions::ranges
  int stop = -1;                     ///< index of the rigid stop that it is pressed on; -1: none
  double stop_effort = 0;            ///< effort of that stop, N m or N

  /// Natural frequency without damping.
  ///
  /// @returns frequency (Hz); NaN where it is not stable or moves no mass
  double frequency() const;
  /// Damping as a share of that with which it just does not swing.
  ///
  /// @returns ratio; NaN where there is no frequency
  double damping_ratio() const;
};

/// A range of the free input in which the linkage assembles, with the forces along it.
struct RestRange {
  double from = 0, to = 0;    ///< rad or m
  bool full_turn = false;     ///< closes on itself
  bool stop_below = false,    ///< the linkage cannot go beyond `from`: end of the range, of a stroke, stop
      stop_above = false;     ///< the same of `to`
  bool dead_below = false,    ///< a dead point of the input ends it at `from`
      dead_above = false;     ///< the same of `to`
  bool balanced = false;      ///< the forces vanish everywhere: it rests anywhere
  std::vector<double> modes;  ///< signs, one a group
  std::vector<double> value;  ///< samples of the input, rad or m
  std::vector<double> force;  ///< generalised force there, N m or N
  std::vector<double> potential;  ///< energy of weight, springs and struts there, J
};

/// The rest positions of a linkage.
struct RestPositions {
  Status status = Status::done;         ///< no_assembly: nowhere; cancelled, deadline: what is known so far
  std::vector<RestRange> ranges;        ///< ranges in the modes that were asked for
  std::vector<RestPosition> positions;  ///< by range, then by value
};

/// A range of the free input in which friction holds the linkage at rest, wherever it is left.
struct RestBand {
  std::size_t range = 0;    ///< index into RestPositions::ranges
  double from = 0, to = 0;  ///< rad or m
};

/// The rest positions of a range while one load grows: with which multiple of it the linkage rests where.
struct LoadPath {
  /// What happens to a linkage that rests stably without the load as it grows slowly.
  struct Way {
    double from = 0;      ///< value of the free input without the load (rad or m)
    double to = 0;        ///< value at the end of the way
    double factor = 1;    ///< multiple of the load there
    bool snaps = false;   ///< the way ends at a fold, from which the linkage jumps elsewhere
    bool leaves = false;  ///< the way ends at the end of the range
  };
  std::vector<double> value;  ///< samples of the range, rad or m
  std::vector<double>
      factor;  ///< multiple of the load with which it rests there; NaN where the load does no work
  std::vector<double> stable;  ///< 1 where it is stable there, else 0
  std::vector<Way> ways;       ///< by `from`
};

/// The choices of a search for rest positions.
struct RestSearch {
  std::vector<double> inputs;  ///< values of all inputs: those that are held stay there (rad or m)
  std::size_t free = 0;        ///< index of the free input
  /// Range of the free input (rad or m); nothing: all of it, a turn or four sizes of the linkage to each side
  std::optional<std::array<double, 2>> range = {};
  int samples = 720;       ///< samples of each range, 16 at least
  bool all_modes = false;  ///< ranges of all assembly modes; else those of the plan
};

/// All rest positions of a linkage with one free input: zeros of the generalised force Q(q) of weight,
/// springs, struts and loads at rest, on every range in which the linkage assembles. Zeros with a change of
/// sign are found to rounding; those without where the least |Q| is below 1e-9 of its largest value in the
/// range. At ends of a range that is given, and at the ends of the stroke of a gas spring, the linkage rests
/// where Q presses outwards. Friction is left out.
///
/// @param linkage the linkage, with masses and loads that do not depend on time
/// @param plan its plan; with groups without closed form only for linkages with one input
/// @param search the choices
/// @param context cancellation and deadline; null: none
/// @returns ranges and rest positions
/// @throws ContractError if a body has no mass, or the choices do not fit the plan
RestPositions rest_positions(const Linkage& linkage, const LinkagePlan& plan, const RestSearch& search,
                             const RunContext* context = nullptr);

/// The bands in which friction holds a linkage with one input at rest: there its drive may be zero, see
/// HoldingForces. Bands narrower than a sample of the ranges are found where they are about a rest position.
///
/// @param linkage the linkage, with masses and loads that do not depend on time
/// @param plan its plan, with one input
/// @param found its rest positions
/// @param context cancellation and deadline; null: none
/// @returns the bands, by range, then by value
/// @throws ContractError if a body has no mass, or the plan has not one input
std::vector<RestBand> rest_bands(const Linkage& linkage, const LinkagePlan& plan, const RestPositions& found,
                                 const RunContext* context = nullptr);

/// The paths of a load, one a range: the generalised force is affine in the size of the load, so that each
/// position has its multiple, whose extremes are folds.
///
/// @param linkage the linkage, with the load
/// @param unloaded the same linkage without the load
/// @param plan the plan of both
/// @param search the choices of the search for rest positions
/// @param found the rest positions with the load
/// @returns one path a range
/// @throws ContractError as rest_positions does
std::vector<LoadPath> load_paths(const Linkage& linkage, const Linkage& unloaded, const LinkagePlan& plan,
                                 const RestSearch& search, const RestPositions& found);

}  // namespace linkwright::planar
