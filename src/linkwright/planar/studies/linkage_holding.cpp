// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_holding.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/simulation/holding.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

struct HoldingTable {
  std::string drive, load;
};
template <class Visitor>
void fields(Visitor&& visit, HoldingTable& h) {
  visit(field::entry("drive", "joint whose drive holds the linkage; if absent the only one"), h.drive);
  visit(field::entry("load", "force whose size holds the linkage without a drive"), h.load);
}

// The ranges of an instant, found once for all columns.
struct HoldingInstant {
  HoldingInstant(const Linkage& l, const LinkagePlan& p, std::optional<std::size_t> unknown)
      : linkage(l), plan(p), load(unknown) {
    if (plan.inputs() == 1) forces.emplace(linkage, plan, load);
  }

  void find(const LinkageInstant& now) {
    std::vector<double> here;
    for (const InputMotion& input : now.inputs) here.push_back(input.value);
    if (is_found && here == values && now.time == time) return;
    values = here, time = now.time, is_found = true;
    if (forces) {
      range = forces->range(values[0], *now.motion, time);
      margin = forces->self_locking_margin(values[0], *now.motion, time);
      return;
    }
    const HeldLoad held = held_load(linkage, plan, *load, values, *now.motion, time);
    range = {held.status, held.least, held.greatest, nan};
    margin = held.margin;
  }

  const Linkage& linkage;
  const LinkagePlan& plan;
  std::optional<std::size_t> load;
  std::optional<HoldingForces> forces;
  bool is_found = false;
  std::vector<double> values;
  double time = 0;
  HoldingRange range;
  double margin = 0;
};

bool in_newtons(const LinkageStudy& s) { return s.holding->load || !s.plan.rotary[0]; }
std::string holding_key(const LinkageStudy& s, std::string_view which) {
  return fmt::format("holding_{}_{}", which, in_newtons(s) ? "N" : "N_m");
}

}  // namespace

std::optional<LinkageHolding> read_holding(study::ObjectReader& document, const Linkage& l,
                                           const LinkagePlan& plan, Value* canonical) {
  auto table = document.table("holding");
  if (!table) return std::nullopt;
  HoldingTable read;
  table->read(read);
  if (plan.inputs() != 1 && read.load.empty()) {
    table->error("drive",
                 fmt::format("the linkage has {} inputs; a drive alone holds one input", plan.inputs()),
                 "name a force as `load`, or leave [holding] out");
    return std::nullopt;
  }
  LinkageHolding holding;
  const std::string& joint = input_joint(l, 0).name;
  if (!read.drive.empty() && !read.load.empty()) {
    table->error("load", "a drive and a load are given, and one of them is unknown", "leave one out");
  } else if (!read.load.empty()) {
    std::vector<std::string_view> names;
    for (const PointForce& f : l.forces) names.push_back(f.name);
    const auto found = std::find(names.begin(), names.end(), read.load);
    if (found == names.end())
      table->no_such("load", "force", read.load, names);
    else
      holding.load = static_cast<std::size_t>(found - names.begin());
    if (holding.load && std::abs(l.forces[*holding.load].force) == 0)
      table->error("load", fmt::format("the force '{}' has no direction", read.load),
                   "give it the components of one newton");
  } else if (!read.drive.empty() && read.drive != joint) {
    table->error("drive", fmt::format("the drive is at '{}', not at '{}'", joint, read.drive),
                 "name that joint, or leave the key out");
  }
  if (!plan.has_masses) require_masses(document, LinkageType::linkage, plan);
  if (canonical) {
    if (read.load.empty()) read.drive = joint;
    *canonical = Value::object();
    study::ObjectWriter writer(*canonical);
    if (read.load.empty())
      writer(field::entry("drive"), read.drive);
    else
      writer(field::entry("load"), read.load);
  }
  return holding;
}

void describe_holding(study::SchemaWriter& document) {
  document.property(field::entry("holding", "drive or load with which friction holds the linkage at rest"),
                    study::schema_fields<HoldingTable>());
}

void add_holding_columns(const LinkageStudy& s, std::vector<LinkageColumn>& columns) {
  const auto instant = std::make_shared<HoldingInstant>(s.linkage, s.plan, s.holding->load);
  const std::string unit = in_newtons(s) ? "N" : "N m";
  const std::string what = s.holding->load    ? "force " + s.linkage.forces[*s.holding->load].name
                           : s.plan.rotary[0] ? "drive torque"
                                              : "drive force";
  const auto add = [&](std::string key, std::string label, double (*value)(const HoldingInstant&)) {
    columns.push_back({std::move(key), std::move(label), [instant, value](const LinkageInstant& now) {
                         instant->find(now);
                         return value(*instant);
                       }});
  };
  add(holding_key(s, "least"), fmt::format("least {} that holds ({})", what, unit),
      [](const HoldingInstant& i) { return i.range.least; });
  add(holding_key(s, "greatest"), fmt::format("greatest {} that holds ({})", what, unit),
      [](const HoldingInstant& i) { return i.range.greatest; });
  add("self_locking_margin", "self-locking margin", [](const HoldingInstant& i) { return i.margin; });
}

void add_holding_facts(const LinkageStudy& s, study::Result& result) {
  const study::AddFact fact{result.facts};
  const Table& table = result.tables[0];
  const Column *least = table.find(holding_key(s, "least")),
               *greatest = table.find(holding_key(s, "greatest")),
               *margin = table.find("self_locking_margin"),
               *input = table.find(input_key(s.linkage, s.plan, 0));
  if (!least || !greatest || !margin || !input) return;
  const auto force = [&](double value) { return study::torque_or_force(value, !in_newtons(s), 5); };
  const auto where = [&](std::size_t row) {
    Sentence out;
    for (std::size_t k = 0; k < s.plan.inputs(); ++k)
      if (const Column* axis = table.find(input_key(s.linkage, s.plan, k)))
        out += say("{}{}", k ? ", " : "", input_place(s.linkage, s.plan, k, axis->values[row], 6));
    return out;
  };
  const auto place = [&](double value) { return study::angle_or_length(value, s.plan.rotary[0], 5); };
  const auto known = [](double v) { return std::isfinite(v); };
  const auto extreme = [&](const Column& column, double sense) -> std::optional<std::size_t> {
    std::optional<std::size_t> out;
    for (std::size_t r = 0; r < column.values.size(); ++r)
      if (known(column.values[r]) && (!out || sense * column.values[r] > sense * column.values[*out]))
        out = r;
    return out;
  };
  if (const auto row = extreme(*least, -1))
    fact("least that holds", say("{} at {}", force(least->values[*row]), where(*row)));
  if (const auto row = extreme(*greatest, 1))
    fact("greatest that holds", say("{} at {}", force(greatest->values[*row]), where(*row)));
  std::size_t jammed = 0;
  for (std::size_t r = 0; r < table.rows(); ++r)
    jammed += std::isinf(least->values[r]) || std::isinf(greatest->values[r]);
  if (jammed > 0)
    fact("holds any load",
         say("on one side or both in {} of {} positions: it jams, since friction grows with the load", jammed,
             table.rows()));
  if (s.plan.inputs() > 1) {
    const auto held =
        std::count_if(margin->values.begin(), margin->values.end(), [](double v) { return v >= 1; });
    if (const auto row = extreme(*margin, -1))
      fact("locks by itself", say("in {} of {} positions; the least margin is {} at {}", held, table.rows(),
                                  plain_number(margin->values[*row]), where(*row)));
    return;
  }
  // Stretches of rows that lock by themselves; their ends where the margin between two rows is 1.
  const std::vector<double>&m = margin->values, &x = input->values;
  const auto edge = [&](std::size_t a, std::size_t b) {
    if (!known(m[a]) || !known(m[b]) || m[a] == m[b]) return x[m[a] >= 1 ? a : b];
    return x[a] + (1 - m[a]) / (m[b] - m[a]) * (x[b] - x[a]);
  };
  Sentence text;
  for (std::size_t r = 0; r < m.size(); ++r) {
    if (!(m[r] >= 1)) continue;
    std::size_t end = r;
    while (end + 1 < m.size() && m[end + 1] >= 1) ++end;
    const double from = r > 0 ? edge(r - 1, r) : x[r], to = end + 1 < m.size() ? edge(end, end + 1) : x[end];
    text += from == to ? say("{}at {}", text.empty() ? "" : ", ", place(from))
                       : say("{}from {} to {}", text.empty() ? "" : ", ", place(from), place(to));
    r = end;
  }
  if (!text.empty()) {
    fact("locks by itself", text);
  } else if (const auto row = extreme(*margin, 1)) {
    fact("locks by itself",
         say("nowhere; its margin is {} at most, at {}", plain_number(m[*row]), where(*row)));
  }
}

}  // namespace linkwright::planar
