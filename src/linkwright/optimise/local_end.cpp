// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/nlopt_bridge.h"

namespace linkwright::optimise {

Status status_of(LocalEnd end, double violation, Status interruption) {
  if (end == LocalEnd::interrupted) return interruption;
  if (violation > 0) return Status::infeasible;
  const bool converged = end == LocalEnd::step || end == LocalEnd::decrease || end == LocalEnd::success ||
                         end == LocalEnd::rounding;
  return converged ? Status::done : Status::not_converged;
}

}  // namespace linkwright::optimise
