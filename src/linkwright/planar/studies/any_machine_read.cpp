// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/poses.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/planar/type_synthesis/stroke_shape.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t max_given_pivots = 4;  // machines of ten links have no more than five

using study::Absent;

constexpr std::string_view body_turns =
    "not for strokes: a point has no rotation; write type = \"poses\" to lead a body";
constexpr std::string_view of_functions =
    "an output that is a function of the crank rotation is a target of its own: write type = \"function\"";
constexpr std::string_view moves_no_point =
    "not for functions: their output is a link that turns, or a slider; write type = \"path_points\" to "
    "trace "
    "a stroke";
constexpr std::array not_of_strokes{
    Absent{"target.pose", {}, body_turns}, Absent{"target.orientation_length", {}, body_turns},
    Absent{"target.dwell", {}, of_functions}, Absent{"target.time_ratio", {}, of_functions}};
constexpr std::array not_of_poses{
    Absent{"target.band", {}, "not for poses: a weight at each [[target.pose]] says which of them matter"},
    Absent{"target.weights", {}, "not for poses: write weight at each [[target.pose]]"},
    Absent{"target.points", {}, "not for poses: write [[target.pose]] with x_mm, y_mm, angle_deg for each"},
    Absent{"target.points_file", {}, "not for poses: their file is file = \"poses.csv\""},
    Absent{"target.tolerance",
           {},
           "not for poses: orientation_length says what a rotation error counts as beside the places"},
    Absent{"target.dwell", {}, of_functions},
    Absent{"target.time_ratio", {}, of_functions}};
constexpr std::array not_of_functions{
    Absent{"limits.crank_turns",
           {},
           "not for functions: input_range says how far the crank turns, 360 deg for a whole turn; over less "
           "than that, limits hold over the range alone"},
    Absent{"target.closed",
           {},
           "not for functions: one over a whole turn, input_range_deg = 360, ends as it begins"},
    Absent{"target.timing", {}, "not for functions: they are given over the rotation of the crank"},
    Absent{"target.points", {}, moves_no_point},
    Absent{"target.pose", {}, moves_no_point},
    Absent{
        "target.tolerance",
        {},
        "not for functions: write fit = \"minimax\" for the least greatest error, which a check can limit"}};

/// Remarks on strokes that a simpler device draws, or that are not what they seem. False where one is none.
bool check_stroke(study::ObjectReader& target, const study::Common& common, const char* key,
                  const Stroke& stroke) {
  const std::vector<std::complex<double>>& points = stroke.points;
  double extent = 0, far = 0, length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    extent = std::max(extent, std::abs(points[i] - points[0]));
    far = std::max(far, std::abs(points[i]));
    if (i > 0) length += std::abs(points[i] - points[i - 1]);
  }
  if (!(extent > 1e-9 * far)) {
    target.error(key, "the stroke has no extent: its points agree to rounding of their coordinates",
                 "draw it larger, or nearer to the origin");
    return false;
  }
  const double step = length / static_cast<double>(points.size() - 1),
               gap = std::abs(points.back() - points.front());
  if (stroke.closed && gap > 4 * step && gap > 0.02 * length)
    target.warning(key, fmt::format("the stroke is closed by a side of {:.0f} steps", gap / step),
                   "write closed = false if it is to stay open");
  const SampledStroke sampled = sampled_stroke(stroke);
  const StrokeShape shape = stroke_shape_of(sampled);
  if (shape.straight)
    target.warning(key, "the stroke is a straight line, which a slide draws by itself",
                   "a slider-crank or an exact straight-line linkage is simpler");
  if (shape.circle)
    target.warning(key,
                   fmt::format("the stroke is {} with a radius of {}, which one link draws by itself",
                               stroke.closed ? "a circle" : "an arc of a circle",
                               common.units.text(shape.circle_radius * sampled.size, Dimension::length, 4)),
                   "a crank, or a rocker, is simpler");
  return true;
}

/// The crank rotations of a stroke by its timing, of which `given` points were told: a closed one may have
/// been given its first point again. None where the timing is free. `place` is what a message calls a point.
std::vector<double> read_rotations(study::ObjectReader& target, const study::Common& common,
                                   const PathTiming& timing, std::size_t given, const Stroke& stroke,
                                   std::string_view place = "point") {
  std::vector<double> turned = timed_angles(target, common.units, timing, given);
  if (turned.empty()) return turned;
  const double sense = turned.back() < turned.front() ? -1 : 1;
  for (std::size_t k = 1; k < turned.size(); ++k)
    if (!(sense * (turned[k] - turned[k - 1]) > 0)) {
      target.error("timing",
                   fmt::format("the crank does not turn on from {0} {1} to {0} {2}", place, k, k + 1),
                   fmt::format("let the angles rise, or fall, from {0} to {0}", place));
      return {};
    }
  const double most = stroke.closed && given == stroke.points.size() ? 2 * pi - 1e-9 : 2 * pi + 1e-9;
  if (const double whole = std::abs(turned.back() - turned.front()); whole > most) {
    target.error(
        "timing",
        fmt::format("the crank turns {} along the {}s, more than the stroke leaves",
                    common.units.text(whole, Dimension::angle, 5), place),
        fmt::format("a stroke takes one turn of the crank, with its way back to the first {}", place));
    return {};
  }
  turned.resize(stroke.points.size());
  return turned;
}

/// The share of its length at which a point of a stroke lies.
double share_of_point(const Stroke& stroke, std::size_t point) {
  const std::size_t n = stroke.points.size(), sides = stroke.closed ? n : n - 1;
  double before = 0, whole = 0;
  for (std::size_t i = 0; i < sides; ++i) {
    const double side = std::abs(stroke.points[(i + 1) % n] - stroke.points[i]);
    whole += side;
    if (i < point) before += side;
  }
  return before / whole;
}

/// The bands of a stroke; problems are reported at the first of them.
std::vector<ToleranceBand> read_bands(study::ObjectReader& target, const AnyTarget& form,
                                      const MotionTarget& motion, const Stroke& stroke) {
  std::vector<ToleranceBand> out;
  const auto last = static_cast<int>(stroke.points.size());
  for (std::size_t i = 0; i < form.bands.size(); ++i) {
    const AnyBandForm& b = form.bands[i];
    const bool points = b.from_point || b.to_point;
    if (points && (b.from || b.to)) {
      target.error("band", fmt::format("band {} is given by points and by shares of the length", i + 1),
                   "keep one of them");
      return {};
    }
    if (const int most = std::max(b.from_point.value_or(1), b.to_point.value_or(1)); most > last) {
      target.error("band", fmt::format("band {} names point {}, the stroke has {}", i + 1, most, last),
                   "points are counted from 1");
      return {};
    }
    ToleranceBand band{.from = b.from.value_or(0), .to = b.to.value_or(1)};
    if (b.from_point) band.from = share_of_point(stroke, static_cast<std::size_t>(*b.from_point - 1));
    if (b.to_point) band.to = share_of_point(stroke, static_cast<std::size_t>(*b.to_point - 1));
    band.tolerance = b.tolerance / motion.stroke.size;
    if (band.to < band.from && !stroke.closed) {
      target.error("band", fmt::format("band {} ends before it begins", i + 1),
                   "exchange its ends; only on a closed stroke a band continues past the first point");
      return {};
    }
    out.push_back(band);
  }
  return out;
}

/// True where there are weights, which are not negative and not all zero.
bool check_weights(study::ObjectReader& target, const char* key, const std::vector<double>& weights) {
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!(weights[i] >= 0 && weights[i] <= 1e6)) {
      target.error(key, fmt::format("weight {} is {}", i + 1, weights[i]), "write a number from 0 to 1e6");
      return false;
    }
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0; })) return true;
  if (!weights.empty()) target.error(key, "all weights are 0", "write 1 where errors are to count");
  return false;
}

/// Weights of the points of a stroke, of which `given` were told: a closed one may have been given its first
/// point again.
void read_weights(study::ObjectReader& target, AnyTarget& form, std::size_t given, const Stroke& stroke,
                  MotionTarget& motion) {
  if (!form.weights) return;
  std::vector<double>& weights = *form.weights;
  const std::size_t n = stroke.points.size();
  if (weights.size() == given) weights.resize(n);
  if (!weights.empty() && weights.size() != n) {
    target.error("weights", fmt::format("{} weights for {} points", weights.size(), n),
                 "give one for each point");
    return;
  }
  if (check_weights(target, "weights", weights)) weigh_points(motion, stroke, weights);
}

/// Reads the target of a stroke; `form` then says what it is in the end.
void read_stroke_target(study::ObjectReader& target, const study::Common& common, AnyTarget& form,
                        AnyStudy& s) {
  target.read(form);
  std::vector<double> x, y;
  read_stroke(target, common, form, x, y);
  if (x.size() < 5) return;
  const std::size_t given = x.size();
  const char* key = form.points_file ? "points_file" : "points";
  if (repeats_first_point(x, y)) {
    if (!target.has("closed")) form.closed = true;
    if (form.closed) x.pop_back(), y.pop_back();
  }
  s.drawn.closed = form.closed;
  for (std::size_t k = 0; k < x.size(); ++k) s.drawn.points.emplace_back(x[k], y[k]);
  form.points_file.reset();
  form.points.emplace();
  for (std::size_t k = 0; k < x.size(); ++k) form.points->push_back({x[k], y[k]});
  if (!check_stroke(target, common, key, s.drawn)) return;
  const std::vector<double> rotations = read_rotations(target, common, form.timing, given, s.drawn);
  s.motion = rotations.empty() ? MotionTarget(sampled_stroke(s.drawn)) : timed_stroke(s.drawn, rotations);
  set_tolerances(*s.motion, form.tolerance.value_or(0) / s.motion->stroke.size,
                 read_bands(target, form, *s.motion, s.drawn));
  read_weights(target, form, given, s.drawn, *s.motion);
}

/// Reads the target of poses.
void read_poses_target(study::ObjectReader& target, const study::Common& common, AnyPosesTarget& form,
                       AnyStudy& s) {
  target.read(form);
  const bool has_poses = target.has("pose"), has_file = target.has("file");
  if (has_poses == has_file) {
    target.error(has_file ? "file" : "pose",
                 has_file ? "the target has both poses and a file" : "the target has no poses",
                 has_file
                     ? "keep one of them"
                     : "write [[target.pose]] with x_mm, y_mm, angle_deg for each, or file = \"poses.csv\"");
    return;
  }
  if (form.file)
    for (const PoseForm& pose : poses_of_file(target, common, *form.file))
      form.poses.push_back({.x = pose.x, .y = pose.y, .angle = pose.angle.value_or(0)});
  form.file.reset();
  const char* key = has_file ? "file" : "pose";
  if (form.poses.size() < 3 || form.poses.size() > stroke_samples) {
    target.error(key, fmt::format("{} poses, 3 to {} can be given", form.poses.size(), stroke_samples),
                 "two poses are met by any machine whose body is hinged at the pole of the rotation");
    return;
  }
  s.drawn.closed = form.closed;
  double far = 0;
  for (const AnyPoseForm& pose : form.poses) {
    s.drawn.points.emplace_back(pose.x, pose.y);
    s.angles.push_back(pose.angle);
    far = std::max(far, std::abs(s.drawn.points.back()));
  }
  const auto& points = s.drawn.points;
  double extent = 0;
  for (const auto& point : points) extent = std::max(extent, std::abs(point - points[0]));
  if (!(extent > 1e-9 * far)) {
    target.error(key, "the body only turns: all its poses are at one place", "a hinge does it");
    return;
  }
  for (std::size_t k = 1; k < points.size(); ++k)
    if (std::abs(points[k] - points[k - 1]) <= 1e-9 * extent &&
        std::abs(math::wrap_angle(s.angles[k] - s.angles[k - 1])) <= 1e-9)
      target.error(key, fmt::format("poses {} and {} are the same", k, k + 1), "keep one of them");
  const std::vector<double> rotations =
      read_rotations(target, common, form.timing, points.size(), s.drawn, "pose");
  s.motion = pose_target(s.drawn, s.angles, form.orientation_length, rotations);
  std::vector<double> weights;
  for (const AnyPoseForm& pose : form.poses) weights.push_back(pose.weight);
  if (check_weights(target, key, weights)) weigh_points(*s.motion, s.drawn, weights);
}

/// The dwells of a function, within the rotation of the crank and one after the other.
std::vector<Dwell> read_dwells(study::ObjectReader& target, const study::Common& common,
                               const AnyFunctionTarget& form) {
  std::vector<Dwell> out;
  const auto angle = [&](double value) { return common.units.text(value, Dimension::angle, 5); };
  for (const DwellForm& d : form.dwells) {
    if (!(d.to > d.from))
      target.error("dwell", fmt::format("a dwell goes from {} to {}", angle(d.from), angle(d.to)),
                   "write the smaller rotation first");
    else if (d.to > std::abs(form.input_range) + 1e-9)
      target.error("dwell",
                   fmt::format("a dwell ends at {}, the crank turns {}", angle(d.to),
                               angle(std::abs(form.input_range))),
                   "end it within the range of the input");
    else if (!out.empty() && !(d.from > out.back().to))
      target.error("dwell", fmt::format("a dwell from {} begins before the last one ends", angle(d.from)),
                   "write them in their order, apart from each other");
    else
      out.push_back({d.from, d.to});
  }
  return out;
}

/// The strokes of an output that returns quickly, whose motion in between is free.
void read_quick_return(study::ObjectReader& target, const AnyFunctionTarget& form, AnyStudy& s) {
  if (form.function || form.table || !form.dwells.empty()) {
    target.error("time_ratio", "the target has both a time ratio and a function, or a dwell",
                 "keep one of them: between its dead centres the output moves as it likes");
    return;
  }
  if (std::abs(std::abs(form.input_range) - 2 * pi) > 1e-9) {
    target.error("input_range", "the output reciprocates once in a whole turn of the crank",
                 "write input_range_deg = 360, or -360 for the other sense");
    return;
  }
  const bool slider = form.travel.has_value();
  s.function.problem.slider = slider;
  s.quick_return = QuickReturn{.output = slider ? MachineOutput::slide : MachineOutput::angle,
                               .time_ratio = *form.time_ratio,
                               .range = slider ? form.travel->lower : form.angle->lower,
                               .clockwise = form.input_range < 0,
                               .size = form.size.value_or(0.1)};
  s.motion = quick_return_target(*s.quick_return);
}

double middle_of(const Range& range) { return 0.5 * (range.lower + range.upper); }

/// Says which ranges of a function are free; false where they cannot be.
bool read_ranges(study::ObjectReader& target, const study::Common& common, const AnyFunctionTarget& form,
                 AnyStudy& s) {
  const Range output = form.angle ? *form.angle : *form.travel;
  const auto possible = [&](const char* key, const Range& range, double most, Dimension dimension) {
    if (range.fixed()) return true;
    if (!(range.lower * range.upper > 0)) {
      target.error(key,
                   "the sense of a free range is not known: it goes from a negative number to a positive",
                   "let both of its ends have one sign");
      return false;
    }
    if (std::max(std::abs(range.lower), std::abs(range.upper)) <= most) return true;
    target.error(key,
                 fmt::format("a free range goes up to {}, less than a whole turn can be chosen",
                             common.units.text(range.upper, dimension, 5)),
                 "write one number for a whole turn");
    return false;
  };
  constexpr double nearly_a_turn = 359 * pi / 180;
  if (!possible("input_range", form.input, nearly_a_turn, Dimension::angle) ||
      !possible("output_range", output, form.travel ? infinity : nearly_a_turn,
                form.travel ? Dimension::length : Dimension::angle))
    return false;
  if (form.input.fixed() && output.fixed()) return true;
  if (form.time_ratio || !form.dwells.empty()) {
    target.error(form.time_ratio ? "time_ratio" : "dwell",
                 "free ranges are for functions without dwells and time ratio",
                 "write one number for each range");
    return false;
  }
  s.ranges = FunctionRanges{form.input, output};
  return true;
}

/// Reads the target of a function.
void read_function_target(study::ObjectReader& target, const study::Common& common, AnyFunctionTarget& form,
                          AnyStudy& s) {
  // The unit of the range says whether the output is a link or a slider.
  const std::string_view range = "output_range_";
  for (const Value::Member& member : target.value().as_object()) {
    if (!std::string_view(member.key).starts_with(range)) continue;
    const bool slides = !member.key.ends_with("_deg") && !member.key.ends_with("_rad");
    if (form.slides && *form.slides != slides) {
      target.error(member.key, "the output is both an angle and a travel", "keep one of them");
      return;
    }
    form.slides = slides;
  }
  target.read(form);
  const bool slider = form.travel.has_value();
  if (!form.angle && !form.travel) {
    target.error("output_range", "how far the output moves is missing",
                 "write output_range_deg for a link that turns, or output_range_mm for a slider");
    return;
  }
  if (form.fit == FunctionFit::points)
    target.error("fit", "machines of many types have no common number of precision points",
                 "write fit = \"minimax\" or \"least_squares\"");
  if (slider && form.size)
    target.error("size", "the size is for outputs that are angles",
                 "leave it out: the travel of the slider says how large machines are");
  FunctionStudy& f = s.function;
  f.may_return = true;
  form.input_range = middle_of(form.input);
  f.target = form;
  f.target.output_angle = form.angle ? middle_of(*form.angle) : 0;
  f.target.output_length = form.travel ? middle_of(*form.travel) : 0;
  f.problem.slider = slider;
  const std::vector<Dwell> dwells = read_dwells(target, common, form);
  if (!read_ranges(target, common, form, s)) return;
  if (f.target.output_angle == 0 && f.target.output_length == 0) {
    target.error("output_range", "the output does not move", "write a range other than 0");
    return;
  }
  if (form.time_ratio) return read_quick_return(target, form, s);
  set_function(target, f);
  if (!f.problem.output) return;
  if (const double ends = f.problem.output(1);
      std::abs(std::abs(form.input_range) - 2 * pi) < 1e-9 &&
      std::abs(std::remainder(ends, slider ? infinity : 2 * pi)) > 1e-9 * (1 + std::abs(ends))) {
    target.error("input_range", "the crank takes a whole turn, after which the output is not where it was",
                 "let the function end as it begins, or take less than a turn");
    return;
  }
  s.fit = form.fit, s.dwells = dwells;
  s.motion = function_target({.output = slider ? MachineOutput::slide : MachineOutput::angle,
                              .range = form.input_range,
                              .at = f.problem.output,
                              .dwells = dwells,
                              .size = form.size.value_or(0.1)});
}

void read_limits(study::ObjectReader& table, bool function, AnyMotionLimits& l) {
  if (function)
    table.read(static_cast<AnyLimits&>(l));
  else
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

/// Refuses families none of which has an output of the sort that a function asks for.
void check_outputs(study::ObjectReader& document, const AnyStudy& s) {
  if (!s.motion || !s.motion->is_function() || !s.mechanism.families || s.mechanism.families->empty()) return;
  const auto& families = *s.mechanism.families;
  const bool slides = s.motion->output == MachineOutput::slide;
  if (std::any_of(families.begin(), families.end(),
                  [&](MachineFamily family) { return !programs_of(family, s.motion->output).empty(); }))
    return;
  if (auto table = document.table("mechanism"))
    table->error("families",
                 fmt::format("none of the families has a {} as its output",
                             slides ? "slider on the ground" : "link that turns about the ground"),
                 slides ? "add slider_crank, or write output_range_deg for a link that turns"
                        : "add four_bar, or write output_range_mm for a slider");
}

/// Lets the drive rock where the crank need not turn.
void release_crank(study::ObjectReader& document, AnyStudy& s) {
  if (s.limits.crank_turns || !s.motion) return;
  if (!s.motion->stroke.closed)
    let_drive_rock(*s.motion);
  else if (auto table = document.table("limits"))
    table->error("crank_turns",
                 s.angles.empty()
                     ? "a drive that rocks turns back at the ends of its range, and the stroke is closed"
                     : "a drive that rocks turns back at the ends of its range, and the poses are closed",
                 "write closed = false in [target] for a motion with two ends, or leave crank_turns out");
}

/// All tables but the target.
AnyStudy read_search(study::ObjectReader& document, bool function) {
  AnyStudy s;
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
      if (const bool none = programs_of(family, MachineOutput::angle).empty() &&
                            programs_of(family, MachineOutput::slide).empty();
          function ? none : family == MachineFamily::watt_2)
        table->error("families",
                     function ? fmt::format("{} does not generate functions", name_of(family))
                              : "what watt_2 traces a smaller machine traces, too",
                     "leave it out");
      else if (links_of(family) > s.mechanism.most_links)
        table->error("families",
                     fmt::format("{} has {} links, most_links allows {}", name_of(family), links_of(family),
                                 s.mechanism.most_links),
                     fmt::format("write most_links = {}, or leave the family out", links_of(family)));
  }
  if (auto table = document.table("limits")) read_limits(*table, function, s.limits);
  if (auto table = document.table("optimiser")) {
    table->read(s.optimiser);
    if (s.optimiser.seconds && s.optimiser.evaluations)
      table->error("evaluations", "the search has both seconds and evaluations", "keep one of them");
  }
  s.refinement = read_refinement(document, function);
  return s;
}

/// A kind of study of "planar.any", whose target has a form of its own.
template <class Target>
study::Kind any_kind(const char* target, const char* target_summary,
                     void (*read_target)(study::ObjectReader&, const study::Common&, Target&, AnyStudy&)) {
  constexpr bool function = std::is_same_v<Target, AnyFunctionTarget>;
  using Limits = std::conditional_t<function, AnyLimits, AnyMotionLimits>;
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.any";
  kind.target = target;
  kind.seeded = true;
  kind.schema = [target_summary](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "types of machines"), study::schema_fields<AnyMechanism>());
    document.property(field::entry("target", target_summary), study::schema_fields<Target>());
    document.property(field::entry("limits", "what every machine keeps"), study::schema_fields<Limits>());
    document.property(field::entry("optimiser", "how long to search"), study::schema_fields<AnyOptimiser>());
    describe_refinement(document, function);
  };
  kind.prepare = [read_target](study::ObjectReader& document, const study::Common& common) {
    AnyStudy s = read_search(document, function);
    Target form;
    if (auto table = document.table(field::entry("target").required())) read_target(*table, common, form, s);
    check_outputs(document, s);
    release_crank(document, s);
    if (function && s.refinement.loads.torque != 0 && s.function.problem.slider)
      document.error("machine", "a torque acts on the output, which is a slider",
                     "write force_N for a slider, or output_range_deg for a link that turns");
    if (!s.limits.shortest_length && !s.limits.shortest) s.limits.shortest = 0.05;
    if (!s.limits.longest_length && !s.limits.longest) s.limits.longest = 10;
    if (!s.optimiser.seconds && !s.optimiser.evaluations) s.optimiser.seconds = 10;
    study::Prepared prepared;
    // The rows of a quick return can be met exactly: a refinement needs a little room.
    if (double& share = s.refinement.refinement.error_share; s.quick_return) share = std::max(share, 1e-4);
    prepared.canonical["mechanism"] = study::write_fields(s.mechanism);
    prepared.canonical["target"] = study::write_fields(form);
    prepared.canonical["limits"] = study::write_fields(static_cast<const Limits&>(s.limits));
    prepared.canonical["optimiser"] = study::write_fields(s.optimiser);
    write_refinement(s.refinement, prepared.canonical);
    prepared.run = [s, common](RunContext& context) {
      return s.quick_return ? run_any_quick_return_study(s, common, context)
             : function     ? run_any_function_study(s, common, context)
                            : run_any_study(s, common, context);
    };
    return prepared;
  };
  return kind;
}

}  // namespace

study::Kind any_path_kind() {
  study::Kind kind = any_kind<AnyTarget>("path_points", "the stroke", read_stroke_target);
  kind.summary = "machines of many types that trace a stroke, side by side";
  kind.example = templates::synthesis_any_path_points();
  kind.absent = not_of_strokes;
  return kind;
}

study::Kind any_poses_kind() {
  study::Kind kind = any_kind<AnyPosesTarget>("poses", "the poses of a body", read_poses_target);
  kind.summary = "machines of many types that lead a body through poses, side by side";
  kind.example = templates::synthesis_any_poses();
  kind.absent = not_of_poses;
  return kind;
}

study::Kind any_function_kind() {
  study::Kind kind = any_kind<AnyFunctionTarget>("function", "the function", read_function_target);
  kind.summary = "machines of many types that generate a function, or rest, side by side";
  kind.example = templates::synthesis_any_function();
  kind.absent = not_of_functions;
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

}  // namespace linkwright::planar
