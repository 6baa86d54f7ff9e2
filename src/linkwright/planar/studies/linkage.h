// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/planar/four_bar/as_linkage.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/form.h"
#include "linkwright/planar/linkage/inverse.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motor.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/redundant.h"
#include "linkwright/planar/linkage/slider_crank.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/driven_law.h"
#include "linkwright/study/kind.h"

// The analysis of any planar linkage over its inputs or over time: what its file holds, how it is read, run
// and reported. `planar.four_bar` and `planar.slider_crank` are shorthands: linkages by a few parameters.
namespace linkwright::planar {

/// The limits of a drive, which are reported and change no motion; and where it is at the start of a path.
struct LinkageDriveLimits {
  std::optional<double> lowest, highest;              ///< rad or m
  std::optional<double> speed, acceleration, effort;  ///< sizes; effort in N m or N
  std::optional<double> start;                        ///< rad or m, about
};
/// The motion of a driven joint: over a grid its rate and acceleration, over time its law.
struct LinkageDrive {
  std::string joint;
  double rate = 0, acceleration = 0;
  std::optional<math::MotionLaw> law;
  LinkageDriveLimits limits;
};
/// `[path]`: a point that the drives without a law take along a path.
struct LinkagePath {
  PointPath form;
  FollowedPoint point;
  BodyPoint traced;
  math::Vec2 from{0, 0};           ///< place where it begins
  double angle = 0;                ///< angle of the body there
  std::vector<InputMotion> start;  ///< all inputs there
  int samples = 0;
};
/// One axis of a grid.
struct InputSamples {
  std::string joint;
  double from = 0, to = 0;
  int samples = 361;
};
/// The rows of a table: all combinations of inputs, the first input slowest; or times.
struct InputGrid {
  std::vector<InputSamples> inputs;  ///< in the order of the linkage's drives
  /// Range of a single input, if its ends are those between which the linkage assembles.
  std::optional<InputRange> assembled;
};

/// The rows of a grid over one input that count.
enum class CircuitRows {
  reached,  ///< rows on the circuit of the drawing, or of the first row that assembles
  all       ///< rows of all circuits in the assembly modes of the study
};
constexpr std::array<EnumName<CircuitRows>, 2> names(CircuitRows) {
  return {{{CircuitRows::reached, "reached",
            "those that the linkage comes to from the drawn position, or else from the first that assembles"},
           {CircuitRows::all, "all", "those of other circuits as well, for which it is taken apart"}}};
}

/// `[quality]`: what is asked beyond the table, of linkages with one input.
struct LinkageQuality {
  /// Joint whose rate and force ratio to the input, and dead centres, are reported.
  std::string output_joint;
  /// Bodies whose fixed and moving centrode against the ground are tabled.
  std::vector<std::string> centrodes;
  bool instant_centres = false;  ///< table of all instant centres at every row
  bool assembly_modes = false;   ///< table of all assembly modes at the first row
};

/// `[holding]`: what holds the linkage at rest with friction.
struct LinkageHolding {
  std::optional<std::size_t> load;  ///< index of the force that is unknown; nothing: the drive is
};

/// A pin with one direction too many in a linkage that moves since its dimensions agree. It is a pin in a
/// slot in the linkage of the study, see relax_redundant.
struct RedundantJoint {
  int joint = -1;
  int equations = 0, rank = 0;  ///< of all joints in the drawn position
  RedundantForces rule = RedundantForces::least_squares;
  bool gives_way = false;  ///< the rule `compliance` determines all forces
  /// Forces in the joints of the drawing that balance each other, one list a self-stress.
  std::vector<std::vector<JointReaction>> stresses = {};
};
/// `[redundant]`.
struct RedundantForm {
  RedundantForces forces = RedundantForces::least_squares;
};
template <class Visitor>
void fields(Visitor&& visit, RedundantForm& r) {
  visit(field::entry("forces", "rule by which redundant joints share forces that balance each other"),
        r.forces);
}

/// A study of a linkage as read.
struct LinkageStudy {
  Linkage linkage;
  LinkagePlan plan;
  std::vector<LinkageDrive> drives;  ///< one an input
  std::variant<InputGrid, study::TimeSamples> sweep;
  AtChangePoint at_change_point = AtChangePoint::smooth;  ///< for a grid over one input
  CircuitRows circuits = CircuitRows::reached;            ///< likewise
  std::vector<BodyPoint> traces;
  LinkageQuality quality;
  std::optional<LinkageHolding> holding;
  std::optional<LinkagePath> path;  ///< of a sweep over time
  std::vector<Motor> motors;        ///< catalogue of which the drives take theirs
  LinkageQuantities quantities;
  std::optional<RedundantJoint> redundant;
  std::optional<FourBarMechanism> four_bar;  ///< four-bar as which it was written
  study::DisplayUnits units;                 ///< units of its messages
};

/// "analysis" of "planar.linkage" and of its shorthands.
study::Kind linkage_kind();
study::Kind four_bar_kind();
study::Kind slider_crank_kind();

enum class LinkageType { linkage, four_bar, slider_crank };
/// The treatment of a study that lists no quantities, for a linkage without any known mass: forces may be
/// what it is for, or one of many things that could be shown.
enum class WithoutMasses { refused, motion_alone };
/// Reads the tables of the study and writes them into the canonical one unless that is null; nothing when
/// there are problems, which go to the reader.
std::optional<LinkageStudy> read_linkage_study(study::ObjectReader& document, const study::Common& common,
                                               LinkageType type, Value* canonical,
                                               WithoutMasses without_masses = WithoutMasses::refused);

/// The rows to be solved: combinations of a grid with time 0, or times.
struct LinkageRows {
  std::vector<double> time;
  std::vector<std::vector<InputMotion>> inputs;  ///< inputs of each row
  std::optional<PathDrives> path;                ///< of a path: its rows, and where it ends
};
LinkageRows rows_of(const LinkageStudy& study);

/// The tables of an analysis of a found linkage that is written by its parameters: its motion over inputs
/// from the first to the last of these, one turn a second, which needs no masses.
/// Inputs short of a full turn end at dead points, where speeds are not determined: the motion keeps a
/// hundredth of the range off them, but for what the path needs.
Value motion_study(std::string_view type, Value mechanism, std::span<const double> inputs,
                   std::span<const double> on_path);

/// The same of any linkage with one input, at a rate that passes these inputs in a second, with the path of a
/// point ("coupler.C").
Value motion_study(const Linkage& linkage, bool rotary, std::span<const double> inputs,
                   std::string_view point);

/// The table of the study alone, with the columns of these keys only (all when empty), for those who evaluate
/// many designs. A branch is not followed through change points.
Table linkage_table(const LinkageStudy& study, std::span<const std::string> columns);

/// Evaluates every row and reports. Rows that do not assemble, or are at a dead point, hold what is known
/// of them and their status; the status of the result is then the first of these.
study::Result run_linkage_study(const LinkageStudy& study, RunContext& context);

/// The table `ranges`: where the linkage assembles in which modes, and circuits.
void add_limits(const LinkageStudy& study, const InputLimits& limits, study::Result& result);
/// The tables that `[quality]` asks for, of a grid over one input; `branch` through change points if there
/// are any.
void add_quality(const LinkageStudy& study, const std::optional<BranchPath>& branch, study::Result& result);

// ---- shared with other studies of linkages
// ------------------------------------------------------------------

/// `[mechanism]`, `[environment]`, `[[trace]]` of any study of a linkage, and `[[drive]] joint`.
struct LinkageDescription {
  Linkage linkage;
  LinkagePlan plan;
  std::vector<BodyPoint> traces;
  Value shorthand;                           ///< `[mechanism]` as it is written; null of planar.linkage
  std::optional<FourBarMechanism> four_bar;  ///< four-bar as which it was written
  std::string sample;                        ///< its name when the mechanism is a built-in one
  std::vector<double> sample_from;           ///< and the inputs where its motion begins
  std::optional<RedundantJoint> redundant;
};
/// Reads and plans; nothing when there are problems, which go to the reader in the given units.
/// `lists_quantities`: the study may list quantities that need no masses. `follows_path`: it may have
/// `[path]`.
std::optional<LinkageDescription> read_linkage(study::ObjectReader& document, LinkageType type,
                                               bool needs_masses, const study::DisplayUnits& units,
                                               bool lists_quantities = false, bool follows_path = false);
/// Adds to the facts the inertias and mass centres that the study leaves out, as they were taken.
void report_assumed_masses(const Linkage& linkage, study::Result& result);
/// True if every body has its mass; says which do not.
bool require_masses(study::ObjectReader& document, LinkageType type, const LinkagePlan& plan,
                    bool lists_quantities = false);
/// The tables of `read_linkage` as a canonical study holds them.
void write_linkage(const LinkageDescription& description, Value& canonical);
void describe_linkage(study::SchemaWriter& document, LinkageType type);
/// The same with `[[drive]]` and `[sweep]`, as `read_linkage_study` reads them; `at_change_point` only for
/// those who follow branches.
void describe_linkage_motion(study::SchemaWriter& document, LinkageType type, bool at_change_point);

/// The tables `[[drive]]`; a single `[drive]` is one, too.
std::vector<study::ObjectReader> drive_tables(study::ObjectReader& document);
/// Describes `drive`, tables or a single one that hold what `one` describes.
void describe_drives(study::SchemaWriter& document, std::string_view summary, study::SchemaWriter one);

/// A key of a driven joint: an angle or a length, or its derivative of that order by time.
Field drive_field(bool rotary, int order, std::string_view key, std::string_view summary,
                  bool required = false);

/// The numbers of a joint: its kind decides whether they are of angles or of lengths. These are the field
/// lists by which they are read, written into the canonical study and described.
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, LinkageDrive& d) {
  visit(drive_field(rotary, 1, "speed", "rate at every position of a grid"), d.rate);
  visit(drive_field(rotary, 2, "acceleration", "acceleration at every position of a grid"), d.acceleration);
}
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, LinkageDriveLimits& d) {
  visit(drive_field(rotary, 0, "lowest", "least value that the drive can take"), d.lowest);
  visit(drive_field(rotary, 0, "highest", "greatest value that the drive can take"), d.highest);
  visit(drive_field(rotary, 1, "speed_limit", "greatest speed of the drive").positive(), d.speed);
  visit(drive_field(rotary, 2, "acceleration_limit", "greatest acceleration of the drive").positive(),
        d.acceleration);
  if (rotary)
    visit(field::torque("torque_limit", "greatest torque of the drive").positive(), d.effort);
  else
    visit(field::force("force_limit", "greatest force of the drive").positive(), d.effort);
  visit(drive_field(rotary, 0, "path_start", "value from which the drive goes to the beginning of a path"),
        d.start);
}
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, InputSamples& a, bool required = true) {
  visit(drive_field(rotary, 0, "from", "first value", required), a.from);
  visit(drive_field(rotary, 0, "to", "last value", required), a.to);
  visit(field::entry("samples", "number of values, both ends included").between(2, 100000), a.samples);
}
/// Describes them for both kinds of joints; which of them is required only the reader knows.
template <class T>
void describe_joint_fields(study::SchemaWriter& table) {
  T defaults;
  for (const bool rotary : {true, false})
    joint_fields(
        [&](Field field, auto& member) {
          if (field.dimension == Dimension::none) {
            if (rotary) table(field, member);
            return;
          }
          field.is_required = false;
          table.property(field, study::schema_number());
        },
        rotary, defaults);
}

/// The input that a table with `joint` means: the only one when it names none. Nothing, and the problem
/// reported, when there is no such input.
std::optional<std::size_t> input_of(study::ObjectReader& table, const Linkage& linkage);
/// `law` of a `[[drive]]` with its keys, written into the canonical table as well; nothing when it is absent
/// or cannot be read. Problems go to the reader.
std::optional<math::MotionLaw> read_law(study::ObjectReader& drive, bool rotary, bool required,
                                        Value& canonical);

}  // namespace linkwright::planar
