// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/simulation/elastic_body.h"
#include "linkwright/planar/studies/linkage_scene.h"

namespace linkwright::planar {

/// The line of an elastic body from its first node to its last, as the motion of a rigid body that lies
/// there: its frame is where that of the unbent body would be.
PartState<double> chord_state(const ElasticLinkage& elastic, const ElasticPieces& pieces,
                              const LinkageMotion& motion);

/// The data of a drawing for one instant of an elastic linkage.
struct ElasticRecord {
  /// Record of the bodies and joints of the rigid linkage; elastic bodies lie on their lines.
  LinkageRecord record;
  /// One an elastic body: of its nodes, then its points, how far they are away from where they would lie
  /// unbent, global, m.
  std::vector<std::vector<math::Vec2>> away;
};
/// `rigid` is what `elastic` was made of; forces, those of `elastic`, may be null.
ElasticRecord elastic_record(const Linkage& rigid, const ElasticLinkage& elastic, const LinkageMotion& motion,
                             const LinkageForces* forces, double input);

/// The scene of the rigid linkage (see linkage_scene) with bent bodies as lines through their nodes, each
/// beside the line that it has unbent. What lies away across that line is drawn `scale` times as far; without
/// a scale the largest of 1, 2, 5, 10, ... is taken with which it stays within a twentieth of the size of the
/// linkage. The title says so: "deflections drawn 20 x".
study::Scene elastic_scene(const Linkage& rigid, const LinkagePlan& plan,
                           const std::vector<ElasticPieces>& pieces,
                           const std::vector<ElasticRecord>& records, const std::vector<BodyPoint>& traces,
                           std::optional<double> scale);

}  // namespace linkwright::planar
