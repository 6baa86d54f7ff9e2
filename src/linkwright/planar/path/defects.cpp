// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/defects.h"

#include <cmath>
#include <cstddef>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {

Sentence point_text(const std::vector<double>& angles, std::size_t k) {
  return say("point {} (crank angle {})", at_place("point", count_of(static_cast<double>(k + 1))),
             at_place("crank_angle", degrees_of(math::wrap_angle(angles[k])).spelled()));
}

std::vector<Defect> defects(const PathMotion& motion) {
  std::vector<Defect> out;
  const auto& [task, angles, sense, points, turns_fully, reach, words] = motion;
  const std::size_t n = angles.size();
  bool everywhere = true;
  for (std::size_t k = 0; k < n; ++k) {
    if (points[k].status == Status::no_assembly) {
      everywhere = false;
      out.push_back({DefectKind::assembly, say("does not assemble at {}: {}{}{}", point_text(angles, k),
                                               words.missing[0], metres(points[k].gap), words.missing[1])});
    } else if (points[k].status == Status::singular) {
      out.push_back({DefectKind::branch, say("{} at {}", words.singular, point_text(angles, k))});
    }
  }
  const std::size_t steps = task.closed ? n : n - 1;
  // Prescribed angles themselves say which way the crank turns.
  const double direction = task.free_timing() ? sense : std::copysign(1.0, angles.back() - angles.front());
  double turned = 0;
  std::size_t backwards = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t next = (k + 1) % n;
    const double step = direction * (angles[next] - angles[k]);
    const double forward = step - 2 * pi * std::floor(step / (2 * pi));
    turned += forward;
    if (forward > 2 * pi - 1) ++backwards;  // a short way back counts as nearly a turn forward
    if (!everywhere || turns_fully) continue;
    const auto interval = reach(angles[k]);
    const double end = angles[k] + direction * forward, slack = 1e-9;
    if (!interval || end < interval->from - slack || end > interval->to + slack)
      out.push_back(
          {DefectKind::circuit, say("cannot move from point {} to point {} without passing crank angles {}",
                                    k + 1, next + 1, words.without_assembly)});
  }
  const double rounding = 1e-9 * static_cast<double>(n);
  if (task.closed ? std::abs(turned - 2 * pi) > rounding : turned > 2 * pi + rounding)
    out.push_back(
        {DefectKind::order,
         say("meets the points in another order: the crank turns {} in all, {} of {} steps run backwards",
             degrees_of(turned).spelled(), backwards, steps)});
  return out;
}

}  // namespace linkwright::planar
