// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/detail/constraints_kernel.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/structure.h"

namespace linkwright::suspension {
namespace {

void require_spring(const CornerPlan& plan, Driver driver) {
  LINKWRIGHT_REQUIRE(driver != Driver::spring || plan.spring,
                     "the driver is the spring, and the suspension has none");
}

}  // namespace

CornerPlan prepare_suspension(const Suspension& suspension) {
  const Diagnostics problems = check(suspension);
  LINKWRIGHT_REQUIRE(problems.empty(), "{} problems, the first: {}", problems.size(),
                     to_string(problems.front()));
  const int freedoms = mobility(structure_of(suspension), static_cast<int>(suspension.couplers.size()));
  LINKWRIGHT_REQUIRE(freedoms == 1, "{} degrees of freedom remain", freedoms);
  CornerPlan plan = kernel::prepare(suspension);
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i)
    plan.labels.push_back(link_label(suspension, i));
  for (std::size_t i = 0; i < suspension.couplers.size(); ++i) {
    const std::string& name = suspension.couplers[i].name;
    plan.labels.push_back(name.empty() ? "coupler " + std::to_string(i + 1) : name);
  }
  for (std::size_t i = 0; i < suspension.rockers.size(); ++i)
    plan.rocker_labels.push_back(rocker_label(suspension, static_cast<int>(i)));
  return plan;
}

void evaluate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver, double value,
              CornerEquations& out) {
  require_spring(plan, driver);
  kernel::evaluate(plan, place, rack, driver, value, out);
}

double driver_value(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver) {
  require_spring(plan, driver);
  return kernel::driver_value(plan, place, rack, driver);
}

double driver_rate(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver,
                   const Twist& twist, double rack_rate) {
  require_spring(plan, driver);
  return kernel::driver_rate(plan, place, rack, driver, twist, rack_rate);
}

Vec3 place_of(const CornerPlan& plan, const PartPoint& point, const CornerPlace& place, double rack) {
  return kernel::part_point(kernel::Placed<double>{plan, place, rack}, point);
}

std::vector<RockerState> rocker_states(const CornerPlan& plan, const CornerPlace& place, double rack,
                                       const Twist& motion, double rack_rate) {
  const kernel::Placed<double> placed{plan, place, rack};
  std::vector<RockerState> out;
  for (const RockerConstants& rocker : plan.rockers) {
    std::array<double, max_unknowns> by{};
    double by_rack = 0;
    kernel::Row<double> row{by, by_rack};
    const kernel::RockerPose<double> pose = kernel::rocker_pose(placed, rocker);
    if (!(pose.clearance > 0)) {
      out.push_back({.reaches = false});
      continue;
    }
    kernel::add_rocker_angle(placed, rocker, pose, 1.0, row);
    out.push_back({true, std::atan2(pose.sine, pose.cosine), kernel::rate_of(row, motion, rack_rate),
                   std::sqrt(pose.clearance / pose.reach)});
  }
  return out;
}

Misfit worst_misfit(const CornerPlan& plan, const CornerPlace& place, double rack) {
  const kernel::Placed<double> placed{plan, place, rack};
  Misfit worst;
  const auto keep = [&](int link, double gap) {
    if (std::abs(gap) > std::abs(worst.gap) || worst.link < 0) worst = {link, gap};
  };
  const int links = static_cast<int>(plan.links.size());
  for (int i = 0; i < links; ++i) {
    const LinkConstants& link = plan.links[i];
    const auto point = [&](int k) { return placed.point(placed.offset(link.offset[k])); };
    const Vec3 d = point(0) - placed.body(link, 0);
    switch (link.type) {
      case LinkType::US:
      case LinkType::SS:
        keep(i, norm(d) - link.length[0]);
        break;
      case LinkType::RS:
        keep(i, norm(d) - link.length[0]);
        keep(i, norm(point(0) - placed.body(link, 1)) - link.length[1]);
        break;
      case LinkType::SR:
        keep(i, norm(d) - link.length[0]);
        keep(i, norm(point(1) - placed.body(link, 0)) - link.length[1]);
        break;
      case LinkType::SP:
        keep(i, norm(cross(d, placed.offset(link.axis))));
        break;
      case LinkType::S:
      case LinkType::R:
        keep(i, norm(d));
        break;
      case LinkType::RR:
        keep(i, norm(d - math::turn_about(place.arm * link.axis) *
                             (plan.wheel.centre + link.offset[0] - link.body[0])));
        break;
    }
  }
  for (std::size_t i = 0; i < plan.couplers.size(); ++i)
    keep(links + static_cast<int>(i),
         norm(kernel::ends(placed, plan.couplers[i]).between) - plan.couplers[i].length);
  return worst;
}

}  // namespace linkwright::suspension
