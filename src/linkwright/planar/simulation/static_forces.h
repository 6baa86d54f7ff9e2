// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The forces of a linkage at rest in the coordinates of its free inputs: by virtual work, the generalised
/// force Q_j of weight, springs, struts and loads along input j (N m or N), and the masses and dampers that a
/// small motion about the place has. Holds all memory: use it again and again.
class StaticForces {
 public:
  /// Linkage and plan must outlive this.
  ///
  /// @param linkage the linkage, with masses and loads
  /// @param plan its plan
  /// @param free indices of the free inputs; the others are held
  /// @param assembly places general groups on their mode; null: the modes of `motion` place the linkage
  /// @throws ContractError if a body has no mass (see LinkagePlan::massless), or there is no such input
  StaticForces(const Linkage& linkage, const LinkagePlan& plan, std::vector<std::size_t> free,
               LinkageAssembly* assembly = nullptr);

  /// Places the linkage and finds its forces.
  ///
  /// @param values values of all inputs (rad or m)
  /// @returns done; the status of the position where it is not done; limit_reached where a gas spring would
  ///   be beyond its stroke, or a joint beyond a rigid stop
  Status solve(std::span<const double> values);

  /// Mass matrix of the free inputs at the last `solve`, row by row (kg m2, kg m or kg).
  std::vector<double> masses() const;
  /// Derivatives of the generalised forces by the rates, with the opposite sign, row by row: those of dampers
  /// and of loads that go by speed, for slow motion about the last `solve`.
  std::vector<double> dampings();
  /// Energy of weight, springs and struts at the last `solve` (J).
  double potential() const;

  LinkageMotion motion;       ///< position of the last `solve`; set `motion.modes` to change assembly modes
  std::vector<double> force;  ///< generalised force along each free input (N m or N)
  double scale = 0;           ///< the sum of the sizes of what the forces consist of (N m or N)
  std::vector<double> stop_rates;  ///< of the gap of each stop for a unit rate of the first free input

 private:
  struct PartRate {
    math::Vec2 velocity;
    double speed;
  };
  std::vector<double> along_inputs();

  const Linkage& l_;
  const LinkagePlan& plan_;
  std::vector<std::size_t> free_;
  LinkageAssembly* assembly_;
  std::vector<InputMotion> inputs_;
  std::vector<PartRate> rates_;  // parts of an input after those of the input before
  std::vector<AppliedLoad> loads_;
};

}  // namespace linkwright::planar
