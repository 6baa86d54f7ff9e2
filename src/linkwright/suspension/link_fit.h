#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/core/status.h"
#include "linkwright/suspension/carrier_poses.h"
#include "linkwright/suspension/link_fit_motion.h"
#include "linkwright/suspension/suspension.h"

namespace linkwright::suspension {

/// Where a point of a link may lie (m), in the frame of the vehicle with the carrier in its reference pose. A
/// coordinate whose limits are equal is given.
struct PointBox {
  Vec3 lower;
  Vec3 upper;
};

/// A cube of edge `edge` around a point.
PointBox box_around(const Vec3& centre, double edge);

/// A link to be found. Points needed: see GuideLink. Two points of one axis (RS, SR, RR, R) have a freedom
/// along that axis, and the point of a strut on the carrier one along the strut: give one coordinate of each,
/// that of the axis' largest component.
struct LinkTask {
  std::string name;
  LinkType type = LinkType::KS;
  std::vector<PointBox> body, carrier;
  bool moved_by_rack = false;  ///< the body's points move along the rack
};

struct LinkFitOptions {
  int starts = 200;          ///< local searches at most
  double tolerance = 1e-8;   ///< m: root mean square of the structural errors of an exact link
  double same_point = 1e-5;  ///< m: links whose points lie closer are one link
};

/// What was found for one link.
struct LinkFit {
  /// done: the structural errors are within the tolerance, polished to rounding; not_converged: no start came
  /// there, the best place in the boxes is given; infeasible: nothing was found but known links.
  Status status = Status::infeasible;
  GuideLink link;
  double rms = std::numeric_limits<double>::infinity();      ///< m, of all equations and positions
  double largest = std::numeric_limits<double>::infinity();  ///< m
  int starts = 0;                                            ///< local searches made
  int duplicates = 0;  ///< exact links refused because they were known already
  std::int64_t evaluations = 0;
};

/// Finds the points of one link from the positions of the carrier. Local searches begin at random places of
/// the boxes, in turn by variable projection, which eliminates the points of one side, and over all unknowns
/// within the boxes; the first exact link inside the boxes that is none of `known` is taken (links in
/// parallel are independent, Poznanovic 2016, section 5.3).
///
/// Throws ContractError for a wrong number of points, empty boxes, a pose without spin, or options out of
/// range.
LinkFit fit_link(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options,
                 std::span<const GuideLink> known, std::uint64_t seed, std::uint32_t run = 0);

/// How well the positions determine the coordinates of a link: the derivatives of its structural errors,
/// decomposed.
struct LinkConditioning {
  /// Of the free coordinates: m of structural error a m of coordinates, largest first. A small one says that
  /// errors of the positions move the points along its direction by their inverse.
  std::vector<double> singular_values;
  /// Change of the points along the smallest one; the squares of all coordinates add up to 1.
  GuideLink weakest;
};
LinkConditioning conditioning(const CarrierTargets& targets, const LinkTask& task, const GuideLink& link);

/// Fewest positions that determine a synthesis, eq (38): unknowns / (equations + pose_parameters - 6) + 1,
/// the reference included; below it there is a family of exact solutions. `pose_parameters` of the six are
/// given in each position; if fewer than six, `equations` counts those of all links, five. With prescribed
/// lengths one less is needed. Infinite when positions add nothing.
double fewest_positions(int unknowns, int equations, int pose_parameters = 6, bool lengths_given = false);

}  // namespace linkwright::suspension
