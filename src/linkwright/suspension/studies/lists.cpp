// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/lists.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::suspension {
namespace {

/// Points nearer than this are one point (m): what is left when a list's frame was turned into the vehicle's.
constexpr double same_point = 1e-9;

PointFrame frame_of(const ListForm& l) {
  PointFrame out;
  out.x = l.x.value_or(out.x);
  out.y = l.y.value_or(out.y);
  out.z = l.z.value_or(out.z);
  if (l.origin) out.origin = {(*l.origin)[0], (*l.origin)[1], (*l.origin)[2]};
  return out;
}

/// The points of a suspension in the vehicle's frame with the names of the list that they were read from.
std::vector<HardPoint> listed_points(const CornerDescription& d, const Suspension& suspension) {
  std::vector<HardPoint> out = points_of(suspension);
  if (!d.list) return out;
  const std::vector<HardPoint> read = points_of(d.suspension);
  for (std::size_t i = 0; i < out.size() && i < read.size(); ++i)
    for (const ListedPoint& p : d.list->list.points)
      if (norm(to_vehicle(d.frame, p.point.at) - read[i].at) < same_point) {
        out[i].name = p.label;
        break;
      }
  // A point that two parts share is one point of the list as long as both have it at one place.
  std::vector<HardPoint> once;
  for (HardPoint& p : out) {
    const auto same = [&](const HardPoint& o) { return plain_name(o.name) == plain_name(p.name); };
    const auto first = std::find_if(once.begin(), once.end(), same);
    if (first != once.end() && first->at == p.at) continue;
    const std::string base = p.name;
    for (int n = 2; std::any_of(once.begin(), once.end(), same); ++n) p.name = fmt::format("{} {}", base, n);
    once.push_back(std::move(p));
  }
  return once;
}

}  // namespace

std::vector<ListForm> read_lists(study::ObjectReader& document,
                                 const std::optional<CornerDescription>& description) {
  std::vector<ListForm> lists;
  document(field::entry("list"), lists);
  const PointFrame frame = description ? description->frame : PointFrame{};
  std::vector<study::ObjectReader> tables = document.tables("list");
  for (std::size_t i = 0; i < lists.size(); ++i) {
    ListForm& l = lists[i];
    l.unit = l.unit.value_or(description ? description->unit : PointUnit::mm);
    l.x = l.x.value_or(frame.x);
    l.y = l.y.value_or(frame.y);
    l.z = l.z.value_or(frame.z);
    if (!l.origin) l.origin = {frame.origin.x, frame.origin.y, frame.origin.z};
    if (const std::string bad = problem(frame_of(l)); !bad.empty() && i < tables.size())
      tables[i].error("x", bad, "for example x = \"rearward\", y = \"right\", z = \"up\"");
  }
  return lists;
}

Value write_lists(const std::vector<ListForm>& lists) {
  Value out = Value::array();
  for (const ListForm& l : lists) out.push_back(study::write_fields(l));
  return out;
}

void describe_lists(study::SchemaWriter& document) {
  document.property(field::entry("list", "lists of hard points that are written for CAD and other programs"),
                    study::schema_array(study::schema_fields<ListForm>()));
}

void add_lists(study::Result& result, const std::vector<ListForm>& lists,
               const CornerDescription& description, const Suspension& suspension,
               const CornerDescription* other) {
  for (const ListForm& l : lists) {
    const PointFrame frame = frame_of(l);
    std::vector<HardPoint> points;
    const auto add = [&](const CornerDescription& d, const Suspension& of, std::string_view prefix) {
      for (HardPoint p : listed_points(d, of)) {
        p.name.insert(0, prefix);
        // A property file calls points of the right side alone so.
        if (l.format == ListFormat::property && of.side == Side::right) p.name += " right";
        points.push_back({std::move(p.name), from_vehicle(frame, p.at)});
      }
    };
    add(description, suspension, "");
    if (other) add(*other, other->suspension, "other wheel ");
    const bool text = l.format == ListFormat::text || l.format == ListFormat::property;
    std::string name = fmt::format("list-{}", name_of(l.format));
    const auto same = std::count_if(result.files.begin(), result.files.end(),
                                    [&](const study::ResultFile& f) { return f.name.starts_with(name); });
    if (same > 0) name += fmt::format("-{}", same + 1);
    result.files.push_back({name + (text                           ? ".txt"
                                    : l.format == ListFormat::json ? ".json"
                                                                   : ".csv"),
                            write_hard_points(points, l.format, l.unit.value_or(PointUnit::mm))});
  }
}

void add_list_of_found(study::Result& result, const CornerDescription& d, const Suspension& found) {
  if (!d.list) return;
  const std::vector<HardPoint> before = points_of(d.suspension), after = points_of(found);
  std::vector<Vec3> at;
  std::vector<bool> listed(before.size());
  for (const ListedPoint& p : d.list->list.points) {
    at.push_back(p.point.at);
    const Vec3 place = to_vehicle(d.frame, p.point.at);
    for (std::size_t i = 0; i < before.size() && i < after.size(); ++i) {
      if (!(norm(before[i].at - place) < same_point)) continue;
      listed[i] = true;
      if (!(before[i].at == after[i].at)) at.back() = from_vehicle(d.frame, after[i].at);
    }
  }
  result.files.push_back({"list-" + d.list->file, write_hard_points(d.list->list, at)});
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i)
    if (!listed[i] && !(before[i].at == after[i].at))
      study::AddWarning{result.diagnostics}(
          fmt::format("{} has no point where {} was at the start: it is not in list-{}", d.list->file,
                      before[i].name, d.list->file),
          "the table hard_points has it, in the vehicle's frame");
}

}  // namespace linkwright::suspension
