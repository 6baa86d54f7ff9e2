// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/balancing/linear_forces.h"

// Balancing by the distribution of masses alone: lengths and motion stay, so that every force is linear in
// the base parameters of the links and every measure of it convex. The best masses are the answer of a cone
// programme: a global optimum with its proof, in milliseconds.
namespace linkwright::planar {

/// A disc that holds all material of a link, in the frame of the link (m).
struct MassEnvelope {
  std::complex<double> centre{0};
  double radius = 0;
};

/// A link whose mass, mass centre and inertia may be chosen, within bounds. Any direction of the mass centre
/// from the own joint. Every mass distribution has an inertia about the mass centre that is not negative; one
/// inside the envelope also I - 2 c.S + |c|^2 m <= R^2 m.
///
/// Two bounds are not convex: the lower one of the centre distance and the upper one of the inertia. They are
/// left out (what follows from them for the inertia about the own joint stays in), and the answer is checked
/// against them.
struct OpenLink {
  static constexpr double infinite = infinity;
  std::size_t link = 0;                ///< index in LinearForces::links
  Range mass{0, infinite};             ///< kg
  Range centre_distance{0, infinite};  ///< m from the own joint
  Range inertia{0, infinite};          ///< kg m2 about the mass centre
  std::optional<MassEnvelope> envelope = {};
};

/// A point mass added to a link. With an angle it lies on that ray from the own joint; radius lower = upper:
/// at that distance, else within. Without an angle the programme lets it spread out over the disc (or circle)
/// of the radius, or over the rectangle that is given instead of radius and angle; whether the answer is a
/// point is reported.
struct Counterweight {
  std::string name;
  std::size_t link = 0;              ///< index in LinearForces::links
  Range mass{0, 0};                  ///< kg
  Range radius{0, 0};                ///< m from the own joint
  std::optional<double> angle = {};  ///< rad from the link line; without: any
  /// x and y in the frame of the link (m); radius and angle do not count then.
  std::optional<std::array<Range, 2>> rectangle = {};
};

/// One quantity to be made small, over its reference.
struct ForceObjective {
  std::string quantity;  ///< "shaking_force_x_N", or a magnitude: "O1_N"; see LinearForces
  Measure measure = Measure::rms;
  double weight = 1;                     ///< >= 0; 0 when it is there for its limit only
  std::optional<double> reference = {};  ///< > 0, N or N m; default: the value of the initial masses
  std::optional<double> at_most = {};    ///< limit, N or N m
};

/// The rule by which several objectives become one cost.
enum class ForceCost {
  sum,     ///< sum of weight times value over reference
  largest  ///< largest weight times value over reference
};

struct MassBalancing {
  LinearForces forces;
  std::vector<OpenLink> links;  ///< all others keep their initial masses
  std::vector<Counterweight> counterweights;
  std::vector<ForceObjective> objectives;
  ForceCost cost = ForceCost::sum;
};

/// A bound or limit that the answer rests on.
struct ActiveBound {
  std::string name;  ///< "mass of coupler", "O1_x_N (rms)"
  double limit = 0;  ///< SI
  /// By how much the least cost grows for each unit that the limit is raised: negative for upper bounds.
  double price = 0;
};

struct PlacedCounterweight {
  PointMass mass;
  double spread = 0;  ///< kg m2 of inertia about its centre: 0 for a point
};

struct BalancedMasses {
  /// done; infeasible: limits and bounds cannot hold together, and `active` are those that contradict; status
  /// of the motion when it has no answer somewhere; not_converged, deadline, cancelled.
  Status status = Status::done;
  std::vector<LinkMass> links;  ///< one a link of LinearForces, without counterweights; angles in [0, 2 pi)
  std::vector<PlacedCounterweight> counterweights;
  std::vector<BaseParameters> bases;  ///< one a link, with its counterweights
  std::vector<double> before, after;  ///< one an objective: its measure with the initial masses, and now
  double cost = infinity;             ///< cost of the answer, from `after`
  /// No masses within the convex bounds cost less (weak duality, see optimise::ConeReport).
  double lower_bound = -infinity;
  /// (cost - lower_bound) / cost; for a cost that vanishes over a thousandth of that of the initial masses.
  double gap = infinity;
  std::vector<ActiveBound> active;  ///< largest effect (price times limit) first
  /// Bounds without convexity that the answer breaks, in words; empty: it is the global optimum.
  std::vector<std::string> broken;
  int iterations = 0;

  /// The optimum is global and proved.
  bool global() const { return status == Status::done && broken.empty() && gap < 1e-8; }
};

/// The best masses. Inertias that affect no objective are unchanged, moved into their bounds; other numbers
/// that the cost does not determine take a value in the middle of what is left to them.
///
/// Throws ContractError for indices that do not exist, a link given twice, bounds that are not ordered or
/// negative, quantities that do not exist, weights or references out of range, a reference that is not given
/// where the initial value is 0, no objective or nothing to choose.
BalancedMasses balance(const MassBalancing& balancing, RunContext& context);

/// Measures of all objectives for given base parameters, one a link.
std::vector<double> force_measures(const MassBalancing& balancing, std::span<const BaseParameters> links);

}  // namespace linkwright::planar
