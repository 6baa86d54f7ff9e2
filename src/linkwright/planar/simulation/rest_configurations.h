// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/simulation/rest_positions.h"

namespace linkwright::planar {

/// A rest position of a linkage with several free inputs. Matrices are those of small motions about it,
/// M q'' + C q' + K q = 0, row by row in the order of the free inputs that no stop holds.
struct RestConfiguration {
  RestKind kind = RestKind::stable;  ///< its stability
  std::vector<double> values;        ///< of the free inputs, rad or m
  std::vector<double> stiffness;     ///< K = -dQ/dq
  std::vector<double> masses;        ///< M
  std::vector<double> dampings;      ///< C
  std::vector<std::complex<double>>
      vibrations;        ///< eigenvalues with an imaginary part above 0, slowest first, 1/s
  double potential = 0;  ///< of weight, springs and struts, J
  /// Efforts of the stops of the linkage (N m or N): more than 0 of a rigid one that holds its joint, else 0.
  std::vector<double> stops;
};

/// Rest positions that a search has found.
struct RestConfigurations {
  Status status = Status::done;          ///< no_assembly: at no start; cancelled, deadline: so far
  std::vector<RestConfiguration> found;  ///< least potential energy first
  long starts = 0;                       ///< starts of Newton's method
};

/// The choices of a search with several free inputs.
struct RestGrid {
  std::vector<double> inputs;     ///< values of all inputs: those that are held stay there (rad or m)
  std::vector<std::size_t> free;  ///< indices of the free inputs
  int starts = 0;                 ///< starts along each free input; 0: as many as make some hundreds in all
};

/// Rest positions of a linkage with several free inputs, in the assembly modes of its plan: Newton's method
/// from a grid of starts, a turn of each angle and four sizes of the linkage to each side of each
/// displacement, with those that are known removed by deflation. A search cannot say that it has found all.
/// Where the stiffness is symmetric it decides on the stability; else, with loads that turn with a body, the
/// eigenvalues of the small motions do: one that grows and swings is flutter. On rigid stops the linkage
/// rests where each stop that holds its joint pushes; it is at the end of its range (RestKind::at_end) where
/// stops hold all free inputs.
///
/// @param linkage the linkage, with masses and loads that do not depend on time; rigid stops are on free
/// inputs
/// @param plan its plan, in closed form
/// @param grid the choices
/// @param context cancellation and deadline; null: none
/// @returns the rest positions
/// @throws ContractError if a body has no mass, the plan is not in closed form, or the choices do not fit
RestConfigurations rest_configurations(const Linkage& linkage, const LinkagePlan& plan, const RestGrid& grid,
                                       const RunContext* context = nullptr);

}  // namespace linkwright::planar
