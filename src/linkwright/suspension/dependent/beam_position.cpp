// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_position.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"

namespace linkwright::suspension {
namespace {

constexpr double beam_converged = 1e-14;  ///< m
constexpr double beam_stagnated = 1e-11;  ///< m: good enough where rounding allows no better
constexpr int max_beam_iterations = 12;
constexpr double longest_beam_shift = 0.05;  ///< m in one step
constexpr double max_beam_turn = 0.3;        ///< rad in one step
constexpr double sharpest_beam_bend =
    0.5;                                  ///< share by which the direction of a motion may change in one step
constexpr double first_beam_step = 0.01;  ///< m, or rad at half the track
constexpr double smallest_beam_step = 1e-11;

using BeamVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_axle_equations, 1>;
using BeamMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_axle_equations, max_axle_equations>;

/// Newton's method for the equations of an axle.
class BeamSolver {
 public:
  BeamSolver(const BeamAxlePlan& plan, AxleInputs inputs) : plan_(plan), inputs_(inputs), n_(plan.unknowns) {}

  bool converge(BeamPlace& place, const std::array<double, 2>& values) {
    for (int i = 0;; ++i) {
      set(place, values);
      if (!(residual_ < 1e3) || residual_ <= beam_converged || i == max_beam_iterations) break;
      BeamVector right(n_);
      for (int k = 0; k < n_; ++k) right(k) = -equations_.residual[static_cast<std::size_t>(k)];
      const BeamVector step = lu_.solve(right);
      if (!(step.head<6>().squaredNorm() < 4)) return false;
      move(place, step, 1);
    }
    place.rotation = math::rectified(place.rotation);
    return residual_ <= beam_stagnated;
  }

  void set(const BeamPlace& place, const std::array<double, 2>& values) {
    evaluate(plan_, place, inputs_, values, equations_);
    residual_ = 0;
    BeamMatrix matrix(n_, n_);
    for (int i = 0; i < n_; ++i) {
      const auto row = static_cast<std::size_t>(i);
      const double size = std::abs(equations_.residual[row]);
      if (!(size <= residual_)) residual_ = size;  // NaN, too
      for (int j = 0; j < n_; ++j) matrix(i, j) = equations_.jacobian[row][static_cast<std::size_t>(j)];
    }
    lu_.compute(matrix);
  }

  /// The motion by rates of both inputs. The residual of a roll is a distance, whose derivative by the angle
  /// is that of the contacts along the road.
  BeamVector tangent(const BeamPlace& place, double first, double second) const {
    BeamVector right = BeamVector::Zero(n_);
    right(n_ - 2) = first;
    right(n_ - 1) = second;
    if (inputs_ == AxleInputs::heave_roll) {
      const Vec3 apart = contact_point(plan_, place, Side::left) - contact_point(plan_, place, Side::right);
      right(n_ - 1) *= std::hypot(apart.y, apart.z);
    }
    return lu_.solve(right);
  }

  static void move(BeamPlace& place, const BeamVector& along, double by) {
    place.centre += by * Vec3{along(0), along(1), along(2)};
    place.rotation = math::turn_about(by * Vec3{along(3), along(4), along(5)}) * place.rotation;
    for (int w = 6; w < along.size(); ++w) place.cranks[static_cast<std::size_t>(w - 6)] += by * along(w);
  }

  double residual() const { return residual_; }
  double determinant() const { return lu_.determinant(); }
  const AxleEquations& equations() const { return equations_; }

 private:
  const BeamAxlePlan& plan_;
  AxleInputs inputs_;
  int n_;
  AxleEquations equations_;
  Eigen::PartialPivLU<BeamMatrix> lu_;
  double residual_ = 0;
};

bool near_place(const BeamPlace& a, const BeamPlace& b) {
  double trace = 0;
  for (std::size_t i = 0; i < 3; ++i) trace += dot(a.rotation.row[i], b.rotation.row[i]);
  for (std::size_t w = 0; w < max_axle_watts; ++w)
    if (!(std::abs(a.cranks[w] - b.cranks[w]) < max_beam_turn)) return false;
  return norm(a.centre - b.centre) < longest_beam_shift && trace > 1 + 2 * std::cos(max_beam_turn);
}

std::string input_in_words(const BeamInput& input) {
  switch (input.inputs) {
    case AxleInputs::heave_roll:
      return fmt::format("heave {:.3f} mm and roll {:.3f} deg", input.first * 1e3,
                         math::degrees(input.second));
    case AxleInputs::wheel_centres:
      return fmt::format("wheel centres at {:.3f} mm (left) and {:.3f} mm (right)", input.first * 1e3,
                         input.second * 1e3);
    case AxleInputs::contacts:
      return fmt::format("contacts at {:.3f} mm (left) and {:.3f} mm (right)", input.first * 1e3,
                         input.second * 1e3);
  }
  return {};
}

std::string end_of_motion(const BeamAxlePlan& plan, const BeamPosition& at, const BeamInput& wanted) {
  const WeakestAxleMotion weakest = weakest_motion(plan, at.place, at.input.inputs);
  return fmt::format("the motion to {} ends at {}: there {} {} no further (smallest singular value {:.1g})",
                     input_in_words(wanted), input_in_words(at.input), fmt::join(weakest.parts, ", "),
                     weakest.parts.size() == 1 ? "reaches" : "reach", weakest.singular_value);
}

BeamPosition follow_beam(const BeamAxlePlan& plan, const BeamInput& wanted, const BeamPlace& from,
                         const std::array<double, 2>& start) {
  BeamPosition out{.place = from, .input = {wanted.inputs, start[0], start[1]}, .reached = 0};
  BeamSolver solver(plan, wanted.inputs);
  if (!solver.converge(out.place, start)) {
    out.status = Status::no_assembly;
    out.place = from;
    solver.set(from, start);
    out.residual = solver.residual();
    std::size_t worst = 0;
    const AxleEquations& e = solver.equations();
    for (std::size_t i = 0; i + 2 < static_cast<std::size_t>(plan.unknowns); ++i)
      if (std::abs(e.residual[i]) > std::abs(e.residual[worst])) worst = i;
    out.reason = fmt::format("the links do not meet near the reference: {} is {:.3f} mm too {}",
                             plan.labels[static_cast<std::size_t>(e.label[worst])],
                             std::abs(e.residual[worst]) * 1e3, e.residual[worst] > 0 ? "short" : "long");
    return out;
  }
  const bool sign = solver.determinant() > 0;
  const double rise = wanted.first - start[0], turn = wanted.second - start[1];
  const double lever = wanted.inputs == AxleInputs::heave_roll ? norm(plan.wheel_centres[0]) : 1;
  const double length = std::max(std::abs(rise), lever * std::abs(turn));
  double share = length > first_beam_step ? first_beam_step / length : 1, at = 0;
  BeamVector tangent = solver.tangent(out.place, rise, turn);
  out.residual = solver.residual();
  while (at < 1 && length > 0) {
    const double next = at + share > 1 - 1e-9 ? 1 : at + share;
    const std::array<double, 2> there = next == 1
                                            ? std::array{wanted.first, wanted.second}
                                            : std::array{start[0] + next * rise, start[1] + next * turn};
    BeamPlace trial = out.place;
    BeamSolver::move(trial, tangent, next - at);
    bool arrived = near_place(trial, out.place) && solver.converge(trial, there) &&
                   near_place(trial, out.place) && (solver.determinant() > 0) == sign;
    if (arrived) {
      const BeamVector onward = solver.tangent(trial, rise, turn);
      arrived = (onward - tangent).norm() <= sharpest_beam_bend * std::max(onward.norm(), tangent.norm());
      if (arrived) tangent = onward;
    }
    if (arrived) {
      out.place = trial;
      out.input.first = there[0], out.input.second = there[1];
      out.residual = solver.residual();
      at = next;
      share *= 1.5;
      continue;
    }
    share = (next - at) / 2;
    if (share * length < smallest_beam_step) {
      out.status = Status::no_assembly;
      out.reached = at;
      out.reason = end_of_motion(plan, out, wanted);
      return out;
    }
  }
  out.reached = 1;
  return out;
}

}  // namespace

BeamPosition reference_position(const BeamAxlePlan& plan) {
  const BeamPlace reference{plan.centre, {}, {}};
  const std::array<double, 2> values = beam_inputs(plan, reference, AxleInputs::heave_roll);
  return follow_beam(plan, {AxleInputs::heave_roll, values[0], values[1]}, reference, values);
}

BeamPosition solve_position(const BeamAxlePlan& plan, const BeamInput& input, const BeamPosition& start) {
  LINKWRIGHT_REQUIRE(start.status == Status::done, "the start is {}: {}", to_string(start.status),
                     start.reason);
  LINKWRIGHT_REQUIRE(std::isfinite(input.first) && std::isfinite(input.second), "inputs {} and {}",
                     input.first, input.second);
  return follow_beam(plan, input, start.place, beam_inputs(plan, start.place, input.inputs));
}

BeamRates solve_rates(const BeamAxlePlan& plan, const BeamPosition& position, AxleInputs inputs) {
  BeamSolver solver(plan, inputs);
  solver.set(position.place, beam_inputs(plan, position.place, inputs));
  const auto motion = [](const BeamVector& x) {
    BeamMotion out{{x(0), x(1), x(2)}, {x(3), x(4), x(5)}, {}};
    for (int w = 6; w < x.size(); ++w) out.cranks[static_cast<std::size_t>(w - 6)] = x(w);
    return out;
  };
  const BeamVector first = solver.tangent(position.place, 1, 0),
                   second = solver.tangent(position.place, 0, 1);
  BeamRates out{Status::done, motion(first), motion(second)};
  // A metre of travel that turns the beam by a million radians is no motion any more.
  if (!(first.norm() < 1e6) || !(second.norm() < 1e6)) out.status = Status::singular;
  return out;
}

}  // namespace linkwright::suspension
