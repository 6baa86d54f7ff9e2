// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"
#include "linkwright/suspension/indirect/link_task.h"

namespace linkwright::suspension {

struct LinkFitOptions {
  int starts = 200;          ///< local searches at most
  double tolerance = 1e-8;   ///< m: root mean square of the structural errors of an exact link
  double same_point = 1e-5;  ///< m: links whose points lie closer are one link
  bool progress = true;      ///< report to the run context
};
template <class Visitor>
void fields(Visitor&& visit, LinkFitOptions& o) {
  visit(field::entry("starts", "local searches for a link at most").between(1, 1e6), o.starts);
  visit(
      field::length("tolerance", "root mean square of the structural errors at which a link counts as exact")
          .positive(),
      o.tolerance);
  visit(field::length("same_point", "links whose points lie closer are one link").not_negative(),
        o.same_point);
}

/// The link found, and how well it fits.
struct LinkFit {
  /// done: the structural errors are within the tolerance, polished to rounding; not_converged: no start came
  /// there, the best place in the boxes is given; infeasible: nothing was found but known links; deadline,
  /// cancelled: as not_converged.
  Status status = Status::infeasible;
  CornerLink link;
  double rms = infinity;      ///< m, of all equations and positions
  double largest = infinity;  ///< m
  int starts = 0;             ///< local searches made
  int duplicates = 0;         ///< exact links refused because they were known already
  std::int64_t evaluations = 0;
};

/// Finds the points of one link from the positions of the carrier. Local searches begin at random places of
/// the boxes, in turn by variable projection, which eliminates the points of one side, and over all unknowns
/// within the boxes; the first exact link inside the boxes that is none of `known` is taken (links in
/// parallel are independent, Poznanovic 2016, section 5.3).
///
/// Throws ContractError for a wrong number of points, empty boxes, a pose without carrier pitch, or options
/// out of range.
LinkFit fit_link(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options,
                 std::span<const CornerLink> known, std::uint64_t seed, RunContext& context,
                 std::uint32_t run = 0);

/// The same from given links, of which those with all points in their boxes are starts, instead of random
/// ones.
LinkFit fit_link_from(std::span<const CornerLink> starts, const CarrierTargets& targets, const LinkTask& task,
                      const LinkFitOptions& options, std::span<const CornerLink> known, RunContext& context);

/// The accuracy with which the positions determine the coordinates of a link: the derivatives of its
/// structural errors, decomposed.
struct LinkConditioning {
  /// Singular values for the free coordinates: m of structural error a m of coordinates, largest first. A
  /// small one says that errors of the positions move the points along its direction by their inverse.
  std::vector<double> singular_values;
  /// Change of the points along the smallest one; the squares of all coordinates add up to 1.
  CornerLink weakest;
};
LinkConditioning conditioning(const CarrierTargets& targets, const LinkTask& task, const CornerLink& link);

/// Fewest positions that determine a synthesis, eq (38): unknowns / (equations + pose_parameters - 6) + 1,
/// the reference included; below it there is a family of exact solutions. `pose_parameters` of the six are
/// given in each position; if fewer than six, `equations` counts those of all links, five. With prescribed
/// lengths one less is needed. Infinite when positions add nothing.
double fewest_positions(int unknowns, int equations, int pose_parameters = 6, bool lengths_given = false);

}  // namespace linkwright::suspension
