// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/wheel/corner_columns.h"
#include "linkwright/suspension/wheel/tolerances.h"

// The tables `[sensitivity]` and `[tolerances]`: hard points in an analysis of a wheel suspension.
namespace linkwright::suspension {

/// `[sensitivity]`.
struct SensitivityForm {
  std::vector<std::string> quantities;
};
template <class Visitor>
void fields(Visitor&& visit, SensitivityForm& s) {
  visit(field::entry("quantities",
                     "columns of the sweep, without unit; default: toe, camber, half_track_change, "
                     "roll_centre_height"),
        s.quantities);
}

/// `[[tolerances.point]]`.
struct PointTolerance {
  std::string coordinate;
  double tolerance = 0;
};
template <class Visitor>
void fields(Visitor&& visit, PointTolerance& p) {
  visit(field::entry("coordinate",
                     "\"tie rod.body\" for all three, \"tie rod.body_z\" for one; of parts as built also "
                     "\"tie rod.length\"")
            .required(),
        p.coordinate);
  visit(field::length("tolerance", "plus and minus").between(0, 1).required(), p.tolerance);
}

/// What stays as it is when a point moves within its tolerance.
enum class Parts {
  as_drawn,  ///< the wheel's place at the reference: links have the lengths between their points
  as_built   ///< the lengths of the links: the wheel moves, and lengths have tolerances of their own
};
constexpr std::array<EnumName<Parts>, 2> names(Parts) {
  return {{{Parts::as_drawn, "as_drawn", "links fit their points; the wheel stays in its place"},
           {Parts::as_built, "as_built", "links and rods keep their lengths; the wheel moves"}}};
}

/// `[tolerances]`.
struct TolerancesForm {
  Parts parts = Parts::as_drawn;
  double tolerance = 0;
  std::vector<PointTolerance> points;
  std::vector<std::string> quantities;
  MonteCarlo monte_carlo{.samples = 0, .scatter = Scatter::normal, .seed = 1};
};
template <class Visitor>
void fields(Visitor&& visit, TolerancesForm& t) {
  visit(field::entry("parts", "what stays as it is when a point moves"), t.parts);
  visit(field::length("tolerance",
                      "plus and minus, of every coordinate of every point that has none of its own")
            .between(0, 1),
        t.tolerance);
  visit(field::entry("point", "tolerances of their own"), t.points);
  visit(field::entry("quantities", "columns of the sweep, without unit; default as for sensitivity"),
        t.quantities);
  visit(field::entry("samples", "designs drawn at random and solved; 0 = none").between(0, 1e6),
        t.monte_carlo.samples);
  visit(field::entry("scatter", "how numbers lie in their tolerances"), t.monte_carlo.scatter);
  visit(field::entry("seed", "of the designs drawn").not_negative(), t.monte_carlo.seed);
}

/// Check what was read against the suspension; problems go to the reader. Defaults are filled in.
void complete_sensitivity(study::ObjectReader& document, SensitivityForm& form, const Suspension& suspension);
void complete_tolerances(study::ObjectReader& document, TolerancesForm& form, const Suspension& suspension);

/// The table `sensitivity` at the position next to the reference, and a table and a diagram over travel for
/// each quantity; the rack next to the middle.
struct SensitivityInputs {
  Driver travel = Driver::wheel_centre_z;
  std::span<const double> travels;
  double rack = 0;
  Driver lock = Driver::wheel_centre_z;
};
void add_sensitivity(study::Result& result, const Suspension& suspension, const SensitivityForm& form,
                     const SensitivityInputs& inputs);
/// A table and a diagram with bands for each quantity, and the table `tolerance_shares`.
void add_tolerances(study::Result& result, const Suspension& suspension, const TolerancesForm& form,
                    const SensitivityInputs& inputs, RunContext& context);

}  // namespace linkwright::suspension
