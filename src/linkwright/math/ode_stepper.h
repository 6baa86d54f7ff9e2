// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <memory>
#include <span>
#include <vector>

#include "linkwright/math/ode.h"

namespace linkwright::math {

/// The stepper of `integrate`: one step after another from SUNDIALS, and y within the last step. Part of
/// ode.h, not for use elsewhere.
class OdeStepper {
 public:
  enum class Outcome {
    step,        ///< t1, y1, rate1 are new
    shorter,     ///< no step of this length: start again from the last good y with a shorter one
    impossible,  ///< the tolerance is beyond the arithmetic
  };

  OdeStepper();
  ~OdeStepper();
  OdeStepper(const OdeStepper&) = delete;
  OdeStepper& operator=(const OdeStepper&) = delete;

  /// Readies memory for the method and n components; nothing is allocated when both are those of last time.
  void prepare(const OdeFunction& f, std::size_t n, double from, double to, const OdeOptions& options,
               const OdeHooks& hooks);

  /// Begins at (t, y); `length` > 0 is that of the first step, 0 chooses it. False when f cannot be evaluated
  /// here.
  bool start(double t, std::span<const double> y, double length);

  Outcome step();

  /// y at a time within the last step, by the method's own interpolation.
  void state(double t, std::span<double> y);
  /// The same to third order from the ends of the step, without calls of f; CVODE's is cheap anyway.
  void rough_state(double t, std::span<double> y);

  double t0 = 0, t1 = 0;          ///< the last step; after a start both are the start
  std::vector<double> y0, y1;     ///< at its ends
  std::vector<double> rate0;      ///< f at its ends
  std::span<const double> rate1;  ///< valid until the next step
  double reach = 0;               ///< farthest that f was asked for beyond t1 in a step that failed
  bool refused = false;           ///< f or the projection said no in it
  long evaluations = 0;
  std::exception_ptr thrown;    ///< by a hook, on its way through SUNDIALS
  const char* message() const;  ///< last message of SUNDIALS

 private:
  friend struct OdeCallbacks;
  struct Solver;
  bool evaluate(double t, std::span<const double> y, std::span<double> rate) noexcept;
  double first_step();
  void interpolate();
  bool inner_node(double x, std::span<double> y, std::span<double> rate);

  const OdeFunction* f_ = nullptr;
  const OdeOptions* options_ = nullptr;
  const OdeHooks* hooks_ = nullptr;
  double to_ = 0;
  std::unique_ptr<Solver> solver_;
  std::size_t nodes_ = 0;  // number of nodes of the interpolation of the last step; 0: not built yet
  std::vector<double> stages_, trial_, node_rates_, differences_;
};

}  // namespace linkwright::math
