// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity_columns.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/poses.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t max_poses = 200;
// Places and angles that agree to this share of the size of the motion, and of a radian, are one.
constexpr double same_pose = 1e-9;

// True if two poses are equal; a point is the same as what is at its place.
bool same(const PoseProblem& p, std::size_t a, std::size_t b, double size) {
  const BodyPose &one = p.poses[a], &other = p.poses[b];
  const bool angles = p.demands.empty() || (p.demands[a].angle && p.demands[b].angle);
  return std::abs(one.origin - other.origin) <= same_pose * size &&
         (!angles || std::abs(math::wrap_angle(one.angle - other.angle)) <= same_pose);
}

// The rotation at a point, where a search for it begins: between those of the poses before and after it.
void guess_rotations(PoseProblem& p) {
  const std::size_t n = p.poses.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (p.demands[k].angle) continue;
    std::size_t before = k, after = k;
    while (before < n && !p.demands[before].angle) --before;  // wraps round below 0
    while (after < n && !p.demands[after].angle) ++after;
    if (before >= n && after >= n) return;
    if (before >= n) {
      p.poses[k].angle = p.poses[after].angle;
    } else if (after >= n) {
      p.poses[k].angle = p.poses[before].angle;
    } else {
      const double share = static_cast<double>(k - before) / static_cast<double>(after - before);
      p.poses[k].angle =
          p.poses[before].angle + share * math::wrap_angle(p.poses[after].angle - p.poses[before].angle);
    }
  }
}

// Sets the demands on each pose, where they differ.
void set_demands(study::ObjectReader& target, PoseStudy& s) {
  const std::vector<PoseForm>& forms = s.target.poses;
  s.mixed = std::any_of(forms.begin(), forms.end(),
                        [](const PoseForm& f) { return !f.angle || f.exact || f.weight != 1; });
  if (!s.mixed) return;
  int with_angle = 0, exact = 0;
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const PoseForm& f = forms[k];
    s.problem.demands.push_back(
        {.weight = f.weight > 0 ? f.weight : 1, .angle = f.angle.has_value(), .exact = f.exact && f.angle});
    with_angle += f.angle.has_value();
    exact += f.exact;
    if (f.exact && !f.angle)
      target.error("pose", fmt::format("pose {} is to be met exactly, but has no angle", k + 1),
                   "give its angle_deg, or leave exact out");
  }
  if (with_angle < 2)
    target.error(
        "pose",
        fmt::format("{} of {} poses have an angle, a motion needs 2 at least", with_angle, forms.size()),
        "points alone are a path: target type \"path_points\"");
  if (exact > max_exact_demands)
    target.error("pose",
                 fmt::format("{} poses are to be met exactly beside others, at most {} can be", exact,
                             max_exact_demands),
                 "five poses alone are met exactly by fit = \"exact\"");
  guess_rotations(s.problem);
}

// Checks poses by themselves; they are reported at `key`.
void check_poses(study::ObjectReader& target, const char* key, PoseProblem& p) {
  std::vector<BodyPose>& poses = p.poses;
  const std::size_t n = poses.size();
  if (n < 2) {
    target.error(key, fmt::format("{} pose{}, a motion needs at least 2", n, n == 1 ? "" : "s"),
                 "write a [[target.pose]] for each");
    return;
  }
  if (n > max_poses) {
    target.error(key, fmt::format("{} poses, at most {} are allowed", n, max_poses),
                 "keep every second or third");
    return;
  }
  const double size = size_of_motion(poses);
  double far = 0;
  for (const BodyPose& pose : poses) far = std::max(far, std::abs(pose.origin));
  if (far > 1e9) {
    target.error(key, fmt::format("a pose lies {:.3g} m from the origin, at most 1e9 m are allowed", far),
                 "check the unit");
    return;
  }
  if (size < 1e-9 * far)
    target.warning(
        key,
        fmt::format("the poses are {:.3g} m from the origin and {:.3g} m apart: digits are lost", far, size),
        "put the origin near the poses");
  if (n > 2 && same(p, 0, n - 1, size)) {
    target.warning(key, fmt::format("the last of {} poses repeats the first: taken once", n), "remove it");
    poses.pop_back();
    if (!p.demands.empty()) p.demands.pop_back();
  }
  for (std::size_t a = 0; a < poses.size(); ++a)
    for (std::size_t b = a + 1; b < poses.size(); ++b)
      if (same(p, a, b, size)) {
        target.error(key, fmt::format("pose {} repeats pose {}", b + 1, a + 1), "remove one of them");
        return;
      }
  if (poses.size() > 2 && std::all_of(poses.begin(), poses.end(), [&](const BodyPose& pose) {
        return std::abs(math::wrap_angle(pose.angle - poses[0].angle)) <= same_pose;
      }))
    target.error(key, "all poses have the same angle: the body only shifts, and all its points move alike",
                 "a parallelogram carries a body so: look for its path with target type \"path_points\"");
}

Complex complex(const std::array<double, 2>& place) { return {place[0], place[1]}; }

void set_pivots(study::ObjectReader& mechanism, PoseStudy& s) {
  const auto line = [](const PivotLineForm& form) {
    return PivotLine{complex(form.point), std::polar(1.0, form.direction)};
  };
  const auto region = [&](const PivotRegionForm& form, const char* key) {
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
      if (!(form.min[axis] < form.max[axis]))
        mechanism.error("pivot", fmt::format("{}: min is not below max in {}", key, axis == 0 ? "x" : "y"),
                        "a pivot whose place is known is given by fixed or moving");
    return PivotRegion{complex(form.min), complex(form.max)};
  };
  for (const PivotForm& form : s.mechanism.pivots) {
    if (form.dyad != 1 && form.dyad != 2) continue;  // reported already
    Prescription& p = s.problem.pivots[static_cast<std::size_t>(form.dyad - 1)];
    const auto twice = [&](const char* what) {
      mechanism.error("pivot", fmt::format("the {} pivot of dyad {} is given twice", what, form.dyad),
                      "keep one of them");
    };
    const bool fixed_before = p.fixed || p.fixed_line || p.fixed_region,
               moving_before = p.moving || p.moving_line || p.moving_region;
    const int fixed =
                  form.fixed.has_value() + form.fixed_on_line.has_value() + form.fixed_in_region.has_value(),
              moving = form.moving.has_value() + form.moving_on_line.has_value() +
                       form.moving_in_region.has_value();
    if (fixed + fixed_before > 1) return twice("fixed");
    if (moving + moving_before > 1) return twice("moving");
    if (form.fixed) p.fixed = complex(*form.fixed);
    if (form.moving) p.moving = complex(*form.moving);
    if (form.fixed_on_line) p.fixed_line = line(*form.fixed_on_line);
    if (form.moving_on_line) p.moving_line = line(*form.moving_on_line);
    if (form.fixed_in_region) p.fixed_region = region(*form.fixed_in_region, "fixed_in_region");
    if (form.moving_in_region) p.moving_region = region(*form.moving_in_region, "moving_in_region");
    if (p.fixed && p.moving) {
      mechanism.error("pivot",
                      fmt::format("both pivots of dyad {} are given: nothing is left to choose", form.dyad),
                      "keep one of them");
      return;
    }
  }
  for (std::size_t a = 0; a < 2; ++a) {
    const std::optional<Complex>&fixed = s.problem.pivots[a].fixed, &other = s.problem.pivots[1 - a].fixed;
    if (a == 0 && fixed && other && *fixed == *other)
      mechanism.error("pivot", "both dyads have the same fixed pivot: the body would only turn about it",
                      "put them apart");
  }
}

bool allows(const PoseStudy& s, GuidingDyadType type) {
  return std::find(s.mechanism.dyads.begin(), s.mechanism.dyads.end(), type) != s.mechanism.dyads.end();
}

// The dyad beside an RR dyad.
GuidingDyadType other_dyad(MixedPoseLinkage linkage) {
  switch (linkage) {
    case MixedPoseLinkage::slider_crank:
      return GuidingDyadType::pr;
    case MixedPoseLinkage::inverted_slider_crank:
      return GuidingDyadType::rp;
    default:
      return GuidingDyadType::rr;
  }
}

// Checks that poses and points together determine a four-bar or of a slider-crank.
void check_mixed_counts(study::ObjectReader& target, PoseStudy& s, int given) {
  const std::vector<PoseDemand>& demands = s.problem.demands;
  if (std::any_of(demands.begin(), demands.end(),
                  [](const PoseDemand& d) { return d.exact || d.weight != 1; }))
    return target.error("fit", "weights and poses that are marked exact are for least_squares",
                        "write fit = \"least_squares\", or leave weight and exact out");
  if (given > 0)
    return target.error("fit", "pivots are given, or on lines, for poses alone, not with points among them",
                        "give every pose its angle, or give regions for pivots");
  const auto poses =
      std::count_if(demands.begin(), demands.end(), [](const PoseDemand& d) { return d.angle; });
  const auto points = static_cast<std::ptrdiff_t>(demands.size()) - poses;
  if (poses < 2) return;  // reported
  const char* hint =
      "four-bars take 4 poses and 2 points, 3 and 4, or 2 and 6; slider-cranks 4 and 1, 3 and 3, or 2 and 5; "
      "fit = \"least_squares\" takes any";
  const std::string what = fmt::format("{} poses and {} point{}", poses, points, points == 1 ? "" : "s");
  const auto linkages = linkages_of({s.problem.poses, demands});
  if (linkages.empty())
    return target.error(
        "pose",
        fmt::format("{} are met exactly by {}", what,
                    2 * (poses - 1) + points > 8 ? "no linkage of two dyads" : "infinitely many linkages"),
        hint);
  for (const MixedPoseLinkage linkage : linkages)
    if (allows(s, GuidingDyadType::rr) && allows(s, other_dyad(linkage))) s.exact_linkages.push_back(linkage);
  if (s.exact_linkages.empty())
    target.error("pose",
                 fmt::format("{} are for {}, which mechanism.dyads leaves out", what,
                             linkages[0] == MixedPoseLinkage::four_bar
                                 ? "four-bars (RR and RR)"
                                 : "slider-cranks (RR and PR, or inverted RR and RP)"),
                 hint);
}

// Checks that poses and pivots leave a number of linkages that can be listed.
void check_counts(study::ObjectReader& target, PoseStudy& s) {
  const std::size_t n = s.problem.poses.size();
  const int given = poses_replaced(s.problem.pivots[0]) + poses_replaced(s.problem.pivots[1]);
  const PoseFitting fit = s.target.fit;
  s.problem.exact = fit == PoseFitting::exact || (fit == PoseFitting::automatic && n <= 5 && !s.mixed);
  if (s.problem.exact && s.mixed) return check_mixed_counts(target, s, given);
  if (!s.problem.exact) {
    if (n < 5)
      target.error("fit", fmt::format("{} poses are met exactly, least_squares needs 5 at least", n),
                   "write fit = \"exact\", or leave it out");
    if (prescribes(s.problem.pivots[0]) || prescribes(s.problem.pivots[1]))
      target.error(
          "fit", "pivots are prescribed for poses that are met exactly, up to five",
          n > 5 ? "keep the poses that matter, or remove [[mechanism.pivot]]" : "write fit = \"exact\"");
    return;
  }
  if (n > 5) {
    target.error("fit", fmt::format("{} poses, a linkage of links and slides meets five exactly", n),
                 "write fit = \"least_squares\", or keep five poses");
    return;
  }
  for (const std::size_t dyad : {std::size_t{0}, std::size_t{1}}) {
    const int free = freedoms(s.problem, dyad);
    if (free < 0)
      target.error(
          "pose",
          fmt::format("{} poses and what is given of the pivots of dyad {} are {} conditions, a dyad meets 5",
                      n, dyad + 1, 5 - free),
          "a pivot that is given counts as two poses, one on a line as one: remove a pose or a pivot");
    if (free > max_open_numbers) {
      target.error("pose", fmt::format("{} poses leave {} numbers of dyad {} open", n, free, dyad + 1),
                   "add a pose, or [[mechanism.pivot]] with a pivot of it or a line for one; a region is no "
                   "condition");
    }
  }
}

}  // namespace

std::vector<PoseForm> poses_of_file(study::ObjectReader& target, const study::Common& common,
                                    const std::string& file) {
  const std::optional<std::string> text = study::read_beside(target, "file", common.folder, file);
  if (!text) return {};
  Diagnostics problems;
  const std::optional<Table> table = read_csv(*text, (common.folder / file).string(), problems);
  for (const Diagnostic& problem : problems) target.unreadable("file", study::in_file(problem));
  if (!table) return {};
  const auto x = quantity(*table, "x", Dimension::length), y = quantity(*table, "y", Dimension::length),
             angle = quantity(*table, "angle", Dimension::angle);
  if (!x || !y || !angle) {
    std::vector<std::string> found;
    for (const Column& c : table->columns) found.push_back(c.key);
    target.error("file",
                 fmt::format("'{}' has the columns {}, but needs x, y and angle, each with its unit", file,
                             fmt::join(found, ", ")),
                 "name them x_mm, y_mm, angle_deg");
    return {};
  }
  std::vector<PoseForm> out;
  for (std::size_t k = 0; k < x->size(); ++k) {
    out.push_back({(*x)[k], (*y)[k], (*angle)[k]});
    if (std::isfinite((*x)[k]) && std::isfinite((*y)[k]) && std::isfinite((*angle)[k])) continue;
    target.error("file", fmt::format("'{}': pose {} is incomplete", file, k + 1),
                 "give it x, y and an angle");
    return {};
  }
  return out;
}

PoseStudy read_pose_study(study::ObjectReader& document, const study::Common& common) {
  PoseStudy s;
  if (auto mechanism = document.table(field::entry("mechanism").required())) {
    mechanism->read(s.mechanism);
    if (s.mechanism.dyads.empty())
      mechanism->error("dyads", "no type of dyad is allowed", "write dyads = [\"RR\"]");
    set_pivots(*mechanism, s);
  }
  if (auto target = document.table(field::entry("target").required())) {
    target->read(s.target);
    const bool has_poses = target->has("pose"), has_file = target->has("file");
    if (has_poses && has_file)
      target->error("file", "the target has both poses and a file", "keep one of them");
    else if (!has_poses && !has_file)
      target->error("pose", "the target has no poses",
                    "write [[target.pose]] with x_mm, y_mm, angle_deg for each, or file = \"poses.csv\"");
    if (s.target.file && !has_poses) s.target.poses = poses_of_file(*target, common, *s.target.file);
    for (const PoseForm& form : s.target.poses)
      s.problem.poses.push_back({{form.x, form.y}, form.angle.value_or(0)});
    set_demands(*target, s);
    if (!s.target.poses.empty() && !(has_poses && has_file)) {
      check_poses(*target, has_file ? "file" : "pose", s.problem);
      if (s.problem.poses.size() >= 2) check_counts(*target, s);
    }
  }
  if (auto search = document.table("optimiser")) search->read(s.search);
  s.problem.types = s.mechanism.dyads;
  s.problem.drive_turns = s.mechanism.crank_rotates_fully.value_or(false);
  s.problem.angle_length = s.target.angle_length.value_or(0);
  s.problem.max_designs = s.search.max_solutions;
  return s;
}

study::Kind pose_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.four_bar";
  kind.target = "poses";
  kind.summary =
      "four-bars, slider-cranks and other linkages of links and slides that lead a body through poses";
  kind.example = templates::synthesis_four_bar_poses();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "what holds the body"),
                      study::schema_fields<PoseMechanism>());
    document.property(field::entry("target", "the poses"), study::schema_fields<PoseTarget>());
    document.property(field::entry("optimiser", "how linkages are listed"),
                      study::schema_fields<PoseSearch>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const PoseStudy s = read_pose_study(document, common);
    study::Prepared prepared;
    PoseStudy resolved = s;
    resolved.target.file.reset();
    resolved.target.poses.clear();
    for (std::size_t k = 0; k < s.problem.poses.size(); ++k) {
      const BodyPose& pose = s.problem.poses[k];
      const PoseDemand demand = s.mixed ? s.problem.demands[k] : PoseDemand{};
      resolved.target.poses.push_back({pose.origin.real(), pose.origin.imag(),
                                       demand.angle ? std::optional(pose.angle) : std::nullopt, demand.weight,
                                       demand.exact});
    }
    prepared.canonical["mechanism"] = study::write_fields(resolved.mechanism);
    prepared.canonical["target"] = study::write_fields(resolved.target);
    prepared.canonical["optimiser"] = study::write_fields(resolved.search);
    prepared.run = [s, common](RunContext& context) { return run_pose_study(s, common, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
