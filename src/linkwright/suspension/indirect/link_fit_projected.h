// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/suspension/indirect/link_fit_direct.h"

namespace linkwright::suspension {

/// A link with the points of one side eliminated (variable projection): for given points of the carrier each
/// body point of a US, RS or RR link solves a linear least-squares problem, its squared distances from their
/// places being constant; for SR the carrier is what is at rest. For SP the track of the body point, seen
/// from the carrier, gives the line of the strut. What is left are 3 unknowns, 4 with RR, and no valley where
/// positions determine a link poorly.
class LinkProjection {
 public:
  /// `given` holds the coordinates that `columns` leaves out, and for the others a place nearby, which
  /// chooses the point of a strut. The motion must outlive the projection.
  LinkProjection(const LinkMotion& motion, const CornerLink& given, LinkColumns columns);

  /// True if the links of this type can be projected and there is an unknown left.
  bool applicable() const { return applicable_; }
  /// Places of the unknowns among the twelve coordinates of `columns`.
  std::span<const int> unknowns() const { return unknowns_; }
  std::size_t rows() const;

  /// Residuals in m2 (SP: m) and their exact derivatives, as math::ResidualFunction has them.
  bool evaluate(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian);
  /// The link of the last evaluation.
  const CornerLink& link() const { return link_; }

 private:
  bool evaluate_strut(std::span<double> residuals, std::span<double> jacobian);
  bool evaluate_centre(std::size_t centre, std::span<double> residuals, std::span<double> jacobian);

  const LinkMotion* motion_;
  LinkMotion inverse_;
  CornerLink link_;
  Vec3 near_;  ///< the point of a strut
  bool applicable_ = false;
  std::vector<Vec3>*tracks_ = nullptr,
  *centres_ = nullptr;  ///< the points of link_ that are searched, that follow
  std::vector<int> unknowns_;
  int track_column_[2][3] = {};  ///< column of the Jacobian, -1 = given
  int centre_free_[2][3] = {};   ///< free coordinates of a centre, the first centre_count_
  int centre_count_[2] = {};
  int given_along_ = -1;  ///< given coordinate of the point of a strut
  std::vector<double> q_, e_, z_;
};

}  // namespace linkwright::suspension
