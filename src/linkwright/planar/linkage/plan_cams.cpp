// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/planar/linkage/detail/cam_follower.h"
#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

// The coordinate of the moved joint where the programme is 0; nothing, and the problem reported, where there
// is none.
std::optional<double> offset_of(PlanDraft& d, int cam, const std::vector<double>& known) {
  const LinkageCam& c = d.linkage.cams[at(cam)];
  const std::string key = "cam." + c.name, &moves = d.model(c.moves).name;
  CamFollower follower(d.linkage, cam, known);
  if (!follower.problems().empty()) {
    d.error(key,
            fmt::format("without its cam, the follower of '{}' is not moved by joint '{}' alone: {}", c.name,
                        moves, to_string(follower.problems().front().message)),
            "correct that first; the cam takes the place of a drive at this joint");
    return std::nullopt;
  }
  if (!c.base_radius) {
    if (const auto drawn = follower.drawn()) return drawn;
    d.error(key, fmt::format("the base circle of cam '{}' is not known", c.name),
            "give base_radius_mm; or draw the linkage (drawn = true) with the follower on the base circle");
    return std::nullopt;
  }
  const auto found = follower.on_base_circle(*c.base_radius);
  if (!found)
    d.error(key,
            fmt::format("the follower of cam '{}' does not come to its base circle of {:.6g} mm{}", c.name,
                        *c.base_radius * 1e3,
                        c.roller() > 0 ? fmt::format(" with a roller of {:.6g} mm", c.roller() * 1e3) : ""),
            "change the radius, or the place of the cam or of its follower");
  return found;
}

}  // namespace

void add_cams(PlanDraft& d) {
  std::vector<double> offsets;
  for (int k = 0; k < static_cast<int>(d.linkage.cams.size()); ++k) {
    const LinkageCam& c = d.linkage.cams[at(k)];
    const LinkageJoint &turns = d.model(c.turns), &moves = d.model(c.moves);
    const std::string key = "cam." + c.name;
    const auto bodies = bodies_of(d.linkage, c);
    if (!bodies)
      return d.error(
          key,
          fmt::format("no body carries both cam and follower: '{}' joins '{}' and '{}', '{}' joins "
                      "'{}' and '{}'",
                      turns.name, d.body_name(turns.first.body), d.body_name(turns.second.body), moves.name,
                      d.body_name(moves.first.body), d.body_name(moves.second.body)),
          "name joints that have one body in common");
    const auto is_driven = [&](int joint) {
      return std::find(d.linkage.driven.begin(), d.linkage.driven.end(), joint) != d.linkage.driven.end();
    };
    if (is_driven(c.turns) && is_driven(c.moves))
      return d.error(key,
                     fmt::format("two drives on one degree of freedom: '{}' and '{}', which cam '{}' couples",
                                 turns.name, moves.name, c.name),
                     "leave out one of the drives, or the cam");
    const bool slide = moves.type == JointType::prismatic;
    CamPair pair{.base = on_part(d, bodies->base, 0),
                 .cam = on_part(d, bodies->cam, 0),
                 .moved_first = on_part(d, moves.first, slide ? moves.slide_first : 0),
                 .moved_second = on_part(d, moves.second, slide ? moves.slide_second : 0),
                 .contact = on_part(d, c.contact, c.face_direction),
                 .cam_body = bodies->cam.body,
                 .joint = c.moves,
                 .slide = slide,
                 .sense = c.sense(),
                 .phase = c.phase,
                 .scale = d.plan().size,
                 .is_flat = c.face == FollowerFace::flat,
                 .roller = c.roller(),
                 .is_sector = c.programme.is_sector,
                 .programme = ProgrammeCurve(c.programme)};
    if (c.form == CamForm::conjugate)
      pair.second_contact = on_part(d, c.second_contact, 0), pair.second_roller = c.second_roller_radius;
    if (pair.contact.part == pair.cam.part || pair.contact.part == pair.base.part)
      return d.error(
          key,
          fmt::format("the contact of cam '{}' is on '{}', which {}", c.name, d.body_name(c.contact.body),
                      pair.contact.part == pair.cam.part ? "is the cam" : "carries the cam"),
          "name a point of the body that touches the cam");
    const auto offset = offset_of(d, k, offsets);
    if (!offset) return;
    pair.offset = *offset;
    offsets.push_back(*offset);
    PartPair& added = d.pairs.emplace_back();
    added.pair.cam = k;
    added.pair.kind.emplace<CamPair>(pair);
    added.parts = {pair.cam.part, pair.moved_second.part, pair.moved_first.part, pair.base.part};
    if (added.parts[1] == pair.base.part) std::swap(added.parts[1], added.parts[2]);
    added.key = key;
    added.name = c.name;
    d.plan().cams.push_back(std::move(pair));
  }
}

}  // namespace linkwright::planar
