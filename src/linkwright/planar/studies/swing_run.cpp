// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/as_linkage.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/slider_crank.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/swing.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

// Below this a linkage passes force badly (rad): 40 degrees, as is usual.
constexpr double good_transmission = 0.6981317007977318;
// Rounding of the dead centres, which the sweep finds where a rate is zero, over the transmission angle.
constexpr double same_strokes = 1e-9;
constexpr int curve_places = 201;
// Bodies of four-bar and slider-crank.
constexpr int coupler_body = 2, output_body = 3;

// A design of a sense of the slow stroke.
struct SwingDesign {
  Strokes strokes;
  StrokeLinkage lengths;  // in couplers
  double scale = 0;       // m, the coupler
  Linkage linkage;
  std::optional<SweptStrokes> swept;

  double crank() const { return scale * lengths.crank; }
  double slow() const { return std::max(swept->rise, 2 * pi - swept->rise); }
  double time_ratio() const { return slow() / (2 * pi - slow()); }
};

class SwingReport {
 public:
  SwingReport(const SwingStudy& s, const study::Common& common) : s_(s), common_(common) {}

  study::Result make() {
    for (const Strokes& strokes : s_.senses) designs_.push_back(design(strokes));
    std::stable_sort(designs_.begin(), designs_.end(), [](const SwingDesign& a, const SwingDesign& b) {
      return a.lengths.transmission_angle > b.lengths.transmission_angle;
    });
    for (std::size_t i = 0; i < designs_.size(); ++i) solution(designs_[i], i + 1);
    choice_table();
    ratio_table();
    result_.status = designs_[0].swept ? Status::done : Status::singular;
    result_.statistics["imbalance_angle_rad"] = s_.imbalance;
    result_.statistics["greatest_time_ratio"] = time_ratio_of(max_imbalance(s_.swing, true));
    if (!s_.slider)
      result_.statistics["greatest_time_ratio_against_crank"] = time_ratio_of(max_imbalance(s_.swing, false));
    findings();
    return std::move(result_);
  }

 private:
  std::string sense_text(const Strokes& strokes) const {
    if (strokes.imbalance == 0) return "both strokes equal";
    if (!s_.slider)
      return strokes.imbalance < 0 ? "slow stroke with the crank" : "slow stroke against the crank";
    const bool inward = (strokes.imbalance > 0) == (s_.rotation == Rotation::counterclockwise);
    return inward ? "slow stroke inwards" : "slow stroke outwards";
  }

  SwingDesign design(const Strokes& strokes) const {
    SwingDesign d;
    d.strokes = strokes;
    d.lengths = stroke_linkage(strokes, *chosen_crank(s_, strokes));
    d.scale = s_.given[0].length / length_of(d.lengths, s_.given[0].which);
    d.linkage = s_.slider ? slider_crank(slider(d)) : linkage_of(four_bar(d));
    d.swept = sweep_strokes(d.linkage, output_body, s_.slider);
    return d;
  }
  SliderCrankMechanism slider(const SwingDesign& d) const {
    return {
        SliderSide::forward, {.crank = d.crank(), .rod = d.scale, .offset = d.scale * d.lengths.offset}, {}};
  }
  FourBarMechanism four_bar(const SwingDesign& d) const {
    FourBarMechanism m;
    m.linkage = {.ground = d.scale * d.lengths.ground,
                 .crank = d.crank(),
                 .coupler = d.scale,
                 .rocker = d.scale * d.lengths.rocker,
                 .branch = s_.branch};
    return m;
  }

  // Crank angles of a turn from the beginning of the slow stroke.
  std::vector<double> turn(const SwingDesign& d) const {
    const double sense = s_.rotation == Rotation::clockwise ? -1 : 1;
    // The slow stroke is the rise of a crank that turns counter-clockwise where that is more than half a
    // turn; a crank that turns clockwise passes the same stretch from its other end.
    const double from = (d.swept->rise >= pi) == (sense > 0) ? d.swept->at_low : d.swept->at_high;
    std::vector<double> out;
    for (int k = 0; k < common_.output.samples; ++k)
      out.push_back(from + sense * 2 * pi * k / (common_.output.samples - 1));
    return out;
  }

  void solution(const SwingDesign& d, std::size_t number) {
    study::Solution out;
    out.label = fmt::format("{}, {}", s_.slider ? "slider-crank" : "crank-rocker", sense_text(d.strokes));
    const auto add = [&](std::string key, std::string label, double value) {
      out.parameters.push_back({std::move(key), std::move(label), value, -infinity, infinity});
    };
    if (!s_.slider) add("ground_m", "ground link", d.scale * d.lengths.ground);
    add("crank_m", "crank", d.crank());
    add(s_.slider ? "rod_m" : "coupler_m", s_.slider ? "rod" : "coupler", d.scale);
    if (s_.slider)
      add("offset_m", "offset of the guide", d.scale * d.lengths.offset);
    else
      add("rocker_m", "rocker", d.scale * d.lengths.rocker);
    out.objectives["least_transmission_angle_rad"] = d.lengths.transmission_angle;
    if (d.swept) {
      out.objectives[s_.slider ? "stroke_m" : "swing_angle_rad"] = d.swept->swing;
      out.objectives["time_ratio"] = d.time_ratio();
    }
    out.classification["slow_stroke"] = sense_text(d.strokes);
    out.classification[s_.slider ? "rod_ratio" : "coupler_ratio"] = 1 / d.lengths.crank;
    if (d.swept)
      motion(d, out, number);
    else
      out.defects.push_back("locks: the transmission angle is too small for a full turn");
    result_.solutions.push_back(std::move(out));
  }

  void motion(const SwingDesign& d, study::Solution& out, std::size_t number) {
    const PlanResult planned = plan_linkage(d.linkage);
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const std::vector<double> crank = turn(d);
    const double sense = s_.rotation == Rotation::clockwise ? -1 : 1;
    LinkageMotion moving(planned.plan);
    std::vector<LinkageRecord> records;
    std::vector<double> place, speed, transmission;
    for (const double angle : crank) {
      const InputMotion input{angle, 2 * pi * sense, 0};  // one turn a second
      solve_motion(planned.plan, std::span(&input, 1), moving);
      records.push_back(record_of(d.linkage, planned.plan, moving, nullptr, angle));
      const PartState<double> state = body_state(planned.plan, moving, output_body);
      place.push_back(s_.slider ? state.origin.x : std::atan2(state.direction.y, state.direction.x));
      speed.push_back(s_.slider ? state.velocity.x : state.speed);
      transmission.push_back(min_transmission_angle(planned.plan, moving));
    }
    if (!s_.slider) math::unwrap_angles(place);
    Table table;
    table.name = "motion" + suffix;
    table.add("crank_angle_rad", "crank angle (rad)", crank);
    const std::string output = s_.slider ? "slider_m" : "rocker_angle_rad";
    const std::string rate = s_.slider ? "slider_speed_m_per_s" : "rocker_speed_rad_per_s";
    table.add(output, s_.slider ? "place of the slider (m)" : "rocker angle (rad)", std::move(place));
    table.add(rate,
              s_.slider ? "speed of the slider at one turn a second (m/s)"
                        : "speed of the rocker at one turn a second (rad/s)",
              std::move(speed));
    table.add("transmission_angle_rad", "transmission angle (rad)", std::move(transmission));
    result_.tables.push_back(std::move(table));
    scene(d, out, planned.plan, records, number);
    const study::AddPlot plot{result_,
                              {.table = "motion" + suffix, .x = "crank_angle_rad", .scene = out.scene}};
    plot("output" + suffix, s_.slider ? "Place of the slider" : "Rocker angle", {output});
    plot("speed" + suffix, "Speed at one turn of the crank a second", {rate});
    plot("transmission" + suffix, "Transmission angle", {"transmission_angle_rad"});
    out.study = s_.slider ? motion_study("planar.slider_crank", study::write_fields(slider(d)), crank, crank)
                          : motion_study("planar.four_bar", study::write_fields(four_bar(d)), crank, crank);
  }

  void scene(const SwingDesign& d, study::Solution& out, const LinkagePlan& plan,
             const std::vector<LinkageRecord>& records, std::size_t number) {
    study::Scene scene = linkage_scene(d.linkage, plan, records, {}, "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", number, out.label);
    // The linkage at its dead centres, pale behind.
    scene.runs = {"linkage", "dead centres"};
    LinkageMotion moving(plan);
    for (const double angle : {d.swept->at_low, d.swept->at_high}) {
      const InputMotion input{angle, 0, 0};
      solve_position(plan, std::span(&input, 1), moving);
      const math::Vec2 pin = body_state(plan, moving, coupler_body).origin,
                       end = point_motion(plan, moving, coupler_body, d.scale).position;
      const std::string at = angle == d.swept->at_low ? " (low)" : " (high)";
      const auto point = [&](std::string_view name, const math::Vec2& place) {
        scene.points.push_back({std::string(name) + at, {place.x}, {place.y}});
        return static_cast<int>(scene.points.size()) - 1;
      };
      const int o = point("O", {0, 0}), a = point("A", pin), b = point("B", end);
      const auto bar = [&](std::string_view name, int from, int to) {
        scene.bodies.push_back(
            {std::string(name) + " at a dead centre", {from, to}, study::Scene::BodyStyle::bar, 1});
      };
      bar("crank", o, a);
      bar("coupler", a, b);
      if (!s_.slider) bar("rocker", point("B0", {d.scale * d.lengths.ground, 0}), b);
    }
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
  }

  // Lists all linkages of the strokes, for other lengths of the crank.
  void choice_table() {
    Table table;
    table.name = "choice";
    std::vector<double> ratio, sense, ground, crank, coupler, rocker, offset, transmission;
    std::vector<std::string> called;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const double shortest = *shortest_crank(designs_[i].strokes);
      called.push_back(sense_text(designs_[i].strokes));
      for (int k = 0; k < curve_places; ++k) {
        const StrokeLinkage l =
            stroke_linkage(designs_[i].strokes, shortest + (1 - shortest) * (k + 0.5) / curve_places);
        const double scale = s_.given[0].length / length_of(l, s_.given[0].which);
        sense.push_back(static_cast<double>(i + 1));
        ratio.push_back(l.crank);
        ground.push_back(scale * l.ground);
        crank.push_back(scale * l.crank);
        coupler.push_back(scale);
        rocker.push_back(scale * l.rocker);
        offset.push_back(scale * l.offset);
        transmission.push_back(l.transmission_angle);
      }
    }
    table.add("crank_ratio", s_.slider ? "crank over rod" : "crank over coupler", std::move(ratio));
    table.add("sense", "sense of the slow stroke", std::move(sense));
    if (!s_.slider) table.add("ground_m", "ground link (m)", std::move(ground));
    table.add("crank_m", "crank (m)", std::move(crank));
    table.add(s_.slider ? "rod_m" : "coupler_m", s_.slider ? "rod (m)" : "coupler (m)", std::move(coupler));
    if (s_.slider)
      table.add("offset_m", "offset of the guide (m)", std::move(offset));
    else
      table.add("rocker_m", "rocker (m)", std::move(rocker));
    table.add("least_transmission_angle_rad", "least transmission angle (rad)", std::move(transmission));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{
        result_, {.table = "choice", .x = "crank_ratio", .group = "sense", .group_names = called}};
    plot("choice", "All linkages with these strokes: least transmission angle",
         {"least_transmission_angle_rad"});
  }

  // Lists other time ratios with this swing.
  void ratio_table() {
    Table table;
    table.name = "time_ratios";
    const double most = max_imbalance(s_.swing, true);
    std::vector<double> ratio, with, against;
    const auto best = [&](const Strokes& strokes) {
      if (!shortest_crank(strokes)) return nan;
      return stroke_linkage(strokes, std::max(best_crank(strokes), 1 / s_.largest_ratio)).transmission_angle;
    };
    for (int k = 0; k < curve_places; ++k) {
      const double imbalance = most * k / curve_places;
      ratio.push_back(time_ratio_of(imbalance));
      with.push_back(best({s_.swing, -imbalance}));
      against.push_back(best({s_.swing, imbalance}));
    }
    table.add("time_ratio", "time ratio", std::move(ratio));
    table.add("with_crank_rad",
              s_.slider ? "largest transmission angle (rad)" : "slow stroke with the crank (rad)",
              std::move(with));
    if (!s_.slider) table.add("against_crank_rad", "slow stroke against the crank (rad)", std::move(against));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "time_ratios", .x = "time_ratio"}};
    plot("time-ratios",
         s_.slider ? "Largest transmission angle of each time ratio"
                   : "Largest transmission angle of each time ratio with this swing",
         {"with_crank_rad", "against_crank_rad"});
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    const SwingDesign& best = designs_[0];
    const char* what = s_.slider ? "slider-crank" : "crank-rocker";
    const Measured transmission = degrees_of(best.lengths.transmission_angle).fixed(1);
    const bool good = transmission.si >= good_transmission;
    if (!best.swept) {
      result_.headline = say("The {} locks: its least transmission angle is {}.", what,
                             degrees_of(best.lengths.transmission_angle, 2));
      warn("target", "the strokes are at the limit of what is possible",
           "take a smaller time ratio, or give no second length");
      return;
    }
    const Measured swing = s_.slider ? length_by_size(best.swept->swing) : degrees_of(best.swept->swing);
    result_.headline =
        say("A {} {} {} with a time ratio of {}, least transmission angle {}.", what,
            s_.slider ? "of stroke" : "swings by", swing, plain_number(best.time_ratio()), transmission);
    fact("least transmission angle", transmission, good ? Verdict::good : Verdict::bad);
    fact(s_.slider ? "stroke, by a sweep of the linkage" : "swing angle, by a sweep of the linkage", swing);
    fact("time ratio, by a sweep of the linkage", plain_number(best.time_ratio()));
    fact("crank rotation of slow and quick stroke",
         say("{} and {}", degrees_of(best.slow()), degrees_of(2 * pi - best.slow())));
    fact("imbalance angle", degrees_of(s_.imbalance));
    fact(s_.slider ? "rod over crank" : "coupler over crank",
         say("{}, {}", plain_number(1 / best.lengths.crank),
             s_.settled                                      ? "given"
             : best.lengths.crank > best_crank(best.strokes) ? "the most allowed"
                                                             : "the best"));
    fact(s_.slider ? "greatest time ratio" : "greatest time ratio with this swing",
         s_.slider ? say("{}", 3)
                   : say("below {}, or {} against the crank",
                         plain_number(time_ratio_of(max_imbalance(s_.swing, true))),
                         plain_number(time_ratio_of(max_imbalance(s_.swing, false)))));
    const double expected = s_.slider ? s_.given[0].length : s_.swing;
    const double loose = same_strokes / transmission.si;
    if (std::abs(best.swept->swing - expected) > loose * expected ||
        std::abs(best.slow() - pi - s_.imbalance) > loose)
      warn(
          say("the sweep gives a {} of {} and an imbalance angle of {}: the linkage is so near to "
              "locking that rounding shows",
              s_.slider ? "stroke" : "swing", swing, degrees_of(best.slow() - pi)));
    if (!good)
      warn("target",
           say("the least transmission angle of {} is below {}{}", transmission,
               degrees_of(good_transmission), s_.settled ? "" : ", the largest possible with these strokes"),
           s_.settled ? "leave out the second length, or take a smaller time ratio"
                      : "take a smaller time ratio; the diagram of time ratios shows what each costs");
  }

  const SwingStudy& s_;
  const study::Common& common_;
  std::vector<SwingDesign> designs_;
  study::Result result_;
};

}  // namespace

study::Result run_swing_study(const SwingStudy& s, const study::Common& common, RunContext&) {
  return SwingReport(s, common).make();
}

}  // namespace linkwright::planar
