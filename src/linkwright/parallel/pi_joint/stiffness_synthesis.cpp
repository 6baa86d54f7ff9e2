// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/stiffness_synthesis.h"

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/zero.h"
#include "linkwright/optimise/nonnegative_fit.h"

namespace linkwright::parallel {

namespace {

// Beyond this condition the rounding of the samples alone decides.
constexpr double worst_condition = 1e10;

void require_range(const AngleRange& r) {
  LINKWRIGHT_REQUIRE(-pi / 2 < r.from && r.from < r.to && r.to < pi / 2, "range from {} to {} rad", r.from,
                     r.to);
}

// Mean over the range of a function that is smooth on the scale of a radian.
double mean_over(const AngleRange& range, math::FunctionRef<double(double)> f) {
  constexpr int panels = 32;
  constexpr double node[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr double weight[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double half = 0.5 * (range.to - range.from) / panels;
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double middle = range.from + (2 * i + 1) * half;
    for (int k = 0; k < 3; ++k) sum += weight[k] * (f(middle - node[k] * half) + f(middle + node[k] * half));
  }
  return sum / (2 * panels);
}

// Compliances by which the bars enter the compliance of the joint, in the order of PiBarsSought.
std::array<double, 4> terms_at(const PiJoint& joint, double angle, double share) {
  const PiBarForces n = bar_forces(joint, angle, share);
  const double along = n.diagonal * n.diagonal;
  return {along, along * diagonal(joint, angle), n.arm_base * n.arm_base + n.arm_top * n.arm_top,
          n.coupler * n.coupler};
}

}  // namespace

double mean_stiffness(const PiJoint& joint, const PiBars& bars, const AngleRange& range, StiffnessMean mean,
                      double share) {
  require_range(range);
  switch (mean) {
    case StiffnessMean::of_stiffness:
      return mean_over(range, [&](double at) { return stiffness(joint, bars, at, share); });
    case StiffnessMean::of_compliance:
      return 1 / mean_over(range, [&](double at) { return compliance(joint, bars, at, share); });
    case StiffnessMean::at_zero:
      break;
  }
  return stiffness(joint, bars, 0, share);
}

std::optional<double> diagonal_for_mean(const PiJoint& joint, const PiBars& bars, const AngleRange& range,
                                        StiffnessMean mean, double wanted, double share) {
  LINKWRIGHT_REQUIRE(wanted > 0 && std::isfinite(wanted), "stiffness {} N m/rad", wanted);
  PiBars tried = bars;
  tried.diagonal = infinity;
  if (!(mean_stiffness(joint, tried, range, mean, share) > wanted)) return {};
  // The joint is never stiffer than J^2 k_d with J at most the shorter length, and its mean tends to that of
  // the other bars from below: both signs are between these powers of e.
  const double shorter = std::min(joint.arm, base_length(joint));
  const double least = std::log(wanted / (shorter * shorter));
  const auto excess = [&](double exponent) {
    tried.diagonal = std::exp(exponent);
    return mean_stiffness(joint, tried, range, mean, share) / wanted - 1;
  };
  double most = least;
  while (excess(most) <= 0) {
    // Closer to the other bars than rounding can distinguish.
    if (most > least + 100) return {};
    most += 1;
  }
  return std::exp(math::zero_between(excess, least - 1, most));
}

PiStiffnessFit fit_bars(const PiJoint& joint, std::span<const PiStiffnessSample> samples,
                        const PiBarsSought& sought, const PiBars& known, double share) {
  const std::array<bool, 4> chosen = {sought.diagonal, sought.screw, sought.arm, sought.coupler};
  PiStiffnessFit out{.bars = known};
  const std::array<double*, 4> bars = {&out.bars.diagonal, &out.bars.screw, &out.bars.arm, &out.bars.coupler};
  std::vector<int> order;
  for (int k = 0; k < 4; ++k)
    if (chosen[k]) order.push_back(k);
  const auto n = static_cast<Eigen::Index>(order.size()), m = static_cast<Eigen::Index>(samples.size());
  LINKWRIGHT_REQUIRE(n > 0, "no bar is sought");
  LINKWRIGHT_REQUIRE(m >= n, "{} samples for {} bars", m, n);

  // Rows relative to the compliance measured.
  Eigen::MatrixXd matrix(m, n);
  Eigen::VectorXd right(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto [angle, stiff] = samples[i];
    LINKWRIGHT_REQUIRE(std::abs(angle) < pi / 2, "sample {} at {} rad", i + 1, angle);
    LINKWRIGHT_REQUIRE(stiff > 0 && std::isfinite(stiff), "sample {}: {} N m/rad", i + 1, stiff);
    const std::array<double, 4> terms = terms_at(joint, angle, share);
    right[i] = 1;
    for (Eigen::Index column = 0, k = 0; k < 4; ++k)
      if (chosen[k])
        matrix(i, column++) = terms[k] * stiff;
      else
        right[i] -= terms[k] * stiff / *bars[k];
  }

  Eigen::VectorXd scale = matrix.colwise().norm();
  for (Eigen::Index j = 0; j < n; ++j)
    if (scale[j] > 0) matrix.col(j) /= scale[j];
  const auto count = [](Eigen::Index k) { return static_cast<std::size_t>(k); };
  const std::vector<double> values = math::singular_vectors(math::numbers(matrix), count(n)).values;
  out.condition = values.back() > 0 ? values.front() / values.back() : infinity;
  if (!(out.condition < worst_condition)) {
    out.status = Status::singular;
    out.condition = infinity;
  }
  Eigen::VectorXd x(n);
  const double norm = optimise::fit_nonnegative({matrix.data(), count(m * n)}, {right.data(), count(m)},
                                                {x.data(), count(n)});
  for (Eigen::Index j = 0; j < n; ++j) *bars[order[j]] = scale[j] / x[j];
  for (Eigen::Index j = 0; j < n; ++j)
    if (!(x[j] > 0)) *bars[order[j]] = infinity;
  out.error = norm / std::sqrt(static_cast<double>(m));
  return out;
}

}  // namespace linkwright::parallel
