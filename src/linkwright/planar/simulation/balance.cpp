// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/balance.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/math/dense.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/dynamics.h"

namespace linkwright::planar {

bool in_unstable_balance(const Linkage& l, const LinkagePlan& plan, std::span<const InputDrive> drives,
                         double time) {
  constexpr double tried = 1e-4, balanced = 1e-9;
  const bool at_rest =
      std::all_of(drives.begin(), drives.end(), [](const InputDrive& d) { return !d.law && d.rate == 0; });
  const bool friction = std::any_of(l.joints.begin(), l.joints.end(), has_friction);
  if (!at_rest || friction) return false;
  const std::size_t n = plan.inputs();
  LinkageDynamics dynamics(l, plan, std::vector<bool>(n, true));
  std::vector<InputMotion> start;
  InputReach reach;
  for (const InputDrive& d : drives) {
    start.push_back({d.value, 0, 0});
    reach.low.push_back(d.value), reach.high.push_back(d.value);
  }
  LinkageAssembly(plan, reach, AtChangePoint::stop).place(start, dynamics.motion);
  if (dynamics.motion.status != Status::done) return false;
  const auto size = [&](std::size_t k) { return plan.rotary[k] ? 1.0 : plan.size; };
  // Accelerations in units of rad, or sizes of the linkage, that displacements in these units give.
  bool assembled = true;
  const auto accelerations = [&](std::size_t moved, double by) {
    std::vector<InputMotion> inputs = start;
    inputs[moved].value += by * size(moved);
    assembled = dynamics.solve(time, inputs) == Status::done && assembled;
    std::vector<double> out;
    for (std::size_t k = 0; k < n; ++k) out.push_back(inputs[k].acceleration / size(k));
    return out;
  };
  const std::vector<double> here = accelerations(0, 0);
  std::vector<double> growth(n * n);
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<double> after = accelerations(k, tried), before = accelerations(k, -tried);
    for (std::size_t j = 0; j < n; ++j) {
      growth[j * n + k] = (after[j] - before[j]) / (2 * tried);
      largest = std::max(largest, std::abs(growth[j * n + k]));
    }
  }
  if (!assembled || !(largest > 0)) return false;
  if (std::any_of(here.begin(), here.end(), [&](double a) { return std::abs(a) > balanced * largest; }))
    return false;
  const std::vector<std::complex<double>> rates = math::eigenvectors(growth, false).values;
  return std::any_of(rates.begin(), rates.end(),
                     [&](std::complex<double> r) { return r.real() > 1e-6 * largest; });
}

}  // namespace linkwright::planar
