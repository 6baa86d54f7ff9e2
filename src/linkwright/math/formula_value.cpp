// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/formula.h"

// The values of formulas, step by step.
namespace linkwright::math {

bool Formula::uses(std::size_t name) const {
  return std::any_of(steps_.begin(), steps_.end(),
                     [&](const Step& s) { return s.code == Code::name && s.index == name; });
}

double Formula::of_one(const Step& step, double a) {
  switch (step.code) {
    case Code::negative:
      return -a;
    case Code::power:
      return std::pow(a, step.value);
    case Code::opposite:
      return a == 0;
    case Code::sine:
      return std::sin(a);
    case Code::cosine:
      return std::cos(a);
    case Code::tangent:
      return std::tan(a);
    case Code::arc_sine:
      return std::asin(a);
    case Code::arc_cosine:
      return std::acos(a);
    case Code::arc_tangent:
      return std::atan(a);
    case Code::root:
      return std::sqrt(a);
    case Code::exponential:
      return std::exp(a);
    case Code::logarithm:
      return std::log(a);
    default:
      return nan;
  }
}

double Formula::of_two(Code code, double a, double b) {
  switch (code) {
    case Code::plus:
      return a + b;
    case Code::minus:
      return a - b;
    case Code::times:
      return a * b;
    case Code::over:
      return a / b;
    case Code::equal:
      return a == b;
    case Code::both:
      return a != 0 && b != 0;
    case Code::either:
      return a != 0 || b != 0;
    case Code::arc_tangent2:
      return std::atan2(a, b);
    default:
      return nan;
  }
}

bool Formula::has_kink(Code code) {
  switch (code) {
    case Code::magnitude:
    case Code::sign:
    case Code::whole:
    case Code::table:
    case Code::less:
    case Code::less_equal:
    case Code::greater:
    case Code::greater_equal:
    case Code::least:
    case Code::greatest:
    case Code::remainder:
      return true;
    default:
      return false;
  }
}

double Formula::kink(const Step& s, double a, double b) const {
  if (s.code == Code::whole) return std::sin(pi * a);
  if (s.code == Code::remainder) return std::sin(pi * a / b);
  if (s.code != Code::table) return s.code >= first_of_two ? a - b : a;
  // The distance from the nearest row, with another sign in every other interval.
  const std::vector<double>& x = tables_[s.index].argument;
  const auto above = std::upper_bound(x.begin(), x.end(), a);
  double distance = infinity;
  if (above != x.begin()) distance = a - *(above - 1);
  if (above != x.end()) distance = std::min(distance, *above - a);
  return (above - x.begin()) % 2 == 0 ? distance : -distance;
}

// A whole number of floor and mod, the rows below the argument of a table, else the sign.
double Formula::branch(const Step& s, double a, double b) const {
  if (s.code == Code::whole) return std::floor(a);
  if (s.code == Code::remainder) return std::floor(a / b);
  if (s.code == Code::table) {
    const std::vector<double>& x = tables_[s.index].argument;
    return std::isnan(a) ? nan : static_cast<double>(std::upper_bound(x.begin(), x.end(), a) - x.begin());
  }
  const double difference = s.code >= first_of_two ? a - b : a;
  return std::isnan(difference) ? nan : static_cast<double>((difference > 0) - (difference < 0));
}

double Formula::on_branch(const Step& s, double a, double b, double branch) const {
  switch (s.code) {
    case Code::magnitude:
      return branch < 0 ? -a : a;
    case Code::sign:
    case Code::whole:
      return branch;
    case Code::least:
      return std::isnan(branch) ? nan : branch <= 0 ? a : b;
    case Code::greatest:
      return std::isnan(branch) ? nan : branch >= 0 ? a : b;
    case Code::less:
      return branch < 0;
    case Code::less_equal:
      return branch <= 0;
    case Code::greater:
      return branch > 0;
    case Code::greater_equal:
      return branch >= 0;
    case Code::remainder:
      return a - b * branch;
    case Code::table: {
      if (std::isnan(a) || std::isnan(branch)) return nan;
      const std::vector<double>&x = tables_[s.index].argument, &y = tables_[s.index].value;
      const auto i = static_cast<std::size_t>(branch);
      if (i == 0) return y.front();
      if (i == x.size()) return y.back();
      return y[i - 1] + (a - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
    }
    default:
      return nan;
  }
}

std::size_t Formula::kinks() const {
  return static_cast<std::size_t>(
      std::count_if(steps_.begin(), steps_.end(), [](const Step& s) { return has_kink(s.code); }));
}

double Formula::value(std::span<const double> values, Kinks at) const {
  // Each level of nesting keeps a value at each of its five sorts of signs, and two of a choice.
  std::array<double, 8 * max_depth> stack;
  std::size_t n = 0;
  for (const Step& s : steps_) {
    if (s.code == Code::number || s.code == Code::name) {
      stack[n++] = s.code == Code::number ? s.value : values[s.index];
      continue;
    }
    if (s.code == Code::choose) {
      n -= 2;
      stack[n - 1] = stack[n - 1] != 0 ? stack[n] : stack[n + 1];
      continue;
    }
    if (s.code >= first_of_two) --n;
    const double a = stack[n - 1], b = s.code >= first_of_two ? stack[n] : 0;
    if (!has_kink(s.code)) {
      stack[n - 1] = s.code >= first_of_two ? of_two(s.code, a, b) : of_one(s, a);
      continue;
    }
    const double found = branch(s, a, b);
    if (at.kinks) *at.kinks++ = kink(s, a, b);
    if (at.found) *at.found++ = found;
    stack[n - 1] = on_branch(s, a, b, at.taken ? *at.taken++ : found);
  }
  return stack[0];
}

}  // namespace linkwright::math
