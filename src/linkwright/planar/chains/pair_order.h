// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "linkwright/planar/chains/markings.h"

// Machines that are built from ground and crank by adding pairs of bars (dyads), one after the other: each of
// their positions follows from triangles.
namespace linkwright::planar {

/// Link 0 is the ground and link 1 the crank. Pair k, counted from 0, hinges bar 2k + 2 to the first of its
/// two links and bar 2k + 3 to the second one, and both bars to each other. The first pair joins (1, 0).
struct PairProgram {
  std::vector<std::array<int, 2>> pairs;
  std::optional<int> traced;  ///< the bar with the traced point

  int links() const { return 2 * static_cast<int>(pairs.size()) + 2; }
  ChainGraph graph() const;
  friend bool operator==(const PairProgram&, const PairProgram&) = default;
  friend bool operator<(const PairProgram& a, const PairProgram& b) {
    return std::tie(a.pairs, a.traced) < std::tie(b.pairs, b.traced);
  }
};

/// All sequences of pairs, in order: 1, 12, 360 for 1, 2, 3 pairs.
std::vector<PairProgram> pair_sequences(int pairs);
/// One of each machine (chain, ground and driver): the first sequence of those that give it.
std::vector<PairProgram> pair_machines(int pairs);
/// One of each machine with a traced bar that is not hinged to the ground and whose motion needs every pair.
/// With `own_curves`, those are left out whose traced bar is moved through a single link that is hinged to
/// the ground: its points trace curves that the smaller chain behind that link traces, too.
std::vector<PairProgram> traced_pair_machines(int pairs, bool own_curves);

/// The program of a mechanism without sliders, as `pair_machines` lists it; nothing when it is not built of
/// pairs alone. Throws ContractError without ground and driver.
std::optional<PairProgram> pair_program(const ChainGraph& graph, const Marking& marking);

/// "four-bar", "six-bar 23", "eight-bar 13-24 b": the pairs behind the first one, and the traced bar of the
/// last pair.
std::string program_name(const PairProgram& program);

}  // namespace linkwright::planar
