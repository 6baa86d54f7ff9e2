// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/flexible/chain.h"

/// Several links in a row on one hub.
namespace linkwright::flexible {

/// A joint at the tip of a link that carries the next one.
struct Hinge {
  double stiffness = 0;      ///< stiffness of a spring, without torque where both links are in line (N m)
  double damping = 0;        ///< N m s
  double mass = 0;           ///< mass of joint and motor (kg)
  double inner_inertia = 0;  ///< moment of inertia that turns with the inner link (kg m2)
  double outer_inertia = 0;  ///< moment of inertia that turns with the outer link (kg m2)
};

/// The chain with a further link of `divisions` divisions welded on in line, of another section as the case
/// may be: stepped links.
///
/// Throws ContractError for a hub or gravity at the further link, whose place these are not; for damping of
/// its material that is not that of the chain; and for source_linearised.
Chain weld(const Chain& inner, const Beam& outer, int divisions);

/// The same with a hinge between. Motors in hinges: HingeDrive (simulation.h).
Chain hinge(const Chain& inner, const Hinge& joint, const Beam& outer, int divisions);

/// Indices of the hinges among the cells, from the hub outwards.
std::vector<std::size_t> hinges(const Chain& chain);

}  // namespace linkwright::flexible
