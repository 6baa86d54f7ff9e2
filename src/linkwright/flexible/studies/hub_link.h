// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/flexible/beam_form.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/studies/chain.h"
#include "linkwright/flexible/studies/drive.h"
#include "linkwright/study/kind.h"

// The simulation of a hub with an elastic link: what its file holds, how it is read, run and reported.
namespace linkwright::flexible {

/// `[mechanism]`.
struct HubLinkForm {
  Beam beam;
  std::optional<double> fibre_distance;
};
template <class Visitor>
void fields(Visitor&& visit, HubLinkForm& form) {
  beam_fields::link(visit, form.beam);
  beam_fields::tip(visit, form.beam);
  beam_fields::hub(visit, form.beam);
  visit(beam_fields::fibre_distance, form.fibre_distance);
}

/// `[drive]`: what turns the hub.
struct HubDriveForm {
  DriveLaw law;
  std::optional<ShapingForm> shaping;
};
template <class Visitor>
void fields(Visitor&& visit, HubDriveForm& d) {
  visit(field::entry("law", "what turns the hub").required(), d.law);
  visit(field::entry("shaping", "input shaping of the drive that cancels a vibration"), d.shaping);
}

/// `[simulation]`.
struct HubSimulationForm : SimulationForm {
  int divisions = 4;
  Kinematics kinematics = Kinematics::chord_consistent;
  bool compare_elastica = false;
};
template <class Visitor>
void fields(Visitor&& visit, HubSimulationForm& s) {
  fields(visit, static_cast<SimulationForm&>(s));
  visit(field::entry("divisions", "of the link, two cells each").between(1, 1000), s.divisions);
  visit(field::entry("kinematics", "how the joints of the chain move"), s.kinematics);
  visit(field::entry(
            "compare_elastica",
            "repeat with a beam of polynomials, integrated by another method, and report the difference"),
        s.compare_elastica);
}

/// A simulation as read.
struct HubLinkStudy {
  HubLinkForm mechanism;
  HubDriveForm drive;
  HubSimulationForm simulation;
  int samples = 361;
};

/// "simulation" of "flexible.hub_link".
study::Kind hub_link_kind();
/// Integrates and reports; what was reached is kept, whatever ends it.
study::Result run_hub_link(const HubLinkStudy& study, RunContext& context);

}  // namespace linkwright::flexible
