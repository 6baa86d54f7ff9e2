// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/motion_law.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/finite.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

// One condition of EndConditions: derivative of an order at an end x = 0, 1.
struct Condition {
  int end;
  std::size_t order;
  double value;
};
std::vector<Condition> conditions(const EndConditions& law) {
  std::vector<Condition> out = {{0, 0, law.from}};
  const auto add = [&](int end, std::size_t order, const std::optional<double>& value) {
    if (value) out.push_back({end, order, *value});
  };
  add(0, 1, law.start_rate);
  add(0, 2, law.start_acceleration);
  add(0, 3, law.start_jerk);
  add(1, 0, law.to);
  add(1, 1, law.end_rate);
  add(1, 2, law.end_acceleration);
  add(1, 3, law.end_jerk);
  return out;
}

std::optional<MotionProblem> interval_problem(double start, double duration) {
  if (!std::isfinite(start)) return MotionProblem{"start", fmt::format("is {} s, must be finite", start), {}};
  if (!(duration > 0) || !std::isfinite(duration))
    return MotionProblem{"duration", fmt::format("is {} s, must be more than 0 s", duration), {}};
  return {};
}

std::optional<MotionProblem> finite_problem(
    std::initializer_list<std::pair<std::string_view, double>> values) {
  for (const auto& [key, value] : values)
    if (!std::isfinite(value)) return MotionProblem{key, fmt::format("is {}, must be finite", value), {}};
  return {};
}

std::optional<MotionProblem> problem_of(const ConstantSpeed& law) {
  return finite_problem({{"from", law.from}, {"speed", law.rate}});
}
std::optional<MotionProblem> problem_of(const CycloidalMotion& law) {
  if (auto bad = interval_problem(law.start, law.duration)) return bad;
  return finite_problem({{"from", law.from}, {"to", law.to}});
}
std::optional<MotionProblem> problem_of(const Polynomial345& law) {
  if (auto bad = interval_problem(law.start, law.duration)) return bad;
  if (!all_finite(law.higher)) return MotionProblem{"higher_coefficients", "must be finite", {}};
  return finite_problem({{"from", law.from}, {"to", law.to}});
}
// Solvable exactly when, for each order k, the conditions of orders 0 ... k are at least k + 1 (Polya's
// condition, sufficient for two places).
std::optional<MotionProblem> problem_of(const EndConditions& law) {
  if (auto bad = interval_problem(law.start, law.duration)) return bad;
  const std::vector<Condition> all = conditions(law);
  for (const Condition& c : all)
    if (!std::isfinite(c.value)) return MotionProblem{"from", "all conditions must be finite", {}};
  constexpr std::array<std::string_view, 4> what = {"positions", "speeds", "accelerations", "jerks"};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto low = std::count_if(all.begin(), all.end(), [&](const Condition& c) { return c.order <= k; });
    const bool more = std::any_of(all.begin(), all.end(), [&](const Condition& c) { return c.order > k; });
    if (more && static_cast<std::size_t>(low) < k + 1)
      return MotionProblem{"law",
                           fmt::format("the conditions do not determine the motion: {} of orders up to {} "
                                       "{} given, but there are conditions of higher order",
                                       low, what[k], low == 1 ? "is" : "are"),
                           fmt::format("add {}", k == 1 ? "to, start_speed or end_speed"
                                                        : "a speed or an acceleration at one of the ends")};
  }
  if (all.size() == 1)
    return MotionProblem{"law", "a start position alone is not a motion",
                         "add to, start_speed, end_speed, ..."};
  return {};
}
std::optional<MotionProblem> problem_of(const MotionTable& law) {
  const std::size_t least =
      law.ends == TableEnds::rest || (law.ends == TableEnds::natural && law.curve == TableCurve::cubic) ? 2
                                                                                                        : 3;
  if (law.times.size() != law.values.size())
    return MotionProblem{"values",
                         fmt::format("has {} values for {} times", law.values.size(), law.times.size()),
                         "give one value for each time"};
  if (law.times.size() < least)
    return MotionProblem{
        "times", fmt::format("has {} rows, must have at least {}", law.times.size(), least), {}};
  if (!all_finite(law.times)) return MotionProblem{"times", "must be finite", {}};
  if (!all_finite(law.values)) return MotionProblem{"values", "must be finite", {}};
  for (std::size_t i = 1; i < law.times.size(); ++i)
    if (law.times[i] <= law.times[i - 1])
      return MotionProblem{
          "times",
          fmt::format("must increase, but {} s follows {} s (row {})", law.times[i], law.times[i - 1], i + 1),
          {}};
  return {};
}
std::optional<MotionProblem> problem_of(const HarmonicMotion& law) {
  return finite_problem({{"centre", law.centre},
                         {"amplitude", law.amplitude},
                         {"frequency", law.frequency},
                         {"phase", law.phase}});
}

PiecewisePolynomial polynomial(const Polynomial345& law) {
  std::vector<double> c = coefficients(law);
  for (double& coefficient : c) coefficient *= law.to - law.from;
  c[0] = law.from;
  return {{law.start, law.start + law.duration}, c.size(), c};
}

PiecewisePolynomial polynomial(const EndConditions& law) {
  const std::vector<Condition> all = conditions(law);
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
  const auto n = static_cast<Eigen::Index>(all.size());
  Matrix matrix = Matrix::Zero(n, n);
  Vector right(n);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Condition& c = all[static_cast<std::size_t>(row)];
    const auto order = static_cast<Eigen::Index>(c.order);
    for (Eigen::Index p = order; p < (c.end == 0 ? order + 1 : n); ++p) {
      double factor = 1;
      for (Eigen::Index k = 0; k < order; ++k) factor *= static_cast<double>(p - k);
      matrix(row, p) = factor;
    }
    right(row) = c.value * std::pow(law.duration, static_cast<double>(c.order));
  }
  const Vector solution = matrix.partialPivLu().solve(right);
  return {{law.start, law.start + law.duration},
          all.size(),
          {solution.data(), solution.data() + solution.size()}};
}

PiecewisePolynomial polynomial(const MotionTable& law) {
  const auto ends = law.ends == TableEnds::natural ? SplineEnds::natural
                    : law.ends == TableEnds::rest  ? SplineEnds::rest
                                                   : SplineEnds::periodic;
  return math::interpolating_spline(
      law.times, law.values, law.curve == TableCurve::cubic ? SplineDegree::cubic : SplineDegree::quintic,
      ends);
}

Motion at(const ConstantSpeed& law, double t) { return {law.from + law.rate * t, law.rate, 0, 0}; }

Motion at(const CycloidalMotion& law, double t) {
  const double x = (t - law.start) / law.duration, stroke = law.to - law.from, T = law.duration;
  if (x < 0) return {law.from, 0, 0, 0};
  if (x > 1) return {law.to, 0, 0, 0};
  const double s = std::sin(2 * pi * x), c = std::cos(2 * pi * x);
  return {law.from + stroke * (x - s / (2 * pi)), stroke / T * (1 - c), stroke / (T * T) * 2 * pi * s,
          stroke / (T * T * T) * 4 * pi * pi * c};
}

Motion at(const HarmonicMotion& law, double t) {
  const double w = 2 * pi * law.frequency, s = std::sin(w * t + law.phase), c = std::cos(w * t + law.phase);
  return {law.centre + law.amplitude * s, law.amplitude * w * c, -law.amplitude * w * w * s,
          -law.amplitude * w * w * w * c};
}

std::vector<double> knots(const ConstantSpeed&, double, double) { return {}; }
std::vector<double> knots(const HarmonicMotion&, double, double) { return {}; }
std::vector<double> knots(const MotionTable& law, double from, double to) {
  std::vector<double> out = law.times;
  if (law.ends != TableEnds::periodic) return out;
  const double first = law.times.front(), period = law.times.back() - first;
  out.clear();
  for (double turn = std::floor((from - first) / period); first + turn * period < to; ++turn)
    for (std::size_t i = 0; i + 1 < law.times.size(); ++i) out.push_back(law.times[i] + turn * period);
  return out;
}
template <class Law>
std::vector<double> knots(const Law& law, double, double) {
  return {law.start, law.start + law.duration};
}

constexpr double always = -infinity;
std::optional<double> settled(const ConstantSpeed&) { return always; }
std::optional<double> settled(const HarmonicMotion& law) {
  return law.amplitude == 0 || law.frequency == 0 ? std::optional(always) : std::nullopt;
}
std::optional<double> settled(const MotionTable& law) {
  return law.ends == TableEnds::periodic ? std::nullopt : std::optional(law.times.back());
}
template <class Law>
std::optional<double> settled(const Law& law) {
  return law.start + law.duration;
}

}  // namespace

std::vector<double> coefficients(const Polynomial345& law) {
  // Each higher term takes its own value, rate and acceleration at x = 1 off those of the first three; the
  // factors are whole numbers.
  std::vector<double> c = {0, 0, 0, 10, -15, 6};
  for (std::size_t i = 0; i < law.higher.size(); ++i) {
    const auto p = static_cast<double>(i + 6), half = p * (p - 1) / 2;
    c[3] -= (10 - 4 * p + half) * law.higher[i];
    c[4] -= (-15 + 7 * p - 2 * half) * law.higher[i];
    c[5] -= (6 - 3 * p + half) * law.higher[i];
  }
  c.insert(c.end(), law.higher.begin(), law.higher.end());
  return c;
}

Motion MotionCurve::at(const Pieces& pieces, double t) {
  const PiecewisePolynomial& p = pieces.polynomial;
  const double first = p.knots.front(), last = p.knots.back();
  const auto motion = [&](double time) {
    const auto d = evaluate(p, time);
    return Motion{d[0], d[1], d[2], d[3]};
  };
  if (pieces.periodic) {
    const double period = last - first, turns = std::floor((t - first) / period);
    Motion m = motion(std::clamp(t - turns * period, first, last));
    m.value += turns * (evaluate(p, last)[0] - evaluate(p, first)[0]);
    return m;
  }
  if (t >= first && t <= last) return motion(t);
  const double end = t < first ? first : last;
  const Motion m = motion(end);
  return {m.value + m.rate * (t - end), m.rate, 0, 0};
}

std::optional<MotionProblem> problem(const MotionLaw& law) {
  return std::visit([](const auto& l) { return problem_of(l); }, law);
}

std::vector<double> breaks(const MotionLaw& law, double from, double to) {
  std::vector<double> out = std::visit([&](const auto& l) { return knots(l, from, to); }, law);
  std::erase_if(out, [&](double t) { return !(t > from && t < to); });
  return out;
}

std::optional<double> even_from(const MotionLaw& law) {
  return std::visit([](const auto& l) { return settled(l); }, law);
}

MotionCurve::MotionCurve(const MotionLaw& law) {
  const std::optional<MotionProblem> bad = problem(law);
  LINKWRIGHT_REQUIRE(!bad, "{} {}", bad->key, bad->message);
  std::visit(
      [this](const auto& l) {
        if constexpr (requires { polynomial(l); }) {
          Pieces pieces{.polynomial = polynomial(l)};
          if constexpr (requires { l.ends; }) pieces.periodic = l.ends == TableEnds::periodic;
          form_ = std::move(pieces);
        } else {
          form_ = l;
        }
      },
      law);
}

Motion MotionCurve::operator()(double t) const {
  return std::visit(
      [t](const auto& form) {
        if constexpr (requires { form.polynomial; })
          return at(form, t);
        else
          return math::at(form, t);
      },
      form_);
}

}  // namespace linkwright::math
