// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/position.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/suspension/corner/structure.h"

namespace linkwright::suspension {
namespace {

constexpr double converged = 1e-14;  ///< m
constexpr double stagnated = 1e-11;  ///< m: good enough where rounding allows no better
constexpr double chord = 1e-7;       ///< m: from here on the factors of the step before do
constexpr int max_iterations = 12;
// A step longer than this may have landed on another assembly.
constexpr double longest_shift = 0.05;  ///< m
constexpr double max_turn = 0.3;        ///< rad
// And so may one along which the direction of the motion changes by more than this share: beyond a fold there
// can be assemblies for which the determinant has the same sign, but before it the direction grows beyond
// bounds.
constexpr double sharpest_bend = 0.5;
/// Sine of the angle between a rocker's rod and arm below which a path ends at a toggle.
constexpr double in_line = 1e-3;
constexpr double no_squareness = 1e-12;  ///< relative limit of squareness: some thousand roundings

/// Newton's method for plans with N unknowns.
template <int N>
class Solver {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Column = std::array<double, N>;

  Solver(const CornerPlan& plan, Driver driver) : plan_(plan), driver_(driver) {}

  /// Brings the place onto the input; leaves the factors of the equations there. Next to the solution the
  /// factors of the step before serve once more: what they lack is smaller than what is left to go.
  bool converge(CornerPlace& place, const CornerInput& input) {
    bool factored = false;
    for (int i = 0;; ++i) {
      set(place, input);
      if (!(residual_ < 1e3) || residual_ <= converged || i == max_iterations) break;
      if (!factored || residual_ > chord) factor();
      factored = true;
      Column residual;
      std::copy_n(equations_.residual.begin(), N, residual.begin());
      const Vector step = vector(lu_.solve(residual));
      if (!(step.template head<6>().squaredNorm() < 4)) return false;
      move(place, -step, 1);
    }
    factor();
    place.carrier.rotation = math::rectified(place.carrier.rotation);
    return residual_ <= stagnated;
  }

  void set(const CornerPlace& place, const CornerInput& input) {
    evaluate(plan_, place, input.rack, driver_, input.value, equations_);
    residual_ = 0;
    for (int i = 0; i < N; ++i) {
      const double size = std::abs(equations_.residual[i]);
      if (!(size <= residual_)) residual_ = size;  // NaN, too
    }
  }

  void factor() { lu_.factor(equations_.jacobian); }

  Vector tangent(double value_rate, double rack_rate) const {
    Column right;
    for (int i = 0; i < N; ++i) right[i] = -equations_.by_rack[i] * rack_rate;
    right[N - 1] += value_rate;
    return vector(lu_.solve(right));
  }

  static void move(CornerPlace& place, const Vector& along, double by) {
    place.carrier.centre += by * Vec3{along(0), along(1), along(2)};
    place.carrier.rotation =
        math::turn_about(by * Vec3{along(3), along(4), along(5)}) * place.carrier.rotation;
    if constexpr (N == 7) place.arm += by * along(6);
  }

  double residual() const { return residual_; }
  bool orientation() const { return lu_.determinant() > 0; }
  /// Volume of the rows against that of a box with their lengths (Hadamard): 0 = rank lost, 1 = all at right
  /// angles.
  double squareness() const {
    double box = 1;
    for (int i = 0; i < N; ++i) {
      double square = 0;
      for (int j = 0; j < N; ++j) square += equations_.jacobian[i][j] * equations_.jacobian[i][j];
      box *= std::sqrt(square);
    }
    return std::abs(lu_.determinant()) / box;
  }

 private:
  static Vector vector(const Column& column) { return Eigen::Map<const Vector>(column.data()); }

  const CornerPlan& plan_;
  Driver driver_;
  CornerEquations equations_;
  math::SmallLu<N> lu_;
  double residual_ = 0;
};

bool near(const CornerPlace& a, const CornerPlace& b) {
  double trace = 0;
  for (int i = 0; i < 3; ++i) trace += dot(a.carrier.rotation.row[i], b.carrier.rotation.row[i]);
  return norm(a.carrier.centre - b.carrier.centre) < longest_shift && trace > 1 + 2 * std::cos(max_turn) &&
         std::abs(a.arm - b.arm) < max_turn;
}

/// The rockers along a step: their angles change as little as everything else does, and their rates, which
/// grow beyond bounds at a toggle, belong to the direction of the motion. Without rockers nothing is looked
/// at.
struct RockerStep {
  std::vector<RockerState> states;

  /// Rates per share of the path, for the motion `tangent` with the rack's `way`.
  template <class Vector>
  static RockerStep of(const CornerPlan& plan, const CornerPlace& place, double rack, const Vector& tangent,
                       double way) {
    if (plan.rockers.empty()) return {};
    Twist motion{{tangent(0), tangent(1), tangent(2)}, {tangent(3), tangent(4), tangent(5)}};
    if (plan.unknowns == 7) motion.arm = tangent(tangent.size() - 1);
    return {rocker_states(plan, place, rack, motion, way)};
  }
  bool reaches() const {
    return std::all_of(states.begin(), states.end(), [](const RockerState& s) { return s.reaches; });
  }
  bool near(const RockerStep& other) const {
    for (std::size_t i = 0; i < states.size(); ++i)
      if (!(std::abs(states[i].angle - other.states[i].angle) < max_turn)) return false;
    return true;
  }
  double squared_rates() const {
    double sum = 0;
    for (const RockerState& s : states) sum += s.rate * s.rate;
    return sum;
  }
  double squared_change(const RockerStep& other) const {
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double change = states[i].rate - other.states[i].rate;
      sum += change * change;
    }
    return sum;
  }
};

std::string_view in_words(Driver driver) {
  for (const auto& entry : names(Driver{}))
    if (entry.value == driver) return entry.summary.substr(0, entry.summary.find(','));
  return {};
}

std::string limit_reason(const CornerPlan& plan, const CornerPosition& at, const CornerInput& start,
                         const CornerInput& asked) {
  const double rise = asked.value - start.value, way = asked.rack - start.rack;
  const double weakest = weakest_motion(plan, at.place, at.input.rack, at.driver).singular_value;
  if (at.status == Status::singular)
    return fmt::format(
        "at {} {:.3f} mm and rack {:.3f} mm the motion beyond is not determined: the links lose rank "
        "(smallest "
        "singular value {:.1g})",
        in_words(at.driver), at.input.value * 1e3, at.input.rack * 1e3, weakest);
  std::string end = fmt::format("the motion turns back there (smallest singular value {:.1g})", weakest);
  const std::vector<RockerState> rockers = rocker_states(plan, at.place, at.input.rack);
  for (std::size_t i = 0; i < rockers.size(); ++i)
    if (rockers[i].lever < in_line)
      end = fmt::format("the rod of {} comes into line with its arm there (toggle, at {:.3f} deg)",
                        plan.rocker_labels[i], math::degrees(rockers[i].angle));
  if (way == 0)
    return fmt::format("the {} cannot pass {:.3f} mm at rack {:.3f} mm, {:.3f} mm short of {:.3f} mm: {}",
                       in_words(at.driver), at.input.value * 1e3, at.input.rack * 1e3,
                       std::abs(asked.value - at.input.value) * 1e3, asked.value * 1e3, end);
  if (rise == 0)
    return fmt::format("the rack cannot pass {:.3f} mm at {} {:.3f} mm, {:.3f} mm short of {:.3f} mm: {}",
                       at.input.rack * 1e3, in_words(at.driver), at.input.value * 1e3,
                       std::abs(asked.rack - at.input.rack) * 1e3, asked.rack * 1e3, end);
  return fmt::format("the motion to {} {:.3f} mm and rack {:.3f} mm ends at {:.3f} mm and {:.3f} mm: {}",
                     in_words(at.driver), asked.value * 1e3, asked.rack * 1e3, at.input.value * 1e3,
                     at.input.rack * 1e3, end);
}

template <int N>
CornerPosition follow(const CornerPlan& plan, Driver driver, const CornerInput& input,
                      const CornerPlace& from, const CornerInput& start, const CornerStepping& stepping) {
  CornerPosition out{.place = from, .driver = driver, .input = start, .reached = 0};
  Solver<N> solver(plan, driver);
  if (!solver.converge(out.place, start)) {
    out.status = Status::no_assembly;
    const Misfit worst = worst_misfit(plan, from, start.rack);
    out.place = from;
    out.residual = std::abs(worst.gap);
    out.reason =
        fmt::format("the links do not meet near the reference: {} is {:.3f} mm too {}",
                    plan.labels[worst.link], std::abs(worst.gap) * 1e3, worst.gap > 0 ? "short" : "long");
    return out;
  }
  const auto stop = [&](Status status, double at) {
    out.status = status;
    out.reached = at;
    out.reason = limit_reason(plan, out, start, input);
    return out;
  };
  if (!(solver.squareness() > no_squareness)) return stop(Status::singular, 0);
  const auto stop_at_rocker = [&] {
    const auto states = rocker_states(plan, out.place, start.rack);
    const auto lost = std::find_if(states.begin(), states.end(), [](const auto& s) { return !s.reaches; });
    out.status = Status::no_assembly;
    out.reason = fmt::format("the rod of {} does not reach", plan.rocker_labels[lost - states.begin()]);
    return out;
  };
  const bool orientation = solver.orientation();
  const double rise = input.value - start.value, way = input.rack - start.rack;
  const double length = std::max(std::abs(rise), std::abs(way));
  double share = length > stepping.first ? stepping.first / length : 1, at = 0;
  typename Solver<N>::Vector tangent = solver.tangent(rise, way);
  RockerStep rockers = RockerStep::of(plan, out.place, start.rack, tangent, way);
  out.residual = solver.residual();
  if (!rockers.reaches()) return stop_at_rocker();
  while (at < 1 && length > 0) {
    const double next = at + share > 1 - 1e-9 ? 1 : at + share;
    const CornerInput there =
        next == 1 ? input : CornerInput{start.value + next * rise, start.rack + next * way};
    CornerPlace trial = out.place;
    Solver<N>::move(trial, tangent, next - at);
    bool arrived = near(trial, out.place) && solver.converge(trial, there) && near(trial, out.place) &&
                   solver.orientation() == orientation;
    if (arrived) {
      const typename Solver<N>::Vector onward = solver.tangent(rise, way);
      arrived = (onward - tangent).norm() <= sharpest_bend * std::max(onward.norm(), tangent.norm());
      const RockerStep turned = RockerStep::of(plan, trial, there.rack, onward, way);
      if (arrived && !turned.states.empty())
        arrived = turned.reaches() && turned.near(rockers) &&
                  (onward - tangent).squaredNorm() + turned.squared_change(rockers) <=
                      sharpest_bend * sharpest_bend *
                          std::max(onward.squaredNorm() + turned.squared_rates(),
                                   tangent.squaredNorm() + rockers.squared_rates());
      if (arrived) {
        tangent = onward;
        rockers = turned;
      }
    }
    if (arrived) {
      out.place = trial;
      out.input = there;
      out.residual = solver.residual();
      at = next;
      share *= 1.5;
    } else {
      share = (next - at) / 2;
      if (share * length < stepping.smallest) return stop(Status::no_assembly, at);
    }
  }
  out.reached = 1;
  return out;
}

CornerPosition follow_any(const CornerPlan& plan, Driver driver, const CornerInput& input,
                          const CornerPlace& from, const CornerInput& start, const CornerStepping& stepping) {
  return plan.unknowns == 7 ? follow<7>(plan, driver, input, from, start, stepping)
                            : follow<6>(plan, driver, input, from, start, stepping);
}

template <int N>
CornerRates rates(const CornerPlan& plan, const CornerPosition& position, Driver driver) {
  Solver<N> solver(plan, driver);
  solver.set(position.place, {0, position.input.rack});  // the value moves no derivative
  solver.factor();
  const auto twist = [](const auto& x) {
    Twist out{{x(0), x(1), x(2)}, {x(3), x(4), x(5)}};
    if constexpr (N == 7) out.arm = x(6);
    return out;
  };
  const auto bump = solver.tangent(1, 0), steer = solver.tangent(0, 1);
  CornerRates out{Status::done, twist(bump), twist(steer)};
  // A metre of travel that turns the wheel by a million radians is no motion any more.
  if (!(bump.norm() < 1e6) || !(steer.norm() < 1e6)) out.status = Status::singular;
  return out;
}

}  // namespace

CornerPosition reference_position(const CornerPlan& plan, Driver driver) {
  return follow_any(plan, driver, {}, {{plan.wheel.centre, {}}, 0}, {}, {});
}

CornerPosition solve_position(const CornerPlan& plan, Driver driver, const CornerInput& input,
                              const CornerPosition& start, const CornerStepping& stepping) {
  LINKWRIGHT_REQUIRE(start.status == Status::done, "the start is {}: {}", to_string(start.status),
                     start.reason);
  LINKWRIGHT_REQUIRE(std::isfinite(input.value) && std::isfinite(input.rack), "input {} m, rack {} m",
                     input.value, input.rack);
  LINKWRIGHT_REQUIRE(stepping.first > 0 && stepping.smallest > 0, "steps of {} m, at least {} m",
                     stepping.first, stepping.smallest);
  const CornerInput from{
      start.driver == driver ? start.input.value : driver_value(plan, start.place, start.input.rack, driver),
      start.input.rack};
  return follow_any(plan, driver, input, start.place, from, stepping);
}

TravelLimits travel_limits(const CornerPlan& plan, Driver driver, double rack, const CornerPosition& start,
                           double range) {
  CornerInput from{driver_value(plan, start.place, start.input.rack, driver), rack};
  const CornerPosition there = solve_position(plan, driver, from, start);
  TravelLimits out;
  for (int i : {0, 1}) {
    if (there.status != Status::done) {
      out.status[i] = there.status;
      out.value[i] = there.input.value;
      continue;
    }
    const CornerPosition end = solve_position(plan, driver, {i == 0 ? -range : range, rack}, there);
    out.status[i] = end.status;
    out.value[i] = end.input.value;
  }
  return out;
}

CornerRates solve_rates(const CornerPlan& plan, const CornerPosition& position, Driver driver) {
  return plan.unknowns == 7 ? rates<7>(plan, position, driver) : rates<6>(plan, position, driver);
}

}  // namespace linkwright::suspension
