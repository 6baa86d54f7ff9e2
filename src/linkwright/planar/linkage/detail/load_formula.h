// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linkwright/math/formula.h"
#include "linkwright/planar/linkage/motion.h"

/// Formulas as laws of loads, by quantities of the motion.
namespace linkwright::planar {

/// A quantity of the motion that the formula of a load names.
struct LoadQuantity {
  enum class Kind : std::uint8_t {
    unused,       ///< nobody asks for it
    time,         ///< s
    x,            ///< of the first point, global, m
    y,            ///< likewise
    x_speed,      ///< m/s
    y_speed,      ///< m/s
    length,       ///< distance of both points, m
    lengthening,  ///< speed at which they part, m/s
    turning,      ///< angular speed of the first body against the second one, rad/s
    coordinate,   ///< of the joint; that of a pin counts its turns
    rate          ///< of the joint
  };
  Kind kind = Kind::unused;
  BodyPoint first, second;
  int joint = -1;
};

/// The formulas of a load: one of a torque or a strut, two of a force, along x and y.
struct LoadFormula {
  std::vector<math::Formula> components;
  std::vector<LoadQuantity> quantities;  ///< in the order of the values of the formulas
  std::size_t first_kink = 0;  ///< of LinkageMotion::branches: behind those of the formulas read before
};

/// The largest number of quantities of a load.
constexpr std::size_t max_load_quantities = 64;

/// A quantity with the word that stands for it.
struct NamedQuantity {
  math::FormulaName name;
  LoadQuantity quantity;
};

/// Reads the formulas of a load.
///
/// @param linkage has the joints, points, springs and struts that formulas name; notes the pins whose turns
///   they count
/// @param texts one formula a component
/// @param result their dimension
/// @param known quantities of the load itself
/// @param problem receives what is wrong, with its column
/// @returns the formulas; null if there is a problem
std::shared_ptr<const LoadFormula> load_formula(Linkage& linkage, std::span<const std::string> texts,
                                                Dimension result, std::span<const NamedQuantity> known,
                                                std::string& problem);

/// The texts of the formulas of a load.
std::vector<std::string> texts_of(const LoadFormula& formula);

/// The values of the formulas at a motion with velocities, one a component.
///
/// @returns the first two components; the second is 0 of a load with one
std::array<double, 2> values_of(const LoadFormula& formula, const Linkage& linkage, const LinkagePlan& plan,
                                const LinkageMotion& motion, double time);

/// The number of places at which the formulas of a load may jump or bend, see math::Formula::kinks.
std::size_t kinks_of(const LoadFormula& formula);
/// The branches that the formulas of a load take there.
void find_branches(const LoadFormula& formula, const Linkage& linkage, const LinkagePlan& plan,
                   const LinkageMotion& motion, double time, std::span<double> branches);
/// The numbers whose signs change there.
void find_kinks(const LoadFormula& formula, const Linkage& linkage, const LinkagePlan& plan,
                const LinkageMotion& motion, double time, std::span<double> kinks);

/// Calls visit(load) for every load that has a formula.
template <class L, class Visit>
void for_formulas(L& linkage, const Visit& visit) {
  for (auto& f : linkage.forces)
    if (f.formula) visit(f);
  for (auto& t : linkage.torques)
    if (t.formula) visit(t);
  for (auto& s : linkage.struts)
    if (s.formula) visit(s);
}

}  // namespace linkwright::planar
