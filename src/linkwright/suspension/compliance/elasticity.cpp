// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elasticity.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

bool usable(double stiffness) { return stiffness >= 0; }  // NaN is not

/// Empty, or why a characteristic is none of a bushing.
std::string problem_of_bushing(const ForceCurve& curve) {
  if (std::string why = problem(curve); !why.empty()) return why;
  for (std::size_t i = curve.force.size() - 1; i > 0; --i)  // the positive side first, as people write it
    if (!(curve.force[i] > curve.force[i - 1]))
      return fmt::format("the force falls from {} to {} N", curve.force[i - 1], curve.force[i]);
  const double most = std::max(std::abs(curve.force.front()), std::abs(curve.force.back()));
  if (curve.compression.front() > 0 || curve.compression.back() < 0) return "it leaves out displacement 0";
  const double at_rest = force_of(curve, 0).force;
  return std::abs(at_rest) <= 1e-9 * most ? ""
                                          : fmt::format("its force without displacement is {} N", at_rest);
}

void check_joints(const std::string& key, const char* where, const std::vector<JointStiffness>& joints,
                  int points, Diagnostics& found) {
  const auto add = [&](std::string message, std::string hint = {}) {
    found.push_back({.key = key, .message = std::move(message), .hint = std::move(hint)});
  };
  const int count = static_cast<int>(joints.size());
  if (count > 1 && count != points)
    return add(
        fmt::format("{} joints at the {}, where it has {} point{}", count, where, points,
                    points == 1 ? "" : "s"),
        points == 2 ? "give one joint for the hinge, or one for each of its points" : "give one joint");
  if (count > 0 && points == 0)
    return add(fmt::format("a joint at the {}, where it has no point", where),
               "its joint is the one at the body");
  for (const JointStiffness& joint : joints) {
    for (const auto& curve : joint.curves) {
      if (!curve) continue;
      const std::string why =
          joint.matrix ? "it stands beside a stiffness matrix" : problem_of_bushing(*curve);
      if (!why.empty())
        return add(fmt::format("a characteristic at the {}: {}", where, why),
                   "its force ascends with the displacement and is 0 without one");
    }
    if (joint.matrix) {
      const Matrix6& k = *joint.matrix;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j) {
          const double scale = std::sqrt(std::abs(k[i][i] * k[j][j]));
          if (!std::isfinite(k[i][j]) || !(k[i][i] >= 0) || !(std::abs(k[i][j]) <= scale) ||
              !(std::abs(k[i][j] - k[j][i]) <= 1e-9 * scale))
            return add(fmt::format("row {}, column {} of a stiffness matrix at the {}: {} and {}", i + 1,
                                   j + 1, where, k[i][j], k[j][i]),
                       "a stiffness matrix is symmetric and positive semidefinite");
        }
      continue;
    }
    for (const auto* three : {&joint.translation, &joint.rotation})
      for (double stiffness : *three)
        if (!usable(stiffness))
          return add(fmt::format("stiffness {} at the {}", stiffness, where), "0 is free, infinity is rigid");
  }
}

}  // namespace

JointStiffness bushing(double axial, double radial, double torsional, double conical, const Vec3& axis) {
  return {.translation = {axial, radial, radial}, .rotation = {torsional, conical, conical}, .axis = axis};
}

JointStiffness ball_joint(double stiffness) { return {.translation = {stiffness, stiffness, stiffness}}; }

JointStiffness ideal_joint(char letter) {
  LINKWRIGHT_REQUIRE(letter == 'R' || letter == 'S' || letter == 'P', "joint '{}'; there are R, S and P",
                     letter);
  if (letter == 'R') return {.rotation = {0, rigid, rigid}};
  if (letter == 'P') return {.translation = {0, rigid, rigid}, .rotation = {rigid, rigid, rigid}};
  return {};
}

CornerElasticity elastic_rods(const Suspension& suspension, const std::vector<double>& rods, double spring) {
  LINKWRIGHT_REQUIRE(rods.size() == suspension.links.size(), "{} stiffnesses for {} rods", rods.size(),
                     suspension.links.size());
  CornerElasticity out{.spring = spring};
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const LinkType type = suspension.links[i].type;
    LINKWRIGHT_REQUIRE(type == LinkType::US || type == LinkType::SS, "{} is not a rod",
                       link_label(suspension, static_cast<int>(i)));
    out.links.push_back({.body = {{.translation = {rods[i], rigid, rigid}}}});
  }
  return out;
}

Diagnostics check(const Suspension& suspension, const CornerElasticity& elasticity) {
  Diagnostics found;
  const auto count = [&](const char* key, std::size_t has, std::size_t needs) {
    if (has == 0 || has == needs) return true;
    found.push_back({.key = key, .message = fmt::format("{} of them for {}", has, needs)});
    return false;
  };
  if (count("links", elasticity.links.size(), suspension.links.size()))
    for (int i = 0; i < static_cast<int>(elasticity.links.size()); ++i) {
      const LinkType type = suspension.links[i].type;
      const std::string key = "link." + link_label(suspension, i);
      check_joints(key, "body", elasticity.links[i].body, body_points(type), found);
      check_joints(key, "carrier", elasticity.links[i].carrier, carrier_points(type), found);
    }
  if (count("couplers", elasticity.couplers.size(), suspension.couplers.size()))
    for (std::size_t i = 0; i < elasticity.couplers.size(); ++i)
      if (!usable(elasticity.couplers[i]))
        found.push_back(
            {.key = "coupler." + (suspension.couplers[i].name.empty() ? std::to_string(i + 1)
                                                                      : suspension.couplers[i].name),
             .message = fmt::format("stiffness {} N/m", elasticity.couplers[i])});
  if (!usable(elasticity.spring) || !std::isfinite(elasticity.spring))
    found.push_back({.key = "spring",
                     .message = fmt::format("stiffness {} N/m", elasticity.spring),
                     .hint = "a finite number, not negative; hold it by the choice of the support"});
  return found;
}

}  // namespace linkwright::suspension
