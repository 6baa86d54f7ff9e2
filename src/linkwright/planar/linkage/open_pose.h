// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// After no_assembly of a group in closed form: lays its bodies as near to closing as they come, each held by
/// what is placed before it, for drawings; rates stay unknown. Gives the two places that a joint would hold
/// together, `motion.gap` apart; nothing of groups without closed form. Throws ContractError as
/// solve_position does.
std::optional<std::array<math::Vec2, 2>> lay_open(const LinkagePlan& plan,
                                                  std::span<const InputMotion> inputs, LinkageMotion& motion);

}  // namespace linkwright::planar
