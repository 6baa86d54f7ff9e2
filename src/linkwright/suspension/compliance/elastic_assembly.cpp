// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elastic_assembly.h"

#include <cmath>

#include "linkwright/suspension/indirect/link_poses.h"

namespace linkwright::suspension {
namespace {

Mat3 axes_of(const JointStiffness& stiffness, const Vec3& standard, const Mat3& rotation) {
  const Vec3 first = stiffness.axis == Vec3{} ? standard : rotation * unit(stiffness.axis);
  const Vec3 wanted = rotation * stiffness.across, beside = wanted - dot(wanted, first) * first;
  const Vec3 second =
      norm(beside) > 1e-9 * norm(wanted) ? unit(beside) : math::across(first)[0];  // none given: 0 > 0
  return {{first, second, cross(first, second)}};
}

/// True if a joint resists rotation about a direction by more than rounding.
bool resists_turning(const ElasticJoint& joint, const Vec3& about) {
  double across = 0, all = 0;
  for (int i = 0; i < 3; ++i) {
    const double share = dot(about, joint.axes.row[i]);
    if (joint.stiffness.matrix) {
      all += (*joint.stiffness.matrix)[3 + i][3 + i];
      for (int j = 0; j < 3; ++j)
        across += share * dot(about, joint.axes.row[j]) * (*joint.stiffness.matrix)[3 + i][3 + j];
    } else if (joint.stiffness.rotation[i] > 0 && std::abs(share) > 1e-9) {
      return true;
    }
  }
  return across > 1e-12 * all;
}

class Builder {
 public:
  Builder(const Suspension& suspension, const CornerPlace& place, double rack,
          const CornerElasticity& elasticity)
      : of_{.suspension = &suspension}, place_(place), rack_(rack) {
    of_.origin.push_back(place.carrier.centre);
    of_.labels.push_back("the carrier");
    poses_ = link_poses(suspension, place, rack);
    for (int i = 0; i < static_cast<int>(suspension.links.size()); ++i)
      add_link(i, elasticity.links.empty() ? LinkElasticity{} : elasticity.links[i]);
    for (std::size_t i = 0; i < suspension.couplers.size(); ++i) {
      const Coupler& coupler = suspension.couplers[i];
      of_.couplers.push_back({body_[coupler.first], body_[coupler.second],
                              coupler_begin(suspension, coupler, place, rack),
                              placed(poses_[coupler.second], coupler.point),
                              elasticity.couplers.empty() ? rigid : elasticity.couplers[i]});
    }
    if (suspension.spring && acts_directly(*suspension.spring))
      of_.spring = {ground, suspension.spring->link < 0 ? 0 : body_[suspension.spring->link],
                    suspension.spring->body, spring_end(suspension, place, rack), elasticity.spring};
    if (const auto& end = elasticity.droplink)
      of_.droplink = {end->link < 0 ? 0 : body_[static_cast<std::size_t>(end->link)], end->at, end->along};
  }

  ElasticAssembly take() { return std::move(of_); }

 private:
  void add_link(int index, const LinkElasticity& elasticity) {
    const CornerLink& link = of_.suspension->links[index];
    const bool direct = carrier_points(link.type) == 0;
    const std::size_t first_joint = of_.joints.size();
    std::vector<Vec3> at_body, at_carrier;
    for (int k = 0; k < body_points(link.type); ++k)
      at_body.push_back(body_point(*of_.suspension, index, k, rack_));
    for (int k = 0; k < carrier_points(link.type); ++k)
      at_carrier.push_back(carrier_point(*of_.suspension, index, k, place_.carrier));
    int body = 0;
    if (!direct) {
      body = static_cast<int>(of_.origin.size());
      of_.origin.push_back(at_body[0]);
      of_.labels.push_back(link_label(*of_.suspension, index));
    }
    body_.push_back(body);
    const Vec3 line = direct ? Vec3{0, 0, 1} : unit(at_carrier[0] - at_body[0]);
    const auto name = name_of(link.type);
    const auto add = [&](const std::vector<JointStiffness>& given, const std::vector<Vec3>& points,
                         bool carrier, char letter) {
      const Vec3 standard = points.size() == 2 ? unit(points[1] - points[0]) : line;
      const Mat3 rotation = carrier ? place_.carrier.rotation : Mat3{};
      const auto put = [&](const Vec3& point, const JointStiffness& stiffness) {
        ElasticJoint joint{.first = carrier ? body : ground,
                           .second = carrier ? 0 : body,
                           .at_carrier = carrier || direct,
                           .link = index,
                           .point = point,
                           .by_rack = carrier ? Vec3{} : by_rack(*of_.suspension, index, point, rack_),
                           .on_subframe = !carrier && elasticity.on_subframe,
                           .axes = axes_of(stiffness, standard, rotation),
                           .stiffness = stiffness};
        for (int i = 0; i < 6; ++i)
          if (const auto& curve = stiffness.curves[i])
            joint.stiffness.component(i) = force_of(*curve, 0).stiffness;
        of_.has_subframe = of_.has_subframe || joint.on_subframe;
        of_.joints.push_back(joint);
      };
      if (given.size() == 2) {
        for (int k : {0, 1}) put(points[k], given[k]);
      } else {
        const Vec3 point = points.size() == 2 ? 0.5 * (points[0] + points[1]) : points[0];
        put(point, given.empty() ? ideal_joint(letter == 'U' ? 'S' : letter) : given[0]);
      }
    };
    add(elasticity.body, at_body, false, name.front());
    if (direct) return;
    add(elasticity.carrier, at_carrier, true, name.back());
    if (link.type != LinkType::US && link.type != LinkType::SS && link.type != LinkType::SP) return;
    bool held = false;
    for (std::size_t i = first_joint; i < of_.joints.size(); ++i)
      held = held || resists_turning(of_.joints[i], line);
    if (held) return;
    HeldTurn turn{.body = body, .about = line};
    if (link.type == LinkType::US) {
      const auto [standing, turning] = cross_axes(*of_.suspension, index, place_.carrier, rack_);
      turn = {.body = body,
              .about = cross(turning, standing),
              .link = index,
              .standing = standing,
              .turning = turning};
    }
    of_.held_turns.push_back(turn);
  }

  ElasticAssembly of_;
  const CornerPlace& place_;
  double rack_;
  std::vector<LinkPose> poses_;
  std::vector<int> body_;  ///< body of each link; R and S are joints of the carrier
};

}  // namespace

ElasticAssembly assemble(const Suspension& suspension, const CornerPlace& place, double rack,
                         const CornerElasticity& elasticity) {
  return Builder(suspension, place, rack, elasticity).take();
}

}  // namespace linkwright::suspension
