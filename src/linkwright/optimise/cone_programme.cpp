// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cone_programme.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/cone_scaling.h"

namespace linkwright::optimise {
namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using VectorRef = Eigen::Ref<Vector>;
using VectorView = Eigen::Ref<const Vector>;

template <class V>
auto view(V&& v) {
  return std::span(v.data(), static_cast<std::size_t>(v.size()));
}

// The rows of a cone in the programme.
struct Place {
  std::size_t group = 0;
  // First row and number of rows of the slacks; first entry in the group's matrix.
  Index first = 0, size = 1, row = 0;
  double row_scale = 1;  // all rows of a cone alike, so that it stays one
};

// Rows that use the same variables, one after the other.
struct Group {
  std::vector<Index> support;
  Matrix g, scaled, normal;   // rows x support; W^-1 G; its square
  std::vector<Index> places;  // places of the lower triangle of `normal` among the values of the equations
};

// The programme as min c'x, G x + s = h, s in K, equilibrated; and everything the iteration needs.
class Solver {
 public:
  Solver(const ConeProgramme& programme, const ConeOptions& options);
  ConeReport run(RunContext& context);

 private:
  void equilibrate();
  void make_equations();
  bool factorise();
  void multiply(const VectorView& x, VectorRef out) const;             // out = G x
  void multiply_transposed(const VectorView& z, VectorRef out) const;  // out = G'z
  void apply(const VectorView& v, bool inverse, VectorRef out) const {
    cones_.apply(view(v), inverse, view(out));
  }
  void solve(const VectorView& bx, const VectorView& bz, Vector& x, Vector& z);
  void start();
  bool advance(const Vector& rx, const Vector& rz, double rt);  // false where rounding leaves no step
  struct Quality {
    double primal = 0, dual = 0, gap = 0;
    double worst() const { return std::max({primal, dual, gap}); }
  };
  Quality quality() const;
  ConeReport answer(ConeEnd end) const;

  const ConeProgramme& programme_;
  const ConeOptions& options_;
  Index n_, m_ = 0;
  ConeScaling cones_;
  std::vector<Place> places_;  // places of the blocks of cones_
  std::vector<std::size_t> place_of_cone_;
  std::vector<Group> groups_;
  Vector c_, h_, column_;
  double cost_scale_ = 1, degree_ = 0;
  Eigen::SparseMatrix<double> equations_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;

  Vector x_, s_, z_;
  double tau_ = 1, kappa_ = 1;
  mutable Vector scratch_m_, scratch_n_;
};

Solver::Solver(const ConeProgramme& programme, const ConeOptions& options)
    : programme_(programme), options_(options), n_(static_cast<Index>(programme.cost.size())) {
  // Cones that use the same variables go together.
  std::map<std::vector<Index>, std::vector<std::size_t>> by_support;
  for (std::size_t k = 0; k < programme.cones.size(); ++k) {
    std::vector<Index> support;
    const auto collect = [&](const Affine& form) {
      for (const std::size_t v : form.variables) support.push_back(static_cast<Index>(v));
    };
    collect(programme.cones[k].bound);
    for (const Affine& part : programme.cones[k].parts) collect(part);
    std::sort(support.begin(), support.end());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    by_support[std::move(support)].push_back(k);
  }
  place_of_cone_.resize(programme.cones.size());
  std::vector<double> h;
  for (const auto& [support, cones] : by_support) {
    Group group{.support = support};
    Index rows = 0;
    for (const std::size_t k : cones) {
      const auto size = static_cast<Index>(programme.cones[k].parts.size() + 1);
      place_of_cone_[k] = places_.size();
      places_.push_back({.group = groups_.size(), .first = m_ + rows, .size = size, .row = rows});
      cones_.blocks.push_back({static_cast<std::size_t>(m_ + rows), static_cast<std::size_t>(size)});
      rows += size;
    }
    group.g = Matrix::Zero(rows, static_cast<Index>(support.size()));
    Index row = 0;
    const auto add = [&, &support = support](const Affine& form) {
      for (std::size_t i = 0; i < form.variables.size(); ++i) {
        const auto at =
            std::lower_bound(support.begin(), support.end(), static_cast<Index>(form.variables[i]));
        group.g(row, at - support.begin()) = -form.factors[i];
      }
      h.push_back(form.constant);
      ++row;
    };
    for (const std::size_t k : cones) {
      add(programme.cones[k].bound);
      for (const Affine& part : programme.cones[k].parts) add(part);
    }
    m_ += rows;
    groups_.push_back(std::move(group));
  }
  c_ = Eigen::Map<const Vector>(programme.cost.data(), n_);
  h_ = Eigen::Map<const Vector>(h.data(), m_);
  degree_ = static_cast<double>(places_.size()) + 1;
  scratch_m_.resize(m_);
  scratch_n_.resize(n_);
  cones_.reset(static_cast<std::size_t>(m_));
  equilibrate();
  make_equations();
}

// Rows of a cone by one factor, columns by another, towards largest entries of 1 (Ruiz 2001).
void Solver::equilibrate() {
  column_ = Vector::Ones(n_);
  for (int pass = 0; pass < 4; ++pass) {
    Vector most = Vector::Zero(n_);
    for (Place& b : places_) {
      Group& group = groups_[b.group];
      auto rows = group.g.middleRows(b.row, b.size);
      const double largest = rows.size() > 0 ? rows.cwiseAbs().maxCoeff() : 0;
      if (!(largest > 0)) continue;
      const double factor = 1 / std::sqrt(largest);
      rows *= factor;
      h_.segment(b.first, b.size) *= factor;
      b.row_scale *= factor;
    }
    for (const Group& group : groups_)
      for (Index j = 0; j < group.g.cols(); ++j) {
        double& entry = most(group.support[static_cast<std::size_t>(j)]);
        entry = std::max(entry, group.g.col(j).cwiseAbs().maxCoeff());
      }
    for (Index j = 0; j < n_; ++j) most(j) = most(j) > 0 ? 1 / std::sqrt(most(j)) : 1;
    for (Group& group : groups_)
      for (Index j = 0; j < group.g.cols(); ++j)
        group.g.col(j) *= most(group.support[static_cast<std::size_t>(j)]);
    column_.array() *= most.array();
  }
  c_.array() *= column_.array();
  const double largest = c_.cwiseAbs().maxCoeff();
  cost_scale_ = largest > 0 ? 1 / largest : 1;
  c_ *= cost_scale_;
}

// The pattern of G' W^-2 G, once, and where each group adds to it.
void Solver::make_equations() {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index j = 0; j < n_; ++j) entries.emplace_back(j, j, 0.0);
  for (const Group& group : groups_)
    for (std::size_t a = 0; a < group.support.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b) entries.emplace_back(group.support[a], group.support[b], 0.0);
  equations_.resize(n_, n_);
  equations_.setFromTriplets(entries.begin(), entries.end());
  equations_.makeCompressed();
  const auto* rows = equations_.innerIndexPtr();
  const auto* starts = equations_.outerIndexPtr();
  for (Group& group : groups_)
    for (std::size_t b = 0; b < group.support.size(); ++b)
      for (std::size_t a = b; a < group.support.size(); ++a) {
        const auto column = group.support[b];
        const auto* at = std::lower_bound(rows + starts[column], rows + starts[column + 1], group.support[a]);
        group.places.push_back(at - rows);
      }
  factors_.analyzePattern(equations_);
}

void Solver::multiply(const VectorView& x, VectorRef out) const {
  Index first = 0;
  for (const Group& group : groups_) {
    Vector part(group.g.cols());
    for (Index j = 0; j < part.size(); ++j) part(j) = x(group.support[static_cast<std::size_t>(j)]);
    out.segment(first, group.g.rows()).noalias() = group.g * part;
    first += group.g.rows();
  }
}

void Solver::multiply_transposed(const VectorView& z, VectorRef out) const {
  out.setZero();
  Index first = 0;
  for (const Group& group : groups_) {
    const Vector part = group.g.transpose() * z.segment(first, group.g.rows());
    for (Index j = 0; j < part.size(); ++j) out(group.support[static_cast<std::size_t>(j)]) += part(j);
    first += group.g.rows();
  }
}

bool Solver::factorise() {
  for (Group& group : groups_) group.scaled = group.g;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& b = places_[k];
    auto rows = groups_[b.group].scaled.middleRows(b.row, b.size);
    if (b.size > 1) {
      const double* w = cones_.w.data() + b.first;
      const Eigen::Map<const Vector> w1(w + 1, b.size - 1);
      const Eigen::RowVectorXd dot = w1.transpose() * rows.bottomRows(b.size - 1);
      rows.bottomRows(b.size - 1).noalias() -= w1 * (rows.row(0) - dot / (1 + w[0]));
      rows.row(0) = w[0] * rows.row(0) - dot;
    }
    rows /= cones_.beta[k];
  }
  double* values = equations_.valuePtr();
  std::fill(values, values + equations_.nonZeros(), 0.0);
  for (Group& group : groups_) {
    group.normal = Matrix::Zero(group.g.cols(), group.g.cols());
    group.normal.selfadjointView<Eigen::Lower>().rankUpdate(group.scaled.transpose());
    std::size_t at = 0;
    for (Index b = 0; b < group.g.cols(); ++b)
      for (Index a = b; a < group.g.cols(); ++a) values[group.places[at++]] += group.normal(a, b);
  }
  // Against columns that depend on each other; what it does to a step, refinement takes out again.
  const double tiny = 1e-15 * std::max(1.0, equations_.diagonal().maxCoeff());
  for (Index j = 0; j < n_; ++j) equations_.coeffRef(j, j) += tiny;
  factors_.factorize(equations_);
  return factors_.info() == Eigen::Success;
}

// G'z = bx, G x - W^2 z = bz.
void Solver::solve(const VectorView& bx, const VectorView& bz, Vector& x, Vector& z) {
  Vector rx = bx, rz = bz, t(m_), dx(n_), dz(m_), u(m_);
  x = Vector::Zero(n_);
  z = Vector::Zero(m_);
  for (int pass = 0; pass < 3; ++pass) {
    apply(rz, true, t);
    apply(t, true, u);
    multiply_transposed(u, dx);
    dx = factors_.solve(Vector(rx + dx));
    multiply(dx, dz);
    dz -= rz;
    apply(dz, true, t);
    apply(t, true, dz);
    x += dx;
    z += dz;
    if (pass == 2) break;
    multiply_transposed(z, rx);
    rx = bx - rx;
    multiply(x, rz);
    apply(z, false, t);
    apply(t, false, u);
    rz = bz - rz + u;
  }
}

// The nearest points that solve the equations of either side, moved into their cones.
void Solver::start() {
  factorise();
  Vector ignored(n_);
  solve(Vector::Zero(n_), h_, x_, s_);
  s_ = -s_;
  solve(-c_, Vector::Zero(m_), ignored, z_);
  for (Vector* v : {&s_, &z_}) {
    const double a = cones_.outside(view(*v));
    if (a >= -1e-8 * std::max(1.0, v->norm())) cones_.add_unit(1 + std::max(a, 0.0), view(*v));
  }
}

Solver::Quality Solver::quality() const {
  multiply(x_, scratch_m_);
  Quality q;
  const Vector rz = scratch_m_ + s_ - h_ * tau_;
  q.primal = rz.norm() / tau_ / std::max(1.0, h_.norm());
  multiply_transposed(z_, scratch_n_);
  q.dual = (scratch_n_ + c_ * tau_).norm() / tau_ / std::max(1.0, c_.norm());
  const double cost = c_.dot(x_) / tau_, bound = -h_.dot(z_) / tau_;
  const double size = c_.cwiseProduct(x_).cwiseAbs().sum() / tau_;
  const double absolute = options_.absolute_gap * cost_scale_ / options_.gap;
  const double floor = std::max({std::abs(cost), std::abs(bound), 1e-10 * size, absolute, 1e-300});
  q.gap = std::max(s_.dot(z_) / (tau_ * tau_), std::abs(cost - bound)) / floor;
  return q;
}

ConeReport Solver::answer(ConeEnd end) const {
  ConeReport report{.end = end};
  report.x.resize(programme_.cost.size());
  const double over = end == ConeEnd::infeasible || end == ConeEnd::unbounded ? 1 : 1 / tau_;
  for (Index j = 0; j < n_; ++j) report.x[static_cast<std::size_t>(j)] = column_(j) * x_(j) * over;
  report.cost = 0;
  for (std::size_t j = 0; j < report.x.size(); ++j) report.cost += programme_.cost[j] * report.x[j];
  report.violation = 0;
  report.lower_bound = 0;
  for (std::size_t k = 0; k < programme_.cones.size(); ++k) {
    const Cone& cone = programme_.cones[k];
    double square = 0;
    for (const Affine& part : cone.parts) {
      const double v = value(part, report.x);
      square += v * v;
    }
    report.violation = std::max(report.violation, std::sqrt(square) - value(cone.bound, report.x));
    const Place& b = places_[place_of_cone_[k]];
    const double factor = b.row_scale / cost_scale_ * over;
    ConeMultiplier multiplier{.bound = factor * z_(b.first)};
    report.lower_bound -= multiplier.bound * cone.bound.constant;
    for (Index i = 1; i < b.size; ++i) {
      multiplier.parts.push_back(factor * z_(b.first + i));
      report.lower_bound -= multiplier.parts.back() * cone.parts[static_cast<std::size_t>(i - 1)].constant;
    }
    report.multipliers.push_back(std::move(multiplier));
  }
  if (end == ConeEnd::infeasible || end == ConeEnd::unbounded) {
    constexpr double infinite = infinity;
    report.cost = report.lower_bound = end == ConeEnd::infeasible ? infinite : -infinite;
    if (end == ConeEnd::infeasible) {
      report.x.clear();
      report.violation = infinite;
    } else {
      report.multipliers.clear();
    }
    return report;
  }
  const Quality q = quality();
  report.gap = q.gap;
  report.dual_residual = q.dual;
  return report;
}

// One step from residuals of the equations; the scaling and its factors are those of the iterate.
bool Solver::advance(const Vector& rx, const Vector& rz, double rt) {
  Vector x1, z1, x2, z2, ds(m_), scaled_s(m_), scaled_z(m_), right(m_), t(m_), u(m_);
  const double mu = (s_.dot(z_) + tau_ * kappa_) / degree_;
  solve(-c_, h_, x1, z1);
  const double denominator = c_.dot(x1) + h_.dot(z1) - kappa_ / tau_;

  double sigma = 0, d_tau = 0, d_kappa = 0, step = 0;
  for (int pass = 0; pass < 2; ++pass) {  // prediction, correction
    cones_.product(cones_.lambda, cones_.lambda, view(right));
    double right_kappa = -tau_ * kappa_;
    right = -right;
    if (pass == 1) {
      cones_.product(view(scaled_s), view(scaled_z), view(t));
      right -= t;
      cones_.add_unit(sigma * mu, view(right));
      right_kappa += sigma * mu - d_tau * d_kappa;
    }
    const double share = 1 - sigma;
    cones_.divide(view(right), view(t));
    apply(t, false, u);  // W (lambda \ d)
    solve(share * rx, -share * rz - u, x2, z2);
    d_tau = (-share * rt - right_kappa / tau_ - c_.dot(x2) - h_.dot(z2)) / denominator;
    x2 += d_tau * x1;
    z2 += d_tau * z1;
    d_kappa = (right_kappa - kappa_ * d_tau) / tau_;
    apply(z2, false, scaled_z);
    scaled_s = t - scaled_z;
    step = std::min(cones_.longest_step(view(scaled_s)), cones_.longest_step(view(scaled_z)));
    if (d_tau < 0) step = std::min(step, -tau_ / d_tau);
    if (d_kappa < 0) step = std::min(step, -kappa_ / d_kappa);
    if (pass == 0) {
      const double a = 1 - std::min(1.0, step);
      sigma = a * a * a;
    }
  }
  step = std::min(1.0, 0.99 * step);
  if (!(step > 1e-10) || !std::isfinite(d_tau) || !x2.allFinite() || !z2.allFinite()) return false;
  apply(scaled_s, false, ds);
  x_ += step * x2;
  s_ += step * ds;
  z_ += step * z2;
  tau_ += step * d_tau;
  kappa_ += step * d_kappa;
  // The embedding is homogeneous: its iterates may be brought to any size.
  const double size = std::max(tau_, kappa_);
  for (Vector* v : {&x_, &s_, &z_}) *v /= size;
  tau_ /= size;
  kappa_ /= size;
  return true;
}

ConeReport Solver::run(RunContext& context) {
  start();
  Vector rx(n_), rz(m_);
  Vector best_x, best_s, best_z;
  double best_tau = 1, best_kappa = 1, best = infinity;
  ConeEnd end = ConeEnd::iterations;
  Status interruption = Status::done;
  int iteration = 0;
  for (;; ++iteration) {
    multiply_transposed(z_, rx);
    const double dual_size = rx.norm();
    rx = -rx - c_ * tau_;
    multiply(x_, rz);
    rz += s_;
    const double primal_size = rz.norm();
    rz -= h_ * tau_;
    const double cx = c_.dot(x_), hz = h_.dot(z_);
    const double rt = kappa_ + cx + hz;

    const Quality q = quality();
    if (q.worst() < best) {
      best = q.worst();
      best_x = x_, best_s = s_, best_z = z_;
      best_tau = tau_, best_kappa = kappa_;
    }
    if (q.primal <= options_.residual && q.dual <= options_.residual && q.gap <= options_.gap) {
      end = ConeEnd::optimal;
      break;
    }
    // A combination of the cones that no x can meet, or a direction that lowers the cost for ever.
    if (hz < 0 && dual_size <= 1e-9 * -hz / std::max(1.0, h_.norm())) {
      end = ConeEnd::infeasible;
      z_ /= -hz;
      break;
    }
    if (cx < 0 && primal_size <= 1e-9 * -cx / std::max(1.0, c_.norm())) {
      end = ConeEnd::unbounded;
      x_ /= -cx;
      break;
    }
    if (iteration == options_.max_iterations) break;
    interruption = iteration > 0 ? context.interruption() : Status::done;
    if (interruption != Status::done) {
      end = ConeEnd::interrupted;
      break;
    }
    if (!cones_.update(view(s_), view(z_)) || !factorise() || !advance(rx, rz, rt)) {
      end = ConeEnd::rounding;
      break;
    }
  }
  if (end == ConeEnd::rounding || end == ConeEnd::iterations || end == ConeEnd::interrupted) {
    x_ = best_x, s_ = best_s, z_ = best_z;
    tau_ = best_tau, kappa_ = best_kappa;
  }
  ConeReport report = answer(end);
  report.iterations = iteration;
  if (end == ConeEnd::optimal || (end == ConeEnd::rounding && best <= 1e-7))
    report.status = Status::done;
  else if (end == ConeEnd::infeasible)
    report.status = Status::infeasible;
  else if (end == ConeEnd::interrupted)
    report.status = interruption;
  return report;
}

void require_good(const Affine& form, std::size_t n, std::vector<int>& used, int stamp, std::size_t cone) {
  LINKWRIGHT_REQUIRE(form.variables.size() == form.factors.size(), "{} variables and {} factors in cone {}",
                     form.variables.size(), form.factors.size(), cone);
  LINKWRIGHT_REQUIRE(std::isfinite(form.constant), "constant {} in cone {}", form.constant, cone);
  for (std::size_t i = 0; i < form.variables.size(); ++i) {
    LINKWRIGHT_REQUIRE(form.variables[i] < n, "variable {} of {} in cone {}", form.variables[i], n, cone);
    LINKWRIGHT_REQUIRE(std::isfinite(form.factors[i]), "factor {} in cone {}", form.factors[i], cone);
    LINKWRIGHT_REQUIRE(used[form.variables[i]] != stamp,
                       "variable {} occurs twice in an expression of cone {}", form.variables[i], cone);
    used[form.variables[i]] = stamp;
  }
}

}  // namespace

double value(const Affine& form, std::span<const double> x) {
  double sum = form.constant;
  for (std::size_t i = 0; i < form.variables.size(); ++i) sum += form.factors[i] * x[form.variables[i]];
  return sum;
}

Cone rotated_cone(const std::vector<Affine>& parts, const Affine& first, const Affine& second) {
  const auto combined = [&](double sign) {
    Affine sum = first;
    sum.constant += sign * second.constant;
    for (std::size_t i = 0; i < second.variables.size(); ++i) {
      const auto at = std::find(sum.variables.begin(), sum.variables.end(), second.variables[i]);
      if (at != sum.variables.end()) {
        sum.factors[static_cast<std::size_t>(at - sum.variables.begin())] += sign * second.factors[i];
      } else {
        sum.variables.push_back(second.variables[i]);
        sum.factors.push_back(sign * second.factors[i]);
      }
    }
    return sum;
  };
  Cone cone{.bound = combined(1), .parts = parts};
  for (Affine& part : cone.parts) {
    part.constant *= 2;
    for (double& factor : part.factors) factor *= 2;
  }
  cone.parts.push_back(combined(-1));
  return cone;
}

ConeReport solve(const ConeProgramme& programme, const ConeOptions& options, RunContext& context) {
  const std::size_t n = programme.cost.size();
  LINKWRIGHT_REQUIRE(n > 0, "a cone programme needs variables");
  LINKWRIGHT_REQUIRE(options.absolute_gap >= 0, "absolute gap {} must not be negative", options.absolute_gap);
  LINKWRIGHT_REQUIRE(options.gap > 0 && options.residual > 0 && options.max_iterations >= 1,
                     "tolerances {} and {} must be more than 0, iterations at least 1, got {}", options.gap,
                     options.residual, options.max_iterations);
  for (std::size_t j = 0; j < n; ++j)
    LINKWRIGHT_REQUIRE(std::isfinite(programme.cost[j]), "cost {} of variable {}", programme.cost[j], j);
  std::vector<int> used(n, -1);
  int stamp = 0;
  for (std::size_t k = 0; k < programme.cones.size(); ++k) {
    require_good(programme.cones[k].bound, n, used, stamp++, k);
    for (const Affine& part : programme.cones[k].parts) require_good(part, n, used, stamp++, k);
  }
  for (std::size_t j = 0; j < n; ++j) LINKWRIGHT_REQUIRE(used[j] >= 0, "variable {} is in no cone", j);
  return Solver(programme, options).run(context);
}

}  // namespace linkwright::optimise
