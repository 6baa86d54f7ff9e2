// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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

}  // namespace linkwright
