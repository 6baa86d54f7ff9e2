// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/field.h"

namespace linkwright::planar {

/// `[environment]` of mechanisms whose weight acts along -y.
struct Environment {
  double gravity = 9.81;  ///< m/s2
};
template <class Visitor>
void fields(Visitor&& visit, Environment& e) {
  visit(field::acceleration("gravity", "along -y of the global frame").not_negative(), e.gravity);
}

}  // namespace linkwright::planar
