#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/link_fit.h"
#include "linkwright/suspension/suspension.h"

namespace linkwright::suspension {

/// A rod to be found between two links of the task: from a point on the line of a KS link to one fixed to an
/// SR link.
struct CouplerTask {
  std::string name;
  int first = 0;   ///< KS link
  int second = 0;  ///< SR link
  double least_offset =
      0;           ///< m: of its point on the first link from that link's body point; at most its length
  PointBox point;  ///< of its point on the second link, in the reference pose
};

/// What was found for a coupler.
struct CouplerFit {
  Status status = Status::infeasible;  ///< as LinkFit::status; infeasible also when a link is not there
  Coupler coupler;
  double offset = 0;  ///< m, from the body point of the first link
  double rms = std::numeric_limits<double>::infinity(), largest = rms;  ///< m: change of its length
};

/// Finds a coupler between links that are known: seen from the second link, the point on the first one moves
/// on a sphere about the coupler's other end. The centre solves a linear problem for every offset, so one
/// unknown is searched (Poznanovic 2016, section 5.3.4, decoupled). Throws ContractError for links of other
/// types and for a position without spin.
CouplerFit fit_coupler(const CarrierTargets& targets, std::span<const GuideLink> links,
                       const CouplerTask& task, double tolerance = 1e-8);

/// A wheel guide to be found from positions of its carrier. The wheel needs its tyre diameter: at its radius
/// turns count in the check of the rank.
struct IndirectTask {
  CarrierTargets targets;
  std::vector<LinkTask> links;
  std::vector<CouplerTask> couplers;
};

struct IndirectSynthesis {
  /// done: all links are exact and the guide moves as it should; not_converged, infeasible: of the links or
  /// couplers; singular: exact links that leave the carrier a further freedom, see `findings`.
  Status status = Status::infeasible;
  std::vector<LinkFit> links;
  std::vector<CouplerFit> couplers;
  WheelGuide guide;    ///< as far as it was found
  double largest = 0;  ///< m: structural error of all links and couplers
  double fewest = 0;   ///< positions that determine all links, see fewest_positions, the largest of the links
  Diagnostics findings;  ///< of check_structure, and a warning when there are fewer positions
};

/// Finds the links one after the other, each from its own starts and none twice, then the couplers.
IndirectSynthesis synthesise(const IndirectTask& task, const LinkFitOptions& options, std::uint64_t seed);

}  // namespace linkwright::suspension
