// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/chains/markings.h"
#include "linkwright/study/kind.h"

// Type synthesis: all planar kinematic chains of a number of links, and the mechanisms that they become; what
// their file holds, how it is read, run and reported.
namespace linkwright::planar {

struct ChainMechanism {
  int links = 6, freedoms = 1, sliders = 0;
  bool gear_pair = false, ground = true, driver = true, fractionated = false;
};
template <class Visitor>
void fields(Visitor&& visit, ChainMechanism& m) {
  visit(field::entry("links", "number of links, the ground among them").between(4, 10).required(), m.links);
  visit(field::entry("freedoms", "degrees of freedom of the chain").between(1, 3), m.freedoms);
  visit(field::entry("sliders", "joints that slide; the others are pins").between(0, 13), m.sliders);
  visit(field::entry("gear_pair", "gears two links about a third one, in chains of two degrees of freedom"),
        m.gear_pair);
  visit(field::entry("ground", "lists the mechanisms of a chain by the link that is held"), m.ground);
  visit(field::entry("driver", "lists them by the driven joint of the ground, too"), m.driver);
  visit(field::entry("fractionated", "lists chains with cut links, too: parts that turn independently"),
        m.fractionated);
}

inline MarkingChoice marking_choice(const ChainMechanism& m) {
  return {.sliders = m.sliders, .gear = m.gear_pair, .ground = m.ground, .driver = m.ground && m.driver};
}

/// "enumeration" of "planar.chain".
study::Kind chain_kind();

study::Result run_chain_study(const ChainMechanism& asked, RunContext& context);

}  // namespace linkwright::planar
