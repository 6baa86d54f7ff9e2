// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/flexible/beam_form.h"
#include "linkwright/flexible/links.h"
#include "linkwright/flexible/studies/chain.h"
#include "linkwright/flexible/studies/drive.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// The simulation of an arm of elastic links in series: what its file holds, how it is read, run and reported.
namespace linkwright::flexible {

/// `[mechanism.link.hinge]`.
struct HingeForm {
  Hinge joint;
};
template <class Visitor>
void fields(Visitor&& visit, HingeForm& f) {
  Hinge& h = f.joint;
  visit(field::stiffness_angular("stiffness", "of a spring, without torque where both links are in line")
            .not_negative(),
        h.stiffness);
  visit(field::damping_angular("damping", "of a damper").not_negative(), h.damping);
  visit(field::mass("mass", "of joint and motor").not_negative(), h.mass);
  visit(field::inertia("inner_inertia", "of what turns with the inner link, such as a stator").not_negative(),
        h.inner_inertia);
  visit(field::inertia("outer_inertia", "of what turns with the outer link, such as a rotor").not_negative(),
        h.outer_inertia);
}

/// `[[mechanism.link]]`.
struct ArmLinkForm {
  std::string name;
  Beam beam;
  int divisions = 4;
  std::optional<double> fibre_distance;
  std::optional<HingeForm> hinge;
};
template <class Visitor>
void fields(Visitor&& visit, ArmLinkForm& l) {
  visit(field::entry("name", "for tables and drives; default: link1, link2, ..."), l.name);
  beam_fields::link(visit, l.beam);
  beam_fields::tip(visit, l.beam);
  visit(beam_fields::fibre_distance, l.fibre_distance);
  visit(field::entry("divisions", "two cells each").between(1, 200), l.divisions);
  visit(field::entry("hinge", "that carries the link; without it, the link is welded on in line"), l.hinge);
}

/// `[mechanism]`.
struct ArmForm {
  Beam hub;  ///< hub, gravity and damping only
  std::vector<ArmLinkForm> links;
};
template <class Visitor>
void fields(Visitor&& visit, ArmForm& a) {
  beam_fields::hub(visit, a.hub);
  visit(field::entry("link", "the links from the hub outwards").required(), a.links);
}

/// `[[drive]]`.
struct ArmDriveForm {
  std::string link;
  DriveLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, ArmDriveForm& d) {
  visit(
      field::entry("link", "that is turned: the first one with the hub, another one in its hinge").required(),
      d.link);
  visit(field::entry("law", "what turns it; angles of a hinge count from the line of the inner link")
            .required(),
        d.law);
}

/// A simulation as read.
struct ArmStudy {
  ArmForm mechanism;
  std::vector<DriveLaw> drives;  ///< law of the hub, then one a hinge
  std::optional<ShapingForm> shaping;
  SimulationForm simulation;
  int samples = 361;
};

/// Reads the tables of the study and writes them into `canonical`; problems go to the reader.
std::optional<ArmStudy> read_arm_study(study::ObjectReader& document, const study::Common& common,
                                       Value& canonical);
/// The part of the study that arms share with a single link.
ChainStudy arm_chain_study(const ArmStudy& study);

/// "simulation" of "flexible.arm".
study::Kind arm_kind();
/// Integrates and reports; what was reached is kept, whatever ends it.
study::Result run_arm_study(const ArmStudy& study, RunContext& context);

}  // namespace linkwright::flexible
