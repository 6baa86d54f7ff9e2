// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/parallel/robot/path_trouble.h"

/// Proof that nothing is singular all over a body of places, not at points of it alone.
namespace linkwright::parallel {

/// All are along the axes.
enum class InscribedShape { cylinder, ball, box };
constexpr std::array<EnumName<InscribedShape>, 3> names(InscribedShape) {
  return {{{InscribedShape::cylinder, "cylinder", "with its axis along z, only in space"},
           {InscribedShape::ball, "ball", "in the plane: a circle"},
           {InscribedShape::box, "box", "with edges along x, y, z; in the plane: a rectangle"}}};
}

struct Body {
  InscribedShape shape = InscribedShape::cylinder;
  Vec3 centre;  ///< m
  Vec3 half;    ///< half the extent along each axis (m); z = 0 in the plane
};

struct BodyProof {
  bool proven = false;
  std::optional<Vec3> violated{};  ///< a place where it is not so; neither: given up after so many looks
  std::int64_t looks = 0;          ///< poses
};

inline constexpr std::int64_t max_proof_looks = 400000;

/// Everywhere in the body the legs reach (but for 1 um at the edge of what they reach), no arm and rod are
/// aligned, the marks are those of task.home, the rods hold the platform and the constraint index is at least
/// the limit or the floor, both less 5e-4. By branch and bound: a box that change_within (regular_ball.h)
/// does not decide is cut across its longest side.
BodyProof prove(const TroubleTask& task, const Body& body, const Mat3& rotation,
                std::int64_t max_looks = max_proof_looks);

}  // namespace linkwright::parallel
