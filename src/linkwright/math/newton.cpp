#include "linkwright/math/newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

using Vector = Eigen::Map<Eigen::VectorXd>;
using Matrix = Eigen::Map<Eigen::MatrixXd>;

double largest(std::span<const double> values) {
  double out = 0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

// Of the values over their largest: squares neither overflow nor vanish.
double norm(std::span<const double> values) {
  const double unit = largest(values);
  if (unit == 0) return 0;
  double sum = 0;
  for (const double v : values) sum += (v / unit) * (v / unit);
  return unit * std::sqrt(sum);
}

}  // namespace

struct NewtonWorkspace::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

NewtonWorkspace::NewtonWorkspace() : factors_(std::make_unique<Factors>()) {}
NewtonWorkspace::~NewtonWorkspace() = default;
NewtonWorkspace::NewtonWorkspace(NewtonWorkspace&&) noexcept = default;
NewtonWorkspace& NewtonWorkspace::operator=(NewtonWorkspace&&) noexcept = default;

void NewtonWorkspace::resize(std::size_t n) {
  if (!factors_) factors_ = std::make_unique<Factors>();  // moved from
  residuals_.resize(n);
  trial_residuals_.resize(n);
  jacobian_.resize(n * n);
  trial_jacobian_.resize(n * n);
  trial_.resize(n);
  step_.resize(n);
  unit_.resize(n);
  inverse_.resize(n);
}

NewtonReport solve_newton(ResidualFunction function, std::span<double> x, const NewtonOptions& o,
                          NewtonWorkspace& w) {
  const std::size_t n = x.size();
  LINKWRIGHT_REQUIRE(n >= 1, "no unknowns");
  LINKWRIGHT_REQUIRE(o.residual_tolerance >= 0 && o.step_tolerance >= 0, "tolerances {} and {}",
                     o.residual_tolerance, o.step_tolerance);
  LINKWRIGHT_REQUIRE(o.max_iterations >= 0 && o.max_halvings >= 0, "{} iterations, {} halvings",
                     o.max_iterations, o.max_halvings);
  w.resize(n);

  NewtonReport report;
  const auto evaluate = [&](std::span<const double> at, std::vector<double>& r,
                            std::vector<double>& jacobian) {
    ++report.evaluations;
    if (!function(at, r, jacobian)) return infinity;
    const auto finite = [](double v) { return std::isfinite(v); };
    if (!std::all_of(r.begin(), r.end(), finite) || !std::all_of(jacobian.begin(), jacobian.end(), finite))
      return infinity;
    return norm(r);
  };
  const auto end = [&](Status status) {
    report.status = status;
    return report;
  };

  double size = evaluate(x, w.residuals_, w.jacobian_);
  if (!std::isfinite(size)) return end(Status::infeasible);

  const auto rows = static_cast<Eigen::Index>(n);
  Eigen::PartialPivLU<Eigen::MatrixXd>& lu = w.factors_->lu;
  Vector unit(w.unit_.data(), rows), inverse(w.inverse_.data(), rows), step(w.step_.data(), rows);
  // The factors of J and its condition, for the step and the report.
  const auto factorise = [&] {
    const Matrix jacobian(w.jacobian_.data(), rows, rows);
    lu.compute(jacobian);
    report.condition = infinity;
    if ((lu.matrixLU().diagonal().array() == 0).any()) return;
    double norm_of_inverse = 0;
    for (Eigen::Index j = 0; j < rows; ++j) {
      unit.setZero();
      unit[j] = 1;
      inverse = lu.solve(unit);
      norm_of_inverse = std::max(norm_of_inverse, inverse.lpNorm<1>());
    }
    const double condition = jacobian.cwiseAbs().colwise().sum().maxCoeff() * norm_of_inverse;
    if (std::isfinite(condition)) report.condition = condition;
  };

  bool small_step = false;
  while (true) {
    factorise();
    report.residual = largest(w.residuals_);
    if (report.residual <= o.residual_tolerance || small_step) return end(Status::done);
    if (!(report.condition * static_cast<double>(n) * std::numeric_limits<double>::epsilon() < 1))
      return end(Status::singular);
    if (report.iterations >= o.max_iterations) return end(Status::not_converged);

    step = lu.solve(Vector(w.residuals_.data(), rows));
    double whole = 0;
    for (std::size_t j = 0; j < n; ++j) whole = std::max(whole, std::abs(w.step_[j]) / (1 + std::abs(x[j])));
    small_step = whole <= o.step_tolerance;

    double part = 1;
    int halvings = 0;
    while (true) {
      for (std::size_t j = 0; j < n; ++j) w.trial_[j] = x[j] - part * w.step_[j];
      const double trial = evaluate(w.trial_, w.trial_residuals_, w.trial_jacobian_);
      if (trial <= (1 - 1e-4 * part) * size) {
        size = trial;
        break;
      }
      // Within rounding of the root |F| need not fall any more.
      if (small_step) {
        report.step = whole;
        return end(Status::done);
      }
      if (halvings++ == o.max_halvings) return end(Status::not_converged);
      part /= 2;
    }
    std::copy(w.trial_.begin(), w.trial_.end(), x.begin());
    std::swap(w.residuals_, w.trial_residuals_);
    std::swap(w.jacobian_, w.trial_jacobian_);
    report.step = part * whole;
    ++report.iterations;
  }
}

}  // namespace linkwright::math
