// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/suspension/corner/plausibility.h"
#include "linkwright/suspension/studies/indirect.h"
#include "linkwright/suspension/studies/templates.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_poses = 2000;

bool open_box(const PointBox& box) { return !(box.lower == box.upper); }

/// The coordinate along which an axis runs most.
void give_along(PointBox& box, const Vec3& at, const Vec3& axis) {
  const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
  if (x >= y && x >= z)
    box.lower.x = box.upper.x = at.x;
  else if (y >= z)
    box.lower.y = box.upper.y = at.y;
  else
    box.lower.z = box.upper.z = at.z;
}

bool fully_open(const PointBox& b) {
  return b.lower.x != b.upper.x && b.lower.y != b.upper.y && b.lower.z != b.upper.z;
}

/// Two points of an axis, and the point of a strut, may slide along it: where a study leaves all their
/// coordinates open, the one along the axis stays where the box is.
void settle_axes(LinkTask& task, const CornerLink& start) {
  for (auto [boxes, points] : {std::pair{&task.body, &start.body}, std::pair{&task.carrier, &start.carrier}})
    if (points->size() == 2)
      for (std::size_t i = 0; i < 2; ++i)
        if (fully_open((*boxes)[i])) give_along((*boxes)[i], (*points)[i], (*points)[1] - (*points)[0]);
  if (task.type == LinkType::SP && fully_open(task.carrier[0]))
    give_along(task.carrier[0], start.carrier[0], start.carrier[0] - start.body[0]);
}

PointBox mirrored_box(const PointBox& b) {
  return {{b.lower.x, -b.upper.y, b.lower.z}, {b.upper.x, -b.lower.y, b.upper.z}};
}

/// Targets of the study as those of a left wheel.
void mirror(IndirectTask& task) {
  CarrierTargets& t = task.targets;
  t.wheel.centre = math::mirrored(t.wheel.centre);
  t.rack_direction = math::mirrored(t.rack_direction);
  for (CarrierTarget& pose : t.poses) pose.centre = math::mirrored(pose.centre);
  for (LinkTask& link : task.links)
    for (auto* boxes : {&link.body, &link.carrier})
      for (PointBox& box : *boxes) box = mirrored_box(box);
  for (CouplerTask& c : task.couplers) c.point = mirrored_box(c.point);
}

void read_poses(study::ObjectReader& target, const study::Common& common, IndirectTask& task,
                PosesTarget& form) {
  target.read(form);
  if (form.file.has_value() == form.poses.has_value()) {
    target.error(form.file ? "file" : "pose",
                 form.file ? "positions are also given here" : "the target has no positions",
                 "write file = \"poses.csv\", or [[target.pose]]");
    return;
  }
  if (form.file) {
    const auto text = study::read_beside(target, "file", common.folder, *form.file);
    if (!text) return;
    Diagnostics problems;
    const std::optional<Table> table = read_csv(*text, *form.file, problems);
    std::optional<CarrierTargets> targets;
    if (table) targets = carrier_targets(task.targets, *table, *form.file, problems);
    for (const Diagnostic& d : problems) target.unreadable("file", study::in_file(d));
    if (targets) task.targets = std::move(*targets);
  } else {
    for (const PoseEntry& p : *form.poses)
      task.targets.poses.push_back({p.rack,
                                    {p.centre[0], p.centre[1], p.centre[2]},
                                    {p.toe, p.camber, p.carrier_pitch.value_or(std::nan(""))}});
  }
  const char* key = form.file ? "file" : "pose";
  if (task.targets.poses.size() > max_poses)
    target.error(key,
                 fmt::format("{} positions, at most {} are allowed", task.targets.poses.size(), max_poses));
  for (const Diagnostic& d : implausible(task.targets))
    d.severity == Diagnostic::Severity::error ? target.error(key, to_string(d.message), to_string(d.hint))
                                              : target.warning(key, to_string(d.message), to_string(d.hint));
  const bool elsewhere = std::any_of(
      task.targets.poses.begin(), task.targets.poses.end(),
      [&](const CarrierTarget& p) { return !(p.centre == task.targets.wheel.centre && p.rack == 0); });
  if (!elsewhere && !target.document().has_errors())
    target.error(key, "no position besides the reference", "list the positions that the carrier is to take");
}

}  // namespace

std::optional<IndirectStudy> read_indirect_study(study::ObjectReader& document, const study::Common& common,
                                                 Value& canonical) {
  IndirectStudy s;
  const auto description = read_suspension(document, common, OpenPoints::boxes);
  PosesTarget form;
  if (description) {
    s.description = *description;
    const Suspension& suspension = description->suspension;
    s.task.targets.wheel = suspension.wheel;
    s.task.targets.rack_direction = suspension.rack_direction;
    s.task.links = description->links;
    s.task.couplers = description->couplers;
    bool open = std::any_of(s.task.couplers.begin(), s.task.couplers.end(),
                            [](const CouplerTask& c) { return open_box(c.point); });
    for (std::size_t i = 0; i < s.task.links.size(); ++i) {
      settle_axes(s.task.links[i], suspension.links[i]);
      const LinkTask& l = s.task.links[i];
      open = open || std::any_of(l.body.begin(), l.body.end(), open_box) ||
             std::any_of(l.carrier.begin(), l.carrier.end(), open_box);
    }
    auto mechanism = document.table("mechanism");
    if (!open)
      mechanism->error("link", "there is no design variable: all points are given",
                       "write body_m = { near = [x, y, z], box_m = 0.15 } for a point to be found");
    for (const Coupler& c : suspension.couplers)
      if (c.begin)
        mechanism->error(
            "coupler",
            fmt::format("'{}' begins off the line of its first link: this synthesis takes it on the line",
                        c.name),
            "give fraction or offset instead of first_point");
    for (const CornerLink& l : suspension.links)
      if (l.length)
        mechanism->error(
            "link", fmt::format("'{}' has a length: in this synthesis it follows from its points", l.name),
            "remove length");
  }
  if (auto target = document.table(field::entry("target").required()))
    read_poses(*target, common, s.task, form);
  if (auto optimiser = document.table("optimiser")) optimiser->read(s.optimiser);
  s.lists = read_lists(document, description);
  if (!description || document.document().has_errors()) return std::nullopt;

  if (!s.lists.empty()) canonical["list"] = write_lists(s.lists);
  canonical["mechanism"] = write_suspension(s.description);
  PosesTarget resolved{.file = {}, .poses = std::vector<PoseEntry>{}};
  for (const CarrierTarget& p : s.task.targets.poses) {
    PoseEntry entry{.rack = p.rack,
                    .centre = {p.centre.x, p.centre.y, p.centre.z},
                    .toe = p.angles.toe,
                    .camber = p.angles.camber,
                    .carrier_pitch = {}};
    if (std::isfinite(p.angles.carrier_pitch)) entry.carrier_pitch = p.angles.carrier_pitch;
    resolved.poses->push_back(entry);
  }
  canonical["target"] = study::write_fields(resolved);
  canonical["optimiser"] = study::write_fields(s.optimiser);
  s.description.links = s.task.links;
  if (s.description.suspension.side == Side::right) mirror(s.task);
  return s;
}

study::Kind indirect_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "suspension.corner";
  kind.target = "carrier_poses";
  kind.summary = "wheel suspension whose carrier takes prescribed positions (indirect synthesis)";
  kind.seeded = true;
  kind.example = templates::synthesis_corner_carrier_poses();
  kind.schema = [](study::SchemaWriter& document) {
    describe_suspension(document);
    document.property(field::entry("target", "positions of the carrier").required(),
                      study::schema_fields<PosesTarget>());
    document.property(field::entry("optimiser", "how links are searched"),
                      study::schema_fields<IndirectOptimiser>());
    describe_lists(document);
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_indirect_study(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s), common](RunContext& context) {
        return run_indirect_study(s, common, context);
      };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::suspension
