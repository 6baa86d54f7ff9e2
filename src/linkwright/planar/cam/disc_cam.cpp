// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/disc_cam.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/math/minimum.h"
#include "linkwright/planar/cam/detail/contour.h"

namespace linkwright::planar {
namespace {

using Number = std::complex<double>;
using math::Motion;

constexpr Number i{0, 1};

Number direction(double angle) { return std::polar(1.0, angle); }

RollerPath roller_path(const DiscCam& cam, const Motion& m) {
  const double base = base_position(cam);
  if (cam.motion == FollowerMotion::translating)
    return {cam.offset + i * (base + m.value), i * m.rate, i * m.acceleration, i};
  const Number arm = cam.arm * direction(pi - base - m.value);
  return {cam.pivot + arm, -i * arm * m.rate, -i * arm * m.acceleration - arm * m.rate * m.rate, -i * arm};
}

CamState flat_state(const DiscCam& cam, const Motion& m, double angle) {
  const double sense = cam.sense();
  CamState out;
  if (cam.motion == FollowerMotion::translating) {
    out = face_contour({{pi / 2, 0, 0}, {cam.base_radius + m.value, m.rate, m.acceleration}}, sense, angle);
    out.contact = sense * m.rate;
    return out;
  }
  const double psi = base_position(cam) + m.value, s = cam.pivot * std::sin(psi),
               c = cam.pivot * std::cos(psi);
  out = face_contour({{pi / 2 - psi, -m.rate, -m.acceleration},
                      {s + cam.face_offset, c * m.rate, c * m.acceleration - s * m.rate * m.rate}},
                     sense, angle);
  out.contact = c / (1 + sense * m.rate);
  out.lever = out.contact;
  out.pressure_angle = sense * std::atan2(cam.face_offset, out.contact);
  return out;
}

std::optional<CamExtreme> radius_of(const CamExtreme& curvature) {
  if (!(curvature.value > 0)) return std::nullopt;
  return CamExtreme{1 / curvature.value, curvature.angle};
}

void find_pressure(CamContour contour, const ProgrammeCurve& curve, CamExtremes& out) {
  const auto pressure = [&](const Motion& m, double angle) { return contour(m, angle).pressure_angle; };
  out.greatest_pressure = greatest_over(curve, pressure);
  out.least_pressure = least_over(curve, pressure);
  for (const double side : {1.0, -1.0}) {
    CamExtreme& largest = side > 0 ? out.largest_in_rise : out.largest_in_return;
    largest = greatest_over(curve, [&](const Motion& m, double angle) {
      return side * m.rate > 0 ? std::abs(pressure(m, angle)) : -infinity;
    });
    if (!std::isfinite(largest.value)) largest = {};
  }
}

void find_radii(CamContour contour, double roller, const ProgrammeCurve& curve, CamExtremes& out) {
  const auto curvature = [&](const Motion& m, double angle) { return contour(m, angle).pitch_curvature; };
  out.least_convex_pitch = radius_of(greatest_over(curve, curvature));
  const CamExtreme hollow = least_over(curve, curvature);
  out.least_concave_pitch = radius_of({-hollow.value, hollow.angle});
  if (out.least_convex_pitch)
    out.least_convex_profile =
        CamExtreme{out.least_convex_pitch->value - roller, out.least_convex_pitch->angle};
  if (out.least_concave_pitch)
    out.least_concave_profile =
        CamExtreme{out.least_concave_pitch->value + roller, out.least_concave_pitch->angle};
  if (roller > 0)
    out.undercut = negative_ranges(
        curve, [&](const Motion& m, double angle) { return 1 - roller * curvature(m, angle); });
}

void find_flat(CamContour contour, const ProgrammeCurve& curve, CamExtremes& out) {
  const auto radius = [&](const Motion& m, double angle) { return contour(m, angle).profile_radius; };
  const auto contact = [&](const Motion& m, double angle) { return contour(m, angle).contact; };
  out.least_convex_profile = least_over(curve, radius);
  out.least_contact = least_over(curve, contact);
  out.greatest_contact = greatest_over(curve, contact);
  out.undercut = negative_ranges(curve, radius);
}

// Distance of places of the pitch curve from the whole profile, which ought to be the radius of the roller.
class GougeSearch {
 public:
  GougeSearch(CamContour contour, double roller, double size, const ProgrammeCurve& curve,
              const std::vector<CamRange>& undercut)
      : contour_(contour), roller_(roller), size_(size), curve_(curve), undercut_(undercut) {
    const double last = curve.breaks().back();
    for (int k = 0; k <= count; ++k) angles_.push_back(last * k / count);
    for (const double angle : angles_) states_.push_back(state(angle));
    for (std::size_t k = 1; k < states_.size(); ++k)
      step_ = std::max(step_, norm(states_[k].profile - states_[k - 1].profile));
  }

  std::optional<CamGouge> deepest() const {
    std::optional<CamGouge> worst;
    const double limit = roller_ + step_;
    for (std::size_t a = 0; a < states_.size(); ++a) {
      if (is_undercut(angles_[a])) continue;
      for (std::size_t b = 1; b + 1 < states_.size(); ++b) {
        const double here = distance(a, b);
        if (here > limit || here > distance(a, b - 1) || here > distance(a, b + 1)) continue;
        const math::Minimum least = math::minimum_about(
            [&](double angle) { return norm(states_[a].pitch - state(angle).profile); }, angles_[b - 1],
            angles_[b], angles_[b + 1], {.absolute = 1e-9, .relative = 0, .sections = 60});
        const double depth = roller_ - least.value;
        if (depth < 1e-9 * size_ || is_undercut(least.at)) continue;
        if (!worst || depth > worst->depth) worst = CamGouge{angles_[a], least.at, depth};
      }
    }
    return worst;
  }

 private:
  static constexpr int count = 720;

  CamState state(double angle) const { return contour_(curve_(angle), angle); }
  double distance(std::size_t a, std::size_t b) const { return norm(states_[a].pitch - states_[b].profile); }
  bool is_undercut(double angle) const {
    const double turn = curve_.breaks().back();
    return std::any_of(undercut_.begin(), undercut_.end(), [&](const CamRange& r) {
      return (angle >= r.from && angle <= r.to) || (angle + turn >= r.from && angle + turn <= r.to);
    });
  }

  CamContour contour_;
  double roller_, size_;
  const ProgrammeCurve& curve_;
  const std::vector<CamRange>& undercut_;
  std::vector<double> angles_;
  std::vector<CamState> states_;
  double step_ = 0;
};

std::optional<CamProblem> problem_of_base(const DiscCam& cam) {
  const double r = cam.prime_radius();
  if (cam.motion == FollowerMotion::translating) {
    if (cam.has_pitch_curve() && !(std::abs(cam.offset) < r)) return CamProblem{CamIssue::offset_too_large};
    return std::nullopt;
  }
  const bool fits = cam.has_pitch_curve() ? r > std::abs(cam.pivot - cam.arm) && r < cam.pivot + cam.arm
                                          : std::abs(cam.base_radius - cam.face_offset) < cam.pivot;
  if (!fits) return CamProblem{CamIssue::no_triangle};
  return std::nullopt;
}

}  // namespace

double base_position(const DiscCam& cam) {
  const double r = cam.prime_radius();
  if (cam.motion == FollowerMotion::translating) {
    if (!cam.has_pitch_curve()) return r;
    return std::sqrt((r - cam.offset) * (r + cam.offset));
  }
  if (!cam.has_pitch_curve()) return std::asin((cam.base_radius - cam.face_offset) / cam.pivot);
  // The half-angle form keeps its digits for small angles.
  const double c = cam.pivot, l = cam.arm;
  return 2 * std::atan2(std::sqrt((r + c - l) * (r - c + l)), std::sqrt((c + l + r) * (c + l - r)));
}

std::optional<CamProblem> problem(const DiscCam& cam, const ProgrammeCurve& curve) {
  if (const auto found = problem_of_base(cam)) return found;
  const double base = base_position(cam);
  if (cam.motion == FollowerMotion::translating) {
    const CamExtreme lowest = least_over(curve, [base](const Motion& m, double) { return base + m.value; });
    if (!(lowest.value > 0)) return CamProblem{CamIssue::passes_centre, lowest.angle};
    return std::nullopt;
  }
  if (cam.has_pitch_curve()) {
    const CamExtreme flattest =
        least_over(curve, [base](const Motion& m, double) { return std::sin(base + m.value); });
    if (!(flattest.value > 0)) return CamProblem{CamIssue::arm_passes_line, flattest.angle};
    return std::nullopt;
  }
  const double sense = cam.sense();
  const CamExtreme turning =
      least_over(curve, [sense](const Motion& m, double) { return 1 + sense * m.rate; });
  if (!(turning.value > 0)) return CamProblem{CamIssue::face_turns_with_cam, turning.angle};
  const CamExtreme lowest = least_over(
      curve, [&](const Motion& m, double) { return cam.pivot * std::sin(base + m.value) + cam.face_offset; });
  if (!(lowest.value > 0)) return CamProblem{CamIssue::passes_centre, lowest.angle};
  const CamExtreme flattest =
      least_over(curve, [base](const Motion& m, double) { return std::cos(base + m.value); });
  if (!(flattest.value > 0)) return CamProblem{CamIssue::arm_passes_line, flattest.angle};
  return std::nullopt;
}

CamState roller_contour(const RollerPath& path, double roller, double sense, double angle) {
  // First and second derivative of the pitch curve, turned into the fixed frame.
  const Number first = path.rate - i * sense * path.place,
               second = path.acceleration - 2.0 * i * sense * path.rate - path.place;
  const double size = std::abs(first);
  const Number normal = i * sense * first / size, turned = direction(-sense * angle);
  CamState out;
  const double lean = std::arg(std::conj(path.lever) * normal);
  out.pressure_angle = sense * lean;
  out.pitch_curvature = -sense * std::imag(std::conj(first) * second) / (size * size * size);
  out.profile_radius = 1 / out.pitch_curvature - roller;
  out.pitch = math::vec(path.place * turned);
  out.profile = math::vec((path.place - roller * normal) * turned);
  out.normal = math::vec(normal * turned);
  out.contact = nan;
  out.lever = std::abs(path.lever) * std::cos(lean);
  return out;
}

// By the support function of the cam: h(chi), the distance of the face from the centre over the direction of
// its normal in the cam.
CamState face_contour(const FacePath& path, double sense, double angle) {
  const auto& [normal_angle, height] = path;
  const double turning = normal_angle.rate - sense, slope = height.rate / turning;
  const Number normal = direction(normal_angle.value), point = height.value * normal + slope * (i * normal);
  const Number turned = direction(-sense * angle);
  CamState out;
  out.profile_radius =
      height.value + (height.acceleration - slope * normal_angle.acceleration) / (turning * turning);
  out.pitch_curvature = nan;
  out.profile = out.pitch = math::vec(point * turned);
  out.normal = math::vec(normal * turned);
  return out;
}

CamState cam_state(const DiscCam& cam, const Motion& motion, double angle) {
  if (!cam.has_pitch_curve()) return flat_state(cam, motion, angle);
  return roller_contour(roller_path(cam, motion), cam.roller(), cam.sense(), angle);
}

CamExtremes contour_extremes(CamContour contour, double roller, bool is_flat, double size,
                             const ProgrammeCurve& curve) {
  CamExtremes out;
  find_pressure(contour, curve, out);
  if (is_flat) {
    find_flat(contour, curve, out);
    return out;
  }
  find_radii(contour, roller, curve, out);
  if (roller > 0) out.gouge = GougeSearch(contour, roller, size, curve, out.undercut).deepest();
  return out;
}

CamExtremes cam_extremes(const DiscCam& cam, const ProgrammeCurve& curve) {
  LINKWRIGHT_REQUIRE(!problem(cam, curve), "there is no such cam");
  return contour_extremes([&cam](const Motion& m, double angle) { return cam_state(cam, m, angle); },
                          cam.roller(), !cam.has_pitch_curve(), cam.prime_radius(), curve);
}

math::Vec2 cutter_centre(const CamState& state, double radius) {
  return state.profile + radius * state.normal;
}

}  // namespace linkwright::planar
