// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "linkwright/planar/function/synthesis.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar::test {

// The functions of the stored generators: 90 degrees of crank and rocker each.
inline FunctionProblem stored_function(const std::string& name) {
  double from = 0, to = 1;
  double (*y)(double) = nullptr;
  if (name == "x^1.5 1..4") from = 1, to = 4, y = [](double x) { return std::pow(x, 1.5); };
  if (name == "log10 1..10") from = 1, to = 10, y = [](double x) { return std::log10(x); };
  if (name == "log10 1..2") from = 1, to = 2, y = [](double x) { return std::log10(x); };
  if (name == "sin 0..90") to = pi / 2, y = [](double x) { return std::sin(x); };
  if (name == "tan 0..45") to = pi / 4, y = [](double x) { return std::tan(x); };
  if (name == "exp 0..1") y = [](double x) { return std::exp(x); };
  if (name == "x^2 0..1") y = [](double x) { return x * x; };
  if (name == "1/x 1..2") from = 1, to = 2, y = [](double x) { return 1 / x; };
  FunctionProblem p;
  p.input_range = pi / 2;
  p.output = [=](double share) {
    return pi / 2 * (y(from + (to - from) * share) - y(from)) / (y(to) - y(from));
  };
  p.fit = FunctionFit::minimax;
  return p;
}

}  // namespace linkwright::planar::test
