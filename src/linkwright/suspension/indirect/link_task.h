// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/point_box.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// A link to be found. Points needed: see CornerLink. Two points of one axis (RS, SR, RR, R) have a freedom
/// along that axis, and the point of a strut on the carrier one along the strut: give one coordinate of each,
/// that of the axis' largest component.
struct LinkTask {
  std::string name;
  LinkType type = LinkType::US;
  std::vector<PointBox> body, carrier;
  bool moved_by_rack = false;  ///< the body's points move along the rack
};

/// A rod to be found between two links of the task: from a point on the line of a US link to one fixed to an
/// SR link.
struct CouplerTask {
  std::string name;
  int first = 0;   ///< US link
  int second = 0;  ///< SR link
  /// m: of its point on the first link from that link's body point; at most that link's length.
  double min_offset = 0, max_offset = infinity;
  PointBox point;  ///< box of its point on the second link, in the reference pose
};

/// The task whose answer is known.
LinkTask given_link(const CornerLink& link);

/// The coordinates of a link's points, body points first, x, y, z of each, by their places 0 ... 11; those
/// whose box has a width are the unknowns. Coordinates are counted from `origin`.
class LinkCoordinates {
 public:
  /// Throws ContractError for a wrong number of boxes, or limits that are not finite or in the wrong order.
  explicit LinkCoordinates(const LinkTask& task, const Vec3& origin = {});

  const CornerLink& middle() const { return middle_; }  ///< link at the middle of the boxes
  const std::vector<int>& columns() const {
    return columns_;
  }                                                       ///< number of the unknown of each place, or -1
  const std::vector<int>& free() const { return free_; }  ///< place of each unknown
  double lower(int place) const { return lower_[static_cast<std::size_t>(place)]; }
  double upper(int place) const { return upper_[static_cast<std::size_t>(place)]; }

  static double get(const CornerLink& link, int place);
  static void set(CornerLink& link, int place, double value);
  /// True if all points lie in their boxes, to a nanometre.
  bool inside(const CornerLink& link) const;

 private:
  CornerLink middle_;
  std::vector<int> columns_, free_;
  std::vector<double> lower_, upper_;
};

/// The link with all its points moved.
CornerLink shifted(CornerLink link, const Vec3& by);

}  // namespace linkwright::suspension
