// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/plan.h"

// The stages of a plan, one source each: bodies become parts, parts fall into groups, what is left over is
// named, and the drawing shows modes and inputs.
namespace linkwright::planar {

// A joint between two parts as the model has it, before it gets its place in a chain.
struct PartJoint {
  PartPoint first, second;
  bool slide = false;
  int joint = -1;  // -1: the slide of a pin in a slot
  int input = -1;
  bool used = false;
};
struct PartGear {
  int joint = 0, first = 0, second = 0, carrier = 0;  // parts
  double phase = 0, ratio = 1;
  std::array<int, 3> bodies{};  // first, second, carrier
  std::string key, name;        // "joint.teeth", "teeth"
  int strand = -1;              // of a belt: index into LinkagePlan::strands
  bool used = false;
};
struct PartPair {
  PlanPair pair;
  std::vector<int> parts;
  std::string key, name;
  bool used = false;
};

// A plan in the making.
struct PlanDraft {
  const Linkage& linkage;
  PlanResult result;
  std::vector<PartJoint> joints;
  std::vector<PartJoint> written;  // the joints before pins of several links were paired otherwise
  std::vector<PartGear> gears;
  std::vector<PartPair> pairs;
  // One a part.
  std::vector<std::optional<math::Pose>> start;    // poses in which the model shows the parts
  std::vector<bool> known;                         // placed by the groups so far
  std::vector<std::optional<DrivenAngle>> angles;  // angles of the parts that drives and gears alone turn

  LinkagePlan& plan() { return result.plan; }
  const LinkagePlan& plan() const { return result.plan; }
  std::size_t parts() const { return result.plan.parts.size(); }
  bool good() const { return result.problems.empty(); }
  const LinkageJoint& model(int joint) const { return linkage.joints[at(joint)]; }
  const std::string& body_name(int body) const { return linkage.bodies[at(body)].name; }
  void error(std::string key, std::string message, std::string hint) {
    result.problems.push_back(
        {Diagnostic::Severity::error, {}, {}, std::move(key), std::move(message), std::move(hint)});
  }
};

// plan_parts.cpp: the parts, their masses, and the joints and gears between them.
void find_parts(PlanDraft& d);
PartPoint on_part(const PlanDraft& d, const BodyPoint& p, double direction);
double gear_phase(const PlanDraft& d, const LinkageJoint& j);

// plan_groups.cpp: the groups in order, as far as parts can be placed.
void find_groups(PlanDraft& d);
PlanJoint chained(const PartJoint& joint, int before);
void place_group(PlanDraft& d, Group group);

// plan_angles.cpp: parts whose angles follow from gears and drives, as one group; the gear of a group; and
// gears that are left over, which repeat what others say or contradict them.
bool find_train(PlanDraft& d);
PlanGear gear_of_group(PlanDraft& d, const PartGear& gear, bool in_loop);
void check_left_gears(PlanDraft& d);

// plan_pairs.cpp: racks, strands and curved slots between parts; a part on one joint that such a pair moves;
// and pairs that are left over.
void add_rack(PlanDraft& d, int joint);
void add_curve(PlanDraft& d, int joint);
void add_slot(PlanDraft& d, int joint);
void add_geneva(PlanDraft& d, int joint);
void add_belts(PlanDraft& d);
bool find_follower(PlanDraft& d);
void check_left_pairs(PlanDraft& d);

// plan_cams.cpp: cams and their followers.
void add_cams(PlanDraft& d);

// plan_pins.cpp: pairs the links of a pin of several so that another one can be placed or a dyad closes;
// false where no other pairs would help. `find_shared_pins` says at the end what the pairs of the model
// carry.
bool pair_otherwise(PlanDraft& d);
void find_shared_pins(PlanDraft& d);
// The first free joint of a part to a known one; drives stay out of dyads.
PartJoint* to_known(PlanDraft& d, int part);
// Finds the points where the teeth of the gears mesh, as far as their wheels have one pin each on the
// carrier.
void find_meshes(PlanDraft& d);

// plan_general.cpp: the smallest group without closed form, or all parts as one instead of all groups.
bool find_general_group(PlanDraft& d);
void merge_groups(PlanDraft& d);
std::vector<int> unknown_parts(const PlanDraft& d);
// True if a joint or gear not used yet connects parts inside `chosen`, or one of them with known parts.
bool holds_chosen(const PlanDraft& d, const PartJoint& joint, const std::vector<bool>& chosen);
bool holds_chosen(const PlanDraft& d, const PartGear& gear, const std::vector<bool>& chosen);
bool holds_chosen(const PlanDraft& d, const PartPair& pair, const std::vector<bool>& chosen);
// Equations of these joints and gears.
int equations_of(const PlanDraft& d, const std::vector<bool>& chosen);

// plan.cpp: the twists of the torsion springs.
void find_twists(PlanDraft& d);

// plan_problems.cpp: why parts stay without a place, or joints without a use.
void find_problems(PlanDraft& d);

// plan_drawing.cpp: signs of the assembly modes, which the model names, else the start poses show, else plus;
// and the values of the driven joints in the start poses.
void find_modes(PlanDraft& d);
void find_drawn_inputs(PlanDraft& d);

}  // namespace linkwright::planar
