#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/least_squares.h"

namespace linkwright::math {

struct NewtonOptions {
  /// Either tolerance ends the search with `done`.
  double residual_tolerance = 1e-12;  ///< on max |F_i|, absolute, in the units of F
  double step_tolerance = 1e-12;      ///< on max |step_j| / (1 + |x_j|) of a whole Newton step
  int max_iterations = 50;            ///< Newton steps
  int max_halvings = 30;              ///< of one step, until |F| is lower
};

struct NewtonReport {
  /// done: a tolerance was met; singular: the condition at x is beyond 1 / (n eps), the step is not
  /// determined; not_converged: iterations used up, or no part of a step lowers |F|; infeasible: the start
  /// cannot be evaluated (x is left as it was).
  Status status = Status::done;
  int iterations = 0;          ///< steps taken, whole or halved
  int evaluations = 0;         ///< calls of the function
  double residual = infinity;  ///< max |F_i| at x
  double step = 0;             ///< max |step_j| / (1 + |x_j|) of the last step, as far as it was taken
  /// |J|_1 |J^-1|_1 at x: about how many times a relative error of J or F is felt in the step. Depends on the
  /// units of rows and variables. Infinite where J is singular to the last digit.
  double condition = infinity;
};

/// Memory of a search; use one again and again (per thread) and nothing is allocated after the first call of
/// a size, for systems up to some hundred unknowns.
class NewtonWorkspace {
 public:
  NewtonWorkspace();
  ~NewtonWorkspace();
  NewtonWorkspace(NewtonWorkspace&&) noexcept;
  NewtonWorkspace& operator=(NewtonWorkspace&&) noexcept;

  /// Makes room for n equations.
  void resize(std::size_t n);

  /// F (n) and Jacobian (n x n, column-major) at the x of the last search.
  std::span<const double> residuals() const { return residuals_; }
  std::span<const double> jacobian() const { return jacobian_; }

 private:
  friend NewtonReport solve_newton(ResidualFunction, std::span<double>, const NewtonOptions&,
                                   NewtonWorkspace&);
  struct Factors;
  std::vector<double> residuals_, jacobian_, trial_residuals_, trial_jacobian_, trial_, step_, unit_,
      inverse_;
  std::unique_ptr<Factors> factors_;
};

/// Solves F(x) = 0, as many equations as unknowns, by Newton steps J step = -F with the exact Jacobian. A
/// step is halved until |F|_2 falls at least by 1e-4 of what the step promises (Armijo's rule; Dennis and
/// Schnabel 1983, A6.3.1 with halving), so a start far off comes nearer too; places that cannot be evaluated
/// count as too far. Quadratic convergence to roots with a regular Jacobian. For small dense systems:
/// partial-pivot LU, and a condition number from n further solves.
///
/// `function` gets x.size() residuals and is asked for the Jacobian with every trial.
///
/// Throws ContractError for an empty x or options out of range.
NewtonReport solve_newton(ResidualFunction function, std::span<double> x, const NewtonOptions& options,
                          NewtonWorkspace& workspace);

}  // namespace linkwright::math
