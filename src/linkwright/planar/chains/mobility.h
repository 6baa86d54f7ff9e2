// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "linkwright/planar/chains/graph.h"

namespace linkwright::planar {

/// Two links in mesh, both hinged to a third one that keeps their distance.
struct GearPair {
  int carrier = 0;
  int first = 0, second = 0;  ///< first < second
  friend bool operator==(const GearPair&, const GearPair&) = default;
};

/// The instantaneous freedoms of a chain of general proportions, and whether each joint moves in them: by the
/// velocity equations at random positions, exactly modulo a prime.
struct Mobility {
  int freedoms = 0;
  bool each_joint_moves = false;
};
Mobility mobility(const ChainGraph& graph, std::uint32_t sliders, const std::optional<GearPair>& gear = {});

}  // namespace linkwright::planar
