// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/corner/point_box.h"
#include "linkwright/suspension/corner/position.h"

/// Room that the links of a suspension keep: to each other, to the tyre, to the body. Links are straight
/// lines between their points, one for each pair of a body and a carrier point that they join.
namespace linkwright::suspension {

/// A point of a link stays out of a box: a body point where it is, a carrier point at all positions.
struct KeepOut {
  int link = 0;
  bool carrier = false;
  int point = 0;
  PointBox box;
};

/// Distance of the first body point of a link from its first carrier point.
struct LengthLimit {
  int link = 0;
  double least = 0;            ///< m
  double greatest = infinity;  ///< m
};

/// Least distance (m) of the lines of two links: their radii and what is to be left between.
struct LinkClearance {
  int first = 0, second = 0;
  double least = 0;
};

/// The tyre is what lies between two radii and within half its width of the wheel centre; inside the rim
/// there is room.
struct TyreShape {
  double inner_diameter = 0, outer_diameter = 0, width = 0;  ///< m
};
struct TyreClearance {
  int link = 0;
  TyreShape tyre;
  double least = 0;  ///< m
};

struct BoxClearance {
  int link = 0;
  PointBox box;
  double least = 0;  ///< m
};

struct CornerLimits {
  std::vector<KeepOut> keep_out;
  std::vector<LengthLimit> lengths;
  std::vector<LinkClearance> links;
  std::vector<TyreClearance> tyres;
  std::vector<BoxClearance> boxes;
};

/// One limit at a design: met when `excess` <= 0.
struct LimitAnswer {
  std::string name;        ///< "clearance of upper arm and tie rod"
  double excess = 0;       ///< m: by how much it is missed, the worst of the positions
  int position = -1;       ///< index of the position; -1 = the same at all
  std::vector<double> by;  ///< [number]: derivatives, empty without numbers
};

/// All limits in the order of their lists, a length with both its ends (an infinite one is left out).
/// `positions` are those that clearances are looked at in, solved; `shifts` [position][number] how the
/// carrier moves with the numbers, as WheelDerivatives has it; both of `numbers` and `shifts` may be empty.
/// Distances from boxes and tyres are those from their nearest face, less than the true ones off an edge.
/// Throws ContractError for links and points that the suspension does not have.
std::vector<LimitAnswer> limit_answers(const Suspension& suspension, const CornerLimits& limits,
                                       std::span<const CornerPosition> positions,
                                       std::span<const DesignNumber> numbers,
                                       std::span<const std::vector<Twist>> shifts);

}  // namespace linkwright::suspension
