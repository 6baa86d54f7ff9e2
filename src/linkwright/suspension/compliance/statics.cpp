// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/statics.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/detail/constraints_kernel.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/indirect/link_poses.h"

namespace linkwright::suspension {
namespace {

struct Wrench {
  Vec3 force, moment;  ///< about the wheel centre
};

/// Adds a force at a point.
void add(Wrench& to, const Vec3& force, const Vec3& arm) {
  to.force += force;
  to.moment += cross(arm, force);
}

/// The wrench on the carrier that does the same work as a force at a point.
Wrench kernel_wrench(const kernel::Placed<double>& placed, const PartPoint& point, const Vec3& force) {
  std::array<double, max_unknowns> by{};
  double by_rack = 0;
  kernel::Row<double> row{by, by_rack};
  kernel::add_part_point(placed, point, force, row);
  return {{by[0], by[1], by[2]}, {by[3], by[4], by[5]}};
}

Vec3 middle(const std::vector<Vec3>& points) {
  return points.size() == 2 ? 0.5 * (points[0] + points[1]) : points.at(0);
}

// The forces in the joints of all links, from what the links give to the carrier (`on_carrier`) and what
// springs and couplers give to the links (`on_link`).
std::vector<JointForce> joint_forces(const Suspension& suspension, const CarrierPose& carrier, double rack,
                                     const std::vector<Wrench>& on_carrier,
                                     const std::vector<Wrench>& on_link) {
  std::vector<JointForce> out;
  for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i) {
    std::vector<Vec3> at_body, at_carrier;
    for (int k = 0; k < body_points(suspension.links[i].type); ++k)
      at_body.push_back(body_point(suspension, i, k, rack));
    for (int k = 0; k < carrier_points(suspension.links[i].type); ++k)
      at_carrier.push_back(carrier_point(suspension, i, k, carrier));
    // The body gives to the link what the link gives to the carrier, less what springs and couplers give to
    // the link.
    const Vec3 body = middle(at_body);
    const Vec3 force = on_carrier[i].force - on_link[i].force;
    const Vec3 moment = on_carrier[i].moment - on_link[i].moment - cross(body - carrier.centre, force);
    if (at_carrier.empty()) {
      out.push_back({i, true, body, force, moment});
      continue;
    }
    out.push_back({i, false, body, force, moment});
    const Vec3 end = middle(at_carrier);
    out.push_back({i, true, end, on_carrier[i].force,
                   on_carrier[i].moment - cross(end - carrier.centre, on_carrier[i].force)});
  }
  return out;
}

}  // namespace

CornerForces solve_forces(const Suspension& suspension, const CornerPlan& plan,
                          const CornerPosition& position, const WheelLoad& load, Support support) {
  const bool by_spring = support == Support::spring || support == Support::spring_held;
  const Driver held = by_spring                          ? Driver::spring
                      : support == Support::contact_held ? Driver::contact_z
                                                         : Driver::wheel_centre_z;
  const int n = plan.unknowns;
  const double rack = position.input.rack;
  CornerEquations equations;
  evaluate(plan, position.place, rack, held, 0, equations);
  Eigen::MatrixXd transposed(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) transposed(j, i) = equations.jacobian[i][j];
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(transposed);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  right.head<6>() << -load.force.x, -load.force.y, -load.force.z, -load.moment.x, -load.moment.y,
      -load.moment.z;
  const Eigen::VectorXd factor = lu.solve(right);
  CornerForces out;
  // The same bound as for rates: a force a million times the load is none.
  if (!(lu.rcond() > 1e-12) || !factor.allFinite()) {
    out.status = Status::singular;
    return out;
  }
  const auto wrench = [&](int row) {
    const auto& by = equations.jacobian[row];
    const double f = factor(row);
    return Wrench{{f * by[0], f * by[1], f * by[2]}, {f * by[3], f * by[4], f * by[5]}};
  };

  // On the carrier by each link: the forces of its equations, and what springs and couplers on it pass on.
  const CarrierPose& carrier = position.place.carrier;
  const int links = static_cast<int>(suspension.links.size());
  std::vector<Wrench> on_carrier(links),
      on_link(links);  // on_link: by springs and couplers, in the present position
  int row = 0;
  for (int i = 0; i < links; ++i) {
    const int rows =
        constraints(suspension.links[i].type) + (suspension.links[i].type == LinkType::RR ? 1 : 0);
    for (int k = 0; k < rows; ++k, ++row) {
      const Wrench of = wrench(row);
      on_carrier[i].force += of.force;
      on_carrier[i].moment += of.moment;
    }
  }
  const kernel::Placed<double> placed_plan{plan, position.place, rack};
  const std::vector<LinkPose> poses = link_poses(suspension, position.place, rack);
  for (const Coupler& coupler : suspension.couplers) {
    const Vec3 end = carrier_point(suspension, coupler.first, 0, carrier);
    const Vec3 at_rod = coupler_begin(suspension, coupler, position.place, rack);
    const Vec3 at_second = placed(poses[coupler.second], coupler.point);
    const Vec3 pull = -factor(row) * unit(at_second - at_rod);  // on the rod, of a coupler in tension
    Wrench passed;
    const CouplerConstants& constants = plan.couplers[out.couplers.size()];
    add(passed,
        kernel::rod_weight(kernel::rod_point(placed_plan, plan.links[coupler.first], constants.begin), pull),
        end - carrier.centre);
    add(on_link[coupler.first], pull, at_rod - carrier.centre);
    add(on_link[coupler.second], -pull, at_second - carrier.centre);
    // The row holds both ends; the share that the rod passes on is known, the rest goes by the other link.
    const Wrench all = wrench(row);
    on_carrier[coupler.first].force += passed.force;
    on_carrier[coupler.first].moment += passed.moment;
    on_carrier[coupler.second].force += all.force - passed.force;
    on_carrier[coupler.second].moment += all.moment - passed.moment;
    out.couplers.push_back(-factor(row));
    ++row;
  }
  out.support = factor(row);
  if (by_spring) {
    const SpringConstants& spring = *plan.spring;
    const Vec3 push = factor(row) * unit(place_of(plan, spring.second, position.place, rack) -
                                         place_of(plan, spring.first, position.place, rack));
    // The row holds both ends; the link of the moving end takes what the other end does not.
    Wrench all = wrench(row);
    const auto pass_on = [&](const kernel::PassedForce<double>& end, const Wrench& share) {
      if (end.part.kind != PartKind::link) return;
      on_carrier[end.part.index].force += share.force;
      on_carrier[end.part.index].moment += share.moment;
      add(on_link[end.part.index], end.force, end.at - carrier.centre);
    };
    if (spring.first.part.kind != PartKind::body) {
      const Wrench first = kernel_wrench(placed_plan, spring.first, -push);
      pass_on(kernel::passed_force(placed_plan, spring.first, -push), first);
      all.force += -first.force;
      all.moment += -first.moment;
    }
    pass_on(kernel::passed_force(placed_plan, spring.second, push), all);
  }

  out.joints = joint_forces(suspension, carrier, rack, on_carrier, on_link);
  return out;
}

double rod_force(const Suspension& suspension, const CornerPosition& position, const JointForce& joint) {
  const LinkType type = suspension.links.at(joint.link).type;
  LINKWRIGHT_REQUIRE(type == LinkType::US || type == LinkType::SS, "{} is not a rod",
                     link_label(suspension, joint.link));
  return dot(joint.force, unit(carrier_point(suspension, joint.link, 0, position.place.carrier) -
                               body_point(suspension, joint.link, 0, position.input.rack)));
}

}  // namespace linkwright::suspension
