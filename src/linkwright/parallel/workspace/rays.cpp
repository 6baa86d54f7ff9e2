// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/rays.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"

namespace linkwright::parallel {

namespace {

struct Route {
  const PoseConditions& conditions;
  Pose origin;
  bool turns;

  Pose at(const Vec3& direction, double distance) const {
    if (!turns) return {origin.position + distance * direction, origin.rotation};
    return {origin.position, math::turn_about(distance * direction) * origin.rotation};
  }
};

// All stretches of one ray: a march, then all ends bisected together, as many as fit in registers.
void follow(const Route& route, const RaySearch& search, Ray& ray) {
  const auto steps = static_cast<std::size_t>(std::ceil(search.longest / search.step));
  const auto distance = [&](std::size_t i) {
    return i >= steps ? search.longest : search.step * static_cast<double>(i);
  };
  std::vector<Pose> poses(steps + 1);
  std::vector<Criterion> criterion(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) poses[i] = route.at(ray.direction, distance(i));
  check_poses(route.conditions, poses, {.criterion = criterion});

  struct End {
    double inside, outside;
    Criterion criterion;
  };
  std::vector<End> ends;
  for (std::size_t i = 0; i < steps; ++i) {
    const bool here = criterion[i] == Criterion::none, next = criterion[i + 1] == Criterion::none;
    if (here && !next) ends.push_back({distance(i), distance(i + 1), criterion[i + 1]});
    if (!here && next) ends.push_back({distance(i + 1), distance(i), criterion[i]});
  }
  const auto unsettled = [&](const End& e) {
    const double middle = 0.5 * (e.inside + e.outside);
    return std::abs(e.outside - e.inside) > search.tolerance && middle != e.inside && middle != e.outside;
  };
  poses.resize(ends.size());
  criterion.resize(ends.size());
  while (std::any_of(ends.begin(), ends.end(), unsettled)) {
    for (std::size_t i = 0; i < ends.size(); ++i)
      poses[i] = route.at(ray.direction, 0.5 * (ends[i].inside + ends[i].outside));
    check_poses(route.conditions, poses, {.criterion = criterion});
    for (std::size_t i = 0; i < ends.size(); ++i) {
      End& e = ends[i];
      const double middle = 0.5 * (e.inside + e.outside);
      if (criterion[i] == Criterion::none) {
        e.inside = middle;
      } else {
        e.outside = middle;
        e.criterion = criterion[i];
      }
    }
  }
  bool open = check_pose(route.conditions, route.at(ray.direction, 0)) == Criterion::none;
  if (open) ray.stretch.push_back({.from = 0, .to = search.longest});
  for (const End& e : ends) {
    if (open)
      ray.stretch.back().to = e.inside, ray.stretch.back().after = e.criterion;
    else
      ray.stretch.push_back({.from = e.inside, .to = search.longest, .before = e.criterion});
    open = !open;
  }
}

Rays follow_all(const Route& route, std::span<const Vec3> directions, const RaySearch& search,
                const RunContext& context) {
  const auto trouble = problem(route.conditions);
  LINKWRIGHT_REQUIRE(!trouble, "{}", trouble.value_or(""));
  LINKWRIGHT_REQUIRE(
      search.longest > 0 && search.step > 0 && search.tolerance > 0 && search.longest / search.step < 1e7,
      "rays of {} in steps of {} to {}", search.longest, search.step, search.tolerance);
  Rays out;
  for (const Vec3& d : directions) {
    LINKWRIGHT_REQUIRE(norm(d) > 0 && std::isfinite(norm(d)), "direction ({}, {}, {})", d.x, d.y, d.z);
    out.ray.push_back({.direction = math::unit(d)});
  }
  optimise::parallel_for(out.ray.size(), context.threads(), [&](std::size_t i) {
    if (!context.interrupted()) follow(route, search, out.ray[i]);
  });
  out.status = context.interruption();
  if (out.status != Status::done) out.ray.clear();
  return out;
}

// The common area of two discs with centres a distance apart.
double common_area(double r, double s, double distance) {
  if (distance >= r + s) return 0;
  const double least = std::min(r, s);
  if (distance <= std::abs(r - s)) return pi * least * least;
  // Half angles of both segments, seen from the centres, by the sides of the triangle (r, s, distance).
  const double four =
      std::sqrt((distance + r + s) * (r + s - distance) * (distance + r - s) * (distance - r + s));
  const double at_r = std::atan2(four, distance * distance + r * r - s * s),
               at_s = std::atan2(four, distance * distance + s * s - r * r);
  return r * r * at_r + s * s * at_s - 0.5 * four;
}

}  // namespace

Rays position_rays(const PoseConditions& conditions, const Pose& origin, std::span<const Vec3> directions,
                   const RaySearch& search, const RunContext& context) {
  return follow_all({conditions, origin, false}, directions, search, context);
}

Rays rotation_rays(const PoseConditions& conditions, const Pose& origin, std::span<const Vec3> directions,
                   const RaySearch& search, const RunContext& context) {
  LINKWRIGHT_REQUIRE(conditions.robot.freedom == Freedom::space, "the platform of this robot does not turn");
  LINKWRIGHT_REQUIRE(search.longest <= pi, "turns of {} rad: at most half a turn", search.longest);
  return follow_all({conditions, origin, true}, directions, search, context);
}

std::vector<Vec3> directions_around(int count, const Vec3& first, const Vec3& second) {
  LINKWRIGHT_REQUIRE(count > 0, "{} directions", count);
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    out.push_back(std::cos(angle) * first + std::sin(angle) * second);
  }
  return out;
}

std::vector<Vec3> directions_over_sphere(int count) {
  LINKWRIGHT_REQUIRE(count > 0, "{} directions", count);
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    out.push_back({r * std::cos(golden * i), r * std::sin(golden * i), z});
  }
  return out;
}

double area_of(const Rays& rays) {
  double sum = 0;
  for (const Ray& ray : rays.ray)
    for (const RayStretch& s : ray.stretch) sum += (s.to - s.from) * (s.to + s.from);
  return sum * pi / static_cast<double>(rays.ray.size());
}

RotationRange rotation_range(const PoseConditions& conditions, const Pose& pose, int axes,
                             const RaySearch& search, const RunContext& context) {
  std::vector<Vec3> directions = directions_around(axes);
  directions.push_back({0, 0, -1});
  directions.push_back({0, 0, 1});
  Rays found = rotation_rays(conditions, pose, directions, search, context);
  RotationRange out{.status = found.status};
  if (found.status != Status::done) return out;
  // The criterion that ends the rotation; if the pose itself does not pass, that of the pose.
  const Criterion here = check_pose(conditions, pose);
  const auto criterion = [&](const Ray& ray) {
    return here != Criterion::none ? here : ray.stretch[0].after;
  };
  const auto n = static_cast<std::size_t>(axes);
  out.min_yaw = -found.ray[n].reach();
  out.min_yaw_criterion = criterion(found.ray[n]);
  out.max_yaw = found.ray[n + 1].reach();
  out.max_yaw_criterion = criterion(found.ray[n + 1]);
  found.ray.resize(n);
  const auto first = std::min_element(found.ray.begin(), found.ray.end(),
                                      [](const Ray& a, const Ray& b) { return a.reach() < b.reach(); });
  out.tilt = first->reach();
  out.tilt_azimuth = std::atan2(first->direction.y, first->direction.x);
  out.tilt_criterion = criterion(*first);
  out.tilts = std::move(found.ray);
  return out;
}

double reachable_area(const Robot& robot) {
  LINKWRIGHT_REQUIRE(robot.freedom == Freedom::plane_translation, "only planar robots have an area");
  const Leg &a = robot.leg[0], &b = robot.leg[1];
  const double distance = norm((b.base - b.platform) - (a.base - a.platform));
  const auto common = [&](double r, double s) { return common_area(r, s, distance); };
  const double a_out = a.arm + a.rod, a_in = std::abs(a.arm - a.rod), b_out = b.arm + b.rod,
               b_in = std::abs(b.arm - b.rod);
  return common(a_out, b_out) - common(a_in, b_out) - common(a_out, b_in) + common(a_in, b_in);
}

}  // namespace linkwright::parallel
