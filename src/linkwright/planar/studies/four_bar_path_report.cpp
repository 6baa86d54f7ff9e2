// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/objective.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/path_run.h"

namespace linkwright::planar {
namespace {

bool assembled(const FourBarPosition& pose) { return pose.status != Status::no_assembly; }

bool is_eighteen_points(const FourBarPathStudy& s) {
  const PathProblem known = eighteen_points();
  const PathTiming& timing = s.target.timing;
  return s.problem.x == known.x && s.problem.y == known.y && timing.mode == Timing::equal_steps &&
         std::abs(*timing.step - known.step) < 1e-12;
}

std::string_view short_name(DrawbackKind kind) {
  switch (kind) {
    case DrawbackKind::transmission:
      return "low transmission angle";
    case DrawbackKind::crowded:
      return "crowded points";
    case DrawbackKind::bound:
      return "a link at its bound";
    case DrawbackKind::locks:
      return "locks at both ends";
  }
  return {};
}

}  // namespace

std::string called(const PathDesign& d) {
  const FourBarClass type = classify(d.linkage);
  const std::string_view branch = name_of(d.linkage.branch);
  if (!type.grashof)
    return fmt::format("linkage in which no link rotates fully ({}; {} branch)", in_words(type.type), branch);
  return fmt::format("{} ({} branch)", name_of(type.type), branch);
}

double judged_transmission(const PathProblem& p, const PathDesign& d) {
  const PathTransmission mu = path_transmission(p, d);
  return p.crank_rotates_fully ? mu.whole : mu.used;
}

study::Fact transmission_fact(const PathProblem& p, const PathDesign& d) {
  const PathTransmission mu = path_transmission(p, d);
  Sentence text = degrees_of(mu.used).fixed(1);
  if (!p.closed) text += say(" over the path ({} over the whole motion)", degrees_of(mu.whole).fixed(1));
  const bool poor = math::degrees(judged_transmission(p, d)) < 20;
  return {"minimum transmission angle", std::move(text),
          poor ? study::Fact::Verdict::bad : study::Fact::Verdict::plain};
}

study::Scene FourBarPathKind::scene(const FourBar& linkage, std::vector<double> crank_angles) {
  enum { O1, O4, O2, O3, C };  // order of the points
  study::Scene scene;
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  scene.input = std::move(crank_angles);
  scene.points = {{"O1", {}, {}}, {"O4", {}, {}}, {"O2", {}, {}}, {"O3", {}, {}}, {"C", {}, {}}};
  const auto put = [&](int point, std::complex<double> at, bool there) {
    scene.points[static_cast<std::size_t>(point)].x.push_back(there ? at.real() : nan);
    scene.points[static_cast<std::size_t>(point)].y.push_back(there ? at.imag() : nan);
  };
  put(O1, crank_pivot(linkage), true);
  put(O4, rocker_pivot(linkage), true);
  for (const double angle : scene.input) {
    const FourBarPosition pose = position(linkage, angle);
    put(O2, pose.crank_pin, true);
    put(O3, pose.coupler_pin, assembled(pose));
    put(C, pose.coupler_point, assembled(pose));
    scene.status.emplace_back(to_string(pose.status));
  }
  using Body = study::Scene::BodyStyle;
  scene.bodies = {{"ground", {O1, O4}, Body::ground},
                  {"crank", {O1, O2}, Body::bar},
                  {"coupler", {O2, O3, C}, Body::plate},
                  {"rocker", {O4, O3}, Body::bar}};
  using Joint = study::Scene::JointStyle;
  scene.joints = {{"O1", O1, Joint::ground_pivot},
                  {"O4", O4, Joint::ground_pivot},
                  {"O2", O2, Joint::pivot},
                  {"O3", O3, Joint::pivot},
                  {"C", C, Joint::tracer}};
  scene.traces = {{C, "coupler curve", classify(linkage).crank_rotates_fully}};
  return scene;
}

Table FourBarPathKind::motion(const FourBar& linkage, const std::vector<double>& angles) {
  Table table;
  std::vector<double> coupler, rocker, transmission, x, y;
  for (double angle : angles) {
    const FourBarPosition pose = position(linkage, angle);
    const bool there = assembled(pose);
    coupler.push_back(there ? pose.coupler_angle : nan);
    rocker.push_back(there ? pose.rocker_angle : nan);
    transmission.push_back(there ? pose.transmission_angle : nan);
    x.push_back(there ? pose.coupler_point.real() : nan);
    y.push_back(there ? pose.coupler_point.imag() : nan);
    table.status.emplace_back(to_string(pose.status));
  }
  math::unwrap_angles(coupler);
  math::unwrap_angles(rocker);
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("coupler_angle_rad", "coupler angle (rad)", std::move(coupler));
  table.add("rocker_angle_rad", "rocker angle (rad)", std::move(rocker));
  table.add("transmission_angle_rad", "transmission angle (rad)", std::move(transmission));
  table.add("coupler_x_m", "coupler point x (m)", std::move(x));
  table.add("coupler_y_m", "coupler point y (m)", std::move(y));
  return table;
}

std::vector<MotionPlot> FourBarPathKind::motion_plots() {
  return {{"transmission", "Transmission angle", {"transmission_angle_rad"}},
          {"angles", "Coupler and rocker angle", {"coupler_angle_rad", "rocker_angle_rad"}}};
}

Value FourBarPathKind::analysis_form(const FourBar& linkage) {
  return study::write_fields(FourBarMechanism{linkage, {}});
}

Sentence FourBarPathKind::label(const PathProblem&, const PathDesign& d) {
  return fmt::format("{}, {}", in_words(classify(d.linkage).type), name_of(d.linkage.branch));
}

void FourBarPathKind::classify_design(const PathProblem& p, const PathDesign& d, Value active_bounds,
                                      study::Solution& out) {
  const FourBarClass type = classify(d.linkage);
  out.classification["type"] = name_of(type.type);
  out.classification["branch"] = name_of(d.linkage.branch);
  out.classification["sense"] = d.sense > 0 ? "positive" : "negative";
  out.classification["grashof"] = type.grashof;
  out.classification["circuits"] = type.circuits;
  out.classification["crank_rotates_fully"] = type.crank_rotates_fully;
  out.classification["crank_margin_m"] = type.crank_margin;
  const PathTransmission transmission = path_transmission(p, d);
  out.classification["min_transmission_angle_rad"] = transmission.used;  // over the path
  out.classification["whole_motion_min_transmission_angle_rad"] = transmission.whole;
  out.classification["active_bounds"] = std::move(active_bounds);
  const std::vector<Weakness> bad = weaknesses(p, d);
  out.classification["usable"] = d.violations.empty() && bad.empty();
  out.classification["drawbacks"] = Value::array();
  for (const Weakness& weakness : bad) out.classification["drawbacks"].push_back(to_string(weakness.text));
}

void FourBarPathKind::add_cognates(study::Result& result, const PathDesign& best) {
  Table table{.name = "cognates"};
  FourBar numbers;
  fields(
      [&](const Field& field, double&) {
        const std::string key = si_key(field.key, field.dimension);
        table.add(key, key);
      },
      numbers);
  table.add("same_timing", "same_timing");
  const auto row = [&](FourBar l, bool same_timing) {
    std::size_t i = 0;
    fields([&](const Field&, double& value) { table.columns[i++].values.push_back(value); }, l);
    table.columns[i].values.push_back(same_timing ? 1.0 : 0.0);
  };
  row(best.linkage, true);
  for (const Cognate& cognate : cognates(best.linkage, best.angles[0]))
    row(cognate.linkage, cognate.same_timing);
  result.tables.push_back(std::move(table));
}

void FourBarPathKind::add_published(study::Result& result, const FourBarPathStudy& s,
                                    const std::vector<PathDesign>& designs) {
  if (!is_eighteen_points(s)) return;
  const PathProblem& p = s.problem;
  const double best = designs[0].violations.empty() ? designs[0].error : infinity;
  const std::string source = "Boskovic 2018, Table 4.1";
  for (const PublishedPathDesign& published : eighteen_point_designs()) {
    std::vector<double> angles;
    for (std::size_t k = 0; k < p.x.size(); ++k) angles.push_back(published.start_angle + point_angle(p, k));
    const double ours = measure(p, published.linkage, 1, angles).error;
    result.comparisons.push_back({published.label + ", design re-evaluated", source,
                                  published.published_error, ours, published.verdict, published.note});
  }
  constexpr double published_best = 0.00908, best_known = 0.009028884631;
  if (std::isfinite(best)) {
    const bool better = best < published_best, equal = std::abs(best - best_known) <= 1e-7;
    result.comparisons.push_back({"best of this study", source, published_best, best,
                                  better ? "improved" : "not reached",
                                  equal ? "the best design known: both branches, joined by a timed cognate"
                                        : fmt::format("the best design known has {:.9f}", best_known)});
  }
}

Sentence FourBarPathKind::caution(const PathProblem& p, const std::vector<PathDesign>& designs) {
  Sentence out;
  for (const Weakness& weakness : weaknesses(p, designs[0]))
    out += (out.empty() ? " But " : "; ") + weakness.text;
  if (out.empty()) return out;
  for (std::size_t i = 1; i < designs.size(); ++i)
    if (weaknesses(p, designs[i]).empty())
      return say("{}. The best one without such drawbacks is solution {}, a {}: it {}.", out, i + 1,
                 called(designs[i]), how_near(p, path_errors(p, designs[i]), designs[i].error));
  return out + ". No design without such drawbacks was found.";
}

Sentence FourBarPathKind::headline(const FourBarPathStudy& s, const std::vector<PathDesign>& designs,
                                   const PathErrors& errors) {
  return say("A {} {}.", called(designs[0]), how_near(s.problem, errors, designs[0].error));
}

void FourBarPathKind::add_facts(study::Result& result, const FourBarPathStudy& s,
                                const std::vector<PathDesign>& designs) {
  result.facts.push_back({"type", label(s.problem, designs[0])});
  result.facts.push_back(transmission_fact(s.problem, designs[0]));
}

void FourBarPathKind::add_warnings(study::Result& result, const PathProblem& p, const PathDesign& d) {
  std::string names;
  if (d.violations.empty())
    for (const Weakness& weakness : weaknesses(p, d)) {
      const std::string name(short_name(weakness.kind));
      if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    }
  if (!names.empty()) result.facts.push_back({"drawbacks", names, study::Fact::Verdict::bad});
  const double mu = judged_transmission(p, d), limit = math::degrees(p.min_transmission_angle);
  if (math::degrees(mu) >= 20) return;
  study::AddWarning{result.diagnostics}(
      say("the transmission angle falls to {}{}: the linkage transmits force badly there",
          degrees_of(mu).fixed(1),
          p.closed                ? ""
          : p.crank_rotates_fully ? " over the full turn"
                                  : " on the path"),
      limit > 0 ? say("raise the limit of [[constraint]] type = \"transmission_angle\": min_deg is {}",
                      plain_number(limit, 6))
                : "limit it: [[constraint]] type = \"transmission_angle\", min_deg = 30");
}

optimise::Problem FourBarPathKind::population_problem(const FourBarPathStudy& s,
                                                      const CrankSearch<planar::Branch>& search, bool,
                                                      optimise::MinimiseOptions&) {
  return path_population_problem(s.problem, search.branch, search.sense);
}

template study::Result run_path_study(const FourBarPathStudy&, const study::Common&, RunContext&);

}  // namespace linkwright::planar
