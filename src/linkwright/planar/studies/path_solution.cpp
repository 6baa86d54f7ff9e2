#include "linkwright/planar/studies/path_solution.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/path_reached.h"
#include "linkwright/planar/studies/path_scene.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

std::array<double, four_bar_parameter_count> values_of(const PathDesign& d, bool with_start) {
  std::array<double, four_bar_parameter_count> out{};
  std::size_t j = 0;
  FourBar l = d.linkage;
  fields([&](const Field&, double& value) { out[j++] = value; }, l);
  out[j] = with_start ? d.angles[0] : 0.0;
  return out;
}

}  // namespace

study::Solution path_solution(const PathProblem& p, const PathDesign& d, std::size_t number, int samples) {
  constexpr std::array<std::string_view, four_bar_parameter_count> labels = {"ground length",
                                                                             "crank length",
                                                                             "coupler length",
                                                                             "rocker length",
                                                                             "tracing point along coupler",
                                                                             "tracing point across",
                                                                             "crank pivot x",
                                                                             "crank pivot y",
                                                                             "frame angle",
                                                                             "start angle"};
  const FourBarClass type = classify(d.linkage);
  study::Solution out;
  out.label = fmt::format("{}, {}", in_words(type.type), name_of(d.linkage.branch));
  const bool with_start = starts_anywhere(p.timing);
  const auto values = values_of(d, with_start);
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j) {
    const bool angle = j >= index(FourBarParameter::frame_angle);
    if (j == index(FourBarParameter::start_angle) && !with_start) continue;
    double value = values[j];
    const Range& range = p.bounds[j];
    if (angle) {
      const double turned = value - 2 * pi * std::floor((value - range.lower) / (2 * pi));
      if (turned <= range.upper) value = turned;
    }
    out.parameters.push_back({std::string(name(FourBarParameter(j))) + (angle ? "_rad" : "_m"),
                              std::string(labels[j]), value, range.lower, range.upper});
  }
  const PathErrors errors = path_errors(p, d);
  out.objectives["path_error_sum_sq_m2"] = d.error;
  out.objectives["path_error_rms_m"] = std::sqrt(d.error / static_cast<double>(p.x.size()));
  out.objectives["path_error_max_m"] = *std::max_element(errors.excess.begin(), errors.excess.end());
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
  out.classification["active_bounds"] = Value::array();
  for (const std::string& bound : d.active_bounds) out.classification["active_bounds"].push_back(bound);
  const std::vector<Drawback> bad = drawbacks(p, d);
  out.classification["usable"] = d.violations.empty() && bad.empty();
  out.classification["drawbacks"] = Value::array();
  for (const Drawback& drawback : bad) out.classification["drawbacks"].push_back(to_string(drawback.text));
  for (const auto& violation : d.violations) out.defects.push_back(violation_text(violation));
  for (const Defect& defect : defects(p, d))
    out.defects.push_back(say("{}: {}", name_of(defect.kind), defect.text));
  out.scene = fmt::format("solution-{}", number);
  out.study = motion_study("planar.four_bar", study::write_fields(FourBarMechanism{d.linkage, {}}),
                           shown_angles(d, samples), d.angles);
  return out;
}

void add_design_tables(study::Result& result, const PathProblem& problem,
                       const std::vector<PathDesign>& designs, int samples) {
  using Style = study::Plot::Style;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    // The best design's tables have plain names, those of the others carry the number of the solution.
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1), scene = result.solutions[i].scene;
    result.tables.push_back(
        point_table(problem, designs[i].angles, path_errors(problem, designs[i]), "points" + suffix));
    result.tables.push_back(motion_table(designs[i], "motion" + suffix, samples));
    const study::AddPlot of_points{
        result, {.table = "points" + suffix, .x = "crank_angle_rad", .style = Style::points, .scene = scene}},
        of_motion{result, {.table = "motion" + suffix, .x = "crank_angle_rad", .scene = scene}};
    of_points("errors" + suffix, "Distance from the target points", {"distance_m"});
    of_motion("transmission" + suffix, "Transmission angle", {"transmission_angle_rad"});
    of_motion("angles" + suffix, "Coupler and rocker angle", {"coupler_angle_rad", "rocker_angle_rad"});
  }
}

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

}  // namespace linkwright::planar
