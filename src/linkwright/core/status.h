// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "linkwright/core/field.h"

namespace linkwright {

/// The end of a computation. Physics that says no is an answer, not an exception: the good part of a result
/// is kept, and the status says why the rest is missing.
enum class Status {
  done,           ///< everything that was asked for
  no_assembly,    ///< the links do not reach each other at this input
  singular,       ///< dead point or rank loss: the answer is not determined
  not_converged,  ///< iteration stopped before its tolerance
  branch_lost,    ///< continuation could not stay on the branch it followed
  limit_reached,  ///< motion stopped at a limit
  other_circuit,  ///< the links reach each other, but the motion does not come there from where it starts
  at_rest,        ///< friction brought the motion to rest and holds it: an answer, complete up to there
  self_locking,   ///< friction blocks: no finite force of the drives keeps the motion going
  infeasible,     ///< no candidate met every constraint; the least violated one is returned
  deadline,       ///< time limit reached: best so far
  cancelled,      ///< asked to stop: best so far
};

constexpr std::array<EnumName<Status>, 12> names(Status) {
  return {{{Status::done, "done"},
           {Status::no_assembly, "no_assembly"},
           {Status::singular, "singular"},
           {Status::not_converged, "not_converged"},
           {Status::branch_lost, "branch_lost"},
           {Status::limit_reached, "limit_reached"},
           {Status::other_circuit, "other_circuit"},
           {Status::at_rest, "at_rest"},
           {Status::self_locking, "self_locking"},
           {Status::infeasible, "infeasible"},
           {Status::deadline, "deadline"},
           {Status::cancelled, "cancelled"}}};
}

/// @param status any status
/// @returns the name used in files and tables: "no_assembly"
constexpr std::string_view to_string(Status status) { return name_of(status); }

/// One reason why a candidate is not feasible; amounts are dimensionless and comparable, 0 = met.
struct Violation {
  std::string reason;  ///< name of the constraint: "crank_rotates_fully"
  double amount = 0;   ///< dimensionless, >= 0
};

/// "Better" by the feasibility rules of Deb (2000): feasible before infeasible, then by cost; infeasible ones
/// by violation.
///
/// @param cost_a cost of the one
/// @param violation_a sum of its violations, 0 = feasible
/// @param cost_b cost of the other
/// @param violation_b sum of its violations
/// @returns true if the one is better
inline bool better(double cost_a, double violation_a, double cost_b, double violation_b) {
  if (violation_a > 0 || violation_b > 0) {
    if (violation_a != violation_b) return violation_a < violation_b;
  }
  return cost_a < cost_b;
}

}  // namespace linkwright
