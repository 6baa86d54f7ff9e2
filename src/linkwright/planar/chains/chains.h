// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/chains/graph.h"

// All planar kinematic chains of a number of links and freedoms, by ears: every chain without a cut link is a
// cycle to which paths of further links are added, as many as it has independent loops less one.
namespace linkwright::planar {

/// A chain with its links in canonical order.
struct Chain {
  ChainGraph graph;
  std::vector<Labelling> automorphisms;
  /// Number in the list of all chains of as many links and freedoms, from 1: fixed forever.
  int rank = 1;
  /// A link whose removal leaves two parts; such chains have a list of their own.
  bool fractionated = false;
  /// The chain in the tables of this program: "8-07", and "8F3-2", "9-c05" for three freedoms and for a
  /// fractionated one.
  std::string name;
};

/// Number of links of each degree, that of binary links first: {4, 4} of "3333 2222".
std::vector<int> assortment(const ChainGraph& graph);
/// "3333 2222": the degrees of the links, in groups.
std::string assortment_text(const ChainGraph& graph);

/// All graphs without a cut vertex, each once, in canonical form and in order of their codes.
/// Throws ContractError for less than 3 or more than `max_chain_links` links.
std::vector<ChainGraph> two_connected_graphs(int links, int joints);

/// True if chains of so many links and pins can have so many freedoms: 3 (links - 1) - freedoms is even, and
/// the chain closes (links >= freedoms + 3).
bool chain_can_exist(int links, int freedoms);

/// All chains without cut links and without rigid parts, by assortment and then by code. Stops early, with
/// the list incomplete, when the context says so. Throws ContractError for a combination that cannot exist.
std::vector<Chain> chains(int links, int freedoms, const RunContext& context = {});
/// All chains with at least one cut link, each part of which is such a chain: parts turn independently about
/// the links that they share, and their freedoms add up.
std::vector<Chain> fractionated_chains(int links, int freedoms, const RunContext& context = {});

}  // namespace linkwright::planar
