// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "linkwright/planar/path/arrow.h"
#include "linkwright/planar/path/local_fit.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

using SliderPathFit = PathFitOf<SliderCrankMechanism>;

/// Local search in all unknowns of a path problem of the slider-crank, on the side of the start: the nine
/// parameters, with free timing eight and every crank angle. Levenberg-Marquardt with the exact Jacobian;
/// bounds by an active set; full crank rotation and pressure angle, stroke and order by an augmented
/// Lagrangian. A step costs O(points). Holds its scratch memory: one per thread; nothing is allocated after
/// construction but for the answer.
class SliderPathFitter {
 public:
  SliderPathFitter(const SliderPathProblem& problem, double sense);

  /// Limits the stroke (m) anew, as SliderPathProblem::stroke does.
  void limit_stroke(const Range& stroke) { stroke_ = stroke; }

  /// `angles`: crank angle of each point at the start; with prescribed timing only the first one is used.
  SliderPathFit fit(const SliderCrankMechanism& start, const std::vector<double>& angles,
                    const PathFitOptions& options);

 private:
  using Shared = ArrowEquations::Shared;
  bool evaluate(const Shared& q, const std::vector<double>& angles, bool derivatives, double& merit);
  double crank_angle(const Shared& q, const std::vector<double>& angles, std::size_t k) const;
  void add_constraint(std::size_t row, double value, const Shared& gradient, bool derivatives, double& merit,
                      std::size_t point = 0, double by_angle = 0);
  void limit_rod(const Shared& q, const std::vector<double>& angles, bool derivatives, double& merit);
  void limit_way(const Shared& q, bool derivatives, double& merit);
  void keep_order(const std::vector<double>& angles, bool derivatives, double& merit);
  double descend(const PathFitOptions& options);

  const SliderPathProblem& problem_;
  double sense_, size_, side_ = 1;
  Range stroke_;
  std::array<bool, slider_parameter_count> variable_{}, held_{};
  Shared lower_{}, upper_{};
  ArrowEquations equations_;

  Shared q_{}, trial_q_{};
  std::vector<double> angles_, trial_angles_;
  double penalty_ = 1, error_ = 0;
  std::vector<double> multipliers_, values_;
  std::int64_t evaluations_ = 0;
};

}  // namespace linkwright::planar
