// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/motion.h"

// Columns of the tables that studies of linkages write.
namespace linkwright::planar {

struct LinkageQuantities {
  bool position = true, rates = true, reactions = true, drive = true, shaking = true,
       transmission_angle = true, power = true;
  bool dynamic() const { return reactions || drive || shaking || power; }
};

/// The words that `output.quantities` may list, and the quantities that a list selects: all when it is empty.
const std::vector<Word>& linkage_quantity_words();
LinkageQuantities chosen_quantities(const std::vector<std::string>& listed);

/// The data of one row.
struct LinkageInstant {
  double time = 0;
  std::vector<InputMotion> inputs;
  const LinkageMotion* motion = nullptr;
  const LinkageForces* forces = nullptr;  ///< may be null when no quantity needs it
};
struct LinkageColumn {
  std::string key, label;
  std::function<double(const LinkageInstant&)> value;
  bool angle = false;
  bool counted = false;  ///< an angle whose turns the joints count; others are unwrapped
  enum class Needs { nothing, pose, motion } needs = Needs::motion;  ///< at dead points there is no motion
};

/// Unwraps the rows of an angle whose turns are not counted.
void unwrap(const LinkageColumn& column, std::span<double> rows);

/// The value of a column, NaN where the status of the motion leaves it unknown.
double value_of(const LinkageColumn& column, const LinkageInstant& instant);

/// The name of a group as part of a column key: "coupler + rocker" becomes "coupler_rocker".
std::string group_key(std::string name);

/// The joint of an input, the key of its column ("O_angle_rad") and its label.
const LinkageJoint& input_joint(const Linkage& linkage, std::size_t input);
std::string input_key(const Linkage& linkage, const LinkagePlan& plan, std::size_t input);
std::string input_label(const Linkage& linkage, const LinkagePlan& plan, std::size_t input);
/// A value of an input as a place along it, in degrees or millimetres: "30°" of "O_angle".
Measured input_place(const Linkage& linkage, const LinkagePlan& plan, std::size_t input, double value,
                     int digits);

/// The reference point of shaking moments, in words: "the origin", or the point of the ground that is there.
std::string moment_centre_name(const Linkage& linkage);

/// The columns of the quantities, in their order; those of the inputs are not among them. Linkage and plan
/// must outlive them.
std::vector<LinkageColumn> linkage_columns(const Linkage& linkage, const LinkagePlan& plan,
                                           const LinkageQuantities& quantities,
                                           const std::vector<BodyPoint>& traces);

}  // namespace linkwright::planar
