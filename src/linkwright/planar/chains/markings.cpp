// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/markings.h"

#include <algorithm>
#include <array>
#include <bit>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

// The number of the joint between two links, which must be joined.
int joint_between(const std::vector<JointEnds>& joints, int a, int b) {
  const JointEnds ends{std::min(a, b), std::max(a, b)};
  return static_cast<int>(std::lower_bound(joints.begin(), joints.end(), ends) - joints.begin());
}

// An automorphism, with what it does to the joints.
struct Symmetry {
  Labelling links;
  std::vector<int> joints;
};
using Symmetries = std::vector<const Symmetry*>;

std::vector<Symmetry> symmetries_of(const Chain& chain, const std::vector<JointEnds>& joints) {
  std::vector<Symmetry> out;
  for (const Labelling& labelling : chain.automorphisms) {
    Symmetry s{labelling, {}};
    for (const auto& [a, b] : joints)
      s.joints.push_back(joint_between(joints, labelling[at(a)], labelling[at(b)]));
    out.push_back(std::move(s));
  }
  return out;
}

// The symmetries that leave a choice as it is, and nothing when one of them maps it to a smaller one: then
// that one stands for both.
template <class Image, class Thing>
std::optional<Symmetries> stabiliser(const Symmetries& all, const Thing& thing, const Image& image) {
  Symmetries out;
  for (const Symmetry* s : all) {
    const Thing mapped = image(*s, thing);
    if (mapped < thing) return std::nullopt;
    if (mapped == thing) out.push_back(s);
  }
  return out;
}

std::uint32_t image_of(const Symmetry& s, std::uint32_t set) {
  std::uint32_t out = 0;
  for (; set != 0; set &= set - 1) out |= 1u << s.joints[at(std::countr_zero(set))];
  return out;
}

std::array<int, 3> image_of(const Symmetry& s, const std::array<int, 3>& gear) {
  const int a = s.links[at(gear[1])], b = s.links[at(gear[2])];
  return {s.links[at(gear[0])], std::min(a, b), std::max(a, b)};
}

// The next larger number with as many bits (Gosper); set > 0.
std::uint32_t next_set(std::uint32_t set) {
  const std::uint32_t low = set & (0u - set), raised = set + low;
  return raised | (((raised ^ set) >> 2) / low);
}

// Places one kind of mark after the other; each keeps the symmetries that the next ones may still use.
class Marker {
 public:
  Marker(const Chain& chain, const MarkingChoice& choice)
      : graph_(chain.graph),
        choice_(choice),
        joints_(joints_of(chain.graph)),
        symmetries_(symmetries_of(chain, joints_)) {}

  std::vector<Marking> all() {
    Symmetries whole;
    for (const Symmetry& s : symmetries_) whole.push_back(&s);
    sliders(whole);
    return std::move(out_);
  }

 private:
  void sliders(const Symmetries& group) {
    if (choice_.sliders == 0) return gear(group, {});
    const std::uint32_t end = 1u << joints_.size();
    for (std::uint32_t set = (1u << choice_.sliders) - 1; set < end; set = next_set(set)) {
      const auto rest = stabiliser(group, set, [](const auto& s, auto x) { return image_of(s, x); });
      if (!rest) continue;
      const Mobility mobile = mobility(graph_, set);
      if (mobile.freedoms == freedoms(graph_) && mobile.each_joint_moves) gear(*rest, {.sliders = set});
    }
  }

  void gear(const Symmetries& group, Marking marking) {
    if (!choice_.gear) return ground(group, marking);
    const auto is_pin = [&](int a, int b) {
      return graph_.joined(a, b) && (marking.sliders >> joint_between(joints_, a, b) & 1) == 0;
    };
    for (int carrier = 0; carrier < graph_.links; ++carrier)
      for (int a = 0; a < graph_.links; ++a)
        for (int b = a + 1; b < graph_.links; ++b) {
          if (!is_pin(carrier, a) || !is_pin(carrier, b) || graph_.joined(a, b)) continue;
          const std::array<int, 3> pair{carrier, a, b};
          const auto rest =
              stabiliser(group, pair, [](const auto& s, const auto& x) { return image_of(s, x); });
          if (!rest) continue;
          marking.gear = GearPair{carrier, a, b};
          ground(*rest, marking);
        }
  }

  void ground(const Symmetries& group, Marking marking) {
    if (!choice_.ground) return out_.push_back(marking);
    for (int link = 0; link < graph_.links; ++link) {
      const auto rest = stabiliser(group, link, [](const auto& s, int x) { return int{s.links[at(x)]}; });
      if (!rest) continue;
      marking.ground = link;
      driver(*rest, marking);
    }
  }

  void driver(const Symmetries& group, Marking marking) {
    if (!choice_.driver) return out_.push_back(marking);
    for (int link = 0; link < graph_.links; ++link) {
      if (!graph_.joined(*marking.ground, link)) continue;
      const int joint = joint_between(joints_, *marking.ground, link);
      if (!stabiliser(group, joint, [](const auto& s, int x) { return s.joints[at(x)]; })) continue;
      marking.driver = joint;
      out_.push_back(marking);
    }
  }

  const ChainGraph& graph_;
  const MarkingChoice& choice_;
  const std::vector<JointEnds> joints_;
  const std::vector<Symmetry> symmetries_;
  std::vector<Marking> out_;
};

double binomial(int n, int k) {
  double out = 1;
  for (int i = 1; i <= k; ++i) out = out * (n - k + i) / i;
  return out;
}

int joints_inside(const ChainGraph& graph, unsigned set) {
  int ends = 0;
  for (unsigned rest = set; rest != 0; rest &= rest - 1)
    ends += std::popcount(graph.neighbours[at(std::countr_zero(rest))] & set);
  return ends / 2;
}

// The smallest set of links that the links which are known determine; empty when there is none.
unsigned next_group(const ChainGraph& graph, unsigned known) {
  const unsigned unknown = ((1u << graph.links) - 1) & ~known;
  unsigned best = 0;
  const int before = joints_inside(graph, known);
  for (unsigned set = unknown; set != 0; set = (set - 1) & unknown)
    if ((best == 0 || std::popcount(set) < std::popcount(best)) &&
        3 * std::popcount(set) == 2 * (joints_inside(graph, set | known) - before))
      best = set;
  return best;
}

}  // namespace

std::vector<Marking> markings(const Chain& chain, const MarkingChoice& choice) {
  LINKWRIGHT_REQUIRE(choice.ground || !choice.driver, "a driven joint needs a ground");
  LINKWRIGHT_REQUIRE(choice.sliders >= 0 && choice.sliders <= chain.graph.joints(),
                     "{} sliders for {} joints", choice.sliders, chain.graph.joints());
  return Marker(chain, choice).all();
}

double placements(const ChainGraph& graph, const MarkingChoice& choice) {
  double out = binomial(graph.joints(), choice.sliders);
  double pairs = 0;
  for (int v = 0; v < graph.links; ++v) pairs += binomial(graph.degree(v), 2);
  if (choice.gear) out *= pairs;
  if (choice.ground) out *= choice.driver ? 2 * graph.joints() : graph.links;
  return out;
}

int driven_link(const ChainGraph& graph, const Marking& marking) {
  LINKWRIGHT_REQUIRE(marking.ground && marking.driver, "a driven link needs ground and driver");
  const JointEnds ends = joints_of(graph)[at(*marking.driver)];
  return ends[0] == *marking.ground ? ends[1] : ends[0];
}

std::vector<int> driven_groups(const ChainGraph& graph, const Marking& marking) {
  unsigned known = 1u << driven_link(graph, marking) | 1u << *marking.ground;
  std::vector<int> out;
  while (const unsigned group = next_group(graph, known)) {
    out.push_back(std::popcount(group));
    known |= group;
  }
  return out;
}

}  // namespace linkwright::planar
