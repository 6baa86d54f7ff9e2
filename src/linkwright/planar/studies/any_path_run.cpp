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
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/any_path.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

constexpr std::size_t max_given_pivots = 4;  // machines of ten links have no more than five

/// What a value of an enumeration means.
template <class E>
std::string summary_of(E value) {
  for (const auto& word : names(E{}))
    if (word.value == value) return std::string(word.summary);
  return {};
}

class AnyPathReport {
 public:
  AnyPathReport(const AnyPathStudy& s, const study::Common& common, const SampledStroke& target,
                const MachineLimits& limits, TypeSearchAnswer answer)
      : s_(s), common_(common), target_(target), limits_(limits), answer_(std::move(answer)) {}

  study::Result make() {
    result_.status = answer_.status;
    if (answer_.status == Status::done && answer_.machines.empty()) result_.status = Status::infeasible;
    for (std::size_t i = 0; i < answer_.machines.size(); ++i) solution(answer_.machines[i], i + 1);
    machine_table();
    family_table();
    progress_table();
    statistics();
    findings();
    return std::move(result_);
  }

 private:
  double size() const { return target_.size; }
  Measured length(double sizes, int digits = 3) const { return millimetres(sizes * size(), digits); }

  void solution(const FoundMachine& found, std::size_t number) {
    const PointProgram& program = *found.machine.shape.program;
    const MachineMeasures& m = found.measures;
    study::Solution out;
    out.label = say("{}, rms error {}, pair angle {}", program.name, length(m.error),
                    degrees_of(m.min_pair_angle).fixed(1));
    const FoundLinkage of = found_linkage(found.machine, target_);
    for (const LinkageBody& body : of.linkage.bodies)
      for (std::size_t k = 1; &body != &of.linkage.bodies[0] && k < body.points.size(); ++k)
        out.parameters.push_back(
            {fmt::format("{}_{}{}_m", body.name, body.points[0].name, body.points[k].name),
             fmt::format("{}, from {} to {}", body.name, body.points[0].name, body.points[k].name),
             std::abs(body.points[k].at - body.points[0].at), -infinity, infinity});
    out.objectives["path_error_rms_m"] = m.error * size();
    out.objectives["path_error_share"] = m.error;
    out.objectives["chamfer_distance_share"] = found.chamfer;
    out.objectives["largest_deviation_m"] = m.largest_deviation * size();
    out.objectives["least_pair_angle_rad"] = m.min_pair_angle;
    out.objectives["size_m"] = m.size * size();
    out.objectives["longest_link_m"] = m.max_length * size();
    out.objectives["peak_acceleration_share"] = m.peak_acceleration;
    out.classification["family"] = std::string(name_of(program.family));
    out.classification["program"] = program.name;
    out.classification["links"] = program.links;
    out.classification["traced_point"] = of.traced;
    out.classification["crank_range_rad"] = m.span;
    out.classification["sense"] = found.machine.sense > 0 ? "positive" : "negative";
    if (const std::string limit = limited_by(found); !limit.empty()) out.classification["limited_by"] = limit;
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
    std::vector<double> crank;
    std::vector<LinkageRecord> records;
    const int samples = common_.output.samples;
    const double from = found.machine.angle.front() + of.crank_angle;
    for (int k = 0; k < samples; ++k) {
      crank.push_back(from + found.machine.sense * 2 * pi * k / (samples - 1));
      const InputMotion input{crank.back(), 0, 0};
      solve_motion(planned.plan, std::span(&input, 1), moving);
      records.push_back(record_of(of.linkage, planned.plan, moving, nullptr, crank.back()));
    }
    study::Scene scene =
        linkage_scene(of.linkage, planned.plan, records, {point_named(of.linkage, of.traced)},
                      "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", count_of(static_cast<double>(number)), out.label);
    study::Scene::Target stroke{"stroke", {}, {}, {}, {}, {}, target_.closed};
    for (const auto& p : drawn_points()) stroke.x.push_back(p.real()), stroke.y.push_back(p.imag());
    scene.targets.push_back(std::move(stroke));
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
    out.study = motion_study(of.linkage, true, crank, of.traced);
    curve_table(found, of, crank, number);
  }

  /// The stroke as it is drawn: thinned out where it has many points.
  std::vector<std::complex<double>> drawn_points() const {
    constexpr std::size_t most = 500;
    if (s_.stroke.points.size() <= most) return s_.stroke.points;
    return equal_steps(s_.stroke.points, s_.stroke.closed, most);
  }

  /// The traced curve as the search has it.
  void curve_table(const FoundMachine& found, const FoundLinkage& of, const std::vector<double>& crank,
                   std::size_t number) {
    const std::size_t count = crank.size();
    std::vector<double> angle = crank, x, y;
    for (double& a : angle) a -= of.crank_angle;
    angle.resize((count + 7) / 8 * 8, angle.back());
    x.resize(angle.size()), y.resize(angle.size());
    const MachineShape& shape = found.machine.shape;
    compute_curve({.program = shape.program,
                   .x = shape.x.data(),
                   .signs = shape.signs,
                   .angle = angle.data(),
                   .count = angle.size(),
                   .px = x.data(),
                   .py = y.data()});
    x.resize(count), y.resize(count);
    for (double& v : x) v = target_.centre.real() + size() * v;
    for (double& v : y) v = target_.centre.imag() + size() * v;
    Table table{.name = number == 1 ? "curve" : fmt::format("curve-{}", number)};
    table.add("crank_angle_rad", "crank angle (rad)", crank);
    table.add("point_x_m", "x of the traced point (m)", std::move(x));
    table.add("point_y_m", "y of the traced point (m)", std::move(y));
    result_.tables.push_back(std::move(table));
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
    column("path_error_rms_m", "root mean square error (m)", [&](F, M m) { return m.error * size(); });
    column("chamfer_distance_share", "chamfer distance, of the size of the stroke",
           [](F f, M) { return f.chamfer; });
    column("largest_deviation_m", "largest deviation (m)",
           [&](F, M m) { return m.largest_deviation * size(); });
    column("least_pair_angle_rad", "least pair angle (rad)", [](F, M m) { return m.min_pair_angle; });
    column("size_m", "larger side of the box of all pins (m)", [&](F, M m) { return m.size * size(); });
    column("shortest_link_m", "shortest length (m)", [&](F, M m) { return m.min_length * size(); });
    column("longest_link_m", "longest length (m)", [&](F, M m) { return m.max_length * size(); });
    column("crank_range_rad", "crank rotation along the stroke (rad)", [](F, M m) { return m.span; });
    column("peak_acceleration_share", "peak acceleration at unit crank speed, of the size of the stroke",
           [](F, M m) { return m.peak_acceleration; });
    result_.tables.push_back(std::move(table));
  }

  void family_table() {
    Table table{.name = "families"};
    std::vector<double> error, outside, polished, hops, grown, curves, atlas;
    for (const FamilyReport& f : answer_.families) {
      table.names.emplace_back(name_of(f.family));
      error.push_back(std::isfinite(f.error) ? f.error * size() : nan);
      const auto left =
          std::find_if(answer_.outside.begin(), answer_.outside.end(),
                       [&](const FoundMachine& m) { return m.machine.shape.program->family == f.family; });
      outside.push_back(left == answer_.outside.end() ? nan : left->measures.error * size());
      polished.push_back(static_cast<double>(f.polished)), hops.push_back(static_cast<double>(f.hops));
      grown.push_back(static_cast<double>(f.grown)), curves.push_back(static_cast<double>(f.curves));
      atlas.push_back(static_cast<double>(f.atlas_entries));
    }
    table.add("path_error_rms_m", "root mean square error of the best machine within the limits (m)",
              std::move(error));
    table.add("outside_limits_error_rms_m",
              "that of the best machine outside the limits, where none is within (m)", std::move(outside));
    table.add("polished", "shapes of the atlas that were polished", std::move(polished));
    table.add("hops", "trials from machines found before", std::move(hops));
    table.add("grown", "trials from machines of fewer links", std::move(grown));
    table.add("curves", "curves that were computed", std::move(curves));
    table.add("atlas_entries", "shapes of the atlas", std::move(atlas));
    result_.tables.push_back(std::move(table));
  }

  void progress_table() {
    if (answer_.progress.empty()) return;
    Table table{.name = "progress"};
    std::vector<double> curves, best;
    for (const TypeSearchPoint& p : answer_.progress) {
      table.names.emplace_back(name_of(p.family));
      curves.push_back(static_cast<double>(p.curves));
      best.push_back(p.error * size());
    }
    table.add("curves", "curves that were computed", std::move(curves));
    table.add("path_error_rms_m", "root mean square error of a new best machine of its family (m)",
              std::move(best));
    result_.tables.push_back(std::move(table));
    result_.plots.push_back({.name = "progress",
                             .title = "New best machines during the search",
                             .table = "progress",
                             .x = "curves",
                             .y = {"path_error_rms_m"},
                             .style = study::Plot::Style::points,
                             .logarithmic_y = true});
  }

  void statistics() {
    const auto sum = [&](std::int64_t FamilyReport::*part) {
      std::int64_t out = 0;
      for (const FamilyReport& f : answer_.families) out += f.*part;
      return out;
    };
    result_.statistics["machines"] = answer_.machines.size();
    result_.statistics["families"] = answer_.families.size();
    result_.statistics["polished"] = sum(&FamilyReport::polished);
    result_.statistics["hops"] = sum(&FamilyReport::hops);
    result_.statistics["grown"] = sum(&FamilyReport::grown);
    result_.statistics["evaluations"] = answer_.curves;
    result_.statistics["atlas_entries"] = sum(&FamilyReport::atlas_entries);
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    if (answer_.machines.empty()) {
      none_found(warn);
      return;
    }
    const FoundMachine& best = answer_.machines[0];
    const MachineMeasures& m = best.measures;
    result_.headline = say(
        "A machine of {} links follows the stroke with a root mean square error of {} and pair angles of at "
        "least {}.",
        count_of(best.machine.shape.program->links), length(m.error), degrees_of(m.min_pair_angle).fixed(1));
    fact("best machine",
         say("{}, {}", best.machine.shape.program->name, summary_of(best.machine.shape.program->family)));
    fact("root mean square error", length(m.error));
    fact("largest deviation", length(m.largest_deviation));
    fact("chamfer distance, of the size of the stroke", plain_number(best.chamfer, 3));
    fact("least pair angle over the whole turn", degrees_of(m.min_pair_angle).fixed(1));
    fact("box of the pins over the whole turn, larger side", length(m.size));
    if (!target_.closed) fact("crank rotation along the stroke", degrees_of(m.span).fixed(0));
    const auto simplest = std::min_element(
        answer_.machines.begin(), answer_.machines.end(), [](const FoundMachine& a, const FoundMachine& b) {
          return a.machine.shape.program->links < b.machine.shape.program->links;
        });
    if (simplest->machine.shape.program->links < best.machine.shape.program->links)
      fact("best machine with the fewest links",
           say("{} links ({}), root mean square error {}", count_of(simplest->machine.shape.program->links),
               simplest->machine.shape.program->name, length(simplest->measures.error)));
    fact("curves computed", count_of(static_cast<double>(answer_.curves)));
    if (m.peak_acceleration > 100)
      warn("target",
           say("the best machine passes a corner with {} times the acceleration of a point on a circle",
               plain_number(m.peak_acceleration, 3)),
           "round the corners of the stroke where speed matters");
  }

  void none_found(const study::AddWarning& warn) {
    result_.headline = study::is_interrupted(answer_.status) ? "Stopped before a machine was found."
                                                             : "No machine within the limits was found.";
    if (answer_.outside.empty()) return;
    const auto nearest = std::min_element(
        answer_.outside.begin(), answer_.outside.end(),
        [](const FoundMachine& a, const FoundMachine& b) { return a.measures.error < b.measures.error; });
    warn("limits",
         say("the nearest machine, {}, has a root mean square error of {}, but {}",
             nearest->machine.shape.program->name, length(nearest->measures.error),
             summary_of(nearest->measures.defect)),
         "search longer, allow more links, or relax the limits");
  }

  const AnyPathStudy& s_;
  const study::Common& common_;
  const SampledStroke& target_;
  const MachineLimits& limits_;
  const TypeSearchAnswer answer_;
  study::Result result_;
};

/// Remarks on strokes that a simpler device draws, or that are not what they seem.
void check_stroke(study::ObjectReader& target, const char* key, const AnyPathStudy& s) {
  const std::vector<std::complex<double>>& points = s.stroke.points;
  double extent = 0, far = 0, length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    extent = std::max(extent, std::abs(points[i] - points[0]));
    far = std::max(far, std::abs(points[i]));
    if (i > 0) length += std::abs(points[i] - points[i - 1]);
  }
  if (!(extent > 1e-9 * far)) {
    target.error(key, "the stroke has no extent: its points agree to rounding of their coordinates",
                 "draw it larger, or nearer to the origin");
    return;
  }
  const double step = length / static_cast<double>(points.size() - 1),
               gap = std::abs(points.back() - points.front());
  if (s.stroke.closed && gap > 4 * step && gap > 0.02 * length)
    target.warning(key, fmt::format("the stroke is closed by a side of {:.0f} steps", gap / step),
                   "write closed = false if it is to stay open");
  double across = 0;
  const std::complex<double> chord = points.back() - points.front();
  for (const auto& p : points)
    across = std::max(across, std::abs((std::conj(chord) * (p - points.front())).imag()));
  if (!s.stroke.closed && std::abs(chord) > 0 && across / std::abs(chord) < 1e-3 * std::abs(chord) &&
      length < 1.001 * std::abs(chord))
    target.warning(key, "the stroke is a straight line, which a slide draws by itself",
                   "a slider-crank or an exact straight-line linkage is simpler");
}

void read_stroke_of(study::ObjectReader& document, const study::Common& common, AnyPathStudy& s) {
  auto target = document.table(field::entry("target").required());
  if (!target) return;
  target->read(s.target);
  std::vector<double> x, y;
  read_stroke(*target, common, s.target, x, y);
  if (x.size() < 5) return;
  const char* key = s.target.points_file ? "points_file" : "points";
  if (repeats_first_point(x, y)) {
    if (!target->has("closed")) s.target.closed = true;
    if (s.target.closed) x.pop_back(), y.pop_back();
  }
  s.stroke.closed = s.target.closed;
  for (std::size_t k = 0; k < x.size(); ++k) s.stroke.points.emplace_back(x[k], y[k]);
  s.target.points_file.reset();
  s.target.points.emplace();
  for (std::size_t k = 0; k < x.size(); ++k) s.target.points->push_back({x[k], y[k]});
  check_stroke(*target, key, s);
}

void read_limits(study::ObjectReader& table, AnyLimits& l) {
  table.read(l);
  if (l.shortest && l.shortest_length)
    table.error("shortest_link", "the shortest length is given in sizes of the stroke and as a length",
                "keep one of them");
  if (l.longest && l.longest_length)
    table.error("longest_link", "the longest length is given in sizes of the stroke and as a length",
                "keep one of them");
  if (l.shortest_length && l.longest_length && *l.shortest_length >= *l.longest_length)
    table.error("shortest_length", "the shortest length is not below the longest", "exchange the two");
  if (l.ground_box && !(l.ground_box->x[0] < l.ground_box->x[1] && l.ground_box->y[0] < l.ground_box->y[1]))
    table.error("ground_box", "the box has no inside", "write the least number of x and of y first");
  if (!l.ground_pivots) return;
  if (l.ground_pivots->empty() || l.ground_pivots->size() > max_given_pivots)
    table.error(
        "ground_pivots",
        fmt::format("{} ground pivots, 1 to {} can be given", l.ground_pivots->size(), max_given_pivots),
        "leave it out to leave the pivots free");
  for (const auto& [x, y] : *l.ground_pivots)
    if (const auto& box = l.ground_box;
        box && !(x >= box->x[0] && x <= box->x[1] && y >= box->y[0] && y <= box->y[1]))
      table.error("ground_pivots", "a given ground pivot is outside the box of the ground pivots",
                  "move it inside, or widen ground_box");
}

AnyPathStudy read_any_path(study::ObjectReader& document, const study::Common& common) {
  AnyPathStudy s;
  if (auto table = document.table(field::entry("mechanism").required())) {
    table->read(s.mechanism);
    if (s.mechanism.families && s.mechanism.families->empty())
      table->error("families", "the list of families is empty", "leave it out to search all");
    if (const auto& families = s.mechanism.families;
        families && s.mechanism.most_links >= 10 &&
        std::count(families->begin(), families->end(), MachineFamily::ten_bar) > 0 &&
        std::count(families->begin(), families->end(), MachineFamily::eight_bar) == 0)
      table->error("families", "ten_bar is grown from eight_bar, which is not in the list", "add eight_bar");
    for (const MachineFamily family : s.mechanism.families.value_or(std::vector<MachineFamily>{}))
      if (links_of(family) > s.mechanism.most_links)
        table->error("families",
                     fmt::format("{} has {} links, most_links allows {}", name_of(family), links_of(family),
                                 s.mechanism.most_links),
                     fmt::format("write most_links = {}, or leave the family out", links_of(family)));
  }
  read_stroke_of(document, common, s);
  if (auto table = document.table("limits")) read_limits(*table, s.limits);
  if (auto table = document.table("optimiser")) {
    table->read(s.optimiser);
    if (s.optimiser.seconds && s.optimiser.evaluations)
      table->error("evaluations", "the search has both seconds and evaluations", "keep one of them");
  }
  return s;
}

}  // namespace

study::Kind any_path_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.any";
  kind.target = "path_points";
  kind.summary = "machines of many types that trace a stroke, side by side";
  kind.example = templates::synthesis_any_path_points();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "types of machines"), study::schema_fields<AnyMechanism>());
    document.property(field::entry("target", "the stroke"), study::schema_fields<AnyTarget>());
    document.property(field::entry("limits", "what every machine keeps"), study::schema_fields<AnyLimits>());
    document.property(field::entry("optimiser", "how long to search"), study::schema_fields<AnyOptimiser>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    AnyPathStudy s = read_any_path(document, common);
    if (!s.limits.shortest_length && !s.limits.shortest) s.limits.shortest = 0.05;
    if (!s.limits.longest_length && !s.limits.longest) s.limits.longest = 10;
    if (!s.optimiser.seconds && !s.optimiser.evaluations) s.optimiser.seconds = 10;
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(s.mechanism);
    prepared.canonical["target"] = study::write_fields(s.target);
    prepared.canonical["limits"] = study::write_fields(s.limits);
    prepared.canonical["optimiser"] = study::write_fields(s.optimiser);
    prepared.run = [s, common](RunContext& context) { return run_any_path_study(s, common, context); };
    return prepared;
  };
  return kind;
}

MachineLimits limits_of(const AnyLimits& form, const SampledStroke& target) {
  MachineLimits out;
  const double by = 1 / target.size;
  out.min_pair_angle = form.pair_angle;
  if (form.shortest) out.min_length = *form.shortest;
  if (form.longest) out.max_length = *form.longest;
  if (form.shortest_length) out.min_length = by * *form.shortest_length;
  if (form.longest_length) out.max_length = by * *form.longest_length;
  const auto moved = [&](double x, double y) { return (std::complex<double>(x, y) - target.centre) * by; };
  if (const auto& box = form.ground_box) {
    const auto low = moved(box->x[0], box->y[0]), high = moved(box->x[1], box->y[1]);
    out.ground_box = PlaneBox{low.real(), high.real(), low.imag(), high.imag()};
  }
  if (form.ground_pivots)
    for (const auto& pivot : *form.ground_pivots) out.ground_pivots.push_back(moved(pivot[0], pivot[1]));
  if (form.pivot_tolerance) out.pivot_tolerance = by * *form.pivot_tolerance;
  return out;
}

study::Result run_any_path_study(const AnyPathStudy& s, const study::Common& common, RunContext& context) {
  const SampledStroke target = sampled_stroke(s.stroke);
  TypeSearchOptions options;
  if (s.mechanism.families) options.families = *s.mechanism.families;
  options.max_links = s.mechanism.most_links;
  options.limits = limits_of(s.limits, target);
  options.seed = static_cast<std::uint64_t>(s.optimiser.seed);
  options.max_solutions = static_cast<std::size_t>(s.optimiser.max_solutions);
  options.max_curves = s.optimiser.evaluations.value_or(0);
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
  TypeSearchAnswer answer = search_types(target, options, part);
  answer.status = context.interruption();
  return AnyPathReport(s, common, target, options.limits, std::move(answer)).make();
}

}  // namespace linkwright::planar
