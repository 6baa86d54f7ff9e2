// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/arm.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::flexible {

namespace {

math::Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Force of the inner part on the outer one at the cut in the joint of a cell, axes of the hub.
math::Vec2 force_at(const ChainShape& shape, std::size_t cell, const SectionForce& cut) {
  const double mean = (shape.angle[cell] + shape.angle[cell + 1]) / 2;
  return rotate(direction(mean), math::Vec2{-cut.axial, -cut.shear});
}

}  // namespace

ArmChain arm_chain(std::span<const ArmLink> links, Kinematics kinematics) {
  LINKWRIGHT_REQUIRE(!links.empty(), "an arm without links");
  LINKWRIGHT_REQUIRE(!links[0].hinge, "a hinge at the first link, which is welded to the hub");
  ArmChain out{.chain = discretise(links[0].beam, links[0].divisions, kinematics), .links = {}};
  out.links.push_back({.root = 0, .tip = out.chain.cells.size(), .hinge = {}});
  for (const ArmLink& link : links.subspan(1)) {
    ArmChain::Link next{.root = out.chain.cells.size(), .tip = 0, .hinge = {}};
    if (link.hinge) {
      next.hinge = next.root++;
      out.chain = hinge(out.chain, *link.hinge, link.beam, link.divisions);
    } else {
      out.chain = weld(out.chain, link.beam, link.divisions);
    }
    next.tip = out.chain.cells.size();
    out.links.push_back(next);
  }
  return out;
}

std::vector<double> bent(const Chain& chain, std::span<const double> q, double share) {
  LINKWRIGHT_REQUIRE(q.size() == coordinates_per_cell * chain.cells.size(), "{} coordinates for {} cells",
                     q.size(), chain.cells.size());
  std::vector<double> out(q.begin(), q.end());
  for (std::size_t s = 0; s < chain.cells.size(); ++s)
    if (!chain.cells[s].hinge)
      for (std::size_t i = 0; i < coordinates_per_cell; ++i) out[coordinates_per_cell * s + i] *= share;
  return out;
}

TipDisplacement tip_displacement(const Chain& chain, std::span<const double> q) {
  const ChainShape actual = shape(chain, q), rigid = shape(chain, bent(chain, q, 0));
  const math::Vec2 moved =
      rotate_inverse(direction(rigid.angle.back()), actual.node.back() - rigid.node.back());
  return {moved.x, moved.y};
}

std::vector<SectionForce> link_sections(const ArmChain& arm, std::size_t link,
                                        const ChainEquations& equations, const ChainState& state) {
  LINKWRIGHT_REQUIRE(link < arm.links.size(), "link {} of {}", link, arm.links.size());
  const ArmChain::Link& l = arm.links[link];
  const std::vector<SectionForce> all = equations.sections();
  const ChainShape at = shape(arm.chain, state.q);
  const auto tip_length = [&](std::size_t node) {
    double sum = 0;
    for (std::size_t s = l.root; s < node; ++s) sum += arm.chain.cells[s].length;
    return sum;
  };
  // The cut in the joint of a cell, moved to one of its ends: the force is the same, the arm is another.
  const auto moved = [&](std::size_t cell, std::size_t node) {
    SectionForce cut = all[cell + 1];
    const math::Vec2 middle = 0.5 * (at.node[cell] + at.node[cell + 1]);
    cut.moment -= cross(middle - at.node[node], force_at(at, cell, cut));
    cut.position = tip_length(node);
    return cut;
  };
  std::vector<SectionForce> out{l.root == 0 ? all.front() : moved(l.root, l.root)};
  for (std::size_t s = l.root; s < l.tip; ++s) {
    out.push_back(all[s + 1]);
    out.back().position = tip_length(s) + arm.chain.cells[s].length / 2;
  }
  out.push_back(moved(l.tip - 1, l.tip));
  return out;
}

std::vector<math::Vec2> hinge_forces(const ArmChain& arm, const ChainEquations& equations,
                                     const ChainState& state) {
  const std::vector<SectionForce> all = equations.sections();
  const ChainShape at = shape(arm.chain, state.q);
  std::vector<math::Vec2> out;
  for (const ArmChain::Link& l : arm.links)
    if (l.hinge) out.push_back(rotate(direction(state.angle), force_at(at, *l.hinge, all[*l.hinge + 1])));
  return out;
}

}  // namespace linkwright::flexible
