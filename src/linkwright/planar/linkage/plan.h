#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/planar/linkage/linkage.h"
#include "linkwright/planar/plane.h"

namespace linkwright::planar {

/// The order in which a linkage is solved: drivers first, then groups of bodies, each placed from those
/// before it (Assur groups). Two bodies with three joints, a dyad, have closed forms; what does not fall into
/// dyads is a general group and solved by Newton's method.
enum class GroupType { driver, gear, rrr, rrp, rpr, prp, rpp, triangle, general };
constexpr std::array<EnumName<GroupType>, 9> names(GroupType) {
  return {{{GroupType::driver, "driver", "a body placed by its drive"},
           {GroupType::gear, "gear", "a body on a known pin, turned by a gear"},
           {GroupType::rrr, "RRR", "dyad of three pins"},
           {GroupType::rrp, "RRP", "dyad pin, pin, slide"},
           {GroupType::rpr, "RPR", "dyad pin, slide, pin"},
           {GroupType::prp, "PRP", "dyad slide, pin, slide"},
           {GroupType::rpp, "RPP", "dyad pin, slide, slide"},
           {GroupType::triangle, "triangle",
            "two bodies with a drive between them, as a cylinder, hold an arm: a triangle of pins"},
           {GroupType::general, "general", "group without closed form, solved by Newton's method"}}};
}
/// Whether such a group is assembled in closed form, in two ways.
constexpr bool has_modes(GroupType type) {
  return type == GroupType::rrr || type == GroupType::rrp || type == GroupType::rpr ||
         type == GroupType::triangle;
}
/// Whether rates and forces of such a group come from one matrix of all its joint equations.
constexpr bool has_matrix(GroupType type) {
  return type == GroupType::general || type == GroupType::triangle;
}

/// One side of a joint as the solver sees it: a part with a point, and a direction for slides.
struct PartPoint {
  int part = 0;
  Vec<double> at{0, 0};         ///< in the frame of the part, m
  Vec<double> direction{1, 0};  ///< unit vector in the frame of the part: of a slide, or x axis of the body
};

/// A joint between two parts, pins and slides only.
struct PlanJoint {
  bool slide = false;
  PartPoint before, after;
  int joint = -1;         ///< of the linkage; the pin of a pin in a slot carries its index, its slide -1
  bool reversed = false;  ///< `before` is on the side of the second body of the joint
};

/// One step of the solution.
struct Group {
  GroupType type = GroupType::driver;
  std::vector<int> parts;  ///< that this group places; two of a dyad, three of a triangle, chain order
  /// 1 of a driver or gear, 3 of a dyad and 4 of a triangle in chain order, more of a general one. A
  /// triangle: known part, pin, first body, drive, second body, pin, arm, pin, known part.
  std::vector<PlanJoint> joints;
  int input = -1;           ///< of a driver: index into the inputs
  std::vector<int> inputs;  ///< of groups with drives inside: one a driven joint, else -1
  /// gear: turns the part `ratio` times as fast as part `turning`, both seen from part `carrier`.
  double ratio = 1;
  int turning = 0, carrier = 0, gear_joint = -1;
  bool gear_backwards = false;  ///< turns the first body of its joint from the second
  /// gear: angle of the part = angle + sum of gains times inputs (rad).
  double angle = 0;
  std::vector<double> gains;
  /// Sign of the assembly mode that the model names or its start poses show; +1 where there is none.
  double mode = 1;
  bool mode_given = false;
  std::vector<math::Pose> start;  ///< of the parts of a general group, where given; else empty
  // Constants of the closed forms; of a triangle those of the arm alone, as `second`.
  Vec<double> first_link{0, 0}, second_link{0, 0};  ///< from outer to inner joint in the frames of the parts
  double first_square = 0, second_square = 0;       ///< their squared lengths
  double first_length = 0, second_length = 0;
  double per_length = 1;  ///< one over the links between pins: both of RRR, the first of RRP
  /// One over the links as complex numbers: turned onto where a link lies they give the direction of its
  /// part.
  Vec<double> first_inverse{0, 0}, second_inverse{0, 0};
  std::string name;  ///< "coupler + rocker"
};

/// A body as it sits on its part: welded bodies make one part.
struct BodyOnPart {
  int part = 0;
  Vec<double> origin{0, 0};
  Vec<double> turn{1, 0};
  bool same_frame = true;  ///< origin and turn are those of the part
};

/// Mass of a part in the parameters that forces are linear in.
struct PartMass {
  double mass = 0;           ///< kg
  Vec<double> moment{0, 0};  ///< mass times mass centre in the frame of the part, kg m
  double inertia = 0;        ///< about the origin of the part, kg m2
};

/// A linkage made ready: parts (rigid clusters of bodies; part 0 is the ground), and the groups in order.
struct LinkagePlan {
  std::vector<BodyOnPart> bodies;  ///< one a body
  std::vector<std::string> parts;  ///< names: those of their bodies; blocks of slots are "block of <joint>"
  std::vector<PartMass> masses;    ///< one a part
  bool has_masses = false;         ///< every moving body has its mass given
  std::vector<std::string> massless;  ///< bodies without mass given
  std::vector<Group> groups;
  std::vector<int> group_of_part;  ///< -1 of the ground
  std::vector<bool> rotary;        ///< one an input: whether its joint turns
  double size = 1;                 ///< characteristic length, m
  /// Inputs of the position that the start poses show, one an input; empty when they do not show all of them.
  /// Angles are in (-pi, pi].
  std::vector<double> drawn_inputs;

  std::size_t inputs() const { return rotary.size(); }
  /// Whether all groups have closed forms, so that no search and no history is needed.
  bool closed_form() const;
};

/// Mass of each part: that of the bodies on it and of what is attached to them; of other masses than those
/// the plan was made with, when these are in `linkage`.
std::vector<PartMass> part_masses(const Linkage& linkage, std::span<const BodyOnPart> bodies,
                                  std::size_t parts);

/// Degrees of freedom by count (Chebyshev-Gruebler): 3 a moving body, less 3 a weld, 2 a pin or slide, 1 a
/// pin in a slot or a gear.
int mobility(const Linkage& linkage);

struct PlanResult {
  LinkagePlan plan;
  Diagnostics problems;  ///< errors: the plan is not complete
};

/// How a plan solves: along the groups that the linkage falls into, or all parts at once as one general
/// group, the independent route that checks the other (no gears).
enum class PlanRoute { along_groups, all_at_once };

/// Decomposes a linkage. Problems are named in plain words with the bodies and joints that take part: bodies
/// that hang on nothing, freedoms without a drive, drives beyond the freedoms, joints that close a loop that
/// is closed already, gears whose angle is not known. Includes those of `check`.
PlanResult plan_linkage(const Linkage& linkage, PlanRoute route = PlanRoute::along_groups);

/// Position, velocity and acceleration of one input: rad or m, per second.
struct InputMotion {
  double value = 0, rate = 0, acceleration = 0;
};

}  // namespace linkwright::planar
