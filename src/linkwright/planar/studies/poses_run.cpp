// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/dyads/burmester.h"
#include "linkwright/planar/dyads/linkage.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/pose_design.h"
#include "linkwright/planar/studies/poses.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using Verdict = study::Fact::Verdict;

// A pair angle below this passes force badly (rad).
constexpr double flat_pair = 0.35;
// Points of the Burmester curves for each piece and branch, and how far they are drawn, times the size of the
// motion.
constexpr int curve_samples = 240;
constexpr double curve_reach = 8;

class PoseReport {
 public:
  PoseReport(const PoseStudy& study, const study::Common& common, PoseAnswer answer)
      : p_(study.problem), pivots_(study.mechanism.pivots), common_(common), answer_(std::move(answer)) {}

  study::Result make() {
    result_.status = answer_.status != Status::done ? answer_.status
                     : answer_.free > 0             ? Status::done
                                                    : Status::infeasible;
    // If some pass the poses, the others are only counted.
    for (const PoseDesign& design : answer_.designs)
      if (answer_.free == 0 || !defective(design)) shown_.push_back(&design);
    for (std::size_t i = 0; i < shown_.size(); ++i) solution(*shown_[i], i + 1);
    statistics();
    design_table();
    dyad_table();
    curves();
    findings();
    return std::move(result_);
  }

 private:
  void solution(const PoseDesign& d, std::size_t number) {
    study::Solution out;
    out.label = fmt::format("{} ({}), driven by {}", name_of_linkage(d), type_of(d), drive_of(d));
    const auto add = [&](std::string key, std::string label, double value) {
      out.parameters.push_back({std::move(key), std::move(label), value, -infinity, infinity});
    };
    const auto dyad = [&](const GuidingDyad& one, const std::string& key, const std::string& label) {
      if (one.type != GuidingDyadType::pr) {
        add(key + "_fixed_x_m", label + ", fixed pivot x", one.fixed.real());
        add(key + "_fixed_y_m", label + ", fixed pivot y", one.fixed.imag());
      }
      if (one.type != GuidingDyadType::rp) {
        add(key + "_moving_x_m", label + ", pivot on the body x", one.moving.real());
        add(key + "_moving_y_m", label + ", pivot on the body y", one.moving.imag());
      }
      if (one.type == GuidingDyadType::rr) {
        add(key + "_length_m", label + ", length", one.length);
      } else {
        add(key + "_direction_rad", label + ", direction of the slide", std::arg(Complex(0, 1) * one.normal));
        add(key + "_offset_m", label + ", the slide to the right of the origin by", one.offset);
      }
    };
    dyad(d.driver, "drive", "driven dyad");
    dyad(d.other, "guide", "other dyad");
    out.objectives["least_pair_angle_rad"] = d.passage.pair_angle;
    out.objectives["pose_error_m"] = d.distance;
    out.objectives["pose_error_rad"] = d.rotation;
    out.classification["linkage"] = name_of_linkage(d);
    out.classification["dyads"] = type_of(d);
    out.classification["drive_turns_fully"] = d.passage.drive_turns;
    out.classification["defect"] = name_of(d.passage.defect);
    if (std::isfinite(d.link_ratio)) out.classification["link_ratio"] = d.link_ratio;
    if (defective(d)) out.defects.push_back(defect_text(d));
    motion(d, out, number);
    result_.solutions.push_back(std::move(out));
  }

  // Drawing, tables and study of a design; without a motion through the poses it is drawn at each.
  void motion(const PoseDesign& d, study::Solution& out, std::size_t number) {
    const Linkage linkage = guided_body(d.driver, d.other, d.reached[0]);
    const PlanResult planned = plan_linkage(linkage);
    if (!planned.problems.empty()) return;
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const std::vector<double> inputs =
        defective(d) ? d.passage.drive : shown_inputs(d, common_.output.samples);
    std::vector<LinkageRecord> records;
    std::vector<double> x, y, angle;
    std::vector<std::string> status;
    LinkageMotion moving(planned.plan);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      BodyPose body;
      if (defective(d)) {
        body = d.reached[k];
        const Linkage there = guided_body(d.driver, d.other, body);
        LinkageRecord record{.input = static_cast<double>(k + 1)};
        for (const LinkageBody& part : there.bodies) {
          const math::Pose at = part.start.value_or(math::Pose{});
          record.bodies.push_back({.origin = {at.x, at.y}, .direction = math::unit(at.angle)});
        }
        records.push_back(std::move(record));
      } else {
        const InputMotion input{inputs[k], 0, 0};
        solve_motion(planned.plan, std::span(&input, 1), moving);
        records.push_back(record_of(linkage, planned.plan, moving, nullptr, inputs[k]));
        const LinkageRecord& record = records.back();
        status.emplace_back(to_string(record.status));
        if (record.bodies.empty()) {
          body = {{nan, nan}, nan};
        } else {
          body = {number_of(record.bodies[1].origin), angle_of(record.bodies[1].direction)};
        }
      }
      x.push_back(body.origin.real());
      y.push_back(body.origin.imag());
      angle.push_back(body.angle);
    }
    math::unwrap_angles(angle);
    scene(d, out, linkage, planned.plan, records, fmt::format("solution-{}", number), number);
    pose_table(d, "poses" + suffix);
    if (defective(d)) return;
    Table table;
    table.name = "motion" + suffix;
    table.status = std::move(status);
    const std::string input = rotary(d) ? "drive_angle_rad" : "drive_m";
    table.add(input, rotary(d) ? "angle of the drive (rad)" : "place of the drive on its slide (m)", inputs);
    table.add("x_m", "origin of the body, x (m)", std::move(x));
    table.add("y_m", "origin of the body, y (m)", std::move(y));
    table.add("angle_rad", "rotation of the body (rad)", std::move(angle));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "motion" + suffix, .x = input, .scene = out.scene}};
    plot("rotation" + suffix, "Rotation of the body", {"angle_rad"});
    if (rotary(d) && d.driver.type == GuidingDyadType::rr && d.other.type == GuidingDyadType::rr) {
      const FourBar four_bar = four_bar_of(d);
      std::vector<double> crank = inputs, on_path = d.passage.drive;
      for (double& a : crank) a -= four_bar.frame_angle;
      for (double& a : on_path) a -= four_bar.frame_angle;
      out.study = motion_study("planar.four_bar", study::write_fields(FourBarMechanism{four_bar, {}}), crank,
                               on_path);
    } else {
      out.study = motion_study(linkage, rotary(d), inputs, "body.P");
    }
  }

  void scene(const PoseDesign& d, study::Solution& out, const Linkage& linkage, const LinkagePlan& plan,
             const std::vector<LinkageRecord>& records, std::string name, std::size_t number) {
    constexpr int body = 1;
    std::string key = "pose", label = "pose";
    if (!defective(d)) {
      key = rotary(d) ? "drive_angle_rad" : "drive_m";
      label = rotary(d) ? "angle of the drive" : "place of the drive";
    }
    study::Scene scene = linkage_scene(linkage, plan, records, {{body, 2}}, key, label);
    scene.name = std::move(name);
    scene.title = say("{}: {}", number, out.label);
    // The body at every pose, pale behind, and its origin as what is to be reached.
    scene.runs = {"linkage", "poses"};
    study::Scene::Target target{"poses", {}, {}, {}, {}, {}, false};
    for (std::size_t k = 0; k < p_.poses.size(); ++k) {
      target.x.push_back(p_.poses[k].origin.real());
      target.y.push_back(p_.poses[k].origin.imag());
      target.achieved_x.push_back(d.reached[k].origin.real());
      target.achieved_y.push_back(d.reached[k].origin.imag());
      target.achieved_input.push_back(defective(d) ? static_cast<double>(k + 1) : d.passage.drive[k]);
      place_handles(scene, k);
      if (!has_angle(k)) continue;
      study::Scene::Body ghost{fmt::format("pose {}", k + 1), {}, study::Scene::BodyStyle::plate, 1};
      for (const LinkagePoint& point : linkage.bodies[body].points) {
        const Complex at = place(p_.poses[k], point.at);
        ghost.points.push_back(static_cast<int>(scene.points.size()));
        scene.points.push_back({fmt::format("{} at pose {}", point.name, k + 1), {at.real()}, {at.imag()}});
      }
      rotation_handles(scene, ghost, k);
      scene.bodies.push_back(std::move(ghost));
    }
    scene.targets = {std::move(target)};
    draw_regions(scene);
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
  }

  // Regions of pivots, those of the body at its first pose; corners move those of the ground.
  void draw_regions(study::Scene& scene) const {
    if (!regions()) return;
    const int run = static_cast<int>(scene.runs.size());
    scene.runs.emplace_back("regions");
    for (std::size_t k = 0; k < pivots_.size(); ++k) {
      const PivotForm& form = pivots_[k];
      for (const bool fixed : {true, false}) {
        const auto& region = fixed ? form.fixed_in_region : form.moving_in_region;
        if (!region) continue;
        study::Scene::Body drawn{
            fmt::format("region of the {} pivot of dyad {}", fixed ? "fixed" : "moving", form.dyad),
            {},
            study::Scene::BodyStyle::plate,
            run};
        const auto& [x0, y0] = region->min;
        const auto& [x1, y1] = region->max;
        const Complex corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
        for (const Complex corner : corners) {
          const Complex at = fixed ? corner : place(p_.poses[0], corner);
          drawn.points.push_back(static_cast<int>(scene.points.size()));
          scene.points.push_back({"corner of the " + drawn.name, {at.real()}, {at.imag()}});
        }
        const std::string key = fmt::format("mechanism.pivot[{}].fixed_in_region.", k);
        if (fixed) {
          scene.handles.push_back({.key = key + "min_m", .point = drawn.points[0]});
          scene.handles.push_back({.key = key + "max_m", .point = drawn.points[2]});
        }
        scene.bodies.push_back(std::move(drawn));
      }
    }
  }

  // The origin of a pose moves it.
  static void place_handles(study::Scene& scene, std::size_t k) {
    using Measure = study::Scene::Handle::Measure;
    const std::string pose = fmt::format("target.pose[{}].", k);
    const int index = static_cast<int>(k);
    scene.handles.push_back({.key = pose + "x_m", .measure = Measure::x, .target = 0, .index = index});
    scene.handles.push_back({.key = pose + "y_m", .measure = Measure::y, .target = 0, .index = index});
  }

  // The drawn points of the body other than its origin turn a pose.
  static void rotation_handles(study::Scene& scene, const study::Scene::Body& ghost, std::size_t k) {
    const int origin = ghost.points.back();
    for (const int point : ghost.points)
      if (point != origin)
        scene.handles.push_back({.key = fmt::format("target.pose[{}].angle_rad", k),
                                 .measure = study::Scene::Handle::Measure::angle,
                                 .point = point,
                                 .target = 0,
                                 .index = static_cast<int>(k),
                                 .from = origin});
  }

  bool regions() const {
    return std::any_of(p_.pivots.begin(), p_.pivots.end(),
                       [](const Prescription& p) { return p.fixed_region || p.moving_region; });
  }

  bool has_angle(std::size_t k) const { return p_.demands.empty() || p_.demands[k].angle; }

  // "3 poses and 4 points"; "12 poses".
  Sentence poses_and_points() const {
    const std::size_t n = p_.poses.size();
    const auto points =
        p_.exact
            ? static_cast<std::size_t>(std::count_if(p_.demands.begin(), p_.demands.end(),
                                                     [](const PoseDemand& demand) { return !demand.angle; }))
            : 0;
    return points == 0 ? say("{} poses", n)
                       : say("{} poses and {} point{}", n - points, points, points == 1 ? "" : "s");
  }

  // "5, met exactly"; "3 poses and 4 points, met exactly"; "12, 3 of them exactly and 4 without rotation, by
  // least squares".
  Sentence poses_text() const {
    if (p_.exact)
      return (p_.demands.empty() ? say("{}", p_.poses.size()) : poses_and_points()) + ", met exactly";
    int exact = 0, points = 0;
    for (const PoseDemand& demand : p_.demands) exact += demand.exact, points += !demand.angle;
    Sentence out = say("{}", p_.poses.size());
    if (exact > 0) out += say(", {} of them exactly", exact);
    if (points > 0) out += say(", {} at any rotation", points);
    return out + ", by least squares";
  }

  void pose_table(const PoseDesign& d, std::string name) {
    Table table{.name = std::move(name), .columns{}, .status{}};
    std::vector<double> number, x, y, angle, distance, rotation;
    for (std::size_t k = 0; k < p_.poses.size(); ++k) {
      number.push_back(static_cast<double>(k + 1));
      x.push_back(p_.poses[k].origin.real());
      y.push_back(p_.poses[k].origin.imag());
      angle.push_back(has_angle(k) ? p_.poses[k].angle : nan);
      distance.push_back(std::abs(d.reached[k].origin - p_.poses[k].origin));
      rotation.push_back(has_angle(k) ? math::wrap_angle(d.reached[k].angle - p_.poses[k].angle) : nan);
    }
    table.add("pose", "pose", std::move(number));
    table.add(rotary(d) ? "drive_angle_rad" : "drive_m",
              rotary(d) ? "angle of the drive (rad)" : "place of the drive on its slide (m)",
              d.passage.drive);
    table.add("x_m", "origin of the body, x (m)", std::move(x));
    table.add("y_m", "origin of the body, y (m)", std::move(y));
    table.add("angle_rad", "rotation of the body (rad)", std::move(angle));
    table.add("distance_m", "distance from it (m)", std::move(distance));
    table.add("rotation_error_rad", "error of rotation (rad)", std::move(rotation));
    result_.tables.push_back(std::move(table));
  }

  void statistics() {
    Value& st = result_.statistics;
    st["solutions"] = answer_.solutions;
    if (answer_.pairs >= 0)
      st["real_linkages"] = answer_.pairs;
    else
      st["real_dyads"] = static_cast<int>(answer_.dyads.size());
    if (answer_.outside > 0) st["outside_regions"] = answer_.outside;
    st["linkages"] = answer_.tried;
    st["defect_free"] = answer_.free;
    for (const PoseDefect defect : {PoseDefect::branch, PoseDefect::circuit, PoseDefect::order})
      st[std::string(name_of(defect)) + "_defects"] = answer_.defects[static_cast<std::size_t>(defect)];
    if (!p_.exact) st["fitted_pairs"] = answer_.starts;
    st["outcome"] = answer_.free > 0                              ? "done"
                    : answer_.tried > 0                           ? "all_defective"
                    : answer_.dependent                           ? "dependent_poses"
                    : answer_.outside > 0                         ? "outside_regions"
                    : answer_.dyads.empty() || answer_.pairs == 0 ? "no_real_solution"
                                                                  : "no_solution";
  }

  // Every linkage that was kept, with what is wrong with it.
  void design_table() {
    Table table{.name = "designs", .columns{}, .status{}};
    std::vector<double> number, defect, pair, turns, ratio, distance, rotation;
    for (std::size_t i = 0; i < answer_.designs.size(); ++i) {
      const PoseDesign& d = answer_.designs[i];
      table.names.push_back(type_of(d));
      number.push_back(static_cast<double>(i + 1));
      defect.push_back(static_cast<double>(d.passage.defect));
      pair.push_back(d.passage.pair_angle);
      turns.push_back(d.passage.drive_turns ? 1 : 0);
      ratio.push_back(d.link_ratio);
      distance.push_back(d.distance);
      rotation.push_back(d.rotation);
    }
    table.add("design", "linkage and drive", std::move(number));
    table.add("defect", "defect (0 none, 1 branch, 2 circuit, 3 order)", std::move(defect));
    table.add("least_pair_angle_rad", "least pair angle (rad)", std::move(pair));
    table.add("drive_turns_fully", "drive turns fully", std::move(turns));
    table.add("link_ratio", "longest over shortest link", std::move(ratio));
    table.add("pose_error_m", "greatest distance from a pose (m)", std::move(distance));
    table.add("pose_error_rad", "greatest error of rotation (rad)", std::move(rotation));
    if (!answer_.designs.empty()) result_.tables.push_back(std::move(table));
  }

  void dyad_table() {
    if (answer_.dyads.empty() || answer_.swept) return;
    Table table{.name = "dyads", .columns{}, .status{}};
    constexpr const char* keys[] = {"fixed_x_m", "fixed_y_m",     "moving_x_m", "moving_y_m",
                                    "length_m",  "direction_rad", "offset_m",   "spread_m"};
    for (const char* key : keys) table.add(key, key);
    for (const GuidingDyad& d : answer_.dyads) {
      const bool fixed = d.type != GuidingDyadType::pr, moving = d.type != GuidingDyadType::rp;
      const bool link = d.type == GuidingDyadType::rr;
      const double values[] = {
          fixed ? d.fixed.real() : nan,   fixed ? d.fixed.imag() : nan,
          moving ? d.moving.real() : nan, moving ? d.moving.imag() : nan,
          link ? d.length : nan,          link ? nan : std::arg(Complex(0, 1) * d.normal),
          link ? nan : d.offset,          spread(d, p_.poses)};
      for (std::size_t j = 0; j < std::size(values); ++j) table.columns[j].values.push_back(values[j]);
      table.names.emplace_back(name_of(d.type));
    }
    result_.tables.push_back(std::move(table));
  }

  // Draws the curves on which the pivots of links through four poses can lie.
  void curves() {
    if (!p_.exact || p_.poses.size() != 4 || !p_.demands.empty()) return;
    const std::vector<BurmesterPoint> points = burmester_curves(p_.poses, curve_samples);
    if (points.empty()) return;
    const double reach = curve_reach * size_of_motion(p_.poses);
    const Complex middle = p_.poses[0].origin;
    Table table{.name = "curve_points", .columns{}, .status{}};
    std::vector<double> piece, turn, fixed_x, fixed_y, moving_x, moving_y, at_x, at_y;
    for (const BurmesterPoint& p : points) {
      const bool near = std::abs(p.fixed - middle) <= reach && std::abs(p.moving) <= reach;
      const Complex at = near ? place(p_.poses[0], p.moving) : Complex(nan, nan);
      const Complex fixed = near ? p.fixed : Complex(nan, nan), moving = near ? p.moving : Complex(nan, nan);
      piece.push_back(p.piece + 1);
      turn.push_back(p.turn);
      fixed_x.push_back(fixed.real());
      fixed_y.push_back(fixed.imag());
      moving_x.push_back(moving.real());
      moving_y.push_back(moving.imag());
      at_x.push_back(at.real());
      at_y.push_back(at.imag());
    }
    table.add("piece", "piece", std::move(piece));
    table.add("turn_rad", "rotation of the link to the second pose (rad)", std::move(turn));
    table.add("fixed_x_m", "fixed pivot x (m)", std::move(fixed_x));
    table.add("fixed_y_m", "fixed pivot y (m)", std::move(fixed_y));
    table.add("moving_x_m", "pivot on the body x (m)", std::move(moving_x));
    table.add("moving_y_m", "pivot on the body y (m)", std::move(moving_y));
    table.add("moving_at_first_x_m", "pivot on the body at the first pose x (m)", std::move(at_x));
    table.add("moving_at_first_y_m", "pivot on the body at the first pose y (m)", std::move(at_y));
    result_.tables.push_back(std::move(table));
    result_.plots.push_back(
        {.name = "burmester",
         .title = "Burmester curves: fixed pivots, and pivots on the body at the first pose",
         .table = "curve_points",
         .x = "turn_rad",
         .y = {"fixed_x_m", "fixed_y_m", "moving_at_first_x_m", "moving_at_first_y_m"},
         .style = study::Plot::Style::polar});
  }

  Sentence why() const {
    Sentence out;
    for (const PoseDefect defect : {PoseDefect::branch, PoseDefect::circuit, PoseDefect::order})
      if (const int count = answer_.defects[static_cast<std::size_t>(defect)])
        out += say("{}{} {}", out.empty() ? "" : ", ", count, name_of(defect));
    return out;
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    const std::size_t n = p_.poses.size();
    fact("poses", poses_text());
    if (answer_.pairs >= 0)
      fact("linkages", say("{} real of {}", answer_.pairs, answer_.solutions));
    else if (!answer_.swept)
      fact("dyads",
           p_.exact ? say("{} real of {}", answer_.dyads.size() + static_cast<std::size_t>(answer_.outside),
                          answer_.solutions)
                    : say("{} next to the poses", answer_.dyads.size()));
    if (answer_.outside > 0) fact("with a pivot outside its region", say("{}", answer_.outside));
    if (p_.drive_turns)
      fact("left out, the crank does not rotate fully", say("{}", answer_.swinging),
           answer_.tried > 0 ? Verdict::plain : Verdict::bad);
    fact("linkages with a drive", say("{}", answer_.tried));
    fact("free of defects", say("{}", answer_.free), answer_.free > 0 ? Verdict::good : Verdict::bad);
    if (answer_.tried > answer_.free) fact("defects", why());
    if (shown_.empty() && answer_.dependent) {
      result_.headline =
          "The poses depend on each other: infinitely many dyads hold the body in all of them.";
      warn("target", "the body only turns about one point, or repeats a part of its motion",
           "a pin at that point holds it; or add a pose off that motion");
      return;
    }
    if (shown_.empty()) {
      result_.headline =
          answer_.status != Status::done ? Sentence("Stopped before a linkage was found.")
          : answer_.outside > 0
              ? say("No linkage through the poses has its pivots in the regions: of {}, {} are outside.",
                    answer_.pairs >= 0 ? "the real linkages" : "the real dyads", answer_.outside)
          : answer_.swept && regions() ? "No linkage through the poses has its pivots in the regions."
          : answer_.pairs >= 0 ? say("None of the {} linkages through the poses is real.", answer_.solutions)
          : answer_.dyads.size() == 0
              ? say("No dyad holds the body in all {} poses: there is no real solution.", n)
              : say("Of the dyads through the poses ({}) no two make a linkage.", answer_.dyads.size());
      relax(warn);
      return;
    }
    const PoseDesign& best = *shown_[0];
    if (answer_.free == 0) {
      result_.headline = say("None of {} linkages through the {} passes them in one motion: {}.",
                             answer_.tried, poses_and_points(), why());
      relax(warn);
      return;
    }
    const Measured pair = degrees_of(best.passage.pair_angle).fixed(1);
    result_.headline =
        say("A {} driven by {} leads the body through {}{}, least pair angle {}.", name_of_linkage(best),
            drive_of(best), poses_and_points(),
            p_.exact ? Sentence()
                     : say(" within {} and {}", length_by_size(best.distance), degrees_of(best.rotation, 3)),
            pair);
    fact("least pair angle", pair, best.passage.pair_angle < flat_pair ? Verdict::bad : Verdict::plain);
    fact("drive", std::string(drive_of(best)));
    if (!p_.exact) {
      fact("worst distance", length_by_size(best.distance));
      fact("worst rotation", degrees_of(best.rotation));
      if (p_.demands.empty()) fact("misfit of the poses to a four-bar", plain_number(answer_.misfit[6], 3));
    }
    if (best.passage.pair_angle < flat_pair)
      warn(say("the pair angle falls to {} between the poses: the linkage is near a dead point there", pair),
           "move a pose, or take out one that need not be met");
  }

  void relax(const study::AddWarning& warn) const {
    if (answer_.status != Status::done) return;
    if (regions())
      warn("mechanism", "the pivots of the linkages through the poses lie elsewhere, or these have defects",
           "make a region larger, or take it out to see where the pivots can be");
    else if (!p_.exact)
      warn("target", "no linkage near the poses passes them in one motion",
           "take poses of a smoother motion, or allow other dyads in mechanism.dyads");
    else if (answer_.pairs >= 0)
      warn("target", "poses and points that leave nothing to choose mostly have linkages with defects",
           "take a pose of a smoother motion, or write fit = \"least_squares\"");
    else if (p_.poses.size() == 5)
      warn("target", "five poses leave at most four dyads, and most of their linkages have defects",
           "take out the pose that matters least: four poses leave a curve to choose from; or write fit = "
           "\"least_squares\"");
    else
      warn("target", "no linkage through the poses passes them in one motion",
           "take out a pose or a pivot that is given, or allow other dyads in mechanism.dyads");
  }

  static Complex number_of(const math::Vec2& v) { return {v.x, v.y}; }

  const PoseProblem& p_;
  const std::vector<PivotForm>& pivots_;
  const study::Common& common_;
  const PoseAnswer answer_;
  std::vector<const PoseDesign*> shown_;
  study::Result result_;
};

}  // namespace

study::Result run_pose_study(const PoseStudy& s, const study::Common& common, RunContext& context) {
  if (!s.problem.exact || !s.mixed)
    return PoseReport(s, common, find_pose_designs(s.problem, context)).make();
  int whole = 0, finite = 0, lost = 0;
  Status status = Status::done;
  std::vector<GuidedPair> real;
  for (const MixedPoseLinkage linkage : s.exact_linkages) {
    MixedPoseSolutions found = solve_mixed_poses({s.problem.poses, s.problem.demands}, linkage, context);
    whole += found.whole;
    finite += found.finite;
    lost += found.lost;
    if (found.status != Status::done) status = found.status;
    std::move(found.real.begin(), found.real.end(), std::back_inserter(real));
  }
  PoseAnswer answer = pose_designs_of(s.problem, real, context);
  answer.solutions = finite;
  if (status != Status::done) answer.status = status;
  study::Result result = PoseReport(s, common, std::move(answer)).make();
  const study::AddWarning warn{result.diagnostics};
  if (lost > 0)
    warn("target", fmt::format("{} paths were lost: linkages may be missing", lost),
         "move a pose a little and compare");
  else if (finite < whole && status == Status::done)
    warn("target",
         fmt::format("the poses are special: {} of {} solutions lie at infinity or coincide", whole - finite,
                     whole),
         "move one of them a little to see the rest");
  return result;
}

}  // namespace linkwright::planar
