// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/math/spline.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::planar {

// The order in which a linkage is solved: drivers first, then groups of bodies, each placed from those before
// it (Assur groups). Two bodies with three joints, a dyad, have closed forms; what does not fall into dyads
// is a general group and solved by Newton's method.

/// One side of a joint as the solver sees it: a part with a point, and a direction for slides.
struct PartPoint {
  int part = 0;                ///< index into LinkagePlan::parts
  math::Vec2 at{0, 0};         ///< in the frame of the part, m
  math::Vec2 direction{1, 0};  ///< unit vector in the frame of the part: of a slide, or x axis of the body
};

/// A joint between two parts, pins and slides only.
struct PlanJoint {
  bool slide = false;     ///< a slide, else a pin
  bool reversed = false;  ///< `before` is on the side of the second body of the joint
  int joint = -1;    ///< index in the linkage; the pin of a pin in a slot carries its index, its slide -1
  int input = -1;    ///< index into the inputs of the one that drives it, else -1
  PartPoint before,  ///< side of the part that comes before the joint in the chain of the group
      after;         ///< side of the part that comes after it
};

/// The properties of a kind of group; each kind has its `traits_of`.
struct GroupTraits {
  std::string_view name;     ///< name in the words of users
  bool closes_loop = false;  ///< it can be at a dead point, and has a sine that says how far that is
  bool closed_form = true;   ///< it is placed without a search
  bool has_modes = false;    ///< it is assembled in closed form, in two ways
  bool has_limits = false;   ///< in closed form it can cease to assemble, or run away, as the inputs move
  bool has_matrix = false;   ///< its rates and forces come from one matrix of all its joint equations
};

/// A part placed by its drive.
struct Driver {};
/// @returns the properties of a driver
constexpr GroupTraits traits_of(const Driver&) { return {.name = "driver"}; }

/// The meshing of two wheels. Radii are signed, so that for external and internal teeth alike the pitch point
/// lies by its radius from a centre towards the other one.
struct GearMesh {
  PartPoint first,           ///< centre of the first wheel, on its part
      second;                ///< centre of the second wheel
  double first_radius = 0;   ///< m, from the first centre towards the second
  double second_radius = 0;  ///< m, from the second centre towards the first
  double tangent = 0;        ///< tangent of the pressure angle
};

/// The share that the angle of one part has in that of another.
struct AngleShare {
  int part = 0;      ///< index of the part
  double share = 0;  ///< change of the other angle for a unit of this part's
};

/// The angle of a part by relations that are linear in angles (rad): `angle` + the sum of `gains` times the
/// inputs + the sum of `shares` times the angles of other parts.
struct DrivenAngle {
  double angle = 0;                ///< rad, where all inputs and the other angles are zero
  std::vector<double> gains = {};  ///< one an input; empty where no input takes part
  /// Parts that loops turn. Their angles count their turns: they continue from the last position by less than
  /// half a turn, from the first one in (-pi, pi].
  std::vector<AngleShare> shares = {};
  /// The fewest turns of this part after which whole turns of the others leave it as it was: the denominator
  /// of the shares. 0 if there is none.
  int turns = 1;
};

/// A gear in a group: the angle of its second wheel by those of the first wheel and the carrier.
struct PlanGear {
  int joint = -1;     ///< index in the linkage
  int part = 0;       ///< part of the second wheel
  DrivenAngle angle;  ///< phase of the parts, and the shares of first wheel (the ratio) and carrier
  /// Nothing where the radii are not known: the gear then passes a torque alone (LinkagePlan::torque_gears).
  std::optional<GearMesh> mesh = {};
  int strand = -1;  ///< of a belt: index into LinkagePlan::strands; `joint` is then -1
};

/// A pinion that rolls on a rack.
struct RackPair {
  PartPoint pinion,   ///< centre of the pinion
      rack;           ///< point and direction of the pitch line
  double radius = 0;  ///< m, positive where the centre lies to the left of the pitch line's direction
  double phase =
      0;  ///< angle of the pinion's part from that of the rack with the centre beside the point, rad
  double tangent = 0;  ///< tangent of the pressure angle
};

/// A strand of a belt or rope between two wheels. Radii have the sign of the side on which the wheel lies:
/// plus to the left of the running belt.
struct StrandPair {
  PartPoint first,          ///< centre of the wheel that the strand leaves
      second;               ///< centre of the wheel that it runs on to
  double first_radius = 0,  ///< m
      second_radius = 0;    ///< m
  double constant = 0;      ///< what angles, directions and length of the strand sum up to, m
  double reference = 0;     ///< direction of the strand in the drawing, rad: turns are counted from there
};

/// Two wheels that are not circular, or pin and slots of a Geneva drive: the angle of the second from the
/// carrier, plus its offset, is a curve of that of the first.
struct CurvePair {
  int first = 0,                    ///< part of the first wheel
      second = 0,                   ///< part of the second wheel
      carrier = 0;                  ///< part that carries both
  double first_offset = 0;          ///< rad
  double second_offset = 0;         ///< rad
  math::PiecewisePolynomial curve;  ///< rad
  bool around = false;  ///< the curve covers a turn of the first wheel and repeats; else it is a sector
  std::optional<GenevaSlots> geneva = {};  ///< instead of the curve
  PartPoint pin;                           ///< of a Geneva drive
  /// The mesh, whose radii are those of a ratio of 0: the second one is the distance of the centres.
  std::optional<GearMesh> mesh = {};
  double scale = 1;  ///< length (m) by which the equation is multiplied
};

/// A cam and its follower. The coordinate of the moved joint less `offset` is the programme of the angle of
/// the cam.
struct CamPair {
  PartPoint base,            ///< centre of the cam on the part that carries it, and the x axis of that body
      cam,                   ///< centre and x axis on the cam
      moved_first,           ///< side of the first body of the moved joint
      moved_second;          ///< side of its second body
  PartPoint contact;         ///< centre of the roller, edge or point of the face, and direction of the face
  PartPoint second_contact;  ///< conjugate: centre of the roller on the second disc
  double second_roller = 0;  ///< conjugate: radius of that roller, m; 0: there is none
  int cam_body = 0;          ///< body of the cam, index in the linkage
  int joint = -1;            ///< the moved joint, index in the linkage
  bool slide = false;        ///< it is a slide, else a pin
  double sense = 1;          ///< +1 for a programme over the counter-clockwise angle of the cam, else -1
  double phase = 0;          ///< angle of the programme where that of the cam from its carrier is 0, rad
  double offset = 0;         ///< coordinate of the moved joint where the programme is 0, rad or m
  double scale = 1;          ///< length (m) by which the equation of a pin is multiplied
  bool is_flat = false;      ///< the follower is a flat face
  double roller = 0;         ///< radius of the roller, 0 of an edge and of a flat face, m
  bool is_sector = false;    ///< the cam stops at the ends of its programme
  ProgrammeCurve programme;  ///< m or rad
};

class SlotTrack;

/// A pin that runs in a curved slot.
struct SlotPair {
  PartPoint slot,                          ///< origin and x axis of the body of the slot
      pin;                                 ///< the pin
  std::shared_ptr<const SlotTrack> track;  ///< in the frame of the body of the slot
};

/// A pair that gives one equation between parts, other than a gear of constant ratio.
struct PlanPair {
  int joint = -1;   ///< index in the linkage, -1 of a strand or cam
  int strand = -1;  ///< index into LinkagePlan::strands, -1 of others
  std::variant<RackPair, StrandPair, CurvePair, CamPair, SlotPair> kind;  ///< the pair with its dimensions
  int cam = -1;  ///< index into Linkage::cams, -1 of others
};

/// Parts on pins, each of a part that is placed before it, whose angles follow from gears and drives.
struct GearTrain {
  std::vector<DrivenAngle> angles;  ///< one a part of the group
};
/// @returns the properties of a train of gears
constexpr GroupTraits traits_of(const GearTrain&) { return {.name = "gear", .has_matrix = true}; }

/// A part on one pin or slide that a pair moves: a pinion on a rack, a rack, a wheel that a strand turns, the
/// follower of a cam.
struct Follower {};
/// @returns the properties of a follower
constexpr GroupTraits traits_of(const Follower&) { return {.name = "follower", .has_matrix = true}; }

/// A link between two joints of a closed form, and what that needs of it.
struct PlanLink {
  math::Vec2 vector{0, 0};  ///< from outer to inner joint in the frame of the part
  double square = 0,        ///< square of its length, m2
      length = 0;           ///< m
  /// One over the link as a complex number: turned onto where the link lies it gives the direction of its
  /// part. 0 of a link without length.
  math::Vec2 inverse{0, 0};
};

/// The type of a dyad by its joints in the order of the chain: R a pin, P a slide.
enum class DyadType {
  rrr,  ///< three pins
  rrp,  ///< pin, pin, slide
  rpr,  ///< pin, slide, pin
  prp,  ///< slide, pin, slide
  rpp   ///< pin, slide, slide
};
constexpr std::array<EnumName<DyadType>, 5> names(DyadType) {
  return {{{DyadType::rrr, "RRR", "dyad of three pins"},
           {DyadType::rrp, "RRP", "dyad pin, pin, slide"},
           {DyadType::rpr, "RPR", "dyad pin, slide, pin"},
           {DyadType::prp, "PRP", "dyad slide, pin, slide"},
           {DyadType::rpp, "RPP", "dyad pin, slide, slide"}}};
}

/// Two parts with three joints, in the order of the chain.
struct Dyad {
  DyadType type = DyadType::rrr;  ///< joints in the order of the chain
  PlanLink first,  ///< link of the first part; the links of RPR are seen from the direction of the slide
      second;      ///< link of the second part
  double per_length = 1;  ///< one over the links between pins: both of RRR, the first of RRP
};

/// The properties of a dyad, which depend on its type.
///
/// @param dyad the dyad
/// @returns its properties
constexpr GroupTraits traits_of(const Dyad& dyad) {
  GroupTraits out{.name = name_of(dyad.type), .closes_loop = true};
  switch (dyad.type) {
    case DyadType::rrr:
    case DyadType::rrp:
    case DyadType::rpr:
      out.has_modes = out.has_limits = true;
      break;
    case DyadType::prp:
      out.has_limits = true;  // its slides can become parallel
      break;
    case DyadType::rpp:
      break;  // its slides keep their angle
  }
  return out;
}

/// Two bodies with a drive between them, as a cylinder, hold an arm: a triangle of pins. Known part, pin,
/// first body, drive, second body, pin, arm, pin, known part.
struct Triangle {
  PlanLink arm;  ///< link of the arm between its two pins
};
/// @returns the properties of a triangle
constexpr GroupTraits traits_of(const Triangle&) {
  return {.name = "triangle", .closes_loop = true, .has_modes = true, .has_limits = true, .has_matrix = true};
}

/// A group without closed form, solved by Newton's method.
struct GeneralGroup {
  std::vector<math::Pose> start;  ///< poses of the parts, where given; else empty
};
/// @returns the properties of a general group
constexpr GroupTraits traits_of(const GeneralGroup&) {
  return {.name = "general", .closes_loop = true, .closed_form = false, .has_matrix = true};
}

/// One step of the solution.
struct Group {
  /// Kind of the group, with the constants of its formulas.
  std::variant<Driver, GearTrain, Follower, Dyad, Triangle, GeneralGroup> kind;
  std::string name;        ///< "coupler + rocker"
  std::vector<int> parts;  ///< parts that this group places; in the order of the chain, if it is one
  /// One of a driver, one a part of a train; in the order of the chain, if the group is one.
  std::vector<PlanJoint> joints;
  std::vector<PlanGear> gears;  ///< of a train and of a general group
  std::vector<PlanPair> pairs;  ///< of a follower and of a general group
  /// Sign of the assembly mode that the model names or its start poses show; +1 where there is none.
  double mode = 1;
  bool mode_given = false;  ///< the model names the mode

  /// The group as one of a kind.
  ///
  /// @tparam Kind Driver, GearTrain, Follower, Dyad, Triangle or GeneralGroup
  /// @returns the kind with its constants, or null if the group is of another kind
  template <class Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&kind);
  }
};

/// The properties of a group, which are those of its kind.
///
/// @param group the group
/// @returns its properties
inline GroupTraits traits_of(const Group& group) {
  return std::visit([](const auto& kind) { return traits_of(kind); }, group.kind);
}

/// Calls the one of `cases` that takes the kind of the group. A kind without a case does not compile.
///
/// @param group the group
/// @param cases one function for each kind
/// @returns what the function returns
template <class... Cases>
decltype(auto) by_kind(const Group& group, Cases... cases) {
  struct Overloaded : Cases... {
    using Cases::operator()...;
  };
  return std::visit(Overloaded{std::move(cases)...}, group.kind);
}

/// A body as it sits on its part: welded bodies make one part.
struct BodyOnPart {
  int part = 0;             ///< index of the part
  math::Vec2 origin{0, 0};  ///< origin of the body in the frame of the part, m
  math::Vec2 turn{1, 0};    ///< direction of the x axis of the body in the frame of the part, unit vector
  bool same_frame = true;   ///< origin and turn are those of the part
};

/// Mass of a part in the parameters that forces are linear in.
struct PartMass {
  double mass = 0;          ///< kg
  math::Vec2 moment{0, 0};  ///< mass times mass centre in the frame of the part, kg m
  double inertia = 0;       ///< about the origin of the part, kg m2
};

/// The twist of a torsion spring, or the angle of a pin with a stop: that of the second body from the first,
/// with its turns.
struct PlanTwist {
  int first = 0,   ///< part of the first body
      second = 0;  ///< part of the second body
  /// Direction of the second body on its part, less that of the first on its own (unit vector).
  math::Vec2 turn{1, 0};
  /// True if drives and gears alone turn both: their joints count the turns, and the twist is `angle` + the
  /// sum of `gains` times the inputs. Else it continues from the last position by less than half a turn, from
  /// the first one to the angle that is nearest to `free` but for its whole turns.
  bool counted = false;
  double angle = 0,           ///< rad, where all inputs are zero; if counted
      free = 0;               ///< free angle of the spring (rad)
  std::vector<double> gains;  ///< one an input; if counted
};

/// A pin of several links: of n links it is n - 1 joints of the model, and which two links each of them names
/// does not matter for the motion. Where the plan needs other pairs than the model has, to find its dyads,
/// the forces in the joints of the model follow from those in the pairs of the plan.
struct SharedPin {
  std::vector<int> joints;  ///< joints of the model
  /// The force in joint i of the model is the sum over k of share[i][k] (-1, 0 or 1) times the force in the
  /// pair of the plan that has the number joints[k].
  std::vector<std::vector<double>> share;
};

/// A strand of a belt. The last one of a closed belt on a carrier has no equation of its own.
struct PlanStrand {
  int belt = 0;            ///< index in the linkage
  int first = 0,           ///< body of the wheel that it leaves
      second = 0;          ///< body of the wheel that it runs on to
  bool preloaded = false;  ///< its belt is closed and on a carrier, so that its mean tension is given
  StrandPair run;          ///< its wheels
};

/// A linkage made ready: parts (rigid clusters of bodies; part 0 is the ground), and the groups in order.
struct LinkagePlan {
  std::vector<BodyOnPart> bodies;  ///< one a body
  std::vector<std::string> parts;  ///< names: those of their bodies; blocks of slots are "block of <joint>"
  std::vector<PartMass> masses;    ///< one a part
  bool has_masses = false;         ///< every moving body has its mass given
  std::vector<std::string> massless;               ///< bodies without mass given
  std::vector<Group> groups;                       ///< in the order of the solution
  std::vector<int> group_of_part;                  ///< -1 of the ground
  std::vector<std::optional<DrivenAngle>> turned;  ///< one a part; nothing of those that loops turn
  std::vector<PlanTwist> twists;                   ///< one a torsion spring, a stop, a counted pin
  std::vector<SharedPin> shared_pins;              ///< pins whose pairs differ from those of the model
  std::vector<std::string> torque_gears;           ///< gears without tooth force, each with the reason
  std::vector<int> redundant_gears;                ///< joints that repeat what other gears say
  std::vector<PlanStrand> strands;                 ///< those of all belts, in their order
  std::vector<CamPair> cams;                       ///< one a cam of the linkage
  std::vector<bool> rotary;                        ///< one an input: whether its joint turns
  double size = 1;                                 ///< characteristic length, m
  /// Inputs of the position that the start poses show, one an input; empty when they do not show all of them.
  /// Angles are in (-pi, pi].
  std::vector<double> drawn_inputs;

  /// The number of inputs. @returns number of joints with a drive
  std::size_t inputs() const { return rotary.size(); }
  /// Test for closed forms.
  ///
  /// @returns true if all groups have closed forms, so that no search and no history is needed
  bool closed_form() const;
};

/// Mass of each part: the sum over the bodies on it and the masses attached to them. A linkage with other
/// masses than those that the plan was made with is allowed.
///
/// @param linkage the linkage, with its masses
/// @param bodies bodies on their parts, LinkagePlan::bodies
/// @param parts number of parts
/// @returns one mass a part
std::vector<PartMass> part_masses(const Linkage& linkage, std::span<const BodyOnPart> bodies,
                                  std::size_t parts);

/// Degrees of freedom by count (Chebyshev-Gruebler): 3 a moving body, less 3 a weld, 2 a pin or slide, 1 a
/// pin in a slot, a gear, a rack, a cam or a strand, but for the last strand of a closed belt on a carrier.
///
/// @param linkage the linkage
/// @returns the count; redundant joints make it less than the freedoms
int mobility(const Linkage& linkage);

/// A plan and the problems that were found while making it.
struct PlanResult {
  LinkagePlan plan;      ///< complete if there are no problems
  Diagnostics problems;  ///< errors: the plan is not complete
};

/// The route by which a plan is solved: along the groups that the linkage falls into, or all parts at once as
/// one general group, the independent route that checks the other.
enum class PlanRoute {
  along_groups,  ///< along the groups that the linkage falls into
  all_at_once    ///< all parts at once as one general group
};

/// Decomposes a linkage. Problems are named in plain words with the bodies and joints that take part: bodies
/// that hang on nothing, freedoms without a drive, drives beyond the freedoms, joints that close a loop that
/// is closed already, gears that contradict each other. Includes those of `check`.
///
/// @param linkage the linkage
/// @param route the route by which it is to be solved
/// @returns the plan, and the problems
PlanResult plan_linkage(const Linkage& linkage, PlanRoute route = PlanRoute::along_groups);

/// The motion of one input at an instant.
struct InputMotion {
  double value = 0,      ///< rad or m
      rate = 0,          ///< rad/s or m/s
      acceleration = 0;  ///< rad/s2 or m/s2
};

/// One input over the samples of a sweep.
struct SweepInput {
  /// Values, one a sample (rad or m).
  std::span<const double> value,
      rate,          ///< rates (rad/s or m/s): one a sample, or one for all, or none for zero
      acceleration;  ///< accelerations, likewise
};

}  // namespace linkwright::planar
