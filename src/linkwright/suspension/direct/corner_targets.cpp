// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/corner_targets.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

/// Steps between targets are a few centimetres. A design that needs steps below a millimetre is next to a
/// fold, where it is unusable and its limit is not sought out.
constexpr CornerStepping stepping{.first = 0.03, .smallest = 1e-3};

double apart(const CornerInput& a, const CornerInput& b) {
  return std::max(std::abs(a.value - b.value), std::abs(a.rack - b.rack));
}

}  // namespace

double tolerance_of(const ToleranceRule& rule, double value) {
  return rule.least + rule.slope * std::max(std::abs(value) - rule.from, 0.0);
}

double quartic(std::span<const double, 15> c, double x1, double x2) {
  double sum = c[14];
  std::size_t k = 0;
  for (int degree = 4; degree > 0; --degree)
    for (int second = 0; second <= degree; ++second) {
      double power = 1;
      for (int i = 0; i < degree; ++i) power *= i < second ? x2 : x1;
      sum += c[k++] * power;
    }
  return sum;
}

TargetPositions target_positions(std::span<const TargetObjective> objectives, Driver driver) {
  TargetPositions out{.driver = driver};
  const auto position = [&](const CornerInput& input) {
    for (std::size_t i = 0; i < out.inputs.size(); ++i)
      if (apart(out.inputs[i], input) == 0) return static_cast<int>(i);
    out.inputs.push_back(input);
    return static_cast<int>(out.inputs.size()) - 1;
  };
  LINKWRIGHT_REQUIRE(!objectives.empty(), "no objectives");
  for (std::size_t o = 0; o < objectives.size(); ++o) {
    const TargetObjective& objective = objectives[o];
    const std::size_t before = out.rows.size();
    for (std::size_t c = 0; c < objective.curves.size(); ++c) {
      const TargetCurve& curve = objective.curves[c];
      if (!curve.motion && row_of(curve.quantity).extent == Extent::all) out.extent = Extent::all;
      for (std::size_t p = 0; p < curve.points.size(); ++p) {
        const TargetPoint& point = curve.points[p];
        LINKWRIGHT_REQUIRE(point.tolerance > 0 && std::isfinite(point.tolerance) && point.weight >= 0 &&
                               std::isfinite(point.weight) && std::isfinite(point.value),
                           "objective '{}', {}: value {}, tolerance {}, weight {}", objective.name,
                           curve.motion ? "a spring" : name_of(curve.quantity), point.value, point.tolerance,
                           point.weight);
        LINKWRIGHT_REQUIRE(std::isfinite(point.input.value) && std::isfinite(point.input.rack),
                           "objective '{}': input {} m, rack {} m", objective.name, point.input.value,
                           point.input.rack);
        TargetPositions::Row row{o, c, p, position(point.input), -1};
        if (curve.measure != TargetMeasure::value) row.reference = position(curve.reference);
        out.rows.push_back(row);
      }
    }
    LINKWRIGHT_REQUIRE(out.rows.size() > before, "objective '{}' has no targets", objective.name);
  }

  // Nearest to the reference first, so that each finds a neighbour between itself and the reference.
  std::vector<int> order(out.inputs.size()), place(out.inputs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return apart(out.inputs[a], {}) < apart(out.inputs[b], {}); });
  std::vector<CornerInput> sorted;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<int>(i);
    sorted.push_back(out.inputs[order[i]]);
  }
  out.inputs = sorted;
  for (TargetPositions::Row& row : out.rows) {
    row.position = place[row.position];
    if (row.reference >= 0) row.reference = place[row.reference];
  }
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    int nearest = -1;
    double least = apart(sorted[i], {});
    for (std::size_t k = 0; k < i; ++k)
      if (apart(sorted[i], sorted[k]) < least) {
        least = apart(sorted[i], sorted[k]);
        nearest = static_cast<int>(k);
      }
    out.from.push_back(nearest);
  }
  return out;
}

TargetAnswer answer(const Suspension& suspension, std::span<const TargetObjective> objectives,
                    const TargetPositions& at, std::span<const DesignNumber> numbers) {
  TargetAnswer out;
  if (!check(suspension).empty()) return out;
  DerivativePlan plan;
  if (numbers.empty())
    plan.plan = prepare_suspension(suspension);
  else
    plan = prepare_derivatives(suspension, {numbers.begin(), numbers.end()});

  const std::size_t count = at.inputs.size();
  const CornerPosition reference = reference_position(plan.plan, at.driver);
  double there = 0;
  std::vector<WheelParameters> parameters(count);
  out.positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const CornerPosition& start = at.from[i] < 0 ? reference : out.positions[at.from[i]];
    out.positions[i] = start.status == Status::done
                           ? solve_position(plan.plan, at.driver, at.inputs[i], start, stepping)
                           : CornerPosition{.status = start.status, .reached = 0};
    const CornerPosition& position = out.positions[i];
    there += position.status == Status::done ? 1 : position.reached;
  }
  out.reached = there / static_cast<double>(count);
  const auto done = [](const CornerPosition& position) { return position.status == Status::done; };
  if (!std::all_of(out.positions.begin(), out.positions.end(), done)) return out;

  std::vector<WheelDerivatives> exact(numbers.empty() ? 0 : count);
  for (std::size_t i = 0; i < count; ++i) {
    if (numbers.empty()) {
      parameters[i] = wheel_parameters(plan.plan, out.positions[i]);
      if (at.extent == Extent::all && parameters[i].status != Status::done) return out;
      continue;
    }
    exact[i] = wheel_derivatives(plan, out.positions[i], at.extent);
    if (exact[i].status != Status::done) return out;
    parameters[i] = exact[i].parameters;
  }

  const bool moving = std::any_of(objectives.begin(), objectives.end(), [](const TargetObjective& o) {
    return std::any_of(o.curves.begin(), o.curves.end(), [](const TargetCurve& c) { return c.motion; });
  });
  std::vector<MotionDerivatives> motions;
  if (moving) {
    const MotionPlan of_motions = prepare_motions(suspension, numbers);
    for (const CornerPosition& position : out.positions) {
      motions.push_back(motion_derivatives(of_motions, position));
      if (motions.back().status != Status::done) return out;
    }
  }
  const auto value_at = [&](const TargetCurve& curve, int position) {
    return curve.motion ? value_of(*curve.motion, motions[position].motions)
                        : value_of(parameters[position], curve.quantity);
  };
  const auto derivative_at = [&](const TargetCurve& curve, int position, std::size_t j) {
    return curve.motion ? derivative_of(*curve.motion, motions[position].motions, motions[position].by[j])
                        : value_of(exact[position].by[j], curve.quantity);
  };

  const std::size_t n = numbers.size();
  out.achieved.resize(at.rows.size());
  out.deviations.resize(at.rows.size());
  out.by.resize(at.rows.size() * n);
  bool finite = true;
  for (std::size_t r = 0; r < at.rows.size(); ++r) {
    const auto& row = at.rows[r];
    const TargetCurve& curve = objectives[row.objective].curves[row.curve];
    const TargetPoint& point = curve.points[row.point];
    const double value = value_at(curve, row.position);
    const double before = row.reference < 0 ? 0 : value_at(curve, row.reference);
    const bool relative = curve.measure == TargetMeasure::relative_change;
    out.achieved[r] = relative ? value / before - 1 : value - before;
    const double scale = point.weight / point.tolerance;
    out.deviations[r] = scale * (out.achieved[r] - point.value);
    finite = finite && std::isfinite(out.deviations[r]);
    for (std::size_t j = 0; j < n; ++j) {
      const double by = derivative_at(curve, row.position, j);
      const double of_before = row.reference < 0 ? 0 : derivative_at(curve, row.reference, j);
      const double change = relative ? (by - value / before * of_before) / before : by - of_before;
      out.by[r * n + j] = scale * change;
      finite = finite && std::isfinite(change);
    }
  }
  out.assembled = finite;
  for (WheelDerivatives& of : exact) out.shifts.push_back(std::move(of.shift));
  return out;
}

std::vector<double> objective_values(std::span<const TargetObjective> objectives, const TargetPositions& at,
                                     std::span<const double> deviations) {
  std::vector<double> out(objectives.size());
  for (std::size_t r = 0; r < at.rows.size(); ++r)
    out[at.rows[r].objective] = std::max(out[at.rows[r].objective], std::abs(deviations[r]));
  return out;
}

}  // namespace linkwright::suspension
