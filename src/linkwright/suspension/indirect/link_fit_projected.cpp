// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_projected.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace linkwright::suspension {
namespace {

double& component(Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

}  // namespace

LinkProjection::LinkProjection(const LinkMotion& motion, const CornerLink& given, LinkColumns columns)
    : motion_(&motion), link_(given) {
  if (given.type == LinkType::S || given.type == LinkType::R) return;
  const std::size_t bodies = given.body.size();
  const bool from_body = given.type == LinkType::SR || given.type == LinkType::SP;
  tracks_ = from_body ? &link_.body : &link_.carrier;
  centres_ = from_body ? &link_.carrier : &link_.body;
  if (from_body) inverse_ = inverse(motion);
  const std::size_t first_track = from_body ? 0 : bodies, first_centre = from_body ? bodies : 0;
  for (std::size_t t = 0; t < tracks_->size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int place = static_cast<int>(3 * (first_track + t)) + k;
      const bool free = columns[place] >= 0;
      track_column_[t][k] = free ? static_cast<int>(unknowns_.size()) : -1;
      if (free) unknowns_.push_back(place);
    }
  for (std::size_t c = 0; c < centres_->size(); ++c)
    for (int k = 0; k < 3; ++k) {
      if (columns[3 * (first_centre + c) + k] >= 0)
        centre_free_[c][centre_count_[c]++] = k;
      else
        given_along_ = k;
    }
  if (given.type == LinkType::SP) near_ = given.carrier[0];
  applicable_ = !unknowns_.empty();
}

std::size_t LinkProjection::rows() const {
  const std::size_t n = motion_->size();
  return link_.type == LinkType::SP ? 3 * n : n * tracks_->size() * centres_->size();
}

bool LinkProjection::evaluate(std::span<const double> x, std::span<double> residuals,
                              std::span<double> jacobian) {
  for (std::size_t t = 0; t < tracks_->size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (track_column_[t][k] >= 0) component((*tracks_)[t], k) = x[track_column_[t][k]];
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  if (link_.type == LinkType::SP) return evaluate_strut(residuals, jacobian);
  for (std::size_t c = 0; c < centres_->size(); ++c)
    if (!evaluate_centre(c, residuals, jacobian)) return false;
  return true;
}

bool LinkProjection::evaluate_centre(std::size_t centre, std::span<double> residuals,
                                     std::span<double> jacobian) {
  const LinkMotion& motion = inverse_.size() ? inverse_ : *motion_;
  const std::size_t n = motion.size(), tracks = tracks_->size(), m = n * tracks, all = rows();
  const int free = centre_count_[centre];
  const int* axis = centre_free_[centre];
  q_.resize(3 * m);
  e_.resize(m);
  Vec3& y = (*centres_)[centre];
  for (int f = 0; f < free; ++f) component(y, axis[f]) = 0;

  // (q - x)'y = (|q|^2 - |x|^2) / 2; given coordinates go to the right-hand side.
  for (std::size_t t = 0; t < tracks; ++t) {
    const Vec3& x = (*tracks_)[t];
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 q = motion.moved(i, x), a = q - x;
      const std::size_t row = t * n + i;
      e_[row] = dot(a, 0.5 * (q + x) - y);
      for (int f = 0; f < free; ++f) q_[f * m + row] = component(a, axis[f]);
    }
  }
  // Gram-Schmidt, each column twice: orthogonal to rounding however near the columns are to dependence.
  double t_[3][3] = {}, b[3] = {};
  for (int f = 0; f < free; ++f) {
    double* column = &q_[f * m];
    for (int pass = 0; pass < 2; ++pass)
      for (int g = 0; g < f; ++g) {
        double s = 0;
        for (std::size_t r = 0; r < m; ++r) s += q_[g * m + r] * column[r];
        for (std::size_t r = 0; r < m; ++r) column[r] -= s * q_[g * m + r];
        t_[g][f] += s;
      }
    double square = 0;
    for (std::size_t r = 0; r < m; ++r) square += column[r] * column[r];
    t_[f][f] = std::sqrt(square);
    if (!(t_[f][f] > 0)) return false;
    for (std::size_t r = 0; r < m; ++r) column[r] /= t_[f][f];
  }
  for (int pass = 0; pass < 2; ++pass)
    for (int f = 0; f < free; ++f) {
      double s = 0;
      for (std::size_t r = 0; r < m; ++r) s += q_[f * m + r] * e_[r];
      for (std::size_t r = 0; r < m; ++r) e_[r] -= s * q_[f * m + r];
      b[f] += s;
    }
  for (int f = free; f-- > 0;) {
    double s = b[f];
    for (int g = f + 1; g < free; ++g) s -= t_[f][g] * component(y, axis[g]);
    component(y, axis[f]) = s / t_[f][f];
  }
  std::copy(e_.begin(), e_.end(), residuals.begin() + static_cast<std::ptrdiff_t>(centre * m));
  if (jacobian.empty()) return true;

  z_.resize(m);
  for (std::size_t t = 0; t < tracks; ++t) {
    const Vec3& x = (*tracks_)[t];
    const Vec3 d0 = x - y;
    // Sum of e_i (R_i - I), of which the rows of free coordinates are needed.
    Vec3 turned[3];
    for (int f = 0; f < free; ++f)
      for (std::size_t i = 0; i < n; ++i) turned[f] += e_[t * n + i] * motion.rotation[i].row[axis[f]];
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) total += e_[t * n + i];
    for (int f = 0; f < free; ++f) component(turned[f], axis[f]) -= total;
    for (int k = 0; k < 3; ++k) {
      if (track_column_[t][k] < 0) continue;
      std::fill(z_.begin(), z_.end(), 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 d = motion.moved(i, x) - y;
        const Mat3& r = motion.rotation[i];
        z_[t * n + i] = d.x * component(r.row[0], k) + d.y * component(r.row[1], k) +
                        d.z * component(r.row[2], k) - component(d0, k);
      }
      double v[3] = {};  // T^-T S
      for (int f = 0; f < free; ++f) {
        double s = component(turned[f], k);
        for (int g = 0; g < f; ++g) s -= t_[g][f] * v[g];
        v[f] = s / t_[f][f];
      }
      for (int f = 0; f < free; ++f) {
        for (std::size_t r = 0; r < m; ++r) v[f] += q_[f * m + r] * z_[r];
      }
      double* to = &jacobian[track_column_[t][k] * all + centre * m];
      for (std::size_t r = 0; r < m; ++r) {
        double s = z_[r];
        for (int f = 0; f < free; ++f) s -= v[f] * q_[f * m + r];
        to[r] = s;
      }
    }
  }
  return true;
}

bool LinkProjection::evaluate_strut(std::span<double> residuals, std::span<double> jacobian) {
  const std::size_t n = motion_->size(), all = rows();
  const Vec3 y = link_.body[0];
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 moved = inverse_.moved(i, y) - y;
    const Eigen::Vector3d w(moved.x, moved.y, moved.z);
    scatter += w * w.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d& values = solver.eigenvalues();
  if (!(values[2] - values[1] > 1e-12 * values[2])) return false;  // no line
  Vec3 v[3];
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d column = solver.eigenvectors().col(k);
    v[k] = {column.x(), column.y(), column.z()};
  }
  const Vec3 u = v[2];
  // The point of the strut on its line: at the given coordinate, or nearest to where it may be.
  double along = dot(near_ - y, u);
  if (given_along_ >= 0) along = component(near_ - y, given_along_) / component(u, given_along_);
  link_.carrier[0] = y + along * u;
  if (!std::isfinite(along)) return false;

  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 w = inverse_.moved(i, y) - y, across = w - dot(u, w) * u;
    for (int k = 0; k < 3; ++k) residuals[3 * i + k] = component(across, k);
  }
  if (jacobian.empty()) return true;
  for (int k = 0; k < 3; ++k) {
    if (track_column_[0][k] < 0) continue;
    const auto moved_by = [&](std::size_t i) {  // column k of R' - I
      Vec3 d = motion_->rotation[i].row[k];
      component(d, k) -= 1;
      return d;
    };
    Vec3 change;  // change of the scatter, times u
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 w = inverse_.moved(i, y) - y, d = moved_by(i);
      change += dot(w, u) * d + dot(d, u) * w;
    }
    const Vec3 turn = (dot(v[0], change) / (values[2] - values[0])) * v[0] +
                      (dot(v[1], change) / (values[2] - values[1])) * v[1];
    double* to = &jacobian[track_column_[0][k] * all];
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 w = inverse_.moved(i, y) - y, d = moved_by(i);
      const Vec3 r = d - dot(u, d) * u - dot(u, w) * turn - dot(turn, w) * u;
      to[3 * i] = r.x, to[3 * i + 1] = r.y, to[3 * i + 2] = r.z;
    }
  }
  return true;
}

}  // namespace linkwright::suspension
