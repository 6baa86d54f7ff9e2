// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "linkwright/optimise/population_methods.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/path/task.h"
#include "linkwright/planar/studies/path_points.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/kind.h"

// The path synthesis study of any mechanism: what its file holds (field lists) and how it is read. A
// description D says what is peculiar to a mechanism: a path mechanism with its choices, limits and words,
// beside it in this folder.
namespace linkwright::planar {

/// The senses of crank rotation along the points that are searched.
enum class SenseChoice { automatic, any, positive, negative };
constexpr std::array<EnumName<SenseChoice>, 4> names(SenseChoice) {
  return {{{SenseChoice::automatic, "automatic", "positive when crank angles are prescribed, else any"},
           {SenseChoice::any, "any", "both senses"},
           {SenseChoice::positive, "positive", "counter-clockwise, or as the prescribed angles say"},
           {SenseChoice::negative, "negative", "clockwise, or against the prescribed angles"}}};
}

/// A parameter of a mechanism in a study file and in the tables of a result.
struct ParameterWords {
  std::string_view summary, label;
};

/// `[mechanism.parameters]`: what is left out gets bounds from the path.
template <class Parameter, std::size_t count>
struct PathParameters {
  std::array<std::optional<Range>, count> ranges;
};
template <class Visitor, class Parameter, std::size_t count>
void fields(Visitor&& visit, PathParameters<Parameter, count>& p) {
  for (std::size_t j = 0; j < count; ++j) {
    const auto parameter = Parameter(j);
    Field field = field::of(is_angle(parameter) ? Dimension::angle : Dimension::length, name(parameter),
                            words(parameter)[j].summary);
    if (is_length(parameter)) field.minimum = 0;
    visit(field, p.ranges[j]);
  }
}

template <class D>
struct PathMechanismForm {
  typename D::BranchChoice branch{};
  SenseChoice sense = SenseChoice::automatic;
  typename D::Parameters parameters;
};
template <class Visitor, class D>
void fields(Visitor&& visit, PathMechanismForm<D>& m) {
  visit(field::entry("branch", D::branch_summary), m.branch);
  visit(field::entry("sense", "sense of crank rotation to search"), m.sense);
  visit(field::entry("parameters", "fixed numbers, or { min, max } for design variables"), m.parameters);
}

/// `[target]`: the point that traces, the criterion by which points are met, and the path.
template <class D>
struct PathTarget : PathTargetForm {
  typename D::TracingPoint point{};
  typename D::Fit fit{};
};
template <class Visitor, class D>
void fields(Visitor&& visit, PathTarget<D>& t) {
  visit(field::entry("point", "point that traces the path"), t.point);
  visit(field::entry("fit", "how the points are met"), t.fit);
  fields(visit, static_cast<PathTargetForm&>(t));
}

/// `[[objective]]`; several give a front.
template <class Type>
struct PathObjectiveEntry {
  Type type{};
  double weight = 1;
};
template <class Visitor, class Type>
void fields(Visitor&& visit, PathObjectiveEntry<Type>& o) {
  visit(field::entry("type", "what is minimised").required(), o.type);
  visit(field::entry("weight", names(Type{}).size() > 1
                                   ? "factor, where a method of one objective minimises the sum of both"
                                   : "factor")
            .positive(),
        o.weight);
}

struct CrankRotatesFully {};
template <class Visitor>
void fields(Visitor&&, CrankRotatesFully&) {}
constexpr Word choice_word(const CrankRotatesFully&) {
  return {"crank_rotates_fully", "the crank rotates fully"};
}

/// Always holds for an answer; a study may say so.
struct InOrder {};
template <class Visitor>
void fields(Visitor&&, InOrder&) {}
constexpr Word choice_word(const InOrder&) {
  return {"order", "the points are met one after the other within one turn (always required)"};
}

struct NoDefects {};
template <class Visitor>
void fields(Visitor&&, NoDefects&) {}
constexpr Word choice_word(const NoDefects&) {
  return {"no_defects", "leave out designs with branch, circuit or order defects"};
}

/// `[[constraint]]`: those of every mechanism and the limits of one.
template <class... Limits>
struct PathConstraint {
  std::variant<CrankRotatesFully, InOrder, Limits..., NoDefects> limit;
  bool enabled = true;
};
template <class Visitor, class... Limits>
void fields(Visitor&& visit, PathConstraint<Limits...>& c) {
  visit(field::entry("type", "what is limited").required(), c.limit);
  visit(field::entry("enabled", "false leaves it out"), c.enabled);
}

/// `[optimiser]`: the recommended method or a published one.
struct Recommended {
  PathSynthesisOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, Recommended& r) {
  fields(visit, r.options);
}
constexpr Word choice_word(const Recommended&) {
  return {"recommended", "separable form, global search, exact-gradient polish"};
}

/// A study as read.
template <class D>
struct PathStudy {
  PathMechanismForm<D> mechanism;
  PathTarget<D> target;
  std::vector<PathObjectiveEntry<typename D::Objective>> objectives;
  std::vector<typename D::Constraint> constraints;
  typename D::Optimiser optimiser;

  typename D::Problem problem;  ///< the problem that follows from the above
  bool front = false;           ///< several objectives
  bool no_defects = false;      ///< designs with defects are no answers
};

/// The seeds of a study that was run, and a diagram of a motion; see path_run.h.
template <class D>
struct PathRuns;
struct MotionPlot;

template <class D>
void set_bounds(study::ObjectReader& document, PathStudy<D>& s) {
  auto mechanism = document.table("mechanism");
  if (!mechanism || s.problem.x.size() < 3 || s.problem.x.size() != s.problem.y.size()) return;
  s.problem.bounds = D::bounds(s.problem.x, s.problem.y);
  const auto& ranges = s.mechanism.parameters.ranges;
  for (std::size_t j = 0; j < ranges.size(); ++j) {
    const auto parameter = typename D::Parameter(j);
    if (!ranges[j]) continue;
    s.problem.bounds[j] = *ranges[j];
    if (is_link(parameter) && ranges[j]->upper <= 0)
      mechanism->error("parameters", fmt::format("{} must be able to be longer than 0", name(parameter)));
  }
  if (const Timing mode = s.target.timing.mode; ranges.back() && !starts_anywhere(mode))
    mechanism->warning("parameters", fmt::format("start_angle is ignored: the timing is {}", name_of(mode)));
}

template <class D>
void set_constraints(study::ObjectReader& document, PathStudy<D>& s) {
  s.problem.crank_rotates_fully = false;
  for (const auto& constraint : s.constraints) {
    const auto set = [&](const auto& limit) {
      using Limit = std::decay_t<decltype(limit)>;
      if constexpr (std::is_same_v<Limit, CrankRotatesFully>)
        s.problem.crank_rotates_fully = true;
      else if constexpr (std::is_same_v<Limit, NoDefects>)
        s.no_defects = true;
      else if constexpr (!std::is_same_v<Limit, InOrder>)
        D::set_limit(document, limit, s.problem);
    };
    if (constraint.enabled)
      std::visit(set, constraint.limit);
    else if (std::holds_alternative<InOrder>(constraint.limit))
      document.error("constraint", "the order of the points cannot be given up",
                     "remove the constraint, or enabled = false");
  }
  // A closed path is traced by a crank that rotates fully.
  if (s.problem.closed) s.problem.crank_rotates_fully = true;
}

/// Reads the tables of a study; problems go to the reader.
template <class D>
PathStudy<D> read_path_study(study::ObjectReader& document, const study::Common& common) {
  PathStudy<D> s;
  auto& p = s.problem;
  if (auto mechanism = document.table(field::entry("mechanism").required())) mechanism->read(s.mechanism);
  auto target = document.table(field::entry("target").required());
  if (target) {
    target->read(s.target);
    static_cast<PathTargets&>(p) = read_path_targets(*target, common, s.target);
    const PathTiming& timing = s.target.timing;
    p.timing = timing.mode == Timing::equal_steps ? Timing::increments : timing.mode;
    p.angles = timed_angles(*target, common.units, timing, p.x.size());
  }
  document(field::entry("objective", "what is minimised"), s.objectives);
  document(field::entry("constraint", "what must hold"), s.constraints);
  if (auto optimiser = document.table("optimiser")) optimiser->read(s.optimiser);
  set_bounds(document, s);
  SenseChoice sense = s.mechanism.sense;
  if (sense == SenseChoice::automatic) sense = p.free_timing() ? SenseChoice::any : SenseChoice::positive;
  p.search_positive = sense != SenseChoice::negative;
  p.search_negative = sense != SenseChoice::positive;
  set_constraints(document, s);
  D::complete(document, common.units, s);
  if (target && s.target.fit == D::Fit::exact) D::read_exact(document, *target, s);
  return s;
}

/// The study with all that was left out, as tables.
template <class D>
Value canonical(PathStudy<D> s) {
  if (s.target.fit != D::Fit::exact) {
    auto& ranges = s.mechanism.parameters.ranges;
    for (std::size_t j = 0; j < ranges.size(); ++j)
      if (j + 1 < ranges.size() || starts_anywhere(s.target.timing.mode)) ranges[j] = s.problem.bounds[j];
  }
  write_path_targets(s.problem, s.target);
  if (s.objectives.empty()) s.objectives.emplace_back();
  Value out;
  out["mechanism"] = study::write_fields(s.mechanism);
  out["target"] = study::write_fields(s.target);
  out["objective"] = study::ObjectWriter::to_value(s.objectives);
  out["constraint"] = study::ObjectWriter::to_value(s.constraints);
  out["optimiser"] = study::write_fields(s.optimiser);
  return out;
}

/// Runs a study over its seeds and reports.
template <class D>
study::Result run_path_study(const PathStudy<D>& study, const study::Common& common, RunContext& context);

/// "synthesis" of a mechanism for "path_points".
template <class D>
study::Kind path_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = D::key;
  kind.target = "path_points";
  kind.summary = D::summary;
  kind.seeded = true;
  kind.example = D::example();
  kind.absent = D::absent();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", D::the_mechanism),
                      study::schema_fields<PathMechanismForm<D>>());
    document.property(field::entry("target", "the path"), study::schema_fields<PathTarget<D>>());
    document.property(field::entry("objective", "what is minimised"),
                      study::schema_array(study::schema_fields<PathObjectiveEntry<typename D::Objective>>()));
    document.property(field::entry("constraint", "what must hold"),
                      study::schema_array(study::schema_fields<typename D::Constraint>()));
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<typename D::Optimiser>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const PathStudy<D> s = read_path_study<D>(document, common);
    study::Prepared prepared;
    prepared.canonical = canonical(s);
    prepared.run = [s, common](RunContext& context) {
      return s.target.fit == D::Fit::exact ? D::run_exact(s, common, context)
                                           : run_path_study(s, common, context);
    };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
