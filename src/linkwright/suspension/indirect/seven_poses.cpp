// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/seven_poses.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/dense.h"
#include "linkwright/suspension/indirect/link_fit_direct.h"

namespace linkwright::suspension {
namespace {

using Complex = std::complex<double>;
using Complex3 = Eigen::Vector3cd;
using Complex6 = Eigen::Matrix<Complex, 6, 1>;
using ComplexSystem = Eigen::Matrix<Complex, 6, 6>;
using System = Eigen::Matrix<double, 6, 6>;

constexpr double length_scale = 0.4;  // m: coordinates of wheel suspensions become about one
constexpr int newton_steps = 30;
constexpr std::uint32_t attempts = 6;      // families make the eigenvalues of isolated solutions inexact
constexpr double converged = 1e-11;        // relative to the largest term of an equation
constexpr double same_solution = 1e-6;     // relative
constexpr double singular_system = 1e-11;  // smallest over largest singular value: on a family
constexpr double farthest = 1e4;           // in length scales: a solution at infinity

Eigen::Vector3d eigen(const Vec3& a) { return {a.x, a.y, a.z}; }
Vec3 plain(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }

/// One equation a'x + c - x'B y - t'y = 0.
struct Bilinear {
  Eigen::Vector3d a, t;
  Eigen::Matrix3d b;
  double c = 0;
};
using Equations = std::array<Bilinear, 6>;

Eigen::Matrix3d random_basis(RandomStream& random) {
  const auto draw = [&] { return Eigen::Vector3d{random.normal(), random.normal(), random.normal()}; };
  Eigen::Matrix3d m;
  m.col(0) = draw().normalized();
  m.col(2) = m.col(0).cross(draw()).normalized();
  m.col(1) = m.col(2).cross(m.col(0));
  return m;
}

template <class Scalar>
struct Point {
  Eigen::Matrix<Scalar, 3, 1> x, y;
};

template <class Scalar>
double evaluate(const Equations& equations, const Point<Scalar>& p, Eigen::Matrix<Scalar, 6, 1>& f,
                Eigen::Matrix<Scalar, 6, 6>& jacobian) {
  double relative = 0;
  for (int i = 0; i < 6; ++i) {
    const Bilinear& e = equations[static_cast<std::size_t>(i)];
    const Eigen::Matrix<Scalar, 3, 1> by = e.b.template cast<Scalar>() * p.y;
    const Eigen::Matrix<Scalar, 3, 1> bx = e.b.transpose().template cast<Scalar>() * p.x;
    const auto product = [](const auto& u, const auto& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
    const Scalar ax = product(e.a, p.x), xby = product(p.x, by), ty = product(e.t, p.y);
    f[i] = ax + e.c - xby - ty;
    const double size = std::abs(ax) + std::abs(e.c) + std::abs(xby) + std::abs(ty);
    relative = std::max(relative, std::abs(f[i]) / std::max(size, 1e-300));
    for (int k = 0; k < 3; ++k) {
      jacobian(i, k) = e.a[k] - by[k];
      jacobian(i, 3 + k) = -bx[k] - e.t[k];
    }
  }
  return relative;
}

/// Eigenvalue problem for the third coordinate of x: each equation times the ten monomials of degree three in
/// the other two, in the products of fifteen monomials with y1, y2, y3 and 1. Those of degree four do not
/// meet the hidden coordinate and are eliminated.
std::vector<Complex3> carrier_points(const Equations& equations, double shift, bool& regular) {
  constexpr int high = 40, all = 60;
  // Monomials x1^i x2^j of degree up to three first, then those of degree four.
  std::array<std::array<int, 5>, 5> place{};
  int next = 0;
  for (int degree = 0; degree <= 4; ++degree)
    for (int i = degree; i >= 0; --i) place[i][degree - i] = next++;
  Eigen::MatrixXd m0 = Eigen::MatrixXd::Zero(all, all), m1 = Eigen::MatrixXd::Zero(all, high);
  int row = 0;
  for (const Bilinear& e : equations)
    for (int degree = 0; degree <= 3; ++degree)
      for (int i = degree; i >= 0; --i, ++row) {
        const int j = degree - i;
        const int same = 4 * place[i][j], by_x1 = 4 * place[i + 1][j], by_x2 = 4 * place[i][j + 1];
        for (int k = 0; k < 3; ++k) {
          m0(row, same + k) -= e.t[k];
          m0(row, by_x1 + k) -= e.b(0, k);
          m0(row, by_x2 + k) -= e.b(1, k);
          m1(row, same + k) -= e.b(2, k);
        }
        m0(row, same + 3) += e.c;
        m0(row, by_x1 + 3) += e.a[0];
        m0(row, by_x2 + 3) += e.a[1];
        m1(row, same + 3) += e.a[2];
      }
  m0.leftCols<high>() += shift * m1;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(m0);
  regular = lu.rcond() > 1e-15;
  const Eigen::MatrixXd reduced = lu.solve(m1).topRows<high>();
  std::vector<Complex3> found;
  if (!reduced.allFinite()) return found;
  const math::Eigenvectors solved = math::eigenvectors(math::numbers(reduced));
  for (int k = 0; k < high; ++k) {
    const Complex mu = solved.values[at(k)];
    if (std::abs(mu) < 1.0 / farthest) continue;
    const Complex* w = &solved.vectors[at(k * high)];
    const Complex one = w[3];
    if (std::abs(one) < 1e-12) continue;
    found.emplace_back(w[4 * place[1][0] + 3] / one, w[4 * place[0][1] + 3] / one, shift - 1.0 / mu);
  }
  return found;
}

/// The real form of a complex matrix: real and imaginary parts of its columns, and of the columns times i.
template <int rows, int columns>
Eigen::MatrixXd real_form(const Eigen::Matrix<Complex, rows, columns>& m) {
  Eigen::MatrixXd out(2 * rows, 2 * columns);
  out << m.real(), -m.imag(), m.imag(), m.real();
  return out;
}

Complex3 body_point(const Equations& equations, const Complex3& x) {
  Eigen::Matrix<Complex, 6, 3> m;
  Eigen::VectorXd r(12);
  for (int i = 0; i < 6; ++i) {
    const Bilinear& e = equations[static_cast<std::size_t>(i)];
    m.row(i) = (e.b.transpose().cast<Complex>() * x + e.t.cast<Complex>()).transpose();
    const Complex right = e.a[0] * x[0] + e.a[1] * x[1] + e.a[2] * x[2] + e.c;
    r[i] = right.real();
    r[6 + i] = right.imag();
  }
  const std::vector<double> y = math::linear_fit(math::numbers(real_form(m)), 6, math::numbers(r));
  return Complex3(Complex(y[0], y[3]), Complex(y[1], y[4]), Complex(y[2], y[5]));
}

bool polish(const Equations& equations, Point<Complex>& p) {
  Complex6 f;
  ComplexSystem jacobian;
  double best = infinity;
  for (int step = 0; step < newton_steps; ++step) {
    const double error = evaluate(equations, p, f, jacobian);
    if (!std::isfinite(error) || p.x.norm() > farthest || p.y.norm() > farthest) return false;
    if (error < converged && error >= best / 2) return true;
    best = std::min(best, error);
    Eigen::VectorXd parts(12);
    parts << f.real(), f.imag();
    const Eigen::VectorXd change = Eigen::PartialPivLU<Eigen::MatrixXd>(real_form(jacobian)).solve(parts);
    for (int k = 0; k < 3; ++k) {
      p.x[k] -= Complex(change[k], change[6 + k]);
      p.y[k] -= Complex(change[3 + k], change[9 + k]);
    }
  }
  return best < converged;
}

bool on_family(const Equations& equations, const Point<Complex>& p) {
  Complex6 f;
  ComplexSystem jacobian;
  evaluate(equations, p, f, jacobian);
  const std::vector<double> values = math::singular_vectors(math::numbers(real_form(jacobian)), 12).values;
  return values.back() <= singular_system * values.front();
}

/// Goes to the nearest real solution, on a family too; says how singular the system is there.
bool polish_real(const Equations& equations, Point<double>& p, double& singularity) {
  Eigen::Matrix<double, 6, 1> f;
  System jacobian;
  for (int step = 0; step < newton_steps; ++step) {
    const double error = evaluate(equations, p, f, jacobian);
    if (!std::isfinite(error) || p.x.norm() > farthest || p.y.norm() > farthest) return false;
    const math::LeastNorm change =
        math::least_norm(math::numbers(jacobian), 6, math::numbers(f), singular_system);
    singularity = change.condition;
    if (error < converged) return true;
    p.x -= Eigen::Vector3d(change.x.data());
    p.y -= Eigen::Vector3d(change.x.data() + 3);
  }
  return false;
}

/// Points of a family that share one end: the direction of the line of the others, if they are on one.
bool on_line(const std::vector<Eigen::Vector3d>& points, Eigen::Vector3d& middle,
             Eigen::Vector3d& direction) {
  middle.setZero();
  for (const auto& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points) scatter += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  direction = solver.eigenvectors().col(2);
  return solver.eigenvalues()[2] > 1e-6 && solver.eigenvalues()[1] < 1e-8 * solver.eigenvalues()[2];
}

/// Collects families: solutions with the same point at one end and different ones at the other.
void find_arms(const std::vector<Point<double>>& family, bool shared_carrier, const Vec3& origin,
               bool moved_by_rack, std::vector<CornerLink>& arms) {
  std::vector<bool> used(family.size(), false);
  for (std::size_t i = 0; i < family.size(); ++i) {
    if (used[i]) continue;
    const Eigen::Vector3d shared = shared_carrier ? family[i].x : family[i].y;
    std::vector<Eigen::Vector3d> others;
    for (std::size_t j = i; j < family.size(); ++j) {
      if (((shared_carrier ? family[j].x : family[j].y) - shared).norm() > same_solution) continue;
      used[j] = true;
      others.push_back(shared_carrier ? family[j].y : family[j].x);
    }
    Eigen::Vector3d middle, direction;
    if (others.size() < 3 || !on_line(others, middle, direction)) continue;
    // The axis' point nearest to the shared one, and another 0.1 m along.
    const Eigen::Vector3d foot = middle + direction * direction.dot(shared - middle);
    const Eigen::Vector3d along = foot + direction * (0.1 / length_scale);
    const auto place = [&](const Eigen::Vector3d& p) { return plain(p * length_scale) + origin; };
    CornerLink arm{.type = shared_carrier ? LinkType::RS : LinkType::SR, .moved_by_rack = moved_by_rack};
    auto& one = shared_carrier ? arm.carrier : arm.body;
    auto& two = shared_carrier ? arm.body : arm.carrier;
    one = {place(shared)};
    two = {place(foot), place(along)};
    arms.push_back(arm);
  }
}

}  // namespace

SevenPoseReport seven_pose_rods(const LinkMotion& motion, const SixPositions& positions, const Vec3& origin,
                                bool moved_by_rack, std::uint64_t seed) {
  Equations equations;
  for (std::size_t i = 0; i < 6; ++i) {
    LINKWRIGHT_REQUIRE(positions[i] < motion.size(), "position {} of {}", positions[i], motion.size());
    Eigen::Matrix3d r;
    for (int k = 0; k < 3; ++k) r.row(k) = eigen(motion.rotation[positions[i]].row[k]).transpose();
    const Eigen::Vector3d t = eigen(motion.shift[positions[i]]) / length_scale;
    equations[i] = {.a = r.transpose() * t,
                    .t = t,
                    .b = r.transpose() - Eigen::Matrix3d::Identity(),
                    .c = t.squaredNorm() / 2};
  }

  SevenPoseReport report;
  report.positions = positions;
  bool regular = true;
  std::vector<Point<Complex>> solutions;
  std::vector<Point<double>> family;
  for (std::uint32_t attempt = 0; attempt == 0 || (attempt < attempts && (!regular || !family.empty()));
       ++attempt) {
    RandomStream random({seed, attempt});
    const Eigen::Matrix3d basis_x = random_basis(random), basis_y = random_basis(random);
    Equations turned = equations;
    for (Bilinear& e : turned) {
      e.a = basis_x.transpose() * e.a;
      e.t = basis_y.transpose() * e.t;
      e.b = basis_x.transpose() * e.b * basis_y;
    }
    for (const Complex3& start : carrier_points(turned, random.uniform(0.5, 1.5), regular)) {
      Point<Complex> p;
      p.x = basis_x.cast<Complex>() * start;
      p.y = basis_y.cast<Complex>() * body_point(turned, start);
      Point<double> real{p.x.real(), p.y.real()};
      if (polish(equations, p) && !on_family(equations, p)) {
        const bool known = std::any_of(solutions.begin(), solutions.end(), [&](const Point<Complex>& other) {
          return (other.x - p.x).norm() + (other.y - p.y).norm() <
                 same_solution * (1 + p.x.norm() + p.y.norm());
        });
        if (!known) solutions.push_back(p);
        continue;
      }
      double singularity = 1;
      if (polish_real(equations, real, singularity) && singularity < singular_system) family.push_back(real);
    }
  }
  report.solutions = static_cast<int>(solutions.size());
  if (!regular || !family.empty()) report.status = Status::singular;
  find_arms(family, true, origin, moved_by_rack, report.arms);
  find_arms(family, false, origin, moved_by_rack, report.arms);

  std::vector<double> errors(motion.size());
  std::vector<SevenPoseSolution> complex;
  // Rods and their solutions, to be sorted together.
  std::vector<std::pair<SevenPoseRod, SevenPoseSolution>> real;
  for (const Point<Complex>& p : solutions) {
    SevenPoseSolution solution;
    const std::array<double, 3> from{origin.x, origin.y, origin.z};
    for (int k = 0; k < 3; ++k) {
      solution.carrier[static_cast<std::size_t>(k)] =
          p.x[k] * length_scale + from[static_cast<std::size_t>(k)];
      solution.body[static_cast<std::size_t>(k)] = p.y[k] * length_scale + from[static_cast<std::size_t>(k)];
    }
    if (p.x.imag().norm() + p.y.imag().norm() > 1e-8 * (1 + p.x.norm() + p.y.norm())) {
      complex.push_back(solution);
      continue;
    }
    SevenPoseRod rod{.link = {.body = {plain(p.y.real() * length_scale)},
                              .carrier = {plain(p.x.real() * length_scale)},
                              .moved_by_rack = moved_by_rack}};
    if (!structural_errors(motion, rod.link, errors, {}, {})) {  // no length
      complex.push_back(solution);
      continue;
    }
    for (const double e : errors) {
      rod.rms += e * e / static_cast<double>(errors.size());
      rod.largest = std::max(rod.largest, std::abs(e));
    }
    rod.rms = std::sqrt(rod.rms);
    rod.link.body[0] += origin;
    rod.link.carrier[0] += origin;
    real.emplace_back(rod, solution);
  }
  std::stable_sort(real.begin(), real.end(),
                   [](const auto& a, const auto& b) { return a.first.rms < b.first.rms; });
  for (auto& [rod, solution] : real) {
    solution.rod = static_cast<int>(report.rods.size());
    report.rods.push_back(rod);
    report.all.push_back(solution);
  }
  // Conjugate pairs beside each other.
  std::stable_sort(complex.begin(), complex.end(),
                   [](const SevenPoseSolution& a, const SevenPoseSolution& b) {
                     return a.carrier[0].real() < b.carrier[0].real();
                   });
  report.all.insert(report.all.end(), complex.begin(), complex.end());
  return report;
}

SevenPoseReport seven_pose_rods(const CarrierTargets& targets, bool moved_by_rack, std::uint64_t seed) {
  const LinkMotion motion = link_motion(targets, moved_by_rack, targets.wheel.centre);
  LINKWRIGHT_REQUIRE(motion.size() >= 6, "needs six positions besides the reference, got {}", motion.size());
  // Each time the position furthest from those chosen; turns count at the length scale.
  std::vector<double> nearest(motion.size());
  const auto apart = [](const Vec3& shift, const Mat3& a, const Mat3& b) {
    double square = dot(shift, shift);
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = length_scale * (a.row[k] - b.row[k]);
      square += dot(d, d);
    }
    return square;
  };
  for (std::size_t i = 0; i < motion.size(); ++i)
    nearest[i] = apart(motion.shift[i], motion.rotation[i], Mat3{});
  SixPositions chosen{};
  for (std::size_t& c : chosen) {
    c = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    for (std::size_t i = 0; i < motion.size(); ++i)
      nearest[i] = std::min(nearest[i],
                            apart(motion.shift[i] - motion.shift[c], motion.rotation[i], motion.rotation[c]));
  }
  return seven_pose_rods(motion, chosen, targets.wheel.centre, moved_by_rack, seed);
}

}  // namespace linkwright::suspension
