// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/chain_equations.h"
#include "linkwright/flexible/links.h"

/// Arms of elastic links in series: which part of the chain is which link, and the loads on each link.
namespace linkwright::flexible {

struct ArmLink {
  Beam beam;
  int divisions = 4;
  std::optional<Hinge> hinge;  ///< hinge that carries it; none: it is welded on in line
};

/// An arm as a chain, and the nodes at the ends of its links.
struct ArmChain {
  struct Link {
    std::size_t root = 0, tip = 0;     ///< nodes
    std::optional<std::size_t> hinge;  ///< cell of the hinge that carries it
  };
  Chain chain;
  std::vector<Link> links;
};

/// The first link is welded to the hub, whose data and gravity it holds (links.h); the others have none.
///
/// Throws ContractError without links, for a hinge of the first one, and as discretise, weld and hinge do.
ArmChain arm_chain(std::span<const ArmLink> links, Kinematics kinematics = Kinematics::chord_consistent);

/// The coordinates with the hinges turned as they are, and the links bent `share` times as much: 0 is the
/// rigid arm. One entry a coordinate.
std::vector<double> bent(const Chain& chain, std::span<const double> q, double share);

/// A displacement of the tip from where the rigid arm with the same turns of hub and hinges has it (m): along
/// and across the last link of that arm.
struct TipDisplacement {
  double along = 0, across = 0;
};
TipDisplacement tip_displacement(const Chain& chain, std::span<const double> q);

/// Cuts of one link: at its root, at all of its joints and at its tip, inside the masses there. Positions
/// count from its root. `equations` have evaluated `state`. Not of source_linearised (ContractError).
std::vector<SectionForce> link_sections(const ArmChain& arm, std::size_t link,
                                        const ChainEquations& equations, const ChainState& state);

/// Force of the inner link on the outer one in each hinge, axes of the ground (N), from the hub outwards.
std::vector<math::Vec2> hinge_forces(const ArmChain& arm, const ChainEquations& equations,
                                     const ChainState& state);

}  // namespace linkwright::flexible
