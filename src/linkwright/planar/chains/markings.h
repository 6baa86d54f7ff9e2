// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linkwright/planar/chains/chains.h"
#include "linkwright/planar/chains/mobility.h"

// What makes a chain a mechanism: the link that is held, the joint that is driven, joints that slide, and two
// links that are geared to each other. Two markings are the same if an automorphism of the chain maps one to
// the other.
namespace linkwright::planar {

/// Links count from 0, joints as joints_of() lists them.
struct Marking {
  std::uint32_t sliders = 0;  ///< bit k: joint k slides
  std::optional<GearPair> gear;
  std::optional<int> ground;  ///< link
  std::optional<int> driver;  ///< joint of the ground
  friend bool operator==(const Marking&, const Marking&) = default;
};

struct MarkingChoice {
  int sliders = 0;      ///< number of joints that slide
  bool gear = false;    ///< a gear pair, for chains of two freedoms
  bool ground = false;  ///< the held link
  bool driver = false;  ///< the driven joint of the ground; with `ground` only
};

/// All different markings of a chain, one of each class. Sliders are placed only where the chain keeps its
/// freedoms and all its joints move (see mobility). A gear pair is placed on pins, about any carrier with
/// two neighbours that are not joined to each other; it may lock a part of the chain.
/// Throws ContractError for a driver without ground, and for more sliders than joints.
std::vector<Marking> markings(const Chain& chain, const MarkingChoice& choice);

/// The raw number of placements that `markings` looks at, before symmetry: for limits.
double placements(const ChainGraph& graph, const MarkingChoice& choice);

/// The Assur groups of a mechanism of one freedom, by their number of links and in the order in which they
/// can be solved from the ground and the driven link. Throws ContractError without ground and driver.
std::vector<int> driven_groups(const ChainGraph& graph, const Marking& marking);

/// The link that the driver moves against the ground.
int driven_link(const ChainGraph& graph, const Marking& marking);

}  // namespace linkwright::planar
