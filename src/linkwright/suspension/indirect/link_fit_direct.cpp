// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_direct.h"

#include <algorithm>
#include <cmath>

namespace linkwright::suspension {
namespace {

/// Writes rows of derivatives to the columns of one point.
struct PointColumns {
  const int* column = nullptr;
  double* jacobian = nullptr;
  std::size_t rows = 0;

  void set(std::size_t row, const Vec3& gradient) const {
    if (!jacobian) return;
    if (column[0] >= 0) jacobian[column[0] * rows + row] = gradient.x;
    if (column[1] >= 0) jacobian[column[1] * rows + row] = gradient.y;
    if (column[2] >= 0) jacobian[column[2] * rows + row] = gradient.z;
  }
};

/// m' a.
Vec3 transposed_times(const Mat3& m, const Vec3& a) {
  return a.x * m.row[0] + a.y * m.row[1] + a.z * m.row[2];
}

bool distance_errors(const LinkMotion& motion, const Vec3& body, const Vec3& carrier, std::size_t row,
                     std::span<double> errors, const PointColumns& to_body, const PointColumns& to_carrier) {
  const Vec3 d0 = carrier - body;
  const double l0 = norm(d0);
  if (!(l0 > 0)) return false;
  const Vec3 u0 = (1 / l0) * d0;
  for (std::size_t i = 0; i < motion.size(); ++i, ++row) {
    const Vec3 d = motion.moved(i, carrier) - body;
    const double l = norm(d);
    if (!(l > 0)) return false;
    // (l^2 - l0^2) / (l + l0) keeps the digits that l - l0 loses.
    errors[row] = dot(d - d0, d + d0) / (l + l0);
    const Vec3 u = (1 / l) * d;
    to_body.set(row, u0 - u);
    to_carrier.set(row, transposed_times(motion.rotation[i], u) - u0);
  }
  return true;
}

bool strut_errors(const LinkMotion& motion, const Vec3& body, const Vec3& carrier, std::span<double> errors,
                  const PointColumns& to_body, const PointColumns& to_carrier) {
  const Vec3 d = carrier - body;
  const double l = norm(d);
  if (!(l > 0)) return false;
  const Vec3 u = (1 / l) * d;
  const Mat3 identity;
  const auto component = [](const Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; };
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Mat3 back = transposed(motion.rotation[i]);
    // Displacement of the body point, seen from the carrier.
    const Vec3 w = back * (body - motion.shift[i]) - body;
    const double along = dot(u, w);
    const Vec3 across = w - along * u;
    for (int k = 0; k < 3; ++k) {
      const std::size_t row = 3 * i + k;
      errors[row] = component(across, k);
      if (!to_body.jacobian) continue;
      const Vec3 ek = identity.row[k];
      const double uk = component(u, k);
      // Row k of P (R' - I), and of -(u w' + along I) P / l for the turn of the line.
      const Vec3 normal = ek - uk * u;
      const Vec3 moved = transposed_times(back, normal) - normal;
      const Vec3 turned = (-1 / l) * (uk * across + along * normal);
      to_body.set(row, moved - turned);
      to_carrier.set(row, turned);
    }
  }
  return true;
}

void point_errors(const LinkMotion& motion, const Vec3& point, std::size_t row, std::span<double> errors,
                  const PointColumns& to) {
  const Mat3 identity;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Vec3 moved = motion.moved(i, point) - point;
    errors[row] = moved.x, errors[row + 1] = moved.y, errors[row + 2] = moved.z;
    for (int k = 0; k < 3; ++k) to.set(row++, motion.rotation[i].row[k] - identity.row[k]);
  }
}

}  // namespace

std::size_t error_rows(LinkType type, std::size_t positions) {
  const bool vectors = type == LinkType::SP || type == LinkType::S || type == LinkType::R;
  return positions * static_cast<std::size_t>(error_count(type)) * (vectors ? 3 : 1);
}

bool structural_errors(const LinkMotion& motion, const CornerLink& link, std::span<double> errors,
                       LinkColumns columns, std::span<double> jacobian) {
  const std::size_t n = motion.size(), rows = error_rows(link.type, n);
  const auto to = [&](std::size_t point) {
    if (jacobian.empty()) return PointColumns{};
    return PointColumns{columns.data() + 3 * point, jacobian.data(), rows};
  };
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  if (link.type == LinkType::SP)
    return strut_errors(motion, link.body[0], link.carrier[0], errors, to(0), to(1));
  if (link.type == LinkType::S || link.type == LinkType::R) {
    for (std::size_t k = 0; k < link.body.size(); ++k)
      point_errors(motion, link.body[k], 3 * k * n, errors, to(k));
    return true;
  }
  std::size_t row = 0;
  for (std::size_t b = 0; b < link.body.size(); ++b)
    for (std::size_t c = 0; c < link.carrier.size(); ++c, row += n)
      if (!distance_errors(motion, link.body[b], link.carrier[c], row, errors, to(b),
                           to(link.body.size() + c)))
        return false;
  return true;
}

}  // namespace linkwright::suspension
