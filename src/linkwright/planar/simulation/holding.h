// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The drives, or loads, with which friction keeps a linkage at rest in a position.
struct HoldingRange {
  Status status = Status::done;  ///< status of the position; not_converged where no force was found
  double least = 0,  ///< N m or N; -infinity: however small, friction jams the linkage in that sense
      greatest = 0;  ///< N m or N; infinity: however large
  double without_friction = 0;  ///< the one that holds it without friction
};

/// The statics of a linkage with one input, at rest with friction. Least and greatest drive are those at
/// which the linkage is about to move in the one and the other sense, with all friction against that motion
/// and its sizes by the joint forces (see settle_friction); in between it stays where it is.
class HoldingForces {
 public:
  /// Linkage and plan must outlive this.
  ///
  /// @param linkage the linkage, with masses and loads
  /// @param plan its plan
  /// @param load index of the force of Linkage::forces that is unknown, while the drive is free; nothing: the
  ///   drive is unknown
  /// @throws ContractError if the plan has not one input, a body has no mass, or there is no such force
  HoldingForces(const Linkage& linkage, const LinkagePlan& plan, std::optional<std::size_t> load = {});

  /// The range in a position.
  ///
  /// @param value value of the input (rad or m)
  /// @param placed a motion in that position, whose assembly modes are taken
  /// @param time time for load tables (s)
  /// @returns the range of the drive (N m or N), or of the size of the force (N)
  HoldingRange range(double value, const LinkageMotion& placed, double time);

  /// The self-locking margin in a position: one over the factor on all coefficients of friction with which
  /// the linkage just stays without drive, or without the unknown force. From 1 on it locks by itself.
  ///
  /// @param value value of the input (rad or m)
  /// @param placed a motion in that position, whose assembly modes are taken
  /// @param time time for load tables (s)
  /// @returns the margin; 0 where no friction holds it, infinity where it is balanced without
  double self_locking_margin(double value, const LinkageMotion& placed, double time);

 private:
  HoldingRange drives(double time);
  std::optional<double> drive(double sense, double time);
  void set_friction(double factor);
  void set_load(double size);
  bool place(double value, const LinkageMotion& placed);

  const Linkage& original_;
  Linkage l_;
  const LinkagePlan& plan_;
  std::optional<std::size_t> load_;
  std::vector<InputMotion> inputs_;
  LinkageMotion motion_;
  LinkageForces forces_;
};

/// The sizes of a load with which friction holds a linkage with several free inputs at rest.
struct HeldLoad {
  /// done; the status of the position; infeasible where no size holds it; singular where an input moves no
  /// mass
  Status status = Status::done;
  double least = 0,         ///< N; -infinity: however small
      greatest = 0;         ///< N; infinity: however large
  double margin = 0;        ///< as HoldingForces::self_locking_margin
  int least_slips = -1,     ///< index of the joint that slips below `least`; -1: none
      greatest_slips = -1;  ///< the same above `greatest`
};

/// Statics with friction for any number of free inputs: the linkage stays as long as there are efforts of its
/// joints within what they bear. The least possible share of that which the most loaded joint needs is convex
/// in the load, and 1 at the ends of the range.
///
/// @param linkage the linkage, with masses and loads, in which every input moves a mass
/// @param plan its plan
/// @param load index of the force of Linkage::forces whose size is sought
/// @param values values of all inputs, all of them free (rad or m)
/// @param placed a motion in that position, whose assembly modes are taken
/// @param time time for load tables (s)
/// @returns the range
/// @throws ContractError if a body has no mass, or there is no such force
HeldLoad held_load(const Linkage& linkage, const LinkagePlan& plan, std::size_t load,
                   std::span<const double> values, const LinkageMotion& placed, double time);

}  // namespace linkwright::planar
