// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/chains.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using Graphs = std::set<ChainGraph>;

ChainGraph cycle_of(int links) {
  ChainGraph out{.links = links};
  for (int v = 0; v < links; ++v) out.join(v, (v + 1) % links);
  return out;
}

// A path of `inner` new links between two links.
ChainGraph with_ear(ChainGraph graph, int from, int to, int inner) {
  int last = from;
  for (int k = 0; k < inner; ++k) {
    graph.join(last, graph.links);
    last = graph.links++;
  }
  graph.join(last, to);
  return graph;
}

// Graphs that may be part of a wanted one of `links` links.
using Filter = std::function<bool(const ChainGraph&)>;

void add_ears(const ChainGraph& graph, int least, int most, const Filter& wanted, Graphs& out) {
  for (int from = 0; from < graph.links; ++from)
    for (int to = from + 1; to < graph.links; ++to)
      for (int inner = std::max(least, graph.joined(from, to) ? 1 : 0); inner <= most; ++inner) {
        const ChainGraph longer = with_ear(graph, from, to, inner);
        if (wanted(longer)) out.insert(canonical_form(longer).graph);
      }
}

// The last ear brings the number of links to `links`.
Graphs graphs_by_ears(int links, int joints, const Filter& wanted, const RunContext& context) {
  const int loops = joints - links + 1;
  Graphs now;
  for (int n = loops == 1 ? links : 3; n <= links; ++n)
    if (const ChainGraph cycle = cycle_of(n); wanted(cycle)) now.insert(canonical_form(cycle).graph);
  for (int loop = 2; loop <= loops; ++loop) {
    Graphs next;
    for (const ChainGraph& graph : now) {
      if (context.interrupted()) return {};
      const int rest = links - graph.links;
      add_ears(graph, loop == loops ? rest : 0, rest, wanted, next);
    }
    now = std::move(next);
  }
  return now;
}

std::vector<int> degrees(const ChainGraph& graph) {
  std::vector<int> out;
  for (int v = 0; v < graph.links; ++v) out.push_back(graph.degree(v));
  std::sort(out.begin(), out.end(), std::greater<>());
  return out;
}

std::vector<Chain> listed(const Graphs& graphs, int links, int freedoms, bool fractionated) {
  std::vector<Chain> out;
  for (const ChainGraph& graph : graphs)
    out.push_back({.graph = graph, .automorphisms = automorphisms(graph), .fractionated = fractionated});
  std::stable_sort(out.begin(), out.end(),
                   [](const Chain& a, const Chain& b) { return degrees(a.graph) < degrees(b.graph); });
  const auto width = fmt::formatted_size("{}", out.size());
  const std::string list = fmt::format("{}{}-{}", links, freedoms == 3 ? "F3" : "", fractionated ? "c" : "");
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].rank = static_cast<int>(i) + 1;
    out[i].name = fmt::format("{}{:0{}}", list, i + 1, width);
  }
  return out;
}

void require_possible(int links, int freedoms) {
  LINKWRIGHT_REQUIRE(links <= max_chain_links && chain_can_exist(links, freedoms),
                     "no chain of {} links has {} freedoms, or it has more than {} links", links, freedoms,
                     max_chain_links);
}

Graphs chain_graphs(int links, int freedoms_wanted, const RunContext& context) {
  const auto wanted = [links](const ChainGraph& graph) {
    return !has_rigid_part(graph) && (graph.links == links || freedoms(graph) >= 1);
  };
  return graphs_by_ears(links, (3 * (links - 1) - freedoms_wanted) / 2, wanted, context);
}

// Two chains that have one link in common.
ChainGraph glued(const ChainGraph& a, int link_a, const ChainGraph& b, int link_b) {
  ChainGraph out = a;
  std::array<int, max_chain_links> number{};
  for (int v = 0; v < b.links; ++v) number[at(v)] = v == link_b ? link_a : out.links++;
  for (const auto& [from, to] : joints_of(b)) out.join(number[at(from)], number[at(to)]);
  return out;
}

Graphs fractionated_graphs(int links, int freedoms_wanted, const RunContext& context) {
  Graphs out;
  for (int own = 1; own < freedoms_wanted; ++own)
    for (int n = 4; n <= links - 3; ++n) {
      const int rest_links = links - n + 1, rest = freedoms_wanted - own;
      if (!chain_can_exist(n, own) || !chain_can_exist(rest_links, rest)) continue;
      Graphs parts = chain_graphs(rest_links, rest, context);
      parts.merge(fractionated_graphs(rest_links, rest, context));
      for (const ChainGraph& block : chain_graphs(n, own, context))
        for (const ChainGraph& part : parts)
          for (int v = 0; v < block.links; ++v)
            for (int w = 0; w < part.links; ++w) out.insert(canonical_form(glued(block, v, part, w)).graph);
    }
  return out;
}

}  // namespace

std::vector<int> assortment(const ChainGraph& graph) {
  std::vector<int> out;
  for (const int degree : degrees(graph)) {
    if (std::ssize(out) < degree - 1) out.resize(at(degree - 1));
    ++out[at(degree - 2)];
  }
  return out;
}

std::string assortment_text(const ChainGraph& graph) {
  std::string out;
  int last = 0;
  for (const int degree : degrees(graph)) {
    if (!out.empty() && degree == 2 && last != 2) out += ' ';
    out += fmt::format("{}", degree);
    last = degree;
  }
  return out;
}

std::vector<ChainGraph> two_connected_graphs(int links, int joints) {
  LINKWRIGHT_REQUIRE(links >= 3 && links <= max_chain_links, "3 to {} links, got {}", max_chain_links, links);
  if (joints < links) return {};
  const Graphs found = graphs_by_ears(links, joints, [](const ChainGraph&) { return true; }, {});
  return {found.begin(), found.end()};
}

bool chain_can_exist(int links, int freedoms) {
  return freedoms >= 1 && links >= freedoms + 3 && (3 * (links - 1) - freedoms) % 2 == 0;
}

std::vector<Chain> chains(int links, int freedoms, const RunContext& context) {
  require_possible(links, freedoms);
  return listed(chain_graphs(links, freedoms, context), links, freedoms, false);
}

std::vector<Chain> fractionated_chains(int links, int freedoms, const RunContext& context) {
  require_possible(links, freedoms);
  return listed(fractionated_graphs(links, freedoms, context), links, freedoms, true);
}

}  // namespace linkwright::planar
