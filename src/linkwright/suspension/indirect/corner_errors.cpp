// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/corner_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dual.h"
#include "linkwright/suspension/indirect/link_fit_direct.h"

namespace linkwright::suspension {
namespace {

constexpr std::array axis_letters{"x", "y", "z"};

Mat3 turn_rate_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{-s, 0, c}, Vec3{0, 0, 0}, Vec3{-c, 0, -s}}};
}

/// Points that a coupler depends on, from the wheel centre: body and carrier point of the first link, ball
/// joint and both hinge points of the second, the offset, the point on the second link.
template <class T>
struct CouplerPoints {
  math::Vector3<T> body, carrier, ball, hinge, other, point;
  T offset;
};

/// The point at the offset on the first link as the second one sees it; `frame` are its axes (59)-(64).
template <class T>
math::Vector3<T> seen(const CouplerPoints<T>& p, const math::Matrix3<T>& rotation, const Vec3& centre,
                      const Vec3& first_shift, const Vec3& second_shift, math::Matrix3<T>& frame,
                      math::Vector3<T>& hinge) {
  hinge = centre + rotation * p.hinge;
  const math::Vector3<T> along = rotation * (p.other - p.hinge), ball = p.ball + second_shift;
  const math::Vector3<T> y = math::unit(along), z = math::unit(cross(ball - hinge, along));
  frame = {{cross(y, z), y, z}};
  const math::Vector3<T> from = p.body + first_shift, rod = centre + rotation * p.carrier - from;
  return frame * (from + (p.offset / norm(rod)) * rod - hinge);
}

double longest(const LinkTask& task) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double a = std::abs(component(task.carrier[0].upper, k) - component(task.body[0].lower, k)),
                 b = std::abs(component(task.carrier[0].lower, k) - component(task.body[0].upper, k));
    square += std::max(a, b) * std::max(a, b);
  }
  return std::sqrt(square);
}

bool is_rod(LinkType type) { return type == LinkType::US || type == LinkType::SS; }

}  // namespace

double ErrorTotals::rms() const { return count > 0 ? std::sqrt(square / count) : 0; }
void ErrorTotals::add(double error) {
  sum += error;
  square += error * error;
  largest = std::max(largest, error);
  ++count;
}
void ErrorTotals::add(const ErrorTotals& other) {
  sum += other.sum;
  square += other.square;
  largest = std::max(largest, other.largest);
  count += other.count;
}

CornerErrors::CornerErrors(const CarrierTargets& targets, std::span<const LinkTask> links,
                           std::span<const CouplerTask> couplers, CarrierPitchTechnique technique,
                           double largest_carrier_pitch)
    : targets_(targets), technique_(technique) {
  LINKWRIGHT_REQUIRE(!links.empty(), "no link has unknown points");
  LINKWRIGHT_REQUIRE(largest_carrier_pitch > 0, "carrier pitch of at most {} rad", largest_carrier_pitch);
  add_poses();
  LINKWRIGHT_REQUIRE(!poses_.empty(), "no position besides the reference");
  const bool alone = links.size() == 1 && couplers.empty();
  for (const LinkTask& task : links) add_link(task, alone);
  for (const CouplerTask& task : couplers) add_coupler(task, links);
  add_carrier_pitches(largest_carrier_pitch);
}

void CornerErrors::add_poses() {
  const Vec3& origin = targets_.wheel.centre;
  for (std::size_t i = 0; i < targets_.poses.size(); ++i) {
    const CarrierTarget& target = targets_.poses[i];
    Pose pose{.target = i,
              .before = math::turn_z(-target.angles.toe) * math::turn_x(-target.angles.camber),
              .after = math::turn_x(targets_.wheel.camber) * math::turn_z(targets_.wheel.toe),
              .rate = {},
              .open = std::isnan(target.angles.carrier_pitch),
              .travel = target.centre.z - origin.z};
    carrier_pitches_.push_back(pose.open ? 0 : target.angles.carrier_pitch);
    const bool reference = target.rack == 0 && norm(target.centre - origin) < 1e-12 &&
                           std::abs(target.angles.toe - targets_.wheel.toe) < 1e-12 &&
                           std::abs(target.angles.camber - targets_.wheel.camber) < 1e-12 &&
                           std::abs(carrier_pitches_.back()) < 1e-12;
    if (reference) continue;  // its carrier pitch is 0 by definition
    for (const bool moved : {false, true}) {
      LinkMotion& motion = motions_[moved ? 1 : 0];
      motion.rotation.push_back(pose.before * math::turn_y(carrier_pitches_.back()) * pose.after);
      motion.shift.push_back(moved ? target.centre - origin - target.rack * targets_.rack_direction
                                   : target.centre - origin);
    }
    LINKWRIGHT_REQUIRE(!pose.open || technique_ != CarrierPitchTechnique::quadratic || target.rack == 0,
                       "position {} has the rack at {} m: a quadratic of the travel does not know the rack",
                       i + 1, target.rack);
    poses_.push_back(pose);
  }
}

std::size_t CornerErrors::add_unknown(std::string name, double lower, double upper) {
  names_.push_back(std::move(name));
  lower_.push_back(lower);
  upper_.push_back(upper);
  return unknowns() - 1;
}

void CornerErrors::add_link(const LinkTask& task, bool alone) {
  const std::size_t l = links_.size(), n = poses_.size();
  const Vec3& origin = targets_.wheel.centre;
  LinkPart part{.coordinates = LinkCoordinates(task, origin),
                .link = {},
                .first_unknown = unknowns(),
                .first_row = rows_,
                .rows = error_rows(task.type, n)};
  part.link = part.coordinates.middle();
  const int bodies = static_cast<int>(task.body.size());
  for (const int at : part.coordinates.free()) {
    const int point = at / 3;
    add_unknown(
        fmt::format("{}{}_{}_{}_m", alone ? "" : fmt::format("link_{}_", l + 1),
                    point < bodies ? "body" : "carrier", 1 + (point < bodies ? point : point - bodies),
                    axis_letters[static_cast<std::size_t>(at % 3)]),
        part.coordinates.lower(at) + component(origin, at % 3),
        part.coordinates.upper(at) + component(origin, at % 3));
  }
  rows_ += part.rows;
  if (dyad_ < 0 && is_rod(task.type)) dyad_ = static_cast<int>(l);
  links_.push_back(std::move(part));
}

void CornerErrors::add_coupler(const CouplerTask& task, std::span<const LinkTask> links) {
  const std::size_t k = couplers_.size();
  for (const int link : {task.first, task.second})
    LINKWRIGHT_REQUIRE(link >= 0 && link < static_cast<int>(links.size()), "coupler '{}': link {} of {}",
                       task.name, link, links.size());
  LINKWRIGHT_REQUIRE(is_rod(links[at(task.first)].type) && links[at(task.second)].type == LinkType::SR,
                     "coupler '{}': from a link of type {} to one of type {}, needs US and SR", task.name,
                     name_of(links[at(task.first)].type), name_of(links[at(task.second)].type));
  CouplerPart part;
  part.task = task;
  part.first_row = rows_;
  const double most = std::min(task.max_offset, longest(links[at(task.first)]));
  LINKWRIGHT_REQUIRE(task.min_offset >= 0 && task.min_offset <= most, "coupler '{}': offset from {} to {} m",
                     task.name, task.min_offset, most);
  part.offset = task.min_offset;
  part.columns.fill(-1);
  if (task.min_offset < most)
    part.columns[0] =
        static_cast<int>(add_unknown(fmt::format("coupler_{}_offset_m", k + 1), task.min_offset, most));
  for (int a = 0; a < 3; ++a) {
    const double low = component(task.point.lower, a), high = component(task.point.upper, a);
    LINKWRIGHT_REQUIRE(low <= high, "coupler '{}': box from {} to {} m", task.name, low, high);
    if (low < high)
      part.columns[at(a) + 1] = static_cast<int>(
          add_unknown(fmt::format("coupler_{}_point_{}_m", k + 1, axis_letters[at(a)]), low, high));
  }
  part.point = 0.5 * (task.point.lower + task.point.upper) - targets_.wheel.centre;
  rows_ += poses_.size();
  couplers_.push_back(part);
}

void CornerErrors::add_carrier_pitches(double largest_carrier_pitch) {
  const std::size_t n = poses_.size();
  double farthest = 0;
  bool any_open = false;
  for (const Pose& pose : poses_)
    if (pose.open) {
      any_open = true;
      farthest = std::max(farthest, std::abs(pose.travel));
    }
  first_carrier_pitch_ = unknowns();
  carrier_pitch_columns_.resize(n);
  if (any_open && technique_ == CarrierPitchTechnique::each) {
    for (std::size_t i = 0; i < n; ++i)
      if (poses_[i].open)
        carrier_pitch_columns_[i] = {{add_unknown(fmt::format("carrier_pitch_{}_rad", poses_[i].target + 1),
                                                  -largest_carrier_pitch, largest_carrier_pitch),
                                      1}};
  } else if (any_open && technique_ == CarrierPitchTechnique::quadratic) {
    LINKWRIGHT_REQUIRE(farthest > 0, "the wheel does not travel");
    const double slope = largest_carrier_pitch / farthest, bend = slope / farthest;
    const std::size_t linear = add_unknown("carrier_pitch_slope_rad_per_m", -slope, slope);
    const std::size_t above = add_unknown("carrier_pitch_bend_above_rad_per_m2", -bend, bend);
    const std::size_t below = add_unknown("carrier_pitch_bend_below_rad_per_m2", -bend, bend);
    for (std::size_t i = 0; i < n; ++i)
      if (const double z = poses_[i].travel; poses_[i].open)
        carrier_pitch_columns_[i] = {{linear, z}, {z >= 0 ? above : below, z * z}};
  } else if (any_open) {
    LINKWRIGHT_REQUIRE(dyad_ >= 0, "no US link makes a dyad with the carrier");
    settling_ = settling_order(targets_, PoseParameter::carrier_pitch);
    const LinkPart& part = links_[at(dyad_)];
    for (std::size_t i = 0; i < n; ++i)
      if (poses_[i].open)
        for (std::size_t f = 0; f < part.coordinates.free().size(); ++f)
          carrier_pitch_columns_[i].push_back({part.first_unknown + f, 0});
  }
  if (!any_open || technique_ != CarrierPitchTechnique::dyad) dyad_ = -1;
  carrier_pitch_unknowns_ = unknowns() - first_carrier_pitch_;
}

bool CornerErrors::set_dyad_carrier_pitches() {
  const CornerLink rod = shifted(links_[static_cast<std::size_t>(dyad_)].link, targets_.wheel.centre);
  shortfall_ = 0;
  bool there = true;
  const auto carrier_pitch = [&](int position) {
    return position < 0 ? 0 : carrier_pitches_[static_cast<std::size_t>(position)];
  };
  for (const SettlingStep& step : settling_) {
    const double expected = step.expected(carrier_pitch(step.before), carrier_pitch(step.before_that));
    const RodSolution s =
        solve_for(targets_, targets_.poses[step.position], rod, PoseParameter::carrier_pitch, expected);
    shortfall_ += s.shortfall;
    there = there && s.status == Status::done;
    carrier_pitches_[step.position] = s.value;
  }
  return there;
}

bool CornerErrors::place(std::span<const double> x, bool rates) {
  for (LinkPart& part : links_) {
    std::size_t column = part.first_unknown;
    for (const int at : part.coordinates.free())
      LinkCoordinates::set(part.link, at, x[column++] - component(targets_.wheel.centre, at % 3));
  }
  for (CouplerPart& part : couplers_) {
    const auto value = [&](std::size_t k, double& to) {
      if (part.columns[k] >= 0) to = x[static_cast<std::size_t>(part.columns[k])];
    };
    Vec3 point = part.point + targets_.wheel.centre;
    value(0, part.offset);
    value(1, point.x), value(2, point.y), value(3, point.z);
    part.point = point - targets_.wheel.centre;
  }
  bool there = true;
  if (dyad_ >= 0) there = set_dyad_carrier_pitches();
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    Pose& pose = poses_[i];
    if (!pose.open) continue;
    double& carrier_pitch = carrier_pitches_[pose.target];
    if (dyad_ < 0) {
      carrier_pitch = 0;
      for (const CarrierPitchColumn& c : carrier_pitch_columns_[i])
        carrier_pitch += c.derivative * x[c.column];
    }
    const Mat3 rotation = pose.before * math::turn_y(carrier_pitch) * pose.after;
    for (LinkMotion& motion : motions_) motion.rotation[i] = rotation;
    if (rates) pose.rate = pose.before * turn_rate_y(carrier_pitch) * pose.after;
  }
  return there;
}

void CornerErrors::add_carrier_pitch(std::size_t pose, std::size_t row, double derivative,
                                     std::span<double> jacobian) const {
  for (const CarrierPitchColumn& c : carrier_pitch_columns_[pose])
    jacobian[c.column * rows_ + row] += derivative * c.derivative;
}

/// d(error)/d(carrier pitch) of every row, through what the carrier pitch depends on.
void CornerErrors::add_carrier_pitch_derivatives(std::span<double> jacobian) {
  const std::size_t n = poses_.size();
  if (dyad_ >= 0) {  // the carrier pitch keeps the rod's error at 0
    const LinkPart& part = links_[static_cast<std::size_t>(dyad_)];
    const LinkMotion& m = motion(part.link);
    for (std::size_t i = 0; i < n; ++i) {
      if (!poses_[i].open) continue;
      const Vec3 d = m.moved(i, part.link.carrier[0]) - part.link.body[0];
      const double by_carrier_pitch = dot(math::unit(d), poses_[i].rate * part.link.carrier[0]);
      for (CarrierPitchColumn& c : carrier_pitch_columns_[i])
        c.derivative = -jacobian[c.column * rows_ + part.first_row + i] / by_carrier_pitch;
    }
  }
  for (const LinkPart& part : links_) {
    const CornerLink& link = part.link;
    const LinkMotion& m = motion(link);
    for (std::size_t i = 0; i < n; ++i) {
      if (!poses_[i].open) continue;
      const Mat3& rate = poses_[i].rate;
      if (link.type == LinkType::SP) {
        const Vec3 u = math::unit(link.carrier[0] - link.body[0]);
        const Vec3 w = transposed(rate) * (link.body[0] - m.shift[i]), across = w - dot(u, w) * u;
        for (int k = 0; k < 3; ++k)
          add_carrier_pitch(i, part.first_row + 3 * i + static_cast<std::size_t>(k), component(across, k),
                            jacobian);
      } else if (link.type == LinkType::S || link.type == LinkType::R) {
        for (std::size_t b = 0; b < link.body.size(); ++b) {
          const Vec3 moved = rate * link.body[b];
          for (int k = 0; k < 3; ++k)
            add_carrier_pitch(i, part.first_row + 3 * (b * n + i) + static_cast<std::size_t>(k),
                              component(moved, k), jacobian);
        }
      } else {
        std::size_t row = part.first_row + i;
        for (const Vec3& body : link.body)
          for (const Vec3& carrier : link.carrier) {
            add_carrier_pitch(i, row, dot(math::unit(m.moved(i, carrier) - body), rate * carrier), jacobian);
            row += n;
          }
      }
    }
  }
}

bool CornerErrors::evaluate_coupler(const CouplerPart& part, std::span<double> errors,
                                    std::span<double> jacobian) {
  const LinkPart &first = links_[static_cast<std::size_t>(part.task.first)],
                 &second = links_[static_cast<std::size_t>(part.task.second)];
  const std::array<const Vec3*, 6> points{&first.link.body[0],     &first.link.carrier[0],
                                          &second.link.body[0],    &second.link.carrier[0],
                                          &second.link.carrier[1], &part.point};
  const std::size_t n = poses_.size();
  const auto all = [&]<class T>(const CouplerPoints<T>& p, auto&& rotation_at, auto&& write) {
    math::Matrix3<T> frame;
    math::Vector3<T> hinge;
    const math::Vector3<T> at_rest = seen<T>(p, math::Matrix3<T>{}, Vec3{}, Vec3{}, Vec3{}, frame, hinge);
    const math::Vector3<T> y = frame * (p.point - hinge), d0 = at_rest - y;
    const T l0 = norm(d0);
    for (std::size_t i = 0; i < n; ++i) {
      const auto shift = [&](const LinkPart& link) {  // shift of points that the rack moves
        return motions_[0].shift[i] - motion(link.link).shift[i];
      };
      const math::Vector3<T> d =
          seen<T>(p, rotation_at(i), motions_[0].shift[i], shift(first), shift(second), frame, hinge) - y;
      write(i, dot(d - d0, d + d0) / (norm(d) + l0));
    }
  };
  bool finite = true;
  if (jacobian.empty()) {
    CouplerPoints<double> p{*points[0], *points[1], *points[2], *points[3],
                            *points[4], *points[5], part.offset};
    all(
        p, [&](std::size_t i) { return motions_[0].rotation[i]; },
        [&](std::size_t i, double e) {
          errors[part.first_row + i] = e;
          finite = finite && std::isfinite(e);
        });
    return finite;
  }
  using Number = math::Dual<20>;  // six points, the offset, the carrier pitch
  const auto variables = [&](int point) {
    const Vec3& at = *points[static_cast<std::size_t>(point)];
    return math::Vector3<Number>{Number::variable(at.x, 3 * point), Number::variable(at.y, 3 * point + 1),
                                 Number::variable(at.z, 3 * point + 2)};
  };
  CouplerPoints<Number> p{variables(0),
                          variables(1),
                          variables(2),
                          variables(3),
                          variables(4),
                          variables(5),
                          Number::variable(part.offset, 18)};
  std::array<int, 19> columns{};
  const auto take = [&](std::size_t to, const LinkPart& link, std::size_t from) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int local = link.coordinates.columns()[3 * from + k];
      columns[to + k] = local < 0 ? -1 : static_cast<int>(link.first_unknown) + local;
    }
  };
  take(0, first, 0), take(3, first, 1), take(6, second, 0), take(9, second, 1), take(12, second, 2);
  for (std::size_t k = 0; k < 3; ++k) columns[15 + k] = part.columns[k + 1];
  columns[18] = part.columns[0];
  all(
      p,
      [&](std::size_t i) {
        math::Matrix3<Number> r;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 &row = motions_[0].rotation[i].row[k], &rate = poses_[i].rate.row[k];
          r.row[k] = {row.x, row.y, row.z};
          if (poses_[i].open)
            r.row[k].x.by[19] = rate.x, r.row[k].y.by[19] = rate.y, r.row[k].z.by[19] = rate.z;
        }
        return r;
      },
      [&](std::size_t i, const Number& e) {
        const std::size_t row = part.first_row + i;
        errors[row] = e.value;
        finite = finite && std::isfinite(e.value) &&
                 std::all_of(e.by.begin(), e.by.end(), [](double v) { return std::isfinite(v); });
        for (std::size_t k = 0; k < columns.size(); ++k)
          if (columns[k] >= 0) jacobian[static_cast<std::size_t>(columns[k]) * rows_ + row] += e.by[k];
        if (poses_[i].open) add_carrier_pitch(i, row, e.by[19], jacobian);
      });
  return finite;
}

bool CornerErrors::evaluate(std::span<const double> x, std::span<double> errors, std::span<double> jacobian) {
  if (!place(x, !jacobian.empty())) return false;
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  for (LinkPart& part : links_) {
    const std::size_t free = part.coordinates.free().size();
    scratch_.resize(jacobian.empty() ? 0 : free * part.rows);
    if (!structural_errors(motion(part.link), part.link, errors.subspan(part.first_row, part.rows),
                           part.coordinates.columns(), scratch_))
      return false;
    if (jacobian.empty()) continue;
    for (std::size_t f = 0; f < free; ++f)
      std::copy_n(
          scratch_.begin() + static_cast<std::ptrdiff_t>(f * part.rows), part.rows,
          jacobian.begin() + static_cast<std::ptrdiff_t>((part.first_unknown + f) * rows_ + part.first_row));
  }
  if (!jacobian.empty()) add_carrier_pitch_derivatives(jacobian);
  return std::all_of(couplers_.begin(), couplers_.end(),
                     [&](const CouplerPart& part) { return evaluate_coupler(part, errors, jacobian); });
}

std::vector<CornerLink> CornerErrors::links() const {
  std::vector<CornerLink> out;
  for (const LinkPart& part : links_) out.push_back(shifted(part.link, targets_.wheel.centre));
  return out;
}

std::vector<Coupler> CornerErrors::couplers() const {
  std::vector<Coupler> out;
  for (const CouplerPart& part : couplers_) {
    const CornerLink& first = links_[static_cast<std::size_t>(part.task.first)].link;
    out.push_back({.name = part.task.name,
                   .first = part.task.first,
                   .fraction = part.offset / norm(first.carrier[0] - first.body[0]),
                   .second = part.task.second,
                   .point = part.point + targets_.wheel.centre});
  }
  return out;
}

CarrierTargets CornerErrors::targets() const {
  CarrierTargets out = targets_;
  for (std::size_t i = 0; i < carrier_pitches_.size(); ++i)
    out.poses[i].angles.carrier_pitch = carrier_pitches_[i];
  return out;
}

void CornerErrors::start_from(std::span<const CornerLink> links, std::span<const Coupler> couplers,
                              std::span<double> x) const {
  std::fill(x.begin(), x.end(), 0.0);
  for (std::size_t l = 0; l < links_.size(); ++l) {
    std::size_t column = links_[l].first_unknown;
    for (const int at : links_[l].coordinates.free()) x[column++] = LinkCoordinates::get(links[l], at);
  }
  for (std::size_t k = 0; k < couplers_.size(); ++k) {
    const CouplerPart& part = couplers_[k];
    const CornerLink& first = links[static_cast<std::size_t>(part.task.first)];
    const Vec3& point = couplers[k].point;
    const std::array values{couplers[k].fraction * norm(first.carrier[0] - first.body[0]), point.x, point.y,
                            point.z};
    for (std::size_t c = 0; c < 4; ++c)
      if (part.columns[c] >= 0) x[static_cast<std::size_t>(part.columns[c])] = values[c];
  }
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = std::clamp(x[j], lower_[j], upper_[j]);
}

ErrorTotals CornerErrors::link_totals(std::size_t link, std::span<const double> errors) const {
  const LinkPart& part = links_[link];
  const std::size_t count = poses_.size() * static_cast<std::size_t>(error_count(part.link.type)),
                    parts = part.rows / count;
  ErrorTotals t;
  for (std::size_t i = 0; i < part.rows; i += parts) {
    double square = 0;
    for (std::size_t k = 0; k < parts; ++k)
      square += errors[part.first_row + i + k] * errors[part.first_row + i + k];
    t.add(std::sqrt(square));
  }
  return t;
}

ErrorTotals CornerErrors::coupler_totals(std::size_t coupler, std::span<const double> errors) const {
  ErrorTotals t;
  for (std::size_t i = 0; i < poses_.size(); ++i) t.add(std::abs(errors[couplers_[coupler].first_row + i]));
  return t;
}

ErrorTotals CornerErrors::totals(std::span<const double> errors) const {
  ErrorTotals t;
  for (std::size_t l = 0; l < links_.size(); ++l) t.add(link_totals(l, errors));
  for (std::size_t k = 0; k < couplers_.size(); ++k) t.add(coupler_totals(k, errors));
  return t;
}

}  // namespace linkwright::suspension
