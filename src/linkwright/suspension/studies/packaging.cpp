// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/packaging.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/studies/values.h"

namespace linkwright::suspension {
namespace {

constexpr std::string_view spring_word = "spring", shaft_word = "half_shaft", tyre_word = "tyre";

int link_named(const Suspension& suspension, const std::string& name) {
  for (std::size_t i = 0; i < suspension.links.size(); ++i)
    if (suspension.links[i].name == name) return static_cast<int>(i);
  return -1;
}

bool holds_ball(const CornerLink& link, LinkEnd end) {
  using enum LinkType;
  const LinkType t = link.type;
  return end == LinkEnd::carrier ? t == US || t == SS || t == RS : t == SS || t == SR;
}

/// The lines of a part that a clearance names.
std::vector<Segment> lines_named(const Suspension& suspension, const CornerPlan& plan,
                                 const PackagingForm& packaging, const std::string& name,
                                 const CornerPosition& position) {
  const auto place = [&](const PartPoint& point) {
    return place_of(plan, point, position.place, position.input.rack);
  };
  if (const int link = link_named(suspension, name); link >= 0) return lines_of(plan, link, position);
  if (name == spring_word && plan.spring) return {{place(plan.spring->first), place(plan.spring->second)}};
  const CarrierPose& carrier = position.place.carrier;
  const HalfShaft shaft = shaft_of(*packaging.half_shaft);
  return {{shaft.inner, carrier.centre + carrier.rotation * (shaft.outer - plan.wheel.centre)}};
}

const BoxForm* box_named(const PackagingForm& packaging, const std::string& name) {
  const auto found = std::find_if(packaging.boxes.begin(), packaging.boxes.end(),
                                  [&](const BoxForm& box) { return box.name == name; });
  return found == packaging.boxes.end() ? nullptr : &*found;
}

/// Clearance of two parts at a position.
double clearance_at(const Suspension& suspension, const CornerPlan& plan, const PackagingForm& packaging,
                    const ClearanceForm& c, const CornerPosition& position) {
  double least = std::numeric_limits<double>::infinity();
  if (const BoxForm* form = box_named(packaging, c.second)) {
    const Box box = box_of(*form);
    if (c.first == tyre_word)
      return distance(tyre_circle(plan, *packaging.tyre_width, position), box) - *packaging.tyre_width / 2;
    for (const Segment& a : lines_named(suspension, plan, packaging, c.first, position))
      least = std::min(least, distance(a, box));
    return least - c.first_radius;
  }
  for (const Segment& a : lines_named(suspension, plan, packaging, c.first, position)) {
    if (c.second == tyre_word) {
      const TyreCircle tyre = tyre_circle(plan, *packaging.tyre_width, position);
      least = std::min(least, distance(a, tyre.centre, tyre.axis, tyre.radius) - *packaging.tyre_width / 2);
      continue;
    }
    for (const Segment& b : lines_named(suspension, plan, packaging, c.second, position))
      least = std::min(least, distance(a, b) - c.second_radius);
  }
  return least - c.first_radius;
}

/// Columns with their extremes.
class Packaging {
 public:
  Packaging(study::Result& result, std::span<const CornerPosition> positions)
      : result_(result), table_(result.tables.front()), positions_(positions) {}

  /// An angle or a plunge, whose size must not pass `limit`.
  template <class Value>
  void add_limited(std::string key, std::string label, const Sentence& words, bool is_angle,
                   std::optional<double> limit, Value&& value) {
    study::Extreme most;
    std::vector<double> column = column_of(value);
    for (std::size_t i = 0; i < column.size(); ++i)
      if (std::isfinite(column[i])) most.greatest(std::abs(column[i]), i);
    table_.add(std::move(key), std::move(label), std::move(column));
    if (most.any()) report("greatest " + words, is_angle, most, limit && most.value > *limit, limit);
  }

  /// A clearance, which must not be below `limit`.
  template <class Value>
  void add_clearance(std::string key, std::string label, const Sentence& words, double limit, Value&& value) {
    study::Extreme least;
    std::vector<double> column = column_of(value);
    for (std::size_t i = 0; i < column.size(); ++i)
      if (std::isfinite(column[i])) least.least(column[i], i);
    table_.add(std::move(key), std::move(label), std::move(column));
    if (least.any()) report("least " + words, false, least, least.value < limit, limit);
  }

 private:
  template <class Value>
  std::vector<double> column_of(Value&& value) const {
    std::vector<double> out;
    for (const CornerPosition& p : positions_)
      out.push_back(p.status == Status::done ? value(p) : WheelParameters::missing);
    return out;
  }
  void report(const Sentence& words, bool is_angle, const study::Extreme& extreme, bool passed,
              std::optional<double> limit) {
    const auto shown = [&](double v) { return is_angle ? degrees_of(v).fixed(2) : millimetres(v).fixed(2); };
    const CornerPosition& at = positions_[extreme.row];
    const Sentence place =
        say("travel {}, rack {}", millimetres(table_.find("travel_m")->values[extreme.row], 4),
            millimetres(at.input.rack, 4));
    study::AddFact{result_.facts}(words, say("{}, at {}", shown(extreme.value), place),
                                  passed ? study::Fact::Verdict::bad : study::Fact::Verdict::plain);
    if (passed)
      study::AddWarning{result_.diagnostics}(
          "packaging",
          say("{} is {} at {}; the limit is {}", words, shown(extreme.value), place, shown(*limit)), {});
  }

  study::Result& result_;
  Table& table_;
  std::span<const CornerPosition> positions_;
};

void check_boxes(study::ObjectReader& table, const PackagingForm& packaging, const Suspension& suspension) {
  std::vector<study::ObjectReader> tables = table.tables("box");
  for (std::size_t i = 0; i < packaging.boxes.size() && i < tables.size(); ++i) {
    const BoxForm& box = packaging.boxes[i];
    for (std::size_t k = 0; k < 3; ++k)
      if (box.upper[k] < box.lower[k])
        tables[i].error("upper", fmt::format("is below lower along {}", "xyz"[k]), "exchange them");
    if (box_named(packaging, box.name) != &box || link_named(suspension, box.name) >= 0 ||
        box.name == spring_word || box.name == shaft_word || box.name == tyre_word)
      tables[i].error("name", fmt::format("another part is called '{}'", box.name), "give it another name");
  }
}

}  // namespace

HalfShaft shaft_of(const HalfShaftForm& form) {
  return {vector_of(form.inner), vector_of(form.outer), vector_of(form.inner_axis)};
}

Box box_of(const BoxForm& form) { return {vector_of(form.lower), vector_of(form.upper)}; }

void check_packaging(study::ObjectReader& document, const PackagingForm& packaging,
                     const Suspension& suspension) {
  auto table = document.table("packaging");
  std::vector<std::string_view> links;
  for (const CornerLink& link : suspension.links) links.emplace_back(link.name);
  const auto direction = [](study::ObjectReader& of, const char* key, const std::array<double, 3>& v) {
    if (norm(vector_of(v)) < 1e-9) of.error(key, "has no length", "give a direction, for example [0, 0, 1]");
  };
  if (packaging.half_shaft) {
    auto shaft = table->table("half_shaft");
    direction(*shaft, "inner_axis", packaging.half_shaft->inner_axis);
    if (norm(vector_of(packaging.half_shaft->outer) - vector_of(packaging.half_shaft->inner)) < 1e-6)
      shaft->error("outer", "is the same point as inner");
  }
  if (packaging.tyre_width && *packaging.tyre_width >= suspension.wheel.tyre_diameter)
    table->error("tyre_width", "is not below the diameter of the tyre");
  std::vector<study::ObjectReader> tables = table->tables("ball_joint");
  for (std::size_t i = 0; i < packaging.ball_joints.size() && i < tables.size(); ++i) {
    const BallJointForm& joint = packaging.ball_joints[i];
    const int link = link_named(suspension, joint.link);
    direction(tables[i], "stud", joint.stud);
    if (link < 0)
      tables[i].no_such("link", "link", joint.link, links);
    else if (const CornerLink& of = suspension.links[static_cast<std::size_t>(link)];
             !holds_ball(of, joint.end))
      tables[i].error("end", fmt::format("the {} link has no ball joint at the {}", name_of(of.type),
                                         name_of(joint.end)));
    else if (of.type == LinkType::SS)
      tables[i].error("link", "an SS link turns freely about its line, and so its studs have no angle",
                      "write type = \"US\"");
  }
  check_boxes(*table, packaging, suspension);
  tables = table->tables("clearance");
  for (std::size_t i = 0; i < packaging.clearances.size() && i < tables.size(); ++i) {
    const ClearanceForm& c = packaging.clearances[i];
    for (const auto& [key, name] : {std::pair{"first", &c.first}, std::pair{"second", &c.second}}) {
      const int link = link_named(suspension, *name);
      if (link >= 0) {
        const LinkType type = suspension.links[static_cast<std::size_t>(link)].type;
        if (type == LinkType::R || type == LinkType::S)
          tables[i].error(key,
                          fmt::format("the {} link has no line from the body to the carrier", name_of(type)));
      } else if (*name == spring_word) {
        if (!suspension.spring) tables[i].error(key, "there is no spring", "add [mechanism.spring]");
      } else if (*name == shaft_word) {
        if (!packaging.half_shaft)
          tables[i].error(key, "there is no half-shaft", "add [packaging.half_shaft]");
      } else if (*name == tyre_word && (name == &c.second || box_named(packaging, c.second))) {
        if (!packaging.tyre_width)
          tables[i].error(key, "the width of the tyre is missing", "write tyre_width_mm");
        const bool second = name == &c.second;
        if ((second ? c.second_radius : c.first_radius) != 0)
          tables[i].error(second ? "second_radius" : "first_radius", "a tyre has none",
                          "its width and diameter are enough");
      } else if (name == &c.second && box_named(packaging, *name)) {
        if (c.second_radius != 0) tables[i].error("second_radius", "a box has none", "make the box larger");
      } else {
        tables[i].no_such(key, "link or part", *name, links);
      }
    }
    if (c.first == c.second) tables[i].error("second", "is the same part as first");
  }
}

double packaging_columns(const PackagingForm& packaging) {
  return (packaging.half_shaft ? 4 : 0) +
         static_cast<double>(packaging.ball_joints.size() + packaging.clearances.size());
}

void add_packaging(study::Result& result, const Suspension& suspension, const CornerPlan& plan,
                   const PackagingForm& packaging, std::span<const CornerPosition> positions) {
  Packaging out(result, positions);
  if (const auto& form = packaging.half_shaft) {
    const HalfShaft shaft = shaft_of(*form);
    const auto state = [&](double HalfShaftState::*member) {
      return [&plan, shaft, member](const CornerPosition& p) { return half_shaft(plan, shaft, p).*member; };
    };
    out.add_limited("half_shaft_inner_angle_rad", "angle of the half-shaft's inner joint (rad)",
                    say("angle of the half-shaft's inner joint"), true, form->greatest_inner_angle,
                    state(&HalfShaftState::inner_angle));
    out.add_limited("half_shaft_outer_angle_rad", "angle of the half-shaft's outer joint (rad)",
                    say("angle of the half-shaft's outer joint"), true, form->greatest_outer_angle,
                    state(&HalfShaftState::outer_angle));
    out.add_limited("half_shaft_plunge_m", "plunge of the half-shaft, along its inner axis (m)",
                    say("plunge of the half-shaft"), false, form->greatest_plunge,
                    state(&HalfShaftState::plunge));
    out.add_limited("half_shaft_length_m", "distance of the half-shaft's joints (m)",
                    say("distance of the half-shaft's joints"), false, std::nullopt,
                    state(&HalfShaftState::length));
  }
  for (const BallJointForm& form : packaging.ball_joints) {
    const BallJoint joint{link_named(suspension, form.link), form.end == LinkEnd::carrier,
                          vector_of(form.stud)};
    const std::string words =
        fmt::format("angle of the ball joint of '{}' at the {}", form.link, name_of(form.end));
    out.add_limited(fmt::format("{}_{}_ball_joint_angle_rad", plain_name(form.link), name_of(form.end)),
                    words + " (rad)", Sentence(words), true, form.greatest_angle,
                    [&](const CornerPosition& p) { return ball_joint_angle(suspension, plan, joint, p); });
  }
  for (const ClearanceForm& c : packaging.clearances) {
    const std::string words = fmt::format("clearance of {} and {}", c.first, c.second);
    out.add_clearance(fmt::format("{}_to_{}_clearance_m", plain_name(c.first), plain_name(c.second)),
                      words + " (m)", Sentence(words), c.least, [&](const CornerPosition& p) {
                        return clearance_at(suspension, plan, packaging, c, p);
                      });
  }
}

}  // namespace linkwright::suspension
