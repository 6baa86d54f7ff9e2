// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/pair_order.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

constexpr int max_pairs = (max_chain_links - 2) / 2;

ChainGraph canonical_machine(const PairProgram& program) {
  std::vector<int> colours(at(program.links()), 3);
  colours[0] = 0, colours[1] = 1;
  if (program.traced) colours[at(*program.traced)] = 2;
  return canonical_form(program.graph(), colours).graph;
}

// The pair of which a bar is a part; bars have numbers from 2.
std::size_t pair_of(int bar) { return at(bar / 2 - 1); }

// The links that a bar hangs on, itself included, and those in turn; not through `closed`, which is not
// entered.
unsigned ancestors(const PairProgram& program, int bar, int closed = -1) {
  unsigned out = 0;
  std::vector<int> waiting{bar};
  while (!waiting.empty()) {
    const int link = waiting.back();
    waiting.pop_back();
    if (link == closed || (out >> link & 1) != 0) continue;
    out |= 1u << link;
    if (link >= 2)
      for (const int parent : program.pairs[pair_of(link)]) waiting.push_back(parent);
  }
  return out;
}

bool needs_every_pair(const PairProgram& program, int bar) {
  const unsigned links = ancestors(program, bar);
  for (int k = 0; k < std::ssize(program.pairs); ++k)
    if (pair_of(bar) != at(k) && (links >> (2 * k + 2) & 3u) == 0) return false;
  return true;
}

bool is_hinged_to_ground(const PairProgram& program, int bar) {
  return program.pairs[pair_of(bar)][at(bar % 2)] == 0;
}

// True if all motion comes to the bar through one link that turns about a fixed pivot.
bool is_moved_through_one_link(const PairProgram& program, int bar) {
  for (int link = 2; link < program.links(); ++link)
    if (link != bar && is_hinged_to_ground(program, link) && (ancestors(program, bar, link) >> 1 & 1) == 0)
      return true;
  return false;
}

// The first of the programs that build a machine. Any order of its pairs leads to the end, and the links that
// a pair joins decide the order of its bars.
class LeastProgram {
 public:
  LeastProgram(const ChainGraph& graph, int ground, int crank) : graph_(graph), order_{ground, crank} {}

  PairProgram find() {
    extend();
    return *best_;
  }

 private:
  struct Step {
    std::array<int, 2> pair;
    int first_bar, second_bar;
  };

  // The place in the order of the link that a new bar is joined to; -1 = none.
  int anchor(int bar) const {
    for (int k = 0; k < std::ssize(order_); ++k)
      if (graph_.joined(bar, order_[at(k)])) return k;
    return -1;
  }
  bool is_known(int link) const { return std::find(order_.begin(), order_.end(), link) != order_.end(); }

  std::vector<Step> least_steps() const {
    std::vector<Step> out;
    for (const auto& [a, b] : joints_of(graph_)) {
      if (is_known(a) || is_known(b)) continue;
      const int from_a = anchor(a), from_b = anchor(b);
      if (from_a < 0 || from_b < 0) continue;
      const bool is_first = program_.pairs.empty();
      const Step step =
          (from_a < from_b) != is_first ? Step{{from_a, from_b}, a, b} : Step{{from_b, from_a}, b, a};
      if (!out.empty() && step.pair < out.front().pair) out.clear();
      if (out.empty() || step.pair == out.front().pair) out.push_back(step);
    }
    return out;
  }

  void extend() {
    if (std::ssize(order_) == graph_.links) {
      if (!best_ || program_ < *best_) best_ = program_;
      return;
    }
    for (const Step& step : least_steps()) {
      program_.pairs.push_back(step.pair);
      order_.push_back(step.first_bar), order_.push_back(step.second_bar);
      extend();
      program_.pairs.pop_back();
      order_.pop_back(), order_.pop_back();
    }
  }

  const ChainGraph& graph_;
  std::vector<int> order_;  // number in the program -> link
  PairProgram program_;
  std::optional<PairProgram> best_;
};

}  // namespace

ChainGraph PairProgram::graph() const {
  ChainGraph out{.links = links()};
  out.join(0, 1);
  for (int k = 0; k < std::ssize(pairs); ++k) {
    const int bar = 2 * k + 2;
    out.join(pairs[at(k)][0], bar), out.join(pairs[at(k)][1], bar + 1), out.join(bar, bar + 1);
  }
  return out;
}

std::vector<PairProgram> pair_sequences(int pairs) {
  LINKWRIGHT_REQUIRE(pairs >= 1 && pairs <= max_pairs, "1 to {} pairs, got {}", max_pairs, pairs);
  std::vector<PairProgram> out{{.pairs = {{1, 0}}}};
  for (int k = 1; k < pairs; ++k) {
    std::vector<PairProgram> longer;
    for (const PairProgram& program : out)
      for (int a = 0; a < program.links(); ++a)
        for (int b = 0; b < program.links(); ++b)
          if (a != b) {
            longer.push_back(program);
            longer.back().pairs.push_back({a, b});
          }
    out = std::move(longer);
  }
  return out;
}

std::vector<PairProgram> pair_machines(int pairs) {
  std::set<ChainGraph> known;
  std::vector<PairProgram> out;
  for (const PairProgram& program : pair_sequences(pairs))
    if (known.insert(canonical_machine(program)).second) out.push_back(program);
  return out;
}

std::vector<PairProgram> traced_pair_machines(int pairs, bool own_curves) {
  std::set<ChainGraph> known;
  std::vector<PairProgram> out;
  for (PairProgram program : pair_sequences(pairs))
    for (int bar = 2; bar < program.links(); ++bar) {
      if (!needs_every_pair(program, bar) || is_hinged_to_ground(program, bar)) continue;
      if (own_curves && is_moved_through_one_link(program, bar)) continue;
      program.traced = bar;
      if (known.insert(canonical_machine(program)).second) out.push_back(program);
    }
  return out;
}

std::optional<PairProgram> pair_program(const ChainGraph& graph, const Marking& marking) {
  const int crank = driven_link(graph, marking);
  if (driven_groups(graph, marking) != std::vector<int>(at(graph.links / 2 - 1), 2)) return std::nullopt;
  return LeastProgram(graph, *marking.ground, crank).find();
}

std::string program_name(const PairProgram& program) {
  constexpr std::string_view names[] = {"four", "six", "eight", "ten", "twelve"};
  std::string out = fmt::format("{}-bar", names[program.pairs.size() - 1]);
  for (std::size_t k = 1; k < program.pairs.size(); ++k)
    out += fmt::format("{}{}{}", k == 1 ? ' ' : '-', program.pairs[k][0], program.pairs[k][1]);
  if (program.traced) out += *program.traced % 2 == 0 ? " a" : " b";
  return out;
}

}  // namespace linkwright::planar
