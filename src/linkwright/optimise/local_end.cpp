#include "linkwright/optimise/nlopt_bridge.h"

namespace linkwright::optimise {

std::string_view to_string(LocalEnd end) {
  switch (end) {
    case LocalEnd::step:
      return "step";
    case LocalEnd::decrease:
      return "decrease";
    case LocalEnd::success:
      return "success";
    case LocalEnd::rounding:
      return "rounding";
    case LocalEnd::evaluations:
      return "evaluations";
    case LocalEnd::not_finite:
      return "not_finite";
    case LocalEnd::interrupted:
      return "interrupted";
    case LocalEnd::failed:
      break;
  }
  return "failed";
}

Status status_of(LocalEnd end, double violation, Status interruption) {
  if (end == LocalEnd::interrupted) return interruption;
  if (violation > 0) return Status::infeasible;
  const bool converged = end == LocalEnd::step || end == LocalEnd::decrease || end == LocalEnd::success ||
                         end == LocalEnd::rounding;
  return converged ? Status::done : Status::not_converged;
}

}  // namespace linkwright::optimise
