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
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_machine_layouts.h"
#include "linkwright/planar/studies/any_report.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/search_state.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/stroke_shape.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

constexpr double most_of_a_turn = 300 * pi / 180;  // of an open stroke: more is told

/// Of the best machine within the limits, infinite where there is none.
double least_error(const TypeSearchAnswer& answer) {
  double least = infinity;
  for (const FamilyReport& f : answer.families) least = std::min(least, f.error);
  return least;
}

/// A stroke, or the poses of a body.
class MotionReport final : public AnyReport {
 public:
  using AnyReport::AnyReport;

 private:
  const SampledStroke& target() const { return motion_.stroke; }
  bool poses() const { return motion_.oriented; }
  /// The drive need not turn.
  bool rocks() const { return !motion_.turns; }

  /// The error that machines are compared by.
  SearchError search_error() const override {
    return {poses() ? "pose_error_rms_m" : "path_error_rms_m", "m", size()};
  }
  std::string compared_by() const override { return "path_error_rms_m"; }
  Measured error_outside(const MachineMeasures& measures) const override { return length(measures.distance); }
  Sentence error_in_words(std::size_t i) const override {
    return say("root mean square error {}", length(machines()[i].measures.distance));
  }

  Sentence label_of(std::size_t i) const override {
    const MachineMeasures& m = machines()[i].measures;
    const Measured pair_angle = degrees_of(m.min_pair_angle).fixed(1);
    const Sentence title = title_of(*machines()[i].machine.shape.program);
    const Sentence label =
        poses() ? say("{}, rms errors {} and {}, pair angle {}", title, length(m.distance),
                      degrees_of(m.rotation, 3), pair_angle)
                : say("{}, rms error {}, pair angle {}", title, length(m.distance), pair_angle);
    return rocks() ? say("{}, drive over {}", label, degrees_of(m.span).fixed(0)) : label;
  }

  void describe(std::size_t i, const FoundLinkage& of, study::Solution& out) const override {
    const FoundMachine& found = machines()[i];
    const MachineMeasures& m = found.measures;
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
    if (motion_.has_tolerance()) out.objectives["beyond_tolerance_m"] = m.beyond_tolerance * size();
    out.objectives["peak_acceleration_share"] = m.peak_acceleration;
    out.classification["traced_point"] = of.traced;
    if (poses()) out.classification["body_angle_on_bar_rad"] = found.machine.body_angle;
    out.classification["crank_range_rad"] = m.span;
    if (rocks()) {
      const auto [from, to] = drive_range(motion_, found.machine);
      out.classification["drive_from_rad"] = from, out.classification["drive_to_rad"] = to;
    }
    out.classification["sense"] = found.machine.sense > 0 ? "positive" : "negative";
  }

  std::vector<double> crank_angles(std::size_t i, const FoundLinkage& of) const override {
    return design_rows(motion_, machines()[i].machine, of, common_.output.samples);
  }

  void add_motion(std::size_t i, const FoundLinkage& of, const std::vector<double>& crank,
                  std::span<const PartState<double>> /*states*/, study::Scene& scene) override {
    const FoundMachine& found = machines()[i];
    if (poses()) {
      pose_scene(found, of, scene);
      pose_table(found, of, i);
    } else {
      study::Scene::Target stroke{"stroke", {}, {}, {}, {}, {}, target().closed};
      for (const auto& p : drawn_points()) stroke.x.push_back(p.real()), stroke.y.push_back(p.imag());
      scene.targets.push_back(std::move(stroke));
    }
    curve_table(found, of, crank, i);
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
    for (double& v : out.x) v = target().centre.real() + size() * v;
    for (double& v : out.y) v = target().centre.imag() + size() * v;
    for (std::size_t k = 0; k < count && poses(); ++k) {
      const double angle = std::atan2(by[k], bx[k]) + found.machine.body_angle;
      out.angle.push_back(k == 0 ? math::wrap_angle(angle)
                                 : out.angle[k - 1] + math::wrap_angle(angle - out.angle[k - 1]));
    }
    return out;
  }

  /// The traced curve as the search has it.
  void curve_table(const FoundMachine& found, const FoundLinkage& of, const std::vector<double>& crank,
                   std::size_t i) {
    std::vector<double> angle = crank;
    for (double& a : angle) a -= of.crank_angle;
    Motion motion = motion_at(found, std::move(angle));
    Table table{.name = "curve" + suffix_of(i)};
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
  void pose_table(const FoundMachine& found, const FoundLinkage& of, std::size_t i) {
    std::vector<double> crank = crank_at_poses(found), x, y, apart, turned;
    const Motion motion = motion_at(found, crank);
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const std::complex<double> at = s_.drawn.points[k];
      x.push_back(at.real()), y.push_back(at.imag());
      apart.push_back(std::hypot(motion.x[k] - at.real(), motion.y[k] - at.imag()));
      turned.push_back(math::wrap_angle(motion.angle[k] - s_.angles[k]));
      crank[k] += of.crank_angle;
    }
    Table table{.name = "poses" + suffix_of(i)};
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
    study::Scene::Target places{"poses", {}, {}, motion.x, motion.y, {}, target().closed};
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const std::complex<double> at = s_.drawn.points[k];
      places.x.push_back(at.real()), places.y.push_back(at.imag());
      places.achieved_input.push_back(crank[k] + of.crank_angle);
      const std::complex<double> turn = std::polar(1.0, s_.angles[k] - found.machine.body_angle);
      study::Scene::Body ghost{fmt::format("pose {}", k + 1), {}, study::Scene::BodyStyle::plate, 1};
      for (const LinkagePoint& point : body->points) {
        const std::complex<double> p = at + turn * (point.at - origin->at);
        ghost.points.push_back(static_cast<int>(scene.points.size()));
        scene.points.push_back({fmt::format("{} at pose {}", point.name, k + 1), {p.real()}, {p.imag()}});
      }
      scene.bodies.push_back(std::move(ghost));
    }
    scene.targets.push_back(std::move(places));
  }

  void add_columns(Table& table) const override {
    using M = const MachineMeasures&;
    table.add("path_error_rms_m", "root mean square error (m)",
              measures_of([&](M m) { return m.distance * size(); }));
    if (motion_.has_tolerance()) {
      table.add("beyond_tolerance_rms_m", "root mean square of the distances beyond the tolerance (m)",
                measures_of([&](M m) { return m.error * size(); }));
      table.add("beyond_tolerance_m", "largest distance beyond a tolerance (m)",
                measures_of([&](M m) { return m.beyond_tolerance * size(); }));
      table.add("within_tolerance", "all points within the tolerance: 1, else 0",
                measures_of([&](M m) { return within_tolerance(m) ? 1.0 : 0.0; }));
    } else if (!poses() && motion_.weight != motion_.share) {
      table.add("weighted_error_rms_m", "root mean square error by the weights of the points (m)",
                measures_of([&](M m) { return m.error * size(); }));
    }
    if (poses()) {
      table.add("pose_error_rms_m", "root mean square of distances and of rotations as lengths (m)",
                measures_of([&](M m) { return m.error * size(); }));
      table.add("rotation_error_rms_rad", "root mean square error of the rotation (rad)",
                measures_of([](M m) { return m.rotation; }));
      table.add("largest_rotation_error_rad", "largest error of the rotation (rad)",
                measures_of([](M m) { return m.largest_rotation; }));
    } else {
      table.add("chamfer_distance_share", "chamfer distance, of the size of the stroke",
                column_of([&](std::size_t i) { return machines()[i].chamfer; }));
    }
    table.add("largest_deviation_m", "largest deviation (m)",
              measures_of([&](M m) { return m.largest_deviation * size(); }));
  }

  void add_last_columns(Table& table) const override {
    using M = const MachineMeasures&;
    table.add("crank_range_rad",
              rocks() ? "range of the drive (rad)" : "crank rotation along the stroke (rad)",
              measures_of([](M m) { return m.span; }));
    if (rocks()) {
      table.add("drive_from_rad", "crank angle at which the motion begins (rad)",
                column_of([&](std::size_t i) { return drive_range(motion_, machines()[i].machine)[0]; }));
      table.add("drive_to_rad", "crank angle at which the motion ends (rad)",
                column_of([&](std::size_t i) { return drive_range(motion_, machines()[i].machine)[1]; }));
    }
    table.add("peak_acceleration_share", "peak acceleration at unit crank speed, of the size of the stroke",
              measures_of([](M m) { return m.peak_acceleration; }));
  }

  void tell_of_best(const study::AddFact& fact, const Sentence& links, const Measured& pair_angle) override {
    const FoundMachine& best = machines()[0];
    const MachineMeasures& m = best.measures;
    if (poses())
      result_.headline =
          say("A machine of {} links leads the body through the poses with root mean square errors of {} and "
              "{} and pair angles of at least {}.",
              links, length(m.distance), degrees_of(m.rotation, 3), pair_angle);
    else
      result_.headline =
          say("A machine of {} links follows the stroke with a root mean square error of {} and pair angles "
              "of at least {}.",
              links, length(m.distance), pair_angle);
    fact("root mean square error", length(m.distance));
    if (poses()) fact("root mean square error of the rotation", degrees_of(m.rotation, 3));
    if (poses()) fact("largest error of the rotation", degrees_of(m.largest_rotation, 3));
    fact("largest deviation", length(m.largest_deviation));
    if (motion_.has_tolerance()) tolerance_fact(fact);
    band_facts(fact);
    if (!poses()) fact("chamfer distance, of the size of the stroke", plain_number(best.chamfer, 3));
    if (rocks())
      drive_fact(best.machine, fact);
    else if (!target().closed)
      fact(poses() ? "crank rotation through the poses" : "crank rotation along the stroke",
           degrees_of(m.span).fixed(0));
  }

  void add_remarks(const study::AddFact& fact) override {
    if (auto layouts = layout_table(machines(), motion_)) result_.tables.push_back(std::move(*layouts));
    if (!poses()) stroke_facts(fact);
    band_table();
    const study::AddWarning warn{result_.diagnostics};
    const MachineMeasures& m = machines()[0].measures;
    if (m.peak_acceleration > 100 && !poses())
      warn("target",
           say("the best machine passes a corner with {} times the acceleration of a point on a circle",
               plain_number(m.peak_acceleration, 3)),
           "round the corners of the stroke where speed matters");
    if (!rocks() && !target().closed && m.span > most_of_a_turn)
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

  bool within_tolerance(const MachineMeasures& m) const { return m.beyond_tolerance == 0; }

  /// How a machine keeps a band: the sample that is farthest beyond its tolerance, or nearest to it, and the
  /// distance there (m).
  struct BandFinding {
    std::size_t sample = 0;
    double distance = 0, beyond = 0;
    bool kept() const { return beyond == 0; }
  };
  BandFinding finding_of(const FoundMachine& found, const ToleranceBand& band) const {
    const Motion motion = motion_at(found, {found.machine.angle.begin(), found.machine.angle.end()});
    BandFinding out;
    for (const std::size_t k : samples_of(motion_, band)) {
      const std::complex<double> wanted = target().centre + size() * std::complex(motion_.x[k], motion_.y[k]);
      const double distance = std::abs(std::complex(motion.x[k], motion.y[k]) - wanted);
      if (distance >= out.distance) out.sample = k, out.distance = distance;
    }
    const double tolerance = band.tolerance * size(), beyond = out.distance - tolerance;
    if (beyond > 1e-9 * tolerance) out.beyond = beyond;
    return out;
  }
  /// Share of the length of the stroke at which a sample lies.
  double share_at(std::size_t sample) const {
    return static_cast<double>(sample) /
           static_cast<double>(target().closed ? stroke_samples : stroke_samples - 1);
  }

  /// Each band of each machine.
  void band_table() {
    if (motion_.bands.empty()) return;
    Column machine, number, from, to, tolerance, distance, beyond, at, x, y, kept;
    for (std::size_t i = 0; i < machines().size(); ++i)
      for (std::size_t b = 0; b < motion_.bands.size(); ++b) {
        const ToleranceBand& band = motion_.bands[b];
        const BandFinding found = finding_of(machines()[i], band);
        machine.push_back(static_cast<double>(i + 1)), number.push_back(static_cast<double>(b + 1));
        from.push_back(band.from), to.push_back(band.to), tolerance.push_back(band.tolerance * size());
        distance.push_back(found.distance), beyond.push_back(found.beyond);
        at.push_back(share_at(found.sample));
        x.push_back(target().centre.real() + size() * motion_.x[found.sample]);
        y.push_back(target().centre.imag() + size() * motion_.y[found.sample]);
        kept.push_back(found.kept() ? 1 : 0);
      }
    Table table{.name = "bands"};
    table.add("machine", "number of the machine in the list", std::move(machine));
    table.add("band", "number of the band", std::move(number));
    table.add("from_share", "share of the length of the stroke at which it begins", std::move(from));
    table.add("to_share", "share at which it ends", std::move(to));
    table.add("tolerance_m", "tolerance (m)", std::move(tolerance));
    table.add("largest_deviation_m", "largest deviation in the band (m)", std::move(distance));
    table.add("beyond_tolerance_m", "largest distance beyond the tolerance (m)", std::move(beyond));
    table.add("at_share", "share of the length at which the deviation is largest", std::move(at));
    table.add("x_m", "x of the stroke there (m)", std::move(x));
    table.add("y_m", "y of the stroke there (m)", std::move(y));
    table.add("kept", "the band is kept: 1, else 0", std::move(kept));
    result_.tables.push_back(std::move(table));
  }

  /// The bands of the best machine.
  void band_facts(const study::AddFact& fact) const {
    for (std::size_t b = 0; b < motion_.bands.size(); ++b) {
      const BandFinding found = finding_of(machines()[0], motion_.bands[b]);
      const std::string name =
          motion_.bands.size() == 1 ? std::string("band") : fmt::format("band {}", b + 1);
      const Measured where = percent(share_at(found.sample), 3), largest = millimetres(found.distance, 3);
      fact(name,
           found.kept() ? say("kept; largest deviation {}, at {} of the length", largest, where)
                        : say("exceeded by {}, at {} of the length", millimetres(found.beyond, 3), where),
           found.kept() ? study::Fact::Verdict::good : study::Fact::Verdict::bad)
          .number = largest;
    }
  }

  void tolerance_fact(const study::AddFact& fact) const {
    const auto inside = std::count_if(machines().begin(), machines().end(), [&](const FoundMachine& found) {
      return within_tolerance(found.measures);
    });
    fact("machines within the tolerance", say("{} of {}", count_of(static_cast<double>(inside)),
                                              count_of(static_cast<double>(machines().size()))));
  }

  void stroke_facts(const study::AddFact& fact) const {
    const StrokeShape shape = stroke_shape_of(target());
    if (shape.retraced > 0.03)
      fact("part of the stroke that is traced back and forth", percent(shape.retraced, 2));
    if (shape.crossings > 0)
      fact("crossings of the stroke with itself", count_of(static_cast<double>(shape.crossings)));
  }
};

}  // namespace

TypeSearchOptions search_options(const AnyStudy& s, const study::Common& common,
                                 const MachineLimits& limits) {
  TypeSearchOptions options;
  if (s.mechanism.families) options.families = *s.mechanism.families;
  options.max_links = s.mechanism.most_links;
  options.limits = limits;
  options.seed = static_cast<std::uint64_t>(common.seeds.first);
  options.max_solutions = static_cast<std::size_t>(s.optimiser.max_solutions);
  options.max_curves = s.optimiser.evaluations.value_or(0);
  return options;
}

TypeSearchAnswer search_machines(const AnyStudy& s, const study::Common& common, const MachineLimits& limits,
                                 RunContext& context, study::Result& result) {
  const TypeSearchOptions options = search_options(s, common, limits);
  const std::vector<MachineFamily> families = searched_families(*s.motion, options);
  const bool alone = common.seeds.count == 1;
  const auto search = [&](std::uint64_t seed) {
    // The time of the search is part of the study: it ends as done. Interruptions from outside end the run.
    RunContext part;
    part.set_part_of(context);
    part.set_threads(alone ? context.threads() : 1);
    part.set_checkpoint(context.checkpoint());
    const auto began = RunContext::Clock::now();
    part.set_progress([&](const Progress& progress) {
      Progress shown = progress;
      if (s.optimiser.seconds)
        shown.fraction =
            std::min(1.0, std::chrono::duration<double>(RunContext::Clock::now() - began).count() /
                              *s.optimiser.seconds);
      if (alone) context.report(shown);
    });
    if (s.optimiser.seconds) part.set_time_limit(std::chrono::duration<double>(*s.optimiser.seconds));
    TypeSearchOptions own = options;
    own.seed = seed, own.saved_as = optimise::seed_name(seed) + "/types";
    TypeSearchAnswer answer = search_types(*s.motion, own, part);
    answer.status = context.interruption();
    return answer;
  };
  const auto runs = study::run_seeds(
      common.seeds, context, "search", search, [](const TypeSearchAnswer& answer) { return answer.status; },
      [](const TypeSearchAnswer& answer) { return least_error(answer); },
      [](const TypeSearchAnswer& answer) { return saved_answer(answer); },
      [&](const Value& value, const std::string& what) { return load_answer(value, families, what); });
  for (std::size_t i = 0; i < runs.answers.size(); ++i) {
    const TypeSearchAnswer& answer = runs.answers[i];
    const double least = least_error(answer);
    result.log.push_back(study::seed_entry(runs.seeds[i], answer.status,
                                           std::isfinite(least) ? least * s.motion->error_unit() : nan,
                                           answer.curves));
  }
  study::warn_of_missing_seeds(result, runs.answers.size(), common.seeds);
  return merged_answers(*s.motion, runs.answers, options.max_solutions);
}

study::Result run_any_study(const AnyStudy& s, const study::Common& common, RunContext& context) {
  return MotionReport(s, common).make(context);
}

}  // namespace linkwright::planar
