// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/graph.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

// Colours 0, 1, 2, ... of the links; links of different colours are in the order of their colours.
using Colours = std::array<std::uint8_t, max_chain_links>;

int count_colours(const Colours& colours, int links) {
  return 1 + *std::max_element(colours.begin(), colours.begin() + links);
}

// The colour of a link and the number of its neighbours of each colour, four bits each.
std::pair<std::uint8_t, std::uint64_t> signature(const ChainGraph& graph, const Colours& colours, int link) {
  std::uint64_t around = 0;
  for (unsigned rest = graph.neighbours[at(link)]; rest != 0; rest &= rest - 1)
    around += std::uint64_t{1} << 4 * colours[at(std::countr_zero(rest))];
  return {colours[at(link)], around};
}

// Splits colours until links of one colour have the same neighbours by colour.
void refine(const ChainGraph& graph, Colours& colours) {
  using Signature = std::pair<std::uint8_t, std::uint64_t>;
  std::array<Signature, max_chain_links> own, sorted;
  for (int before = 0, now = count_colours(colours, graph.links); now != before && now < graph.links;) {
    for (int v = 0; v < graph.links; ++v) own[at(v)] = signature(graph, colours, v);
    sorted = own;
    const auto begin = sorted.begin(), end = begin + graph.links;
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    for (int v = 0; v < graph.links; ++v)
      colours[at(v)] = static_cast<std::uint8_t>(std::lower_bound(begin, last, own[at(v)]) - begin);
    before = std::exchange(now, static_cast<int>(last - begin));
  }
}

// Links of the first colour that several links have; empty when each has its own.
unsigned first_alike(const ChainGraph& graph, const Colours& colours) {
  std::array<unsigned, max_chain_links> members{};
  for (int v = 0; v < graph.links; ++v) members[colours[at(v)]] |= 1u << v;
  for (const unsigned set : members)
    if (std::popcount(set) > 1) return set;
  return 0;
}

void search(const ChainGraph& graph, Colours colours, CanonicalForm& best) {
  refine(graph, colours);
  const unsigned alike = first_alike(graph, colours);
  if (alike == 0) {
    const ChainGraph leaf = relabelled(graph, colours);
    if (best.labellings.empty() || leaf < best.graph) best = {leaf, {}};
    if (leaf == best.graph) best.labellings.push_back(colours);
    return;
  }
  for (unsigned rest = alike; rest != 0; rest &= rest - 1) {
    const int single = std::countr_zero(rest);
    Colours next = colours;
    for (int v = 0; v < graph.links; ++v)
      if (v != single && colours[at(v)] >= colours[at(single)]) ++next[at(v)];
    search(graph, next, best);
  }
}

}  // namespace

void ChainGraph::join(int a, int b) {
  neighbours[at(a)] = static_cast<std::uint16_t>(neighbours[at(a)] | 1u << b);
  neighbours[at(b)] = static_cast<std::uint16_t>(neighbours[at(b)] | 1u << a);
}

int ChainGraph::degree(int link) const { return std::popcount(neighbours[at(link)]); }

int ChainGraph::joints() const {
  int ends = 0;
  for (int v = 0; v < links; ++v) ends += degree(v);
  return ends / 2;
}

std::vector<JointEnds> joints_of(const ChainGraph& graph) {
  std::vector<JointEnds> out;
  for (int a = 0; a < graph.links; ++a)
    for (int b = a + 1; b < graph.links; ++b)
      if (graph.joined(a, b)) out.push_back({a, b});
  return out;
}

ChainGraph relabelled(const ChainGraph& graph, const Labelling& labelling) {
  ChainGraph out{.links = graph.links};
  for (int a = 0; a < graph.links; ++a)
    for (unsigned rest = graph.neighbours[at(a)]; rest != 0; rest &= rest - 1)
      out.neighbours[labelling[at(a)]] = static_cast<std::uint16_t>(
          out.neighbours[labelling[at(a)]] | 1u << labelling[at(std::countr_zero(rest))]);
  return out;
}

CanonicalForm canonical_form(const ChainGraph& graph, std::span<const int> colours) {
  LINKWRIGHT_REQUIRE(graph.links >= 1 && graph.links <= max_chain_links, "1 to {} links, got {}",
                     max_chain_links, graph.links);
  LINKWRIGHT_REQUIRE(colours.empty() || std::ssize(colours) == graph.links,
                     "one colour a link, got {} for {}", colours.size(), graph.links);
  Colours start{};
  std::vector<int> distinct(colours.begin(), colours.end());
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  for (std::size_t v = 0; v < colours.size(); ++v)
    start[v] = static_cast<std::uint8_t>(std::lower_bound(distinct.begin(), distinct.end(), colours[v]) -
                                         distinct.begin());
  CanonicalForm best;
  search(graph, start, best);
  return best;
}

std::vector<Labelling> automorphisms(const ChainGraph& graph) {
  const CanonicalForm form = canonical_form(graph);
  // The first labelling and then the inverse of another one.
  std::vector<Labelling> out;
  for (const Labelling& labelling : form.labellings) {
    Labelling inverse{}, product{};
    for (int v = 0; v < graph.links; ++v) inverse[labelling[at(v)]] = static_cast<std::uint8_t>(v);
    for (int v = 0; v < graph.links; ++v) product[at(v)] = inverse[form.labellings.front()[at(v)]];
    out.push_back(product);
  }
  return out;
}

int freedoms(const ChainGraph& graph) { return 3 * (graph.links - 1) - 2 * graph.joints(); }

bool has_rigid_part(const ChainGraph& graph) {
  const unsigned all = (1u << graph.links) - 1;
  std::array<std::uint8_t, 1u << max_chain_links> inner;  // joints among the links of a set
  inner[0] = 0;
  for (unsigned set = 1; set < all; ++set) {
    const unsigned without = set & (set - 1);
    const int link = std::countr_zero(set);
    inner[set] = static_cast<std::uint8_t>(inner[without] +
                                           std::popcount(unsigned{graph.neighbours[at(link)]} & without));
    if (without != 0 && 3 * (std::popcount(set) - 1) - 2 * inner[set] < 1) return true;
  }
  return false;
}

unsigned connected_links(const ChainGraph& graph, unsigned within, int start) {
  unsigned out = 1u << start;
  for (unsigned before = 0; before != out;) {
    before = out;
    for (unsigned rest = before; rest != 0; rest &= rest - 1)
      out |= graph.neighbours[at(std::countr_zero(rest))] & within;
  }
  return out;
}

}  // namespace linkwright::planar
