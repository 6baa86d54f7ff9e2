#pragma once

#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/clearance/contact_simulation.h"
#include "linkwright/clearance/joint_clearance.h"
#include "linkwright/planar/linkage_columns.h"
#include "linkwright/planar/linkage_scene.h"
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

/// A study as read. Either contacts or continuous pins, not both.
struct ClearanceStudy {
  planar::Linkage linkage;
  planar::LinkagePlan plan;
  std::vector<planar::InputCourse> courses;  ///< one an input
  double from = 0, to = 1;                   ///< s
  int samples = 1001;
  double relative_tolerance = 1e-9;
  long max_steps = 10'000'000;
  std::vector<ContactJoint> contacts;
  std::vector<ContinuousPin> continuous;
  std::vector<planar::BodyPoint> traces;
  planar::LinkageQuantities quantities;
  int scene_samples = 361;  ///< of the animation, at most

  std::size_t pins() const { return contacts.size() + continuous.size(); }
  int joint_of(std::size_t pin) const {
    return contacts.empty() ? continuous[pin].clearance.joint : contacts[pin].joint;
  }
  double clearance_of(std::size_t pin) const {
    return contacts.empty() ? continuous[pin].clearance.clearance : contacts[pin].clearance;
  }
  PinSide pin_side(std::size_t pin) const { return contacts.empty() ? PinSide::first : contacts[pin].pin; }
};

/// "simulation" of "clearance.linkage".
study::Kind clearance_kind();

/// Integrates and reports. Rows up to where the motion ends are kept, whatever ends it.
study::Result run_clearance_study(const ClearanceStudy& study, RunContext& context);

// ---- between running and reporting
// -----------------------------------------------------------------------------

/// A pin at one instant: of contact all but the last three, of continuous contact all but depth, friction and
/// contact.
struct PinInstant {
  std::complex<double> eccentricity, rate;  ///< middle of the bush to that of the pin, m and m/s
  double depth = 0;                         ///< m
  double normal = 0, friction = 0;          ///< N; of continuous contact `normal` is the tension
  bool contact = false;
  double angle = 0, angle_rate = 0, angle_acceleration = 0;  ///< of the clearance link
  planar::Vec<double> force{0, 0};                           ///< N, of the first body on the second
};
struct RecordedRow {
  double time = 0;
  Status status = Status::done;
  std::vector<planar::InputMotion> inputs = {};  ///< of the linkage without clearance
  double kinetic = 0, potential = 0, elastic = 0, dissipated = 0, work = 0, drift = 0;  ///< J
  std::vector<PinInstant> pins = {};
  std::vector<double> values = {};  ///< of the columns
  planar::LinkageRecord record = {};
};
/// What a run has recorded.
struct ClearanceRecording {
  Status status = Status::done;
  std::string message;
  double time = 0;  ///< reached, s
  double largest_drift = 0, peak_energy = 0;
  long steps = 0, evaluations = 0;
  std::vector<planar::LinkageColumn> columns;  ///< of the linkage without clearance that are known with it
  std::vector<RecordedRow> rows;
  std::vector<RecordedRow> ideal;     ///< the same without clearance: times, inputs, values
  std::vector<RecordedRow> sections;  ///< once a turn of an even drive, from the start
  double period = 0;                   ///< s, of that drive; 0 = there is none
  std::vector<ContactEvent> events;
  std::vector<ContactValidity> validity;  ///< one a continuous pin
  /// Of every traced point: places on the ideal path, close together.
  std::vector<std::vector<std::complex<double>>> ideal_paths;
};
ClearanceRecording record_clearance(const ClearanceStudy& study, RunContext& context);

/// Tables, plots and facts.
study::Result report_clearance(const ClearanceStudy& study, ClearanceRecording recording);

/// The linkage in motion with its play enlarged so that one sees it.
study::Scene clearance_scene(const ClearanceStudy& study, const ClearanceRecording& recording);

// ---- shared with other studies of clearance
// --------------------------------------------------------------------

/// The joint that `name`, found at `key` of a table, means. Nothing, and the problem told, when there is none.
std::optional<int> joint_named(study::ObjectReader& table, std::string_view key, const std::string& name,
                               const planar::Linkage& linkage);
/// The revolute joint of a `[[clearance]]` table with `joint` and `clearance`, if its links are long enough
/// for that.
std::optional<int> loose_joint(study::ObjectReader& table, const std::string& joint, double clearance,
                               const planar::Linkage& linkage);

}  // namespace linkwright::clearance
