// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/assemblies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/suspension/corner/detail/points_kernel.h"

namespace linkwright::suspension {
namespace {

constexpr int max_iterations = 80;
constexpr double converged = 1e-12;   ///< m
constexpr double longest_step = 0.3;  ///< m, rad
constexpr double same = 1e-6;         ///< m, rad: places that are one

template <int N>
bool newton(const CornerPlan& plan, Driver driver, const CornerInput& input, CornerPlace& place,
            double& residual) {
  CornerEquations equations;
  math::SmallLu<N> lu;
  for (int i = 0; i < max_iterations; ++i) {
    evaluate(plan, place, input.rack, driver, input.value, equations);
    std::array<double, N> right;
    residual = 0;
    for (int k = 0; k < N; ++k) {
      right[k] = equations.residual[k];
      residual = std::max(residual, std::abs(right[k]));
    }
    if (!std::isfinite(residual)) return false;
    if (residual <= converged) return true;
    lu.factor(equations.jacobian);
    const std::array<double, N> step = lu.solve(right);
    double square = 0;
    for (const double s : step) square += s * s;
    if (!std::isfinite(square)) return false;
    const double by = -std::min(1.0, longest_step / std::sqrt(square));
    place.carrier.centre += by * Vec3{step[0], step[1], step[2]};
    place.carrier.rotation =
        math::rectified(math::turn_about(by * Vec3{step[3], step[4], step[5]}) * place.carrier.rotation);
    if constexpr (N == 7) place.arm += by * step[6];
  }
  return false;
}

/// The equations do not distinguish a hinge from one put together the wrong way round, nor a strut from one
/// that has passed its ball joint.
bool right_way_round(const CornerPlan& plan, const CornerPlace& place, double rack) {
  const Mat3& turned = place.carrier.rotation;
  return std::all_of(plan.links.begin(), plan.links.end(), [&](const LinkConstants& link) {
    if (link.type == LinkType::R) return dot(turned * link.carrier_axis, link.carrier_axis) > 0;
    if (link.type == LinkType::RR)
      return dot(turned * link.carrier_axis, math::turn_about(place.arm * link.axis) * link.carrier_axis) > 0;
    if (link.type != LinkType::SP) return true;
    const Vec3 body = kernel::Placed<double>{plan, place, rack}.body(link, 0);
    return dot(place.carrier.centre + turned * link.offset[0] - body, turned * link.axis) > 0;
  });
}

bool alike(const CornerPlace& a, const CornerPlace& b) {
  double difference = norm(a.carrier.centre - b.carrier.centre);
  for (int i = 0; i < 3; ++i)
    difference = std::max(difference, norm(a.carrier.rotation.row[i] - b.carrier.rotation.row[i]));
  return difference < same;
}

/// The largest distance of points of the carrier from the wheel centre, in the reference position.
double reach(const CornerPlan& plan) {
  double out = plan.wheel.tyre_diameter;
  for (const LinkConstants& link : plan.links) {
    const double carrier = std::max(norm(link.offset[0]), norm(link.offset[1]));
    out = std::max(out, 2 * carrier + std::max(link.length[0], link.length[1]));
  }
  return out;
}

}  // namespace

std::vector<Assembly> assemblies(const CornerPlan& plan, Driver driver, const CornerInput& input,
                                 std::uint64_t seed, int starts) {
  LINKWRIGHT_REQUIRE(starts > 0, "{} starts", starts);
  LINKWRIGHT_REQUIRE(driver != Driver::spring || plan.spring, "the suspension has no spring");
  const double far = 2 * reach(plan);
  std::vector<Assembly> found;
  for (int i = 0; i < starts; ++i) {
    CornerPlace place{{plan.wheel.centre, {}}, 0};
    if (i > 0) {
      RandomStream random({seed, static_cast<std::uint32_t>(i)});
      const auto shift = [&] { return random.uniform(-far / 2, far / 2); };
      const double x = shift(), y = shift(), z = shift();
      place.carrier.centre += Vec3{x, y, z};
      const auto turn = [&] { return random.uniform(-pi, pi); };
      const double a = turn(), b = turn(), c = turn();
      place.carrier.rotation = math::turn_z(a) * math::turn_x(b) * math::turn_z(c);
      place.arm = turn();
    }
    double residual = 0;
    const bool good = plan.unknowns == 7 ? newton<7>(plan, driver, input, place, residual)
                                         : newton<6>(plan, driver, input, place, residual);
    if (!good || !right_way_round(plan, place, input.rack)) continue;
    const auto known =
        std::find_if(found.begin(), found.end(), [&](const Assembly& a) { return alike(a.place, place); });
    if (known != found.end())
      ++known->hits;
    else
      found.push_back({place, residual, 1});
  }
  const auto away = [&](const Assembly& a) {
    double out = norm(a.place.carrier.centre - plan.wheel.centre);
    for (int i = 0; i < 3; ++i) out += norm(a.place.carrier.rotation.row[i] - Mat3{}.row[i]);
    return out;
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Assembly& a, const Assembly& b) { return away(a) < away(b); });
  return found;
}

}  // namespace linkwright::suspension
