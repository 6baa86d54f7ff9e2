// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/linkage.h"

// The four-bar by its parameters: a shorthand for a linkage.
namespace linkwright::planar {

/// `[mechanism]` of planar.four_bar.
struct FourBarMechanism {
  FourBar linkage;
  std::optional<FourBarMasses> masses;
};
template <class Visitor>
void fields(Visitor&& visit, FourBarMechanism& m) {
  visit(field::entry("branch", "assembly branch"), m.linkage.branch);
  visit(field::entry("parameters", "the linkage in numbers").required(), m.linkage);
  visit(field::entry("mass", "masses of the links; only forces and torques need them"), m.masses);
}

/// The linkage of it, with bodies crank, coupler and rocker and the joints O1 (driven), O2, O3 and O4. As in
/// FourBar angles are from the ground link: the frames of the bodies are turned against their links by the
/// frame angle, so that the input is the crank angle. Forces at O3 are those of the rocker on the coupler, as
/// in FourBarReactions, and shaking moments are about O1. The coupler has a point C if that is not O2.
Linkage linkage_of(const FourBarMechanism& mechanism);

}  // namespace linkwright::planar
