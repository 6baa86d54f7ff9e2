// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/solve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/core/check.h"
#include "linkwright/math/dense.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using Vector8 = std::array<double, 8>;
using Vector3 = std::array<Complex, 3>;
using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr std::size_t max_rows = 7;
// A direction of the rows that is shorter than this, of rows of length one, is rounding of the others.
constexpr double dependent_rows = 1e-10;
// A point is on both conics if its residual for the conics, of norm one, is at most this.
constexpr double on_conics = 1e-12;
// Solutions that differ by less, in directions of length about one, are one.
constexpr double same_solution = 1e-7;
// Imaginary parts that rounding makes where two real solutions are about to become one.
constexpr double real_solution = 1e-7;
// q0 of a slide, next to the other numbers of poses of size one.
constexpr double no_circle = 1e-9;

double length8(const Vector8& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// Poses about their middle, of size one, so that no row depends on units or on the place of the origin.
struct Frame {
  Complex centre;
  double size = 1;
  explicit Frame(std::span<const BodyPose> poses) {
    for (const BodyPose& pose : poses) centre += pose.origin;
    centre /= static_cast<double>(poses.size());
    double sum = 0;
    for (const BodyPose& pose : poses) sum += std::norm(pose.origin - centre);
    const double rms = std::sqrt(sum / static_cast<double>(poses.size()));
    if (rms > 0) size = rms;
  }
  Complex in(Complex point) const { return (point - centre) / size; }
  Complex out(Complex point) const { return size * point + centre; }
};

Vector8 normalised(Vector8 row) {
  const double length = length8(row);
  for (double& x : row) x /= length;
  return row;
}

Vector8 row_of(const BodyPose& pose, const Frame& frame) {
  const Complex d = frame.in(pose.origin), turn = std::polar(1.0, pose.angle), a = std::conj(d) * turn;
  return normalised({std::norm(d), 2 * a.real(), -2 * a.imag(), 2 * d.real(), 2 * d.imag(), 2 * turn.real(),
                     -2 * turn.imag(), 1});
}

struct Rows {
  std::array<Vector8, max_rows> rows;
  std::size_t count = 0;
  void add(const Vector8& row) { rows[count++] = normalised(row); }
};

void prescribe(const Prescription& p, const Frame& frame, Rows& rows) {
  if (p.fixed) {  // qb = -G q0, qc = -conj(G) qa
    const Complex g = frame.in(*p.fixed);
    rows.add({g.real(), 0, 0, 1, 0, 0, 0, 0});
    rows.add({g.imag(), 0, 0, 0, 1, 0, 0, 0});
    rows.add({0, g.real(), g.imag(), 0, 0, 1, 0, 0});
    rows.add({0, -g.imag(), g.real(), 0, 0, 0, 1, 0});
  }
  if (p.moving) {  // qa = W q0, qc = W conj(qb)
    const Complex w = *p.moving / frame.size;
    rows.add({-w.real(), 1, 0, 0, 0, 0, 0, 0});
    rows.add({-w.imag(), 0, 1, 0, 0, 0, 0, 0});
    rows.add({0, 0, 0, -w.real(), -w.imag(), 1, 0, 0});
    rows.add({0, 0, 0, -w.imag(), w.real(), 0, 1, 0});
  }
  if (p.fixed_line) {  // Re(conj(n) qb) + Re(conj(n) p) q0 = 0
    const Complex n = Complex(0, 1) * p.fixed_line->direction / std::abs(p.fixed_line->direction);
    rows.add({std::real(std::conj(n) * frame.in(p.fixed_line->point)), 0, 0, n.real(), n.imag(), 0, 0, 0});
  }
  if (p.moving_line) {  // Re(conj(n) qa) - Re(conj(n) p) q0 = 0
    const Complex n = Complex(0, 1) * p.moving_line->direction / std::abs(p.moving_line->direction);
    rows.add(
        {-std::real(std::conj(n) * p.moving_line->point) / frame.size, n.real(), n.imag(), 0, 0, 0, 0, 0});
  }
}

// An orthonormal basis of what is perpendicular to the rows, by Householder reflections with pivoting. False
// when the rows depend on each other.
bool null_space(Rows& a, std::array<Vector8, 8>& basis) {
  std::array<Vector8, max_rows> reflections;
  for (std::size_t k = 0; k < a.count; ++k) {
    const auto tail = [&](const Vector8& row) {
      double sum = 0;
      for (std::size_t i = k; i < 8; ++i) sum += row[i] * row[i];
      return sum;
    };
    for (std::size_t j = k + 1; j < a.count; ++j)
      if (tail(a.rows[j]) > tail(a.rows[k])) std::swap(a.rows[j], a.rows[k]);
    const double length = std::sqrt(tail(a.rows[k]));
    if (!(length > dependent_rows)) return false;
    Vector8& v = reflections[k];
    v = a.rows[k];
    std::fill_n(v.begin(), k, 0.0);
    v[k] += std::copysign(length, v[k]);
    v = normalised(v);
    for (std::size_t j = k; j < a.count; ++j) {
      double dot = 0;
      for (std::size_t i = k; i < 8; ++i) dot += v[i] * a.rows[j][i];
      for (std::size_t i = k; i < 8; ++i) a.rows[j][i] -= 2 * dot * v[i];
    }
  }
  for (std::size_t c = a.count; c < 8; ++c) {
    Vector8& out = basis[c - a.count];
    out = {};
    out[c] = 1;
    for (std::size_t k = a.count; k-- > 0;) {
      double dot = 0;
      for (std::size_t i = 0; i < 8; ++i) dot += reflections[k][i] * out[i];
      for (std::size_t i = 0; i < 8; ++i) out[i] -= 2 * dot * reflections[k][i];
    }
  }
  return true;
}

double dot9(const Matrix3& a, const Matrix3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += a[i][j] * b[i][j];
  return sum;
}

// The two conics q0 qc = qa conj(qb) of the null space, of norm one and perpendicular to each other as
// vectors, which changes none of their common points.
bool conics(const std::array<Vector8, 8>& k, Matrix3& a, Matrix3& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto product = [&](const Vector8& u, const Vector8& v) {
        return u[0] * Complex(v[5], v[6]) - Complex(u[1], u[2]) * Complex(v[3], -v[4]);
      };
      const Complex m = 0.5 * (product(k[i], k[j]) + product(k[j], k[i]));
      a[i][j] = m.real();
      b[i][j] = m.imag();
    }
  const auto scale = [](Matrix3& m) {
    const double norm = std::sqrt(dot9(m, m));
    if (!(norm > dependent_rows)) return false;
    for (auto& row : m)
      for (double& x : row) x /= norm;
    return true;
  };
  if (!scale(a) || !scale(b)) return false;
  const double along = dot9(a, b);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) b[i][j] -= along * a[i][j];
  return scale(b);
}

Matrix3 turned(const Matrix3& m, const Matrix3& r) {
  Matrix3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) out[i][j] += r[k][i] * m[k][l] * r[l][j];
  return out;
}

Matrix3 rotation(const std::array<double, 4>& q) {
  const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
           {2 * (x * y + w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - w * x) / n},
           {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, 1 - 2 * (x * x + y * y) / n}}};
}

// Roots of c[0] + c[1] x + ... + c[4] x^4 by the simultaneous iteration of Aberth 1973.
std::array<Complex, 4> quartic_roots(const std::array<double, 5>& c) {
  double radius = 0;
  for (std::size_t i = 0; i < 4; ++i)
    radius = std::max(radius, std::pow(std::abs(c[i] / c[4]), 1 / (4.0 - static_cast<double>(i))));
  std::array<Complex, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    x[i] = std::polar(std::max(radius, 1e-3), 0.7 + 1.5707963267948966 * static_cast<double>(i));
  for (int iteration = 0; iteration < 60; ++iteration) {
    double moved = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      Complex value = c[4], slope = 0;
      for (std::size_t k = 4; k-- > 0;) {
        slope = slope * x[i] + value;
        value = value * x[i] + c[k];
      }
      if (value == 0.0) continue;
      Complex away = 0;
      for (std::size_t j = 0; j < 4; ++j)
        if (j != i && x[i] != x[j]) away += 1.0 / (x[i] - x[j]);
      const Complex step = 1.0 / (slope / value - away);
      if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) continue;
      x[i] -= step;
      moved = std::max(moved, std::abs(step) / (1e-3 + std::abs(x[i])));
    }
    if (moved < 1e-13) break;
  }
  return x;
}

Complex value_at(const Matrix3& m, const Vector3& s) {
  Complex sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += m[i][j] * s[i] * s[j];
  return sum;
}

// Newton on both conics with the greatest component held at one; the residual that is left.
double polish(const Matrix3& a, const Matrix3& b, Vector3& s, int steps) {
  std::size_t top = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(s[i]) > std::abs(s[top])) top = i;
  const Complex scale = s[top];
  for (Complex& x : s) x /= scale;
  const std::size_t u = (top + 1) % 3, v = (top + 2) % 3;
  for (int step = 0; step < steps; ++step) {
    const Complex f = value_at(a, s), g = value_at(b, s);
    Complex fu = 0, fv = 0, gu = 0, gv = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      fu += 2 * a[u][j] * s[j];
      fv += 2 * a[v][j] * s[j];
      gu += 2 * b[u][j] * s[j];
      gv += 2 * b[v][j] * s[j];
    }
    const Complex det = fu * gv - fv * gu;
    if (std::abs(det) < 1e-14) break;
    s[u] -= (f * gv - g * fv) / det;
    s[v] -= (fu * g - gu * f) / det;
  }
  return std::max(std::abs(value_at(a, s)), std::abs(value_at(b, s)));
}

struct CommonPoints {
  std::array<Vector3, 4> points;
  std::size_t count = 0;
};

// Common points of two conics: the resultant after y, of both turned so that no point is near infinity. Of
// four turns the one that keeps most points apart.
CommonPoints common_points(const Matrix3& a, const Matrix3& b) {
  // Directions without a pattern; each turn is tried until four points are apart.
  constexpr std::array<std::array<double, 4>, 4> turns = {
      {{4.1, 1.3, -2.7, 0.9}, {1.1, -3.2, 0.8, 2.3}, {-0.7, 2.1, 3.3, 1.9}, {2.9, 0.4, 1.7, -3.8}}};
  CommonPoints best;
  for (const auto& quaternion : turns) {
    const Matrix3 r = rotation(quaternion), m = turned(a, r), n = turned(b, r);
    // m: a0 y^2 + (a1 + a1x x) y + (a2 + a2x x + a2xx x^2), n likewise.
    const double a0 = m[1][1], b0 = n[1][1];
    const std::array<double, 2> a1 = {2 * m[1][2], 2 * m[0][1]}, b1 = {2 * n[1][2], 2 * n[0][1]};
    const std::array<double, 3> a2 = {m[2][2], 2 * m[0][2], m[0][0]}, b2 = {n[2][2], 2 * n[0][2], n[0][0]};
    std::array<double, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = a0 * b2[i] - b0 * a2[i];
    std::array<double, 2> q;
    for (std::size_t i = 0; i < 2; ++i) q[i] = a0 * b1[i] - b0 * a1[i];
    std::array<double, 4> s{};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 3; ++j) s[i + j] += a1[i] * b2[j] - b1[i] * a2[j];
    std::array<double, 5> resultant{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) resultant[i + j] += p[i] * p[j];
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 4; ++j) resultant[i + j] -= q[i] * s[j];
    if (resultant[4] == 0) continue;
    CommonPoints found;
    for (const Complex& x : quartic_roots(resultant)) {
      const Complex y = -(p[0] + x * (p[1] + x * p[2])) / (q[0] + x * q[1]);
      if (!std::isfinite(y.real()) || !std::isfinite(y.imag())) continue;
      Vector3 t = {x, y, 1}, point;
      for (std::size_t i = 0; i < 3; ++i) point[i] = r[i][0] * t[0] + r[i][1] * t[1] + r[i][2] * t[2];
      if (!(polish(a, b, point, 6) <= on_conics)) continue;
      bool known = false;
      for (std::size_t k = 0; k < found.count; ++k) {
        // The vector product is zero for equal directions.
        double apart = 0;
        for (std::size_t i = 0; i < 3; ++i)
          apart +=
              std::norm(point[i] * found.points[k][(i + 1) % 3] - point[(i + 1) % 3] * found.points[k][i]);
        known = known || std::sqrt(apart) < same_solution;
      }
      if (!known) found.points[found.count++] = point;
    }
    if (found.count > best.count) best = found;
    if (best.count == 4) break;
  }
  return best;
}

// The dyad of a real q in scaled coordinates; nothing for one that only holds the rotation.
std::optional<GuidingDyad> dyad_of(const Vector8& q, const Frame& frame, std::span<const BodyPose> poses) {
  const Complex qa(q[1], q[2]), qb(q[3], q[4]), qc(q[5], q[6]);
  const double most = std::max(std::abs(qa), std::abs(qb));
  if (most <= no_circle * length8(q) && std::abs(q[0]) <= no_circle * length8(q)) return std::nullopt;
  GuidingDyad out;
  const auto mean = [&](auto&& value) {
    double sum = 0;
    for (const BodyPose& pose : poses) sum += value(pose);
    return sum / static_cast<double>(poses.size());
  };
  if (std::abs(q[0]) > no_circle * std::max(most, std::abs(qc))) {
    out.type = GuidingDyadType::rr;
    out.moving = frame.size * qa / q[0];
    out.fixed = frame.out(-qb / q[0]);
    // Not by |W|^2 + |G|^2 - qd / q0, which cancels for distant pivots.
    out.length = mean([&](const BodyPose& pose) { return std::abs(place(pose, out.moving) - out.fixed); });
    return out;
  }
  if (std::abs(qa) < std::abs(qb)) {
    out.type = GuidingDyadType::pr;
    out.normal = qb / std::abs(qb);
    out.moving = frame.size * qc / std::conj(qb);
  } else {
    out.type = GuidingDyadType::rp;
    out.normal = qa / std::abs(qa);
    out.fixed = frame.out(std::conj(-qc / qa));
  }
  out.offset = mean([&](const BodyPose& pose) { return gap(out, pose); });
  return out;
}

bool before(const GuidingDyad& a, const GuidingDyad& b) {
  return a.type != b.type ? a.type < b.type : a.length < b.length;
}

void insert(GuidingDyads& dyads, const GuidingDyad& dyad) {
  std::size_t k = static_cast<std::size_t>(dyads.count++);
  for (; k > 0 && before(dyad, dyads.found[k - 1]); --k) dyads.found[k] = dyads.found[k - 1];
  dyads.found[k] = dyad;
}

// All dyads of a three-dimensional null space.
GuidingDyads dyads_of(const std::array<Vector8, 8>& basis, const Frame& frame,
                      std::span<const BodyPose> poses, const Prescription& prescription) {
  GuidingDyads out;
  Matrix3 a, b;
  if (!conics(basis, a, b)) {
    out.status = Status::singular;
    return out;
  }
  const CommonPoints points = common_points(a, b);
  for (std::size_t k = 0; k < points.count; ++k) {
    Vector3 s = points.points[k];
    ++out.solutions;
    double imaginary = 0;
    for (const Complex& x : s) imaginary = std::max(imaginary, std::abs(x.imag()));
    if (imaginary > real_solution) continue;
    for (Complex& x : s) x = x.real();
    polish(a, b, s, 2);
    Vector8 q{};
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = 0; j < 3; ++j) q[i] += s[j].real() * basis[j][i];
    const std::optional<GuidingDyad> dyad = dyad_of(q, frame, poses);
    // A pivot that is not there is on every line.
    const bool trivial = !dyad || (dyad->type == GuidingDyadType::rp && prescription.fixed_line) ||
                         (dyad->type == GuidingDyadType::pr && prescription.moving_line);
    if (trivial)
      --out.solutions;
    else
      insert(out, *dyad);
  }
  return out;
}

bool finite(std::span<const BodyPose> poses) {
  return std::all_of(poses.begin(), poses.end(), [](const BodyPose& pose) {
    return std::isfinite(pose.origin.real()) && std::isfinite(pose.origin.imag()) &&
           std::isfinite(pose.angle);
  });
}

}  // namespace

int poses_replaced(const Prescription& p) {
  return 2 * (p.fixed.has_value() + p.moving.has_value()) + p.fixed_line.has_value() +
         p.moving_line.has_value();
}

bool prescribes(const Prescription& p) { return poses_replaced(p) > 0 || p.fixed_region || p.moving_region; }

GuidingDyads solve_dyads(std::span<const BodyPose> poses, const Prescription& prescription) {
  LINKWRIGHT_REQUIRE(static_cast<int>(poses.size()) + poses_replaced(prescription) == 5, "{} poses",
                     poses.size());
  LINKWRIGHT_REQUIRE(!(prescription.fixed && (prescription.fixed_line || prescription.moving)) &&
                         !(prescription.moving && prescription.moving_line),
                     "a pivot is given twice, or both are");
  LINKWRIGHT_REQUIRE(finite(poses), "a pose is not finite");
  const Frame frame(poses);
  Rows rows;
  for (const BodyPose& pose : poses) rows.add(row_of(pose, frame));
  prescribe(prescription, frame, rows);
  std::array<Vector8, 8> basis;
  GuidingDyads out;
  if (!null_space(rows, basis)) {
    out.status = Status::singular;
    return out;
  }
  if (rows.count == 5) return dyads_of(basis, frame, poses, prescription);
  // A pivot is given: the rows leave one vector, and the second equation of (1) holds by itself.
  if (const std::optional<GuidingDyad> dyad = dyad_of(basis[0], frame, poses)) {
    out.found[0] = *dyad;
    out.count = out.solutions = 1;
  }
  return out;
}

std::optional<GuidingDyad> slide_dyad(std::span<const BodyPose> poses, GuidingDyadType type) {
  LINKWRIGHT_REQUIRE(poses.size() == 4 && type != GuidingDyadType::rr, "{} poses", poses.size());
  LINKWRIGHT_REQUIRE(finite(poses), "a pose is not finite");
  const Frame frame(poses);
  Rows rows;
  for (const BodyPose& pose : poses) rows.add(row_of(pose, frame));
  const std::size_t other = type == GuidingDyadType::pr ? 1 : 3;
  for (const std::size_t zero : {std::size_t{0}, other, other + 1}) {
    Vector8 row{};
    row[zero] = 1;
    rows.add(row);
  }
  std::array<Vector8, 8> basis;
  if (!null_space(rows, basis)) return std::nullopt;
  return dyad_of(basis[0], frame, poses);
}

DyadFit fit_dyads(std::span<const BodyPose> poses) {
  const std::size_t n = poses.size();
  LINKWRIGHT_REQUIRE(n >= 5, "{} poses", n);
  LINKWRIGHT_REQUIRE(finite(poses), "a pose is not finite");
  const Frame frame(poses);
  // A row of zeros where five poses fill no square: eight singular vectors in any case.
  const std::size_t m = std::max<std::size_t>(n, 8);
  std::vector<double> matrix(m * 8);
  for (std::size_t k = 0; k < n; ++k) {
    const Vector8 row = row_of(poses[k], frame);
    for (std::size_t j = 0; j < 8; ++j) matrix[j * m + k] = row[j];
  }
  const math::SingularVectors vectors = math::singular_vectors(matrix, 8);
  std::array<Vector8, 8> basis{};
  DyadFit out;
  for (std::size_t j = 0; j < 8; ++j) out.misfit[j] = vectors.values[j] / vectors.values[0];
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 8; ++i) basis[k][i] = vectors.right[(5 + k) * 8 + i];
  const GuidingDyads found = dyads_of(basis, frame, poses, {});
  out.dyads.assign(found.real().begin(), found.real().end());
  std::stable_sort(out.dyads.begin(), out.dyads.end(), [&](const GuidingDyad& a, const GuidingDyad& b) {
    return spread(a, poses) < spread(b, poses);
  });
  return out;
}

}  // namespace linkwright::planar
