// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/statics.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/flexible/links.h"

namespace linkwright::flexible {

namespace {

// Beyond this turn in one joint a step of Newton's method has left the place where it holds.
constexpr double max_turn = 1;

}  // namespace

Equilibrium equilibrium(const Chain& chain, const TipLoad& load, const EquilibriumOptions& options) {
  LINKWRIGHT_REQUIRE(chain.kinematics != Kinematics::source_linearised,
                     "source_linearised has no equilibrium of large deflections");
  Equilibrium out{.state = state_at_rest(chain)};
  out.state.angle = options.angle;
  ChainEquations equations(chain);
  const std::vector<std::size_t> joints = hinges(chain);
  LINKWRIGHT_REQUIRE(options.turns.empty() || options.turns.size() == joints.size(), "{} turns of {} hinges",
                     options.turns.size(), joints.size());
  for (std::size_t k = 0; k < options.turns.size(); ++k) {
    equations.lock_turn(joints[k]);
    out.state.q[coordinates_per_cell * joints[k] + turn] = options.turns[k];
  }
  std::vector<double> change(out.state.q.size());
  const auto evaluate = [&](ChainState& state, double share) {
    state.rate = share * options.speed;
    return equations.evaluate(state, {share * load.force, share * load.couple});
  };
  double part = 1;
  while (out.share < 1) {
    ChainState trial = out.state;
    const double share = std::min(1.0, out.share + part);
    bool met = false, regular = true;
    for (int i = 0; i <= options.max_iterations; ++i) {
      evaluate(trial, share);
      met = equations.relative_residual() <= options.tolerance;
      if (met || !std::isfinite(equations.relative_residual()) || i == options.max_iterations) break;
      regular = equations.factor({}, false);
      if (!regular) break;
      equations.solve(equations.residual(), 0, change);
      ++out.iterations;
      double most = 0;
      for (std::size_t s = turn; s < change.size(); s += coordinates_per_cell)
        most = std::max(most, std::abs(change[s]));
      if (most > max_turn) break;
      for (std::size_t k = 0; k < change.size(); ++k) trial.q[k] += change[k];
    }
    if (met) {
      out.state = trial;
      out.share = share;
      part *= 2;
    } else if ((part /= 2) < 1e-4) {
      out.status = regular ? Status::not_converged : Status::singular;
      break;
    }
  }
  out.forces = evaluate(out.state, out.share);
  equations.factor({}, false);
  out.unstable = equations.negative();
  return out;
}

Deflection deflection_of(const Chain& chain, std::span<const double> change) {
  LINKWRIGHT_REQUIRE(change.size() == coordinates_per_cell * chain.cells.size(), "{} changes for {} cells",
                     change.size(), chain.cells.size());
  Deflection out{.eta = {0}, .angle = {0}};
  for (std::size_t s = 0; s < chain.cells.size(); ++s) {
    const double l = chain.cells[s].length, angle = out.angle.back(),
                 delta = change[coordinates_per_cell * s + turn];
    out.eta.push_back(out.eta.back() + change[coordinates_per_cell * s + slide] + l * angle + l / 2 * delta);
    out.angle.push_back(angle + delta);
  }
  return out;
}

Deflection linear_deflection(const Chain& chain, const TipLoad& load) {
  ChainEquations equations(chain);
  const ChainState rest = state_at_rest(chain);
  // The stiffness is that of the unloaded link: forces of the evaluation before the tangent would add theirs.
  equations.evaluate(rest, load);
  const std::vector<double> residual(equations.residual().begin(), equations.residual().end());
  equations.evaluate(rest);
  std::vector<double> change(residual.size());
  const bool regular = equations.factor({}, false);
  LINKWRIGHT_REQUIRE(regular, "a joint of the chain without stiffness");
  equations.solve(residual, 0, change);
  return deflection_of(chain, change);
}

}  // namespace linkwright::flexible
