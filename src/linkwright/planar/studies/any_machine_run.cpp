// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_machine_layouts.h"
#include "linkwright/planar/studies/any_search_tables.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/stroke_shape.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

constexpr double most_of_a_turn = 300 * pi / 180;  // of an open stroke: more is told

class AnyReport {
 public:
  AnyReport(const AnyStudy& s, const study::Common& common, const MachineLimits& limits,
            TypeSearchAnswer answer, ListFigures figures)
      : s_(s),
        common_(common),
        motion_(*s.motion),
        target_(motion_.stroke),
        limits_(limits),
        answer_(std::move(answer)),
        figures_(std::move(figures)) {}

  study::Result make() {
    result_.status = answer_.status;
    if (answer_.status == Status::done && answer_.machines.empty()) result_.status = Status::infeasible;
    for (std::size_t i = 0; i < answer_.machines.size(); ++i) solution(answer_.machines[i], i + 1);
    machine_table();
    if (auto layouts = layout_table(answer_.machines, motion_)) result_.tables.push_back(std::move(*layouts));
    add_search_tables(answer_, {error_key(), "m", size()}, result_);
    if (figures_.refined) {
      result_.statistics["refinements"] = figures_.descents;
      result_.statistics["refinement_steps"] = figures_.steps;
    }
    findings();
    return std::move(result_);
  }

 private:
  double size() const { return target_.size; }
  bool poses() const { return motion_.oriented; }
  /// The drive need not turn.
  bool rocks() const { return !motion_.turns; }
  /// The error that machines are compared by.
  const char* error_key() const { return poses() ? "pose_error_rms_m" : "path_error_rms_m"; }
  Measured length(double sizes, int digits = 3) const { return millimetres(sizes * size(), digits); }

  void solution(const FoundMachine& found, std::size_t number) {
    const PointProgram& program = *found.machine.shape.program;
    const MachineMeasures& m = found.measures;
    study::Solution out;
    const Measured pair_angle = degrees_of(m.min_pair_angle).fixed(1);
    out.label =
        poses() ? say("{}, rms errors {} and {}, pair angle {}", title_of(program), length(m.distance),
                      degrees_of(m.rotation, 3), pair_angle)
                : say("{}, rms error {}, pair angle {}", title_of(program), length(m.distance), pair_angle);
    if (rocks()) out.label = say("{}, drive over {}", out.label, degrees_of(m.span).fixed(0));
    FoundLinkage of = found_linkage(found.machine, target_);
    if (s_.refinement.loaded) add_loads(of, loads_of(s_.refinement));
    add_link_lengths(of.linkage, out);
    out.objectives["path_error_rms_m"] = m.distance * size();
    out.objectives["path_error_share"] = m.distance;
    if (poses()) {
      out.objectives["pose_error_rms_m"] = m.error * size();
      out.objectives["rotation_error_rms_rad"] = m.rotation;
      out.objectives["largest_rotation_error_rad"] = m.largest_rotation;
    } else {
      out.objectives["chamfer_distance_share"] = found.chamfer;
    }
    out.objectives["largest_deviation_m"] = m.largest_deviation * size();
    out.objectives["least_pair_angle_rad"] = m.min_pair_angle;
    out.objectives["size_m"] = m.size * size();
    out.objectives["longest_link_m"] = m.max_length * size();
    out.objectives["peak_acceleration_share"] = m.peak_acceleration;
    out.classification["family"] = std::string(name_of(program.family));
    out.classification["program"] = program.name;
    out.classification["type"] = short_name_of(program);
    out.classification["links"] = program.links;
    out.classification["traced_point"] = of.traced;
    if (poses()) out.classification["body_angle_on_bar_rad"] = found.machine.body_angle;
    out.classification["crank_range_rad"] = m.span;
    if (rocks()) {
      const auto [from, to] = drive_range(motion_, found.machine);
      out.classification["drive_from_rad"] = from, out.classification["drive_to_rad"] = to;
    }
    out.classification["sense"] = found.machine.sense > 0 ? "positive" : "negative";
    if (const std::string limit = limited_by(found); !limit.empty()) out.classification["limited_by"] = limit;
    add_figures(figures_, number - 1, out);
    drawing(found, of, out, number);
    result_.solutions.push_back(std::move(out));
  }

  /// The limits that the machine has come to.
  std::string limited_by(const FoundMachine& found) const {
    const MachineMeasures& m = found.measures;
    std::vector<std::string> out;
    if (m.min_pair_angle < limits_.min_pair_angle + 0.01) out.emplace_back("least_pair_angle");
    if (m.max_length > limits_.max_length * 0.995) out.emplace_back("longest_link");
    if (m.min_length < limits_.min_length * 1.01) out.emplace_back("shortest_link");
    if (const auto& box = limits_.ground_box) {
      const MachineShape& shape = found.machine.shape;
      double inside = infinity;
      for (const GroundPivot& pivot : ground_pivots(*shape.program)) {
        const std::complex<double> at = place_of(pivot, *shape.program, shape.x);
        inside = std::min({inside, at.real() - box->left, box->right - at.real(), at.imag() - box->bottom,
                           box->top - at.imag()});
      }
      if (inside < 0.01) out.emplace_back("ground_box");
    }
    return fmt::format("{}", fmt::join(out, ", "));
  }

  /// The machine by the solver of any linkage, which knows nothing of the search.
  void drawing(const FoundMachine& found, const FoundLinkage& of, study::Solution& out, std::size_t number) {
    const PlanResult planned = plan_linkage(of.linkage);
    LinkageMotion moving(planned.plan);
    const std::vector<double> crank = design_rows(motion_, found.machine, of, common_.output.samples);
    std::vector<LinkageRecord> records;
    for (const double angle : crank) {
      const InputMotion input{angle, 0, 0};
      solve_motion(planned.plan, std::span(&input, 1), moving);
      records.push_back(record_of(of.linkage, planned.plan, moving, nullptr, angle));
    }
    study::Scene scene =
        linkage_scene(of.linkage, planned.plan, records, {point_named(of.linkage, of.traced)},
                      "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", count_of(static_cast<double>(number)), out.label);
    if (poses()) {
      pose_scene(found, of, scene);
      pose_table(found, of, number);
    } else {
      study::Scene::Target stroke{"stroke", {}, {}, {}, {}, {}, target_.closed};
      for (const auto& p : drawn_points()) stroke.x.push_back(p.real()), stroke.y.push_back(p.imag());
      scene.targets.push_back(std::move(stroke));
    }
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
    out.study = motion_study(of.linkage, true, crank, of.traced);
    load_design(s_.refinement, out.study);
    curve_table(found, of, crank, number);
  }

  /// The stroke as it is drawn: thinned out where it has many points.
  std::vector<std::complex<double>> drawn_points() const {
    constexpr std::size_t most = 500;
    if (s_.drawn.points.size() <= most) return s_.drawn.points;
    return equal_steps(s_.drawn.points, s_.drawn.closed, most);
  }

  /// The traced point and the angle of the body at crank angles of the program, in the global frame.
  struct Motion {
    std::vector<double> x, y, angle;
  };
  Motion motion_at(const FoundMachine& found, std::vector<double> crank) const {
    const std::size_t count = crank.size();
    crank.resize((count + 7) / 8 * 8, crank.back());
    Motion out;
    std::vector<double> bx(crank.size()), by(crank.size());
    out.x.resize(crank.size()), out.y.resize(crank.size());
    const MachineShape& shape = found.machine.shape;
    CurveTask task{.program = shape.program,
                   .x = shape.x.data(),
                   .signs = shape.signs,
                   .angle = crank.data(),
                   .count = crank.size(),
                   .px = out.x.data(),
                   .py = out.y.data()};
    if (poses()) task.bx = bx.data(), task.by = by.data();
    compute_curve(task);
    out.x.resize(count), out.y.resize(count);
    for (double& v : out.x) v = target_.centre.real() + size() * v;
    for (double& v : out.y) v = target_.centre.imag() + size() * v;
    for (std::size_t k = 0; k < count && poses(); ++k) {
      const double angle = std::atan2(by[k], bx[k]) + found.machine.body_angle;
      out.angle.push_back(k == 0 ? math::wrap_angle(angle)
                                 : out.angle[k - 1] + math::wrap_angle(angle - out.angle[k - 1]));
    }
    return out;
  }

  /// The traced curve as the search has it.
  void curve_table(const FoundMachine& found, const FoundLinkage& of, const std::vector<double>& crank,
                   std::size_t number) {
    std::vector<double> angle = crank;
    for (double& a : angle) a -= of.crank_angle;
    Motion motion = motion_at(found, std::move(angle));
    Table table{.name = number == 1 ? "curve" : fmt::format("curve-{}", number)};
    table.add("crank_angle_rad", "crank angle (rad)", crank);
    table.add("point_x_m", "x of the traced point (m)", std::move(motion.x));
    table.add("point_y_m", "y of the traced point (m)", std::move(motion.y));
    if (poses()) table.add("body_angle_rad", "angle of the body (rad)", std::move(motion.angle));
    result_.tables.push_back(std::move(table));
  }

  /// Crank angle of the program at each pose: that of the first sample of the pose.
  std::vector<double> crank_at_poses(const FoundMachine& found) const {
    std::vector<double> out;
    const std::size_t n = s_.angles.size();
    for (std::size_t k = 0; k < motion_.count; ++k)
      if (k * n / motion_.count == out.size()) out.push_back(found.machine.angle[k]);
    return out;
  }

  /// The poses and how the body meets them.
  void pose_table(const FoundMachine& found, const FoundLinkage& of, std::size_t number) {
    std::vector<double> crank = crank_at_poses(found), x, y, apart, turned;
    const Motion motion = motion_at(found, crank);
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const std::complex<double> at = s_.drawn.points[k];
      x.push_back(at.real()), y.push_back(at.imag());
      apart.push_back(std::hypot(motion.x[k] - at.real(), motion.y[k] - at.imag()));
      turned.push_back(math::wrap_angle(motion.angle[k] - s_.angles[k]));
      crank[k] += of.crank_angle;
    }
    Table table{.name = number == 1 ? "poses" : fmt::format("poses-{}", number)};
    table.add("crank_angle_rad", "crank angle (rad)", std::move(crank));
    table.add("pose_x_m", "x of the pose (m)", std::move(x));
    table.add("pose_y_m", "y of the pose (m)", std::move(y));
    table.add("pose_angle_rad", "rotation of the pose (rad)", s_.angles);
    table.add("place_error_m", "distance of the body from the pose (m)", std::move(apart));
    table.add("rotation_error_rad", "rotation of the body from the pose (rad)", std::move(turned));
    result_.tables.push_back(std::move(table));
  }

  /// The traced bar at every pose, pale behind, and the origin of the body as what is to be reached.
  void pose_scene(const FoundMachine& found, const FoundLinkage& of, study::Scene& scene) const {
    const std::size_t dot = of.traced.find('.');
    const auto body = std::find_if(of.linkage.bodies.begin(), of.linkage.bodies.end(),
                                   [&](const LinkageBody& b) { return b.name == of.traced.substr(0, dot); });
    if (body == of.linkage.bodies.end()) return;
    const auto origin = std::find_if(body->points.begin(), body->points.end(), [&](const LinkagePoint& p) {
      return p.name == of.traced.substr(dot + 1);
    });
    if (origin == body->points.end()) return;
    scene.runs = {"linkage", "poses"};
    const std::vector<double> crank = crank_at_poses(found);
    const Motion motion = motion_at(found, crank);
    study::Scene::Target target{"poses", {}, {}, motion.x, motion.y, {}, target_.closed};
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const std::complex<double> at = s_.drawn.points[k];
      target.x.push_back(at.real()), target.y.push_back(at.imag());
      target.achieved_input.push_back(crank[k] + of.crank_angle);
      const std::complex<double> turn = std::polar(1.0, s_.angles[k] - found.machine.body_angle);
      study::Scene::Body ghost{fmt::format("pose {}", k + 1), {}, study::Scene::BodyStyle::plate, 1};
      for (const LinkagePoint& point : body->points) {
        const std::complex<double> p = at + turn * (point.at - origin->at);
        ghost.points.push_back(static_cast<int>(scene.points.size()));
        scene.points.push_back({fmt::format("{} at pose {}", point.name, k + 1), {p.real()}, {p.imag()}});
      }
      scene.bodies.push_back(std::move(ghost));
    }
    scene.targets.push_back(std::move(target));
  }

  void machine_table() {
    if (answer_.machines.empty()) return;
    Table table{.name = "machines"};
    const auto column = [&](const char* key, const char* label, auto&& value) {
      std::vector<double> values;
      for (const FoundMachine& found : answer_.machines) values.push_back(value(found, found.measures));
      table.add(key, label, std::move(values));
    };
    using F = const FoundMachine&;
    using M = const MachineMeasures&;
    for (const FoundMachine& found : answer_.machines)
      table.names.push_back(found.machine.shape.program->name);
    column("links", "links", [](F f, M) { return static_cast<double>(f.machine.shape.program->links); });
    column("path_error_rms_m", "root mean square error (m)", [&](F, M m) { return m.distance * size(); });
    if (motion_.tolerance > 0) {
      column("beyond_tolerance_rms_m", "root mean square of the distances beyond the tolerance (m)",
             [&](F, M m) { return m.error * size(); });
      column("within_tolerance", "all points within the tolerance: 1, else 0",
             [&](F, M m) { return within_tolerance(m) ? 1.0 : 0.0; });
    }
    if (poses()) {
      column("pose_error_rms_m", "root mean square of distances and of rotations as lengths (m)",
             [&](F, M m) { return m.error * size(); });
      column("rotation_error_rms_rad", "root mean square error of the rotation (rad)",
             [](F, M m) { return m.rotation; });
      column("largest_rotation_error_rad", "largest error of the rotation (rad)",
             [](F, M m) { return m.largest_rotation; });
    } else {
      column("chamfer_distance_share", "chamfer distance, of the size of the stroke",
             [](F f, M) { return f.chamfer; });
    }
    column("largest_deviation_m", "largest deviation (m)",
           [&](F, M m) { return m.largest_deviation * size(); });
    column("least_pair_angle_rad", "least pair angle (rad)", [](F, M m) { return m.min_pair_angle; });
    column("size_m", "larger side of the box of all pins (m)", [&](F, M m) { return m.size * size(); });
    column("shortest_link_m", "shortest length (m)", [&](F, M m) { return m.min_length * size(); });
    column("longest_link_m", "longest length (m)", [&](F, M m) { return m.max_length * size(); });
    column("crank_range_rad", rocks() ? "range of the drive (rad)" : "crank rotation along the stroke (rad)",
           [](F, M m) { return m.span; });
    if (rocks()) {
      column("drive_from_rad", "crank angle at which the motion begins (rad)",
             [this](F f, M) { return drive_range(motion_, f.machine)[0]; });
      column("drive_to_rad", "crank angle at which the motion ends (rad)",
             [this](F f, M) { return drive_range(motion_, f.machine)[1]; });
    }
    column("peak_acceleration_share", "peak acceleration at unit crank speed, of the size of the stroke",
           [](F, M m) { return m.peak_acceleration; });
    add_figure_columns(figures_, table);
    result_.tables.push_back(std::move(table));
    add_figure_plots(figures_, "path_error_rms_m", result_);
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    if (answer_.machines.empty()) {
      const FoundMachine* nearest = nearest_outside(answer_);
      report_none_found(answer_, nearest ? length(nearest->measures.distance) : Measured{}, result_);
      return;
    }
    const FoundMachine& best = answer_.machines[0];
    const MachineMeasures& m = best.measures;
    const Measured pair_angle = degrees_of(m.min_pair_angle).fixed(1);
    const Sentence links = count_of(best.machine.shape.program->links);
    if (poses())
      result_.headline =
          say("A machine of {} links leads the body through the poses with root mean square errors of {} and "
              "{} and pair angles of at least {}.",
              links, length(m.distance), degrees_of(m.rotation, 3), pair_angle);
    else
      result_.headline =
          say("A machine of {} links follows the stroke with a root mean square error of {} and pair angles "
              "of at "
              "least {}.",
              links, length(m.distance), pair_angle);
    fact("best machine",
         say("{} ({})", title_of(*best.machine.shape.program), best.machine.shape.program->name));
    fact("root mean square error", length(m.distance));
    if (poses()) fact("root mean square error of the rotation", degrees_of(m.rotation, 3));
    if (poses()) fact("largest error of the rotation", degrees_of(m.largest_rotation, 3));
    fact("largest deviation", length(m.largest_deviation));
    if (motion_.tolerance > 0) tolerance_fact(fact);
    if (!poses()) fact("chamfer distance, of the size of the stroke", plain_number(best.chamfer, 3));
    const std::string over = rocks() ? "over the range of the drive" : "over the whole turn";
    fact("least pair angle " + over, pair_angle);
    fact("box of the pins " + over + ", larger side", length(m.size));
    if (rocks())
      drive_fact(best.machine, fact);
    else if (!target_.closed)
      fact(poses() ? "crank rotation through the poses" : "crank rotation along the stroke",
           degrees_of(m.span).fixed(0));
    const auto simplest = std::min_element(
        answer_.machines.begin(), answer_.machines.end(), [](const FoundMachine& a, const FoundMachine& b) {
          return a.machine.shape.program->links < b.machine.shape.program->links;
        });
    if (simplest->machine.shape.program->links < best.machine.shape.program->links)
      fact("best machine with the fewest links",
           say("{} links ({}), root mean square error {}", count_of(simplest->machine.shape.program->links),
               short_name_of(*simplest->machine.shape.program), length(simplest->measures.distance)));
    add_figure_facts(s_.refinement, figures_, *result_.table("machines"), motion_, fact);
    fact("curves computed", count_of(static_cast<double>(answer_.curves)));
    if (!poses()) stroke_facts(fact);
    if (m.peak_acceleration > 100 && !poses())
      warn("target",
           say("the best machine passes a corner with {} times the acceleration of a point on a circle",
               plain_number(m.peak_acceleration, 3)),
           "round the corners of the stroke where speed matters");
    if (!rocks() && !target_.closed && m.span > most_of_a_turn)
      warn("limits",
           say("the best machine takes {} of its turn along the {}, and has {} to come back",
               degrees_of(m.span).fixed(0), poses() ? "poses" : "stroke",
               degrees_of(2 * pi - m.span).fixed(0)),
           "write crank_turns = false for machines whose drive rocks");
  }

  void drive_fact(const FittedMachine& machine, const study::AddFact& fact) const {
    const auto [from, to] = drive_range(motion_, machine);
    const Measured range = degrees_of(std::abs(to - from)).fixed(1);
    fact("range of the drive",
         say("{}, from {} to {}", range, degrees_of(from).fixed(1), degrees_of(to).fixed(1)))
        .number = range;
  }

  /// The polish ends at the edge of the band, to rounding.
  bool within_tolerance(const MachineMeasures& m) const {
    return m.largest_deviation <= motion_.tolerance * (1 + 1e-9);
  }

  void tolerance_fact(const study::AddFact& fact) const {
    const auto inside =
        std::count_if(answer_.machines.begin(), answer_.machines.end(),
                      [&](const FoundMachine& found) { return within_tolerance(found.measures); });
    fact("machines within the tolerance", say("{} of {}", count_of(static_cast<double>(inside)),
                                              count_of(static_cast<double>(answer_.machines.size()))));
  }

  void stroke_facts(const study::AddFact& fact) const {
    const StrokeShape shape = stroke_shape_of(target_);
    if (shape.retraced > 0.03)
      fact("part of the stroke that is traced back and forth", percent(shape.retraced, 2));
    if (shape.crossings > 0)
      fact("crossings of the stroke with itself", count_of(static_cast<double>(shape.crossings)));
  }

  const AnyStudy& s_;
  const study::Common& common_;
  const MotionTarget& motion_;
  const SampledStroke& target_;
  const MachineLimits& limits_;
  const TypeSearchAnswer answer_;
  const ListFigures figures_;
  study::Result result_;
};

}  // namespace

TypeSearchOptions search_options(const AnyStudy& s, const MachineLimits& limits) {
  TypeSearchOptions options;
  if (s.mechanism.families) options.families = *s.mechanism.families;
  options.max_links = s.mechanism.most_links;
  options.limits = limits;
  options.seed = static_cast<std::uint64_t>(s.optimiser.seed);
  options.max_solutions = static_cast<std::size_t>(s.optimiser.max_solutions);
  options.max_curves = s.optimiser.evaluations.value_or(0);
  return options;
}

TypeSearchAnswer search_machines(const AnyStudy& s, const MachineLimits& limits, RunContext& context) {
  // The time of the search is part of the study: it ends as done. Interruptions from outside end the run.
  RunContext part;
  part.set_part_of(context);
  part.set_threads(context.threads());
  part.set_checkpoint(context.checkpoint());
  const auto began = RunContext::Clock::now();
  part.set_progress([&](const Progress& progress) {
    Progress shown = progress;
    if (s.optimiser.seconds)
      shown.fraction = std::min(1.0, std::chrono::duration<double>(RunContext::Clock::now() - began).count() /
                                         *s.optimiser.seconds);
    context.report(shown);
  });
  if (s.optimiser.seconds) part.set_time_limit(std::chrono::duration<double>(*s.optimiser.seconds));
  TypeSearchAnswer answer = search_types(*s.motion, search_options(s, limits), part);
  answer.status = context.interruption();
  return answer;
}

study::Result run_any_study(const AnyStudy& s, const study::Common& common, RunContext& context) {
  const MachineLimits limits = limits_of(s.limits, s.motion->stroke);
  TypeSearchAnswer answer = search_machines(s, limits, context);
  ListFigures figures =
      refine_list(s.refinement, *s.motion, search_options(s, limits), common.output.samples, answer, context);
  answer.status = context.interruption();
  return AnyReport(s, common, limits, std::move(answer), std::move(figures)).make();
}

}  // namespace linkwright::planar
