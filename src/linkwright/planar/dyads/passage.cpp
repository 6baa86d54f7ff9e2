// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/passage.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Sines of the pair angle below which a pose counts as a dead point.
constexpr double dead_point = 1e-9;
// Poses are on their dyads but for rounding: ends of the drive are met that well.
constexpr double slack = 1e-9;

// The other dyad holds the driven pin A at all places where u(A) is between two ends; its branches meet
// there: RR: u = |A - G|^2, PR: u = distance from the line, RP: u = |A - G|^2. `side` is the sine of the pair
// angle, signed by the branch.
struct Hold {
  double lower = -infinity, upper = infinity;
};

class Other {
 public:
  Other(const GuidingDyad& dyad, Complex pin) : dyad_(dyad), pin_(pin), link_(std::abs(dyad.moving - pin)) {
    if (dyad.type == GuidingDyadType::rp)
      arm_ = std::abs(dyad.offset - std::real(std::conj(dyad.normal) * pin));
  }

  Hold hold() const {
    switch (dyad_.type) {
      case GuidingDyadType::rr: {
        const double least = link_ - dyad_.length, most = link_ + dyad_.length;
        return {least * least, most * most};
      }
      case GuidingDyadType::pr:
        return {-link_, link_};
      case GuidingDyadType::rp:
        break;
    }
    return {arm_ * arm_, infinity};
  }

  double u(Complex a) const {
    return dyad_.type == GuidingDyadType::pr ? std::real(std::conj(dyad_.normal) * a) - dyad_.offset
                                             : std::norm(a - dyad_.fixed);
  }

  // Sine of the pair angle at a pose, signed.
  double side(const BodyPose& pose) const {
    const Complex a = place(pose, pin_);
    switch (dyad_.type) {
      case GuidingDyadType::rr:
        return std::imag(std::conj(dyad_.fixed - a) * (place(pose, dyad_.moving) - a)) /
               (link_ * dyad_.length);
      case GuidingDyadType::pr:
        return std::imag(std::conj(dyad_.normal) * (place(pose, dyad_.moving) - a)) / link_;
      case GuidingDyadType::rp:
        break;
    }
    const Complex to = dyad_.fixed - a;
    return std::imag(std::conj(dyad_.normal * std::polar(1.0, pose.angle)) * to) / std::abs(to);
  }

  // Its size where the pin is at u.
  double sine(double u) const {
    double cosine = 0;
    switch (dyad_.type) {
      case GuidingDyadType::rr:
        cosine = (link_ * link_ + dyad_.length * dyad_.length - u) / (2 * link_ * dyad_.length);
        break;
      case GuidingDyadType::pr:
        cosine = u / link_;
        break;
      case GuidingDyadType::rp:
        cosine = u > 0 ? arm_ / std::sqrt(u) : 1;
        break;
    }
    return std::sqrt(std::max(0.0, 1 - cosine * cosine));
  }

  const GuidingDyad& dyad() const { return dyad_; }

 private:
  const GuidingDyad& dyad_;
  Complex pin_;
  double link_, arm_ = 0;
};

struct DriveInterval {
  double from, to;
};

// The intervals in which a drive can be, and the places where the pair angle may have an extreme between two
// of them.
struct Track {
  std::vector<DriveInterval> intervals;
  std::vector<double> turning;  // extremes of u; for a rotation, up to whole turns
  bool whole = false;           // a rotation without ends
  double rounding = slack;      // rounding error of a place
};

// A at O + R e^(i x): u = middle + swing cos(x - reference).
Track circle_track(const GuidingDyad& driver, const Other& other) {
  const GuidingDyad& d = other.dyad();
  const double radius = driver.length;
  double middle, swing, reference;
  if (d.type == GuidingDyadType::pr) {
    middle = other.u(driver.fixed);
    swing = radius;
    reference = std::arg(d.normal);
  } else {
    const Complex from = driver.fixed - d.fixed;
    middle = std::norm(from) + radius * radius;
    swing = 2 * radius * std::abs(from);
    reference = std::arg(from);
  }
  const Hold hold = other.hold();
  const double low = (hold.lower - middle) / swing, high = (hold.upper - middle) / swing;
  Track out;
  out.turning = {reference, reference + pi};
  if (!(swing > 0) || (low <= -1 && high >= 1)) {
    out.whole = true;
    return out;
  }
  const double inner = high >= 1 ? 0 : std::acos(std::max(-1.0, high));
  const double outer = low <= -1 ? pi : std::acos(std::min(1.0, low));
  if (inner == 0)
    out.intervals = {{reference - outer, reference + outer}};
  else if (outer == pi)
    out.intervals = {{reference + inner, reference + 2 * pi - inner}};
  else
    out.intervals = {{reference + inner, reference + outer}, {reference - outer, reference - inner}};
  // Near the end of an interval the angle is known to the root of what its cosine is.
  out.rounding = 3e-5;
  return out;
}

// A at Q + i n x, Q the foot of the origin on the line.
Track line_track(const GuidingDyad& driver, const Other& other) {
  const GuidingDyad& d = other.dyad();
  const Complex foot = driver.offset * driver.normal, along = Complex(0, 1) * driver.normal;
  const Hold hold = other.hold();
  Track out;
  if (d.type == GuidingDyadType::pr) {
    const double at_foot = other.u(foot), slope = std::real(std::conj(d.normal) * along);
    if (std::abs(slope) < 1e-15) {
      out.intervals = {{-infinity, infinity}};
      return out;
    }
    const double a = (hold.lower - at_foot) / slope, b = (hold.upper - at_foot) / slope;
    out.intervals = {{std::min(a, b), std::max(a, b)}};
    out.rounding = slack * (std::abs(a) + std::abs(b));
    return out;
  }
  const double middle = std::real(std::conj(along) * (d.fixed - foot)),
               least = other.u(foot + middle * along);
  out.turning = {middle};
  const double outer = hold.upper - least, inner = hold.lower - least;
  if (outer < 0) return out;
  const double far = std::sqrt(outer), near = std::sqrt(std::max(0.0, inner));
  if (inner <= 0)
    out.intervals = {{middle - far, middle + far}};
  else
    out.intervals = {{middle + near, middle + far}, {middle - far, middle - near}};
  out.rounding = 3e-5 * (std::isfinite(far) ? far : near);
  return out;
}

double wrapped(double angle) { return angle - 2 * pi * std::floor(angle / (2 * pi)); }

// Puts the places of a rotation into the interval that holds the first one. False where one is not in it.
bool bring_into(const Track& track, bool rotation, std::vector<double>& x, int& outside) {
  for (const DriveInterval& interval : track.intervals) {
    const auto brought = [&](double value) {
      if (!rotation) return value;
      const double past = wrapped(value - interval.from + track.rounding) - track.rounding;
      return interval.from + past;
    };
    const auto inside = [&](double value) {
      return value >= interval.from - track.rounding && value <= interval.to + track.rounding;
    };
    if (!inside(brought(x[0]))) continue;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double value = brought(x[j]);
      if (!inside(value)) {
        outside = static_cast<int>(j);
        return false;
      }
      x[j] = value;
    }
    return true;
  }
  outside = 0;
  return false;
}

bool steady(const std::vector<double>& x) {
  const bool rises = x.back() > x.front();
  for (std::size_t j = 1; j < x.size(); ++j)
    if (rises ? !(x[j] > x[j - 1]) : !(x[j] < x[j - 1])) return false;
  return true;
}

// For a drive that rotates fully: unwraps the rotations if they follow each other in one sense, less than a
// turn in all.
bool follow(std::vector<double>& x) {
  for (const double sense : {1.0, -1.0}) {
    std::vector<double> out = x;
    for (std::size_t j = 1; j < x.size(); ++j)
      out[j] = out[j - 1] + sense * wrapped(sense * (x[j] - x[j - 1]));
    if (std::abs(out.back() - out.front()) >= 2 * pi) continue;
    x = std::move(out);
    return true;
  }
  math::unwrap_angles(x);
  return false;
}

}  // namespace

Passage passage(std::span<const BodyPose> poses, const GuidingDyad& driver, const GuidingDyad& other) {
  LINKWRIGHT_REQUIRE(poses.size() >= 2, "{} poses", poses.size());
  if (driver.type == GuidingDyadType::rp) {
    // Seen from the body, the slide is on the ground.
    std::vector<BodyPose> seen;
    for (const BodyPose& pose : poses) seen.push_back(inverse(pose));
    return passage(seen, inverse(driver), inverse(other));
  }
  const bool rotation = driver.type == GuidingDyadType::rr;
  const Other held(other, driver.moving);
  const Track track = rotation ? circle_track(driver, held) : line_track(driver, held);
  Passage out;
  out.drive_turns = rotation && track.whole;
  double least = 1;
  for (std::size_t j = 0; j < poses.size(); ++j) {
    const Complex a = place(poses[j], driver.moving);
    out.drive.push_back(rotation ? std::arg(a - driver.fixed) : std::imag(std::conj(driver.normal) * a));
    const double side = held.side(poses[j]);
    least = std::min(least, std::abs(side));
    if (j == 0) out.side = side < 0 ? -1 : 1;
    if (out.defect == PoseDefect::none && !(side * out.side > dead_point)) {
      out.defect = PoseDefect::branch;
      out.from = j == 0 ? 0 : static_cast<int>(j) - 1;
      out.to = static_cast<int>(j);
    }
  }
  out.pair_angle = std::asin(std::min(1.0, least));
  if (out.defect == PoseDefect::none) {
    if (track.whole) {
      if (!follow(out.drive)) out.defect = PoseDefect::order;
    } else if (int outside = 0; !bring_into(track, rotation, out.drive, outside)) {
      out.defect = PoseDefect::circuit;
      out.from = std::max(0, outside - 1);
      out.to = outside;
    } else if (!steady(out.drive)) {
      out.defect = PoseDefect::order;
    }
  }
  if (out.defect != PoseDefect::none) return out;
  // Between the poses the pair angle is least at an end or where u turns.
  const double from = std::min(out.drive.front(), out.drive.back());
  const double to = std::max(out.drive.front(), out.drive.back());
  const auto at = [&](double x) {
    return rotation ? driver.fixed + std::polar(driver.length, x)
                    : (driver.offset + Complex(0, x)) * driver.normal;
  };
  for (const double turning : track.turning) {
    const double x = rotation ? from + wrapped(turning - from) : turning;
    if (x >= from && x <= to) least = std::min(least, held.sine(held.u(at(x))));
  }
  out.pair_angle = std::asin(std::min(1.0, least));
  return out;
}

}  // namespace linkwright::planar
