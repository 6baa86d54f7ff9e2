// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <cmath>

namespace linkwright::test {

/// Uniform on [low, high], whatever the size that rapidcheck has come to; shrinks towards `low`.
inline rc::Gen<double> between(double low, double high) {
  constexpr int steps = 1 << 30;
  return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1)),
                      [=](int i) { return low + (high - low) * (static_cast<double>(i) / steps); });
}

/// Uniform in the logarithm, 0 < low < high.
inline rc::Gen<double> log_between(double low, double high) {
  return rc::gen::map(between(std::log(low), std::log(high)), [](double x) { return std::exp(x); });
}

}  // namespace linkwright::test
