#pragma once

#include "linkwright/core/field.h"

namespace linkwright::planar {

/// `[environment]` of mechanisms whose weight acts along -y.
struct Environment {
  double gravity = 9.81;  ///< m/s2
};
template <class Visitor>
void fields(Visitor&& visit, Environment& e) {
  visit(Field{.key = "gravity",
              .summary = "along -y of the global frame",
              .dimension = Dimension::acceleration,
              .minimum = 0,
              .maximum = 1e6},
        e.gravity);
}

}  // namespace linkwright::planar
