#include "linkwright/core/status.h"

namespace linkwright {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::no_assembly:
      return "no_assembly";
    case Status::singular:
      return "singular";
    case Status::not_converged:
      return "not_converged";
    case Status::branch_lost:
      return "branch_lost";
    case Status::limit_reached:
      return "limit_reached";
    case Status::at_rest:
      return "at_rest";
    case Status::self_locking:
      return "self_locking";
    case Status::infeasible:
      return "infeasible";
    case Status::deadline:
      return "deadline";
    case Status::cancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace linkwright
