// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/automatic_contact.h"
#include "linkwright/clearance/joint_orbit.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/kind.h"

// The simulation of a linkage whose pins have clearance: what its file holds, how it is read, run and
// reported.
namespace linkwright::clearance {

/// A pin in continuous contact as read.
struct ContinuousPin {
  JointClearance clearance;
  /// Without: where the force of the ideal joint presses the pin, turning as that force does.
  bool angle_given = false, rate_given = false;
};

/// The model of contact between pins and bushes of a study; all of them alike.
enum class PinModel { contact, continuous, automatic };

/// The duration of a study.
struct TransientRun {
  double to = 1;  ///< s
};
constexpr Word choice_word(const TransientRun&) { return {"transient", "from the start to an end"}; }
struct PeriodicRun {
  int max_turns = 200;      ///< periods of the drives after which it is given up
  double tolerance = 1e-5;  ///< for states of a section, see ClearanceRegime::change
};
constexpr Word choice_word(const PeriodicRun&) {
  return {"periodic", "the steady state: a motion that repeats with the drives"};
}

/// A study as read.
struct ClearanceStudy {
  planar::Linkage linkage;
  planar::LinkagePlan plan;
  std::vector<planar::InputDrive> drives;  ///< one an input
  double from = 0;                         ///< s
  std::variant<TransientRun, PeriodicRun> regime;
  double period = 0;   ///< s, of the drives, for what needs it; 0 = there is none
  int samples = 1001;  ///< from start to end, or of a period
  double relative_tolerance = 1e-9;
  long max_steps = 10'000'000;
  PinModel model = PinModel::contact;
  std::vector<ContactJoint> contacts;     ///< joints of contact and automatic
  std::vector<ContinuousPin> continuous;  ///< pins of continuous and automatic
  std::vector<planar::BodyPoint> traces;
  planar::LinkageQuantities quantities;
  int scene_samples = 361;  ///< largest number of samples of the animation

  const PeriodicRun* periodic() const { return std::get_if<PeriodicRun>(&regime); }
  /// s: when it ends at the latest.
  double to() const {
    return periodic() ? from + periodic()->max_turns * period : std::get<TransientRun>(regime).to;
  }
  std::size_t pins() const { return std::max(contacts.size(), continuous.size()); }
  int joint_of(std::size_t pin) const {
    return contacts.empty() ? continuous[pin].clearance.joint : contacts[pin].joint;
  }
  double clearance_of(std::size_t pin) const {
    return contacts.empty() ? continuous[pin].clearance.clearance : contacts[pin].clearance;
  }
  PinSide pin_side(std::size_t pin) const { return contacts.empty() ? PinSide::first : contacts[pin].pin; }
  const std::string& pin_name(std::size_t pin) const {
    return linkage.joints[static_cast<std::size_t>(joint_of(pin))].name;
  }
};

/// "simulation" of "clearance.linkage".
study::Kind clearance_kind();

/// Integrates and reports. Rows up to where the motion ends are kept, whatever ends it.
study::Result run_clearance_study(const ClearanceStudy& study, RunContext& context);

// ---- between running and reporting
// -----------------------------------------------------------------------------

/// A pin at one instant: of continuous contact with the clearance link, which depth and friction are not of.
struct PinInstant {
  std::complex<double> eccentricity, rate;  ///< middle of the bush to that of the pin, m and m/s
  double bush_angle = 0;                    ///< rad: direction of the eccentricity in the frame of the bush
  double depth = 0;                         ///< m
  double normal = 0, friction = 0;          ///< N; of continuous contact `normal` is the tension
  bool contact = false;
  double angle = 0, angle_rate = 0, angle_acceleration = 0;  ///< angle of the clearance link
  math::Vec2 force{0, 0};                                    ///< N, of the first body on the second
};
struct RecordedRow {
  double time = 0;
  Status status = Status::done;
  std::vector<planar::InputMotion> inputs = {};  ///< inputs of the linkage without clearance
  double kinetic = 0, potential = 0, elastic = 0, dissipated = 0, work = 0, drift = 0;  ///< J
  std::vector<PinInstant> pins = {};
  std::vector<double> values = {};  ///< values of the columns
  planar::LinkageRecord record = {};
};
/// The search for a periodic regime, and its result.
struct ClearanceRegime {
  int turns = 0;   ///< periods of the drives after which it repeats; 0: not found
  int waited = 0;  ///< periods from the start to where it was seen to repeat; 0: found by shooting
  /// Largest change of a pin over `turns` periods, or, without, over the last one: displacements as shares of
  /// the clearance, speeds as shares of the largest of all sections; of a clearance link the sine and cosine
  /// of its angle, and its speed as a share of one turn a period.
  double change = nan;
  std::optional<JointOrbit> orbit;  ///< orbit of continuous contact, where that was looked for
};
/// The record of a run.
struct ClearanceRecording {
  Status status = Status::done;
  std::string message;
  double from = 0;  ///< s: where what is reported begins
  double time = 0;  ///< reached, s
  /// When pins went over from continuous to real contact, which of them parted, and where the inputs were
  /// then.
  double switched = nan;  ///< s; NaN: never
  int parted = -1;
  std::vector<planar::InputMotion> switched_inputs;
  bool went_over() const { return !std::isnan(switched); }
  double largest_drift = 0, peak_energy = 0;
  long steps = 0, evaluations = 0;
  /// Columns of the linkage without clearance that are known with it.
  std::vector<planar::LinkageColumn> columns;
  std::vector<RecordedRow> rows;   ///< rows; of a periodic study the last periods alone
  std::vector<RecordedRow> ideal;  ///< the same without clearance: times, inputs, values
  /// Once a period of the drives, from the start, the first `max_sections` of them: times and pins alone.
  std::vector<RecordedRow> sections;
  static constexpr int max_sections = 100'000;
  std::optional<ClearanceRegime> regime;  ///< regime of periodic studies
  /// Contacts; of a periodic regime those of its periods; the first ones of many.
  std::vector<ContactEvent> events;
  std::vector<ContactTotals> contacts;  ///< totals of all these contacts, one a pin
  long all_contacts() const {
    long sum = 0;
    for (const ContactTotals& of : contacts) sum += of.contacts;
    return sum;
  }
  /// True if more contacts came than are listed.
  bool more_contacts_than_listed() const { return all_contacts() > static_cast<long>(events.size()); }
  std::vector<ContactValidity> validity;  ///< one a continuous pin
  /// Points of the ideal path of every traced point, close together.
  std::vector<std::vector<std::complex<double>>> ideal_paths;
};
ClearanceRecording record_clearance(const ClearanceStudy& study, RunContext& context);

/// Tables that summarise rows; without rows when there is nothing to summarise.
Table contacts_table(const ClearanceStudy& study, const ClearanceRecording& recording);
/// The directions in which a pin presses on its bush, and the forces: directions in the frame of the bush, in
/// steps of 5 deg.
Table contact_map_table(const ClearanceStudy& study, const ClearanceRecording& recording);
Table spectrum_table(const ClearanceStudy& study, const ClearanceRecording& recording);
Table section_table(const ClearanceStudy& study, const ClearanceRecording& recording);
/// The start of a periodic motion in continuous contact, one row a pin, and its Floquet multipliers.
Table orbit_table(const ClearanceStudy& study, const JointOrbit& orbit);
Table multipliers_table(const JointOrbit& orbit);

/// The largest distances of traced points from their paths (m); rows are the traces.
struct PathErrors {
  study::Extreme path;   ///< from the ideal path
  study::Extreme place;  ///< from the ideal place
  std::string point;     ///< point that is farthest from its path
};
/// Facts, warnings and the headline.
void add_facts(const ClearanceStudy& study, const ClearanceRecording& recording, const PathErrors& errors,
               study::Result& result);

/// Tables, plots and facts.
study::Result report_clearance(const ClearanceStudy& study, ClearanceRecording recording);

/// The linkage in motion with its clearances enlarged so that one sees them. Of a row it takes the record,
/// whose input is that of the scene, and the eccentricities of the pins; of the study the linkage and its
/// pins.
study::Scene clearance_scene(const ClearanceStudy& study, const ClearanceRecording& recording,
                             std::string input_key = "time_s", std::string input_label = "time");

// ---- shared with other studies of clearance
// --------------------------------------------------------------------

/// The joint that `name`, found at `key` of a table, means. Nothing, and the problem reported, when there is
/// none.
std::optional<int> joint_named(study::ObjectReader& table, std::string_view key, const std::string& name,
                               const planar::Linkage& linkage);
/// The revolute joint of a `[[clearance]]` table with `joint` and `clearance`, if its links are long enough
/// for that.
std::optional<int> loose_joint(study::ObjectReader& table, const std::string& joint, double clearance,
                               const planar::Linkage& linkage);

}  // namespace linkwright::clearance
