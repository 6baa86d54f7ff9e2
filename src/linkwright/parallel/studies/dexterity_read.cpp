// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/parallel/studies/dexterity.h"
#include "linkwright/parallel/studies/templates.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"

namespace linkwright::parallel {
namespace {

std::array<int, 3> three(const std::vector<int>& v, std::array<int, 3> rest) {
  for (std::size_t i = 0; i < v.size() && i < 3; ++i) rest[i] = v[i];
  return rest;
}

PiTravelTask pi_task(const PiTravelForm& f) {
  PiTravelTask out;
  if (f.mounting) out.mounting = {f.mounting->lower, f.mounting->upper};
  if (f.ratio) out.ratio = {f.ratio->lower, f.ratio->upper};
  out.mirror = f.mirrored ? -1 : 1;
  out.limits = requirements_of(f);
  return out;
}

study::Kind kind_of(RobotFamily family) {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = fmt::format("parallel.{}", name_of(family));
  kind.target = "region";
  kind.seeded = true;
  kind.summary = fmt::format("dimensions of a {} for a region: most dexterous, or smallest within limits",
                             family == RobotFamily::delta  ? "DELTA robot"
                             : family == RobotFamily::hexa ? "HEXA robot"
                                                           : "planar five-bar robot");
  kind.example = family == RobotFamily::delta  ? templates::synthesis_delta_region()
                 : family == RobotFamily::hexa ? templates::synthesis_hexa_region()
                                               : templates::synthesis_five_bar_region();
  kind.schema = [family](study::SchemaWriter& document) {
    study::SchemaWriter mechanism;
    for (const FamilyDimension& d : dimensions(family))
      mechanism(field::of(d.is_angle ? Dimension::angle : Dimension::length, d.name, d.summary)
                    .between(0, 1e6)
                    .required(),
                Range{});
    document.property(field::entry("mechanism", "dimensions, fixed numbers or design variables").required(),
                      std::move(mechanism).finish());
    document.property(field::entry("target", "the region and what is wanted there").required(),
                      study::schema_fields<RegionForm>());
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<DexterityOptimiser>());
  };
  kind.prepare = [family](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_dexterity_study(document, family, prepared.canonical))
      prepared.run = [s = *std::move(s), common](RunContext& context) {
        return run_dexterity_study(s, common, context);
      };
    return prepared;
  };
  return kind;
}

}  // namespace

std::optional<DexterityStudy> read_dexterity_study(study::ObjectReader& document, RobotFamily family,
                                                   Value& canonical) {
  DexterityStudy out;
  DexterityTask& task = out.task;
  task.family = family;
  task.mode = elbows_out(family);
  auto mechanism = document.table(field::entry("mechanism").required());
  auto target = document.table(field::entry("target").required());
  RegionForm form;
  if (family == RobotFamily::five_bar) form.shape = RegionShape::rectangle;
  Value written = Value::object();
  if (mechanism)
    for (const FamilyDimension& d : dimensions(family)) {
      Range range;
      const Field field = field::of(d.is_angle ? Dimension::angle : Dimension::length, d.name, d.summary)
                              .between(0, 1e6)
                              .required();
      (*mechanism)(field, range);
      task.dimensions.push_back({range.lower, range.upper});
      study::ObjectWriter writer(written);
      writer(field, range);
    }
  if (target) target->read(form);
  DexterityOptimiser optimiser;
  if (auto table = document.table("optimiser")) table->read(optimiser);
  if (!mechanism || !target || document.document().has_errors()) return std::nullopt;
  const auto count = static_cast<std::size_t>(coordinates(form.shape));
  for (const auto& [key, list] : {std::pair{"nodes", &form.nodes}, std::pair{"cells", &form.cells}})
    if (list->size() != 3 && list->size() != count) {
      target->error(key, fmt::format("{} numbers for {} coordinates", list->size(), count));
      return std::nullopt;
    }
  task.region = {form.shape,
                 form.width,
                 form.length,
                 form.height,
                 form.symmetric && form.shape != RegionShape::box,
                 three(form.nodes, {5, 61, 5}),
                 three(form.cells, {8, 12, 5})};
  task.goal = form.goal;
  DexterityLimitsForm& l = form.limits;
  if (family != RobotFamily::delta && l.constraint) {
    if (auto limits = target->table("limits"))
      limits->error("constraint", "only the legs of a DELTA are parallelograms", "leave it out");
    return std::nullopt;
  }
  if (family == RobotFamily::delta) {
    l.constraint = l.constraint.value_or(task.limits.constraint);
    task.limits.constraint = *l.constraint;
  }
  task.limits.conditioning = l.conditioning;
  task.limits.input = l.input;
  task.limits.output = l.output;
  task.limits.transmission = l.transmission;
  if (task.goal == DexterityGoal::size && !size_is_limited(task.limits)) {
    constexpr double usual = 0.3;
    l.transmission = task.limits.transmission = usual;
    out.transmission_put_in = true;
  }
  if (l.arm_travel) task.limits.arm_travel = *l.arm_travel;
  if (l.side_swing) task.limits.side_swing = *l.side_swing;
  if (l.size) task.limits.size = *l.size;
  if (family == RobotFamily::hexa) {
    const DesignRange& radius = task.dimensions[2];
    task.length = 0.5 * (radius.lower + radius.upper);
  }
  if (form.pi_joint) task.pi_joint = pi_task(*form.pi_joint);
  if (const auto wrong = problem(task)) {
    target->error("type", *wrong);
    return std::nullopt;
  }
  // Coordinates, place and weight of a point, copied once, and its place and indices as they are measured.
  constexpr double bytes_of_point = 2 * sizeof(RegionPoint) + 6 * sizeof(Vec3);
  for (const auto& [key, counts] :
       {std::pair{"nodes", &task.region.nodes}, std::pair{"cells", &task.region.cells}}) {
    double points = 1;
    for (std::size_t k = 0; k < count; ++k) points *= (*counts)[k];
    if (!study::require_memory(*target, key, bytes_of_point * points, fmt::format("{:.0f} {}", points, key),
                               fmt::format("take fewer {}", key)))
      return std::nullopt;
  }
  out.method = optimiser.method;
  canonical["mechanism"] = written;
  canonical["target"] = study::write_fields(form);
  canonical["optimiser"] = study::write_fields(optimiser);
  return out;
}

std::vector<study::Kind> dexterity_kinds() {
  return {kind_of(RobotFamily::delta), kind_of(RobotFamily::hexa), kind_of(RobotFamily::five_bar)};
}

}  // namespace linkwright::parallel
