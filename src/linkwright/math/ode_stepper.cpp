// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/ode_stepper.h"

#include <arkode/arkode_butcher.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string_view>

#include "linkwright/core/finite.h"
#include "linkwright/math/detail/ode_pairs.h"
#include "linkwright/math/detail/ode_vectors.h"

namespace linkwright::math {
namespace {

std::span<double> view(N_Vector v) { return {NV_DATA_S(v), static_cast<std::size_t>(NV_LENGTH_S(v))}; }
std::span<const double> const_view(N_Vector v) { return view(v); }

bool runge_kutta(OdeMethod method) {
  return method == OdeMethod::explicit_runge_kutta_5 || method == OdeMethod::explicit_runge_kutta_8;
}

// Returned to SUNDIALS by callbacks.
constexpr int fine = 0, recoverable = 1, unrecoverable = -1;

// Parts of the step that Hermite's polynomial goes through besides the ends: the inner Lobatto points, which
// keep the product of (x - x_i)^2 small.
std::span<const double> inner_nodes(OdeMethod method) {
  static constexpr std::array<double, 1> five = {0.5};
  static constexpr std::array<double, 3> eight = {0.17267316464601143, 0.5, 0.82732683535398857};
  if (method == OdeMethod::explicit_runge_kutta_5) return five;
  return eight;
}

}  // namespace

// The functions that SUNDIALS calls; `self` is the stepper. No exception may pass through C.
struct OdeCallbacks {
  static OdeStepper& of(void* self) { return *static_cast<OdeStepper*>(self); }

  static int rate(double t, N_Vector y, N_Vector rate, void* self) {
    OdeStepper& s = of(self);
    s.reach = std::max(s.reach, std::abs(t - s.t1));
    s.rate1 = view(rate);
    if (s.evaluate(t, const_view(y), view(rate))) return fine;
    s.refused = true;
    return s.thrown ? unrecoverable : recoverable;
  }

  static bool projected(OdeStepper& s, double t, std::span<double> y) {
    try {
      if (s.hooks_->project(t, y) && all_finite(y)) return true;
    } catch (...) {
      s.thrown = std::current_exception();
    }
    s.refused = true;
    return false;
  }
  static int project(double t, N_Vector y, void* self) {
    OdeStepper& s = of(self);
    if (!s.hooks_->project) return fine;
    return projected(s, t, view(y)) ? fine : unrecoverable;
  }
  static int correction(double t, N_Vector y, N_Vector correction, double, N_Vector, void* self) {
    OdeStepper& s = of(self);
    const auto moved = view(correction);
    std::copy_n(NV_DATA_S(y), moved.size(), moved.begin());
    if (!projected(s, t, moved)) return s.thrown ? unrecoverable : recoverable;
    for (std::size_t j = 0; j < moved.size(); ++j) moved[j] -= NV_DATA_S(y)[j];
    return fine;
  }

  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector,
                      N_Vector) {
    OdeStepper& s = of(self);
    const std::span<double> out(SM_DATA_D(matrix), static_cast<std::size_t>(SM_LDATA_D(matrix)));
    try {
      if (s.hooks_->jacobian(t, const_view(y), out) && all_finite(out)) return fine;
    } catch (...) {
      s.thrown = std::current_exception();
    }
    s.refused = true;
    return s.thrown ? unrecoverable : recoverable;
  }

  static void message(int, const char*, const char*, char* text, void* self);
};

ARKodeButcherTable butcher_table(OdeMethod method) {
  if (method == OdeMethod::explicit_runge_kutta_5)
    return ARKodeButcherTable_LoadERK(ARKODE_DORMAND_PRINCE_7_4_5);
  const RungeKuttaPair& pair = verner_8_7;
  const ARKodeButcherTable table = ARKodeButcherTable_Alloc(pair.stages, SUNTRUE);
  if (!table) return table;
  table->q = pair.order;
  table->p = pair.embedded_order;
  auto next = pair.stage_weights.begin();
  for (int i = 1; i < pair.stages; ++i, next += i - 1) std::copy_n(next, i, table->A[i]);
  std::copy(pair.weights.begin(), pair.weights.end(), table->b);
  std::copy(pair.embedded_weights.begin(), pair.embedded_weights.end(), table->d);
  std::copy(pair.places.begin(), pair.places.end(), table->c);
  return table;
}

// One integrator of SUNDIALS with all it needs; another method or size means another one.
struct OdeStepper::Solver {
  struct Key {
    OdeMethod method{};
    std::size_t n = 0;
    int lower = -1, upper = -1;  // band of the Jacobian
    bool projects = false;       // CVODE cannot forget a projection
    bool backward = false;       // ARKODE remembers the direction of the last step
    friend bool operator==(const Key&, const Key&) = default;
  };

  explicit Solver(const Key& wanted) : key(wanted) {
    const auto length = static_cast<sunindextype>(key.n);
    if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
    y = needed(N_VNew_Serial(length, context));
    N_VConst(0, y);
    use_our_loops(y);
    tolerance = needed(N_VClone(y));
    if (runge_kutta(key.method)) {
      table = needed(butcher_table(key.method));
      arkode = needed(ERKStepCreate(OdeCallbacks::rate, 0, y, context));
      ERKStepSetErrHandlerFn(arkode, OdeCallbacks::message, this);
      ERKStepSetTable(arkode, table);
      ERKStepSetInterpolantDegree(arkode, 3);  // higher ones call f again when the last step is done
      // Gustafsson's PI control with the exponents of Hairer and Wanner (1996, IV.2), every change of step
      // allowed: ARKODE leaves steps alone that could grow by less than half; that
      // takes a fifth to a third more steps.
      const double share = static_cast<double>(table->p) / (table->p + 1);
      std::array<double, 3> exponents = {0.7 * share, 0.4 * share, 0};
      ERKStepSetAdaptivityMethod(arkode, ARK_ADAPT_PI, 0, 0, exponents.data());
      ERKStepSetErrorBias(arkode, 1);
      ERKStepSetSafetyFactor(arkode, 0.9);
      ERKStepSetFixedStepBounds(arkode, 1, 1);
      return;
    }
    const bool adams = key.method == OdeMethod::adams;
    cvode = needed(CVodeCreate(adams ? CV_ADAMS : CV_BDF, context));
    CVodeSetErrHandlerFn(cvode, OdeCallbacks::message, this);
    CVodeInit(cvode, OdeCallbacks::rate, 0, y);
    CVodeSStolerances(cvode, 1e-6, 1e-6);
    if (adams) {
      nonlinear = needed(SUNNonlinSol_FixedPoint(y, 0, context));
      CVodeSetNonlinearSolver(cvode, nonlinear);
      return;
    }
    if (key.lower < 0) {
      matrix = needed(SUNDenseMatrix(length, length, context));
      linear = needed(SUNLinSol_Dense(y, matrix, context));
    } else {
      matrix = needed(SUNBandMatrix(length, key.upper, key.lower, context));
      linear = needed(SUNLinSol_Band(y, matrix, context));
    }
    CVodeSetLinearSolver(cvode, linear, matrix);
    if (key.projects) {
      CVodeSetProjFn(cvode, OdeCallbacks::correction);
      CVodeSetProjErrEst(cvode, SUNFALSE);
    }
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  ~Solver() {
    if (arkode) ERKStepFree(&arkode);
    if (cvode) CVodeFree(&cvode);
    ARKodeButcherTable_Free(table);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (nonlinear) SUNNonlinSolFree(nonlinear);
    if (y) N_VDestroy(y);
    if (tolerance) N_VDestroy(tolerance);
    if (context) SUNContext_Free(&context);
  }

  template <class Pointer>
  static Pointer needed(Pointer pointer) {
    if (!pointer) throw std::bad_alloc();
    return pointer;
  }

  Key key;
  SUNContext context = nullptr;
  void* arkode = nullptr;
  void* cvode = nullptr;
  ARKodeButcherTable table = nullptr;
  N_Vector y = nullptr, tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  SUNNonlinearSolver nonlinear = nullptr;
  std::array<char, 256> message{};
};

void OdeCallbacks::message(int, const char*, const char*, char* text, void* solver) {
  auto& out = static_cast<OdeStepper::Solver*>(solver)->message;
  const std::string_view words(text);
  const std::size_t length = std::min(words.size(), out.size() - 1);
  std::copy_n(words.begin(), length, out.begin());
  out[length] = 0;
}

OdeStepper::OdeStepper() = default;
OdeStepper::~OdeStepper() = default;

const char* OdeStepper::message() const { return solver_->message.data(); }

void OdeStepper::prepare(const OdeFunction& f, std::size_t n, double from, double to, const OdeOptions& o,
                         const OdeHooks& hooks) {
  f_ = &f;
  options_ = &o;
  hooks_ = &hooks;
  to_ = to;
  evaluations = 0;
  thrown = nullptr;
  y0.resize(n);
  y1.resize(n);
  rate0.resize(n);
  trial_.resize(n);

  const Solver::Key key{o.method,
                        n,
                        o.lower_bandwidth,
                        o.upper_bandwidth,
                        o.method == OdeMethod::bdf && hooks.project,
                        runge_kutta(o.method) && to < from};
  if (!solver_ || !(solver_->key == key)) {
    solver_.reset();
    solver_ = std::make_unique<Solver>(key);
  }
  Solver& s = *solver_;
  s.message[0] = 0;
  if (!o.absolute_tolerances.empty())
    std::copy(o.absolute_tolerances.begin(), o.absolute_tolerances.end(), NV_DATA_S(s.tolerance));
  const double longest = std::isfinite(o.max_step) ? o.max_step : 0;  // 0: no limit
  if (s.arkode) {
    const std::size_t nodes = inner_nodes(o.method).size() + 2;
    stages_.resize(n * static_cast<std::size_t>(s.table->stages));
    node_rates_.resize(n * nodes);
    differences_.resize(n * 2 * nodes);
    ERKStepSetUserData(s.arkode, this);
    if (o.absolute_tolerances.empty())
      ERKStepSStolerances(s.arkode, o.relative_tolerance, o.absolute_tolerance);
    else
      ERKStepSVtolerances(s.arkode, o.relative_tolerance, s.tolerance);
    ERKStepSetMaxStep(s.arkode, longest);
    // ERKStep of SUNDIALS 6.4 takes every pair that ends with a stage at the end of the step for one
    // whose last stage is the first of the next step, which costs Verner's pair its order. With a function
    // to be called after steps it evaluates f again.
    const bool last_stage_is_first = o.method == OdeMethod::explicit_runge_kutta_5;
    ERKStepSetPostprocessStepFn(s.arkode,
                                hooks.project || !last_stage_is_first ? OdeCallbacks::project : nullptr);
  } else {
    CVodeSetUserData(s.cvode, this);
    if (o.absolute_tolerances.empty())
      CVodeSStolerances(s.cvode, o.relative_tolerance, o.absolute_tolerance);
    else
      CVodeSVtolerances(s.cvode, o.relative_tolerance, s.tolerance);
    CVodeSetMaxStep(s.cvode, longest);
    if (s.linear) CVodeSetJacFn(s.cvode, hooks.jacobian ? OdeCallbacks::jacobian : nullptr);
  }
}

bool OdeStepper::evaluate(double t, std::span<const double> y, std::span<double> rate) noexcept {
  ++evaluations;
  try {
    return (*f_)(t, y, rate) && all_finite(rate);
  } catch (...) {
    thrown = std::current_exception();
    return false;
  }
}

bool OdeStepper::start(double t, std::span<const double> y, double length) {
  t0 = t1 = t;
  if (y.data() != y1.data()) std::copy(y.begin(), y.end(), y1.begin());
  y0 = y1;
  nodes_ = 0;
  if (!evaluate(t, y1, rate0)) return false;
  rate1 = rate0;
  Solver& s = *solver_;
  std::copy(y1.begin(), y1.end(), NV_DATA_S(s.y));
  const double direction = to_ < t ? -1 : 1;
  if (s.arkode) {
    if (length <= 0) length = first_step();
    if (thrown) return false;
    ERKStepReInit(s.arkode, OdeCallbacks::rate, t, s.y);
    ERKStepSetStopTime(s.arkode, to_);
    ERKStepSetInitStep(s.arkode, direction * length);
  } else {
    CVodeReInit(s.cvode, t, s.y);
    CVodeSetStopTime(s.cvode, to_);
    CVodeSetInitStep(s.cvode, direction * std::max(length, 0.0));
  }
  return true;
}

// Hairer, Norsett and Wanner (1993), II.4: a step of about a hundredth of the tolerance. ARKODE's own choice
// starts from the resolution of t and needs half a dozen steps to get to the right length.
double OdeStepper::first_step() {
  const OdeOptions& o = *options_;
  const std::size_t n = y1.size();
  const auto norm = [&](auto value) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double absolute = o.absolute_tolerances.empty() ? o.absolute_tolerance : o.absolute_tolerances[j];
      const double weight = o.relative_tolerance * std::abs(y1[j]) + absolute;
      if (weight > 0) sum += value(j) / weight * (value(j) / weight);
    }
    return std::sqrt(sum / static_cast<double>(n));
  };
  const double range = std::abs(to_ - t1), longest = std::min(range, o.max_step);
  const double size = norm([&](std::size_t j) { return y1[j]; });
  const double slope = norm([&](std::size_t j) { return rate0[j]; });
  double h = size < 1e-5 || slope < 1e-5 ? 1e-6 * range : 0.01 * size / slope;
  h = std::min(h, longest);

  const std::span<double> rate(stages_.data(), n);
  const double direction = to_ < t1 ? -1 : 1;
  for (std::size_t j = 0; j < n; ++j) trial_[j] = y1[j] + direction * h * rate0[j];
  if (!evaluate(t1 + direction * h, trial_, rate)) return 0.1 * h;
  const double bend = norm([&](std::size_t j) { return rate[j] - rate0[j]; }) / h;
  const double largest = std::max(slope, bend);
  const double order = solver_->table->q;
  const double wanted =
      largest <= 1e-15 ? std::max(1e-6 * range, 1e-3 * h) : std::pow(0.01 / largest, 1 / (order + 1));
  return std::min({100 * h, wanted, longest});
}

OdeStepper::Outcome OdeStepper::step() {
  Solver& s = *solver_;
  reach = 0;
  refused = false;
  if (rate1.data() != rate0.data()) std::copy(rate1.begin(), rate1.end(), rate0.begin());
  double t = t1;
  bool arrived = false, impossible = false;
  if (s.arkode) {
    const int flag = ERKStepEvolve(s.arkode, to_, s.y, &t, ARK_ONE_STEP);
    arrived = flag == ARK_SUCCESS || flag == ARK_TSTOP_RETURN;
    impossible = flag == ARK_TOO_MUCH_ACC || flag == ARK_ILL_INPUT;
  } else {
    const int flag = CVode(s.cvode, to_, s.y, &t, CV_ONE_STEP);
    arrived = flag == CV_SUCCESS || flag == CV_TSTOP_RETURN;
    impossible = flag == CV_TOO_MUCH_ACC || flag == CV_ILL_INPUT;
  }
  if (impossible) return Outcome::impossible;
  if (!arrived || !all_finite(const_view(s.y))) return Outcome::shorter;
  t0 = t1;
  t1 = t;
  std::swap(y0, y1);
  std::copy_n(NV_DATA_S(s.y), y1.size(), y1.begin());
  nodes_ = 0;
  return Outcome::step;
}

// The same formula from the start of the step to a part x of it.
bool OdeStepper::inner_node(double x, std::span<double> y, std::span<double> rate) {
  const ARKodeButcherTable table = solver_->table;
  const std::size_t n = y.size();
  const double h = x * (t1 - t0);
  const auto advance = [&](const double* coefficients, int count) {
    std::copy(y0.begin(), y0.end(), y.begin());
    for (int i = 0; i < count; ++i) {
      if (coefficients[i] == 0) continue;
      const double* stage = stages_.data() + static_cast<std::size_t>(i) * n;
      for (std::size_t j = 0; j < n; ++j) y[j] += h * coefficients[i] * stage[j];
    }
  };
  std::copy(rate0.begin(), rate0.end(), stages_.begin());
  for (int i = 1; i < table->stages; ++i) {
    advance(table->A[i], i);
    if (!evaluate(t0 + h * table->c[i], y, {stages_.data() + static_cast<std::size_t>(i) * n, n}))
      return false;
  }
  advance(table->b, table->stages);
  return evaluate(t0 + h, y, rate);
}

// Divided differences over the nodes, each taken twice (value and slope), with the step as unit of time.
void OdeStepper::interpolate() {
  const std::size_t n = y1.size();
  const std::span<const double> inner = inner_nodes(solver_->key.method);
  const double h = t1 - t0;
  const auto row = [n](std::vector<double>& rows, std::size_t i) {
    return std::span(rows).subspan(i * n, n);
  };
  nodes_ = inner.size() + 2;
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (!inner_node(inner[i], row(differences_, 2 * i + 2), row(node_rates_, i + 1))) nodes_ = 2;
  const std::size_t last = nodes_ - 1;
  std::copy(y0.begin(), y0.end(), row(differences_, 0).begin());
  std::copy(rate0.begin(), rate0.end(), row(node_rates_, 0).begin());
  std::copy(y1.begin(), y1.end(), row(differences_, 2 * last).begin());
  std::copy(rate1.begin(), rate1.end(), row(node_rates_, last).begin());
  const auto place = [&](std::size_t k) { return k / 2 == 0 ? 0 : k / 2 == last ? 1 : inner[k / 2 - 1]; };

  for (std::size_t j = 0; j < n; ++j) {
    const auto d = [&](std::size_t k) -> double& { return differences_[k * n + j]; };
    for (std::size_t i = 0; i <= last; ++i) d(2 * i + 1) = d(2 * i);
    for (std::size_t k = 2 * last + 1; k >= 1; --k)
      d(k) = k % 2 == 1 ? h * node_rates_[k / 2 * n + j] : (d(k) - d(k - 1)) / (place(k) - place(k - 1));
    for (std::size_t level = 2; level <= 2 * last + 1; ++level)
      for (std::size_t k = 2 * last + 1; k >= level; --k)
        d(k) = (d(k) - d(k - 1)) / (place(k) - place(k - level));
  }
}

void OdeStepper::state(double t, std::span<double> y) {
  if (t == t1 || t == t0) {
    std::copy_n((t == t1 ? y1 : y0).begin(), y.size(), y.begin());
    return;
  }
  if (solver_->cvode) {
    CVodeGetDky(solver_->cvode, t, 0, solver_->y);
    std::copy_n(NV_DATA_S(solver_->y), y.size(), y.begin());
    return;
  }
  if (nodes_ == 0) interpolate();
  const std::span<const double> inner = inner_nodes(solver_->key.method);
  const std::size_t n = y.size(), last = nodes_ - 1;
  const double x = (t - t0) / (t1 - t0);
  std::copy_n(differences_.begin() + static_cast<std::ptrdiff_t>((2 * last + 1) * n), n, y.begin());
  for (std::size_t k = 2 * last + 1; k-- > 0;) {
    const double factor = x - (k / 2 == 0 ? 0 : k / 2 == last ? 1 : inner[k / 2 - 1]);
    for (std::size_t j = 0; j < n; ++j) y[j] = y[j] * factor + differences_[k * n + j];
  }
}

void OdeStepper::rough_state(double t, std::span<double> y) {
  if (solver_->cvode || t == t1 || t == t0) return state(t, y);
  const double h = t1 - t0, x = (t - t0) / h, u = 1 - x;
  for (std::size_t j = 0; j < y.size(); ++j) {
    const double chord = y1[j] - y0[j];
    y[j] = u * y0[j] + x * y1[j] + x * u * (u * (h * rate0[j] - chord) - x * (h * rate1[j] - chord));
  }
}

}  // namespace linkwright::math
