// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/parallel/robot/dynamics.h"
#include "linkwright/parallel/studies/robot.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"

// `[masses]` of studies of parallel robots.
namespace linkwright::parallel {

struct MassesForm {
  PlatformMasses platform;
  LegMasses leg;
  std::optional<Coordinates> gravity;
  std::optional<PiMasses> pi;
};
template <class Visitor>
void fields(Visitor&& visit, MassesForm& m) {
  fields(visit, m.platform);
  fields(visit, m.leg);
  visit(field::acceleration(
            "gravity",
            "acceleration of gravity, base axes; default: 9.80665 m/s2 downwards, along y of planar robots"),
        m.gravity);
  visit(field::entry("pi_joint", "masses of each Pi-joint, instead of arm_inertia, arm_mass, arm_centre"),
        m.pi);
}

/// Reads `[masses]`, the same for every leg; nothing when it is absent or has problems, which go to the
/// reader.
std::optional<RobotMasses> read_masses(study::ObjectReader& document, const RobotDescription& description,
                                       Value& canonical);
void describe_masses(study::SchemaWriter& document);

}  // namespace linkwright::parallel
