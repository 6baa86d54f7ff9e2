// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/nonnegative_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/dense.h"

namespace linkwright::optimise {

double fit_nonnegative(std::span<const double> columns, std::span<const double> b, std::span<double> x) {
  const std::size_t m = b.size(), n = x.size();
  LINKWRIGHT_REQUIRE(columns.size() == m * n, "{} numbers for {} columns of {}", columns.size(), n, m);
  using Index = Eigen::Index;
  const Eigen::Map<const Eigen::MatrixXd> a(columns.data(), static_cast<Index>(m), static_cast<Index>(n));
  const Eigen::Map<const Eigen::VectorXd> wanted(b.data(), static_cast<Index>(m));
  Eigen::VectorXd now = Eigen::VectorXd::Zero(static_cast<Index>(n));
  std::vector<Index> in;  // columns with x > 0
  const double rounding = 1e-13 * (1 + a.cwiseAbs().sum()) * (1 + wanted.norm());
  for (std::size_t round = 0; round < 3 * n; ++round) {
    const Eigen::VectorXd slope = a.transpose() * (wanted - a * now);
    Index enters = -1;
    for (Index k = 0; k < static_cast<Index>(n); ++k)
      if (std::find(in.begin(), in.end(), k) == in.end() && slope[k] > rounding &&
          (enters < 0 || slope[k] > slope[enters]))
        enters = k;
    if (enters < 0) break;
    in.push_back(enters);
    while (!in.empty()) {
      const Eigen::MatrixXd part = a(Eigen::all, in);
      const std::vector<double> fit = math::linear_fit(math::numbers(part), in.size(), b);
      double share = 1;  // share of the step to the fit that stays in x >= 0
      for (std::size_t k = 0; k < in.size(); ++k)
        if (fit[k] <= 0) share = std::min(share, now[in[k]] / (now[in[k]] - fit[k]));
      bool left = false;
      for (std::size_t k = in.size(); k-- > 0;) {
        double& value = now[in[k]];
        const double target = fit[k];
        value += share * (target - value);
        if (target <= 0 && value <= 1e-15 * (1 + std::abs(target))) {
          value = 0;
          in.erase(in.begin() + static_cast<std::ptrdiff_t>(k));
          left = true;
        }
      }
      if (!left) break;
    }
  }
  std::copy(now.data(), now.data() + n, x.begin());
  return (a * now - wanted).norm();
}

}  // namespace linkwright::optimise
