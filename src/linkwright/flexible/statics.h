// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/chain_equations.h"

/// The link at rest against its hub.
namespace linkwright::flexible {

struct EquilibriumOptions {
  double angle = 0;  ///< angle of the hub (rad); matters under gravity
  double speed = 0;  ///< speed of the hub, steady (rad/s)
  /// Turns at which all hinges are held (rad); empty: they turn about their springs.
  std::span<const double> turns = {};
  /// Tolerance of the residuals, relative to the largest force and couple in the chain.
  double tolerance = 1e-11;
  int max_iterations = 40;  ///< Newton steps for each part of the load
};

struct Equilibrium {
  /// done; not_converged: the load could be raised no further, the state is that of `share` of it; singular:
  /// the link is about to buckle there.
  Status status = Status::done;
  ChainState state;
  ChainForces forces;
  double share = 0;  ///< share of load and speed reached, 1 = all
  int unstable = 0;  ///< negative eigenvalues of the stiffness: 0 = stable
  int iterations = 0;
};

/// Large deflections under a load at the tip that keeps its direction in the axes of the hub: Newton's method
/// with the exact stiffness, the load raised in parts where it must be. Not of source_linearised, whose
/// equations come from no potential (ContractError).
Equilibrium equilibrium(const Chain& chain, const TipLoad& load, const EquilibriumOptions& options = {});

/// Small deflections of the nodes 0, 1, ..., N under a load at the tip, linear.
struct Deflection {
  std::vector<double> eta;    ///< m
  std::vector<double> angle;  ///< rad
};
Deflection linear_deflection(const Chain& chain, const TipLoad& load);

/// Deflection and angle at the nodes of small changes dq of the straight chain.
Deflection deflection_of(const Chain& chain, std::span<const double> change);

}  // namespace linkwright::flexible
