// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace linkwright::planar {

constexpr int max_chain_links = 12;

/// A kinematic chain as a graph: links are its vertices, joints its edges. Links are numbered from 0.
struct ChainGraph {
  int links = 0;
  /// Bit b of entry a: a joint connects links a and b.
  std::array<std::uint16_t, max_chain_links> neighbours{};

  bool joined(int a, int b) const { return (neighbours[static_cast<std::size_t>(a)] >> b & 1) != 0; }
  void join(int a, int b);
  /// Number of joints of a link: 2 of a binary link, 3 of a ternary one.
  int degree(int link) const;
  int joints() const;
  friend bool operator==(const ChainGraph&, const ChainGraph&) = default;
  friend bool operator<(const ChainGraph& a, const ChainGraph& b) {
    return std::tie(a.links, a.neighbours) < std::tie(b.links, b.neighbours);
  }
};

using JointEnds = std::array<int, 2>;  ///< the two links of a joint, the smaller number first
/// The joints in the order of their links: index k names joint k wherever joints are numbered.
std::vector<JointEnds> joints_of(const ChainGraph& graph);

/// New number of each link.
using Labelling = std::array<std::uint8_t, max_chain_links>;
ChainGraph relabelled(const ChainGraph& graph, const Labelling& labelling);

/// The numbering of links that does not depend on the one that they had.
struct CanonicalForm {
  ChainGraph graph;
  /// All labellings of the original graph that give `graph`: as many as it has automorphisms.
  std::vector<Labelling> labellings;
};
/// The least adjacency code over the leaves of a search: links are told apart by the links that they are
/// joined to (colour refinement), and where that leaves links alike, each of them is singled out in turn.
/// `colours` tells links apart from the beginning (ground, crank); empty = all are alike.
CanonicalForm canonical_form(const ChainGraph& graph, std::span<const int> colours = {});
/// The labellings of a graph that change nothing, the identity among them.
std::vector<Labelling> automorphisms(const ChainGraph& graph);

/// Degree of freedom by Gruebler's formula, all joints being pins: 3 (links - 1) - 2 joints.
int freedoms(const ChainGraph& graph);
/// True if some of the links, but not all, have no freedom among themselves: 3 (links - 1) - 2 joints < 1.
bool has_rigid_part(const ChainGraph& graph);

/// The links that are joined to `start`, directly or through others, within a set of links that holds it; bit
/// k of a set stands for link k.
unsigned connected_links(const ChainGraph& graph, unsigned within, int start);

}  // namespace linkwright::planar
