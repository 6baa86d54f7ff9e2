// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"

namespace linkwright::clearance {

/// A linkage from which pins are taken out, so that each of them gives two more freedoms, with inputs for all
/// freedoms.
struct OpenLinkage {
  /// done; no_assembly and the like when the whole linkage has no position at the start; infeasible when no
  /// inputs can be found.
  Status status = Status::done;
  std::string message;  ///< says why it is not `done`; else empty
  /// Bodies keep their numbers; massless blocks follow that guide bodies which hang on nothing else. Every
  /// body has a start pose. The inputs of the original come first.
  planar::Linkage linkage;
  planar::LinkagePlan plan;
  struct Pin {
    std::string name;
    planar::BodyPoint first, second;
  };
  std::vector<Pin> pins;  ///< pins that were taken out, in the order in which they were named
  /// Values of all inputs at the start, where the pins are closed.
  std::vector<double> start;
};

/// Throws ContractError unless all are revolute joints without drive and friction, each named once.
void require_free_pins(const planar::Linkage& linkage, std::span<const int> joints);

/// Takes the joints out. `inputs` are the values of the drives at the start, and the modes of the plan say
/// how the whole linkage is assembled there. Inputs are added at joints that are left, those that make the
/// most drivers and closed forms first, and at blocks that guide loose bodies over the ground. Throws
/// ContractError for joints that are no revolute joints without drive and friction, or are named twice.
OpenLinkage open_linkage(const planar::Linkage& linkage, std::span<const int> joints,
                         std::span<const double> inputs);

/// Distance of the points of a pin and how it changes, from the first body's to the second's.
struct PinGap {
  std::complex<double> way, rate;
};
PinGap pin_gap(const OpenLinkage& open, const planar::LinkageMotion& motion, std::size_t pin);

/// Values and rates of the added inputs that give the pins these gaps; the other inputs stay. Newton's method
/// from the values that are there.
Status place_pins(const OpenLinkage& open, std::span<const PinGap> gaps,
                  std::vector<planar::InputMotion>& inputs, std::size_t original_inputs);

}  // namespace linkwright::clearance
