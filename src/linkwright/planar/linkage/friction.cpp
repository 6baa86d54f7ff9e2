// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/friction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

double sign_of(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

// The load that the friction of a joint is proportional to, times its coefficient: N m of a pin or gear,
// N of a slide.
double friction_size(const LinkageJoint& j, const JointReaction& r, const math::Vec2& along, double sense) {
  // The second wheel gets the share of what the first one gives, or gives more than the first one gets.
  if (j.type == JointType::gear)
    return std::abs(r.moment) * (r.moment * sense > 0 ? 1 - j.efficiency : 1 / j.efficiency - 1);
  if (j.type == JointType::revolute) return j.friction * j.pin_radius * norm(r.force);
  const double normal = cross(along, r.force);
  if (j.guide_length > 0)
    return j.friction * (std::abs(normal / 2 + r.moment / j.guide_length) +
                         std::abs(normal / 2 - r.moment / j.guide_length));
  return j.friction * std::abs(normal);
}

// Joints with friction that slide, and gears with losses that turn, in which sense.
struct Sliding {
  std::size_t joint;
  double sense;
  math::Vec2 along;  // direction of a slide
};
std::vector<Sliding> sliding_joints(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                                    const std::vector<JointReaction>& joints) {
  const auto part_of = [&](int body) -> const PartState<double>& {
    return motion.parts[at(plan.bodies[at(body)].part)];
  };
  std::vector<Sliding> out;
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& j = l.joints[k];
    if (!loses_power(j) || std::isnan(joints[k].moment)) continue;
    if (j.type == JointType::gear) {
      const Sliding s{k, sign_of(part_of(j.second.body).speed - part_of(j.carrier).speed), {0, 0}};
      if (s.sense != 0) out.push_back(s);
      continue;
    }
    const PartState<double>&first = part_of(j.first.body), &second = part_of(j.second.body);
    Sliding s{k, sign_of(second.speed - first.speed), {0, 0}};
    if (j.type != JointType::revolute) {
      s.along = rotate(body_state(plan, motion, j.first.body).direction, math::unit(j.slide_first));
      s.sense =
          sign_of(dot(s.along, velocity_at(second, joints[k].point) - velocity_at(first, joints[k].point)));
    }
    if (s.sense != 0) out.push_back(s);
  }
  return out;
}
// Friction of given size, as loads on both bodies.
void friction_load(const LinkageJoint& j, const Sliding& s, const math::Vec2& point, double size,
                   std::vector<AppliedLoad>& loads) {
  if (j.type == JointType::revolute || j.type == JointType::gear) {
    const double torque = -size * s.sense;
    loads.push_back({j.second.body, point, {0, 0}, torque});
    loads.push_back({j.type == JointType::gear ? j.carrier : j.first.body, point, {0, 0}, -torque});
  } else {
    const math::Vec2 force = (-size * s.sense) * s.along;
    loads.push_back({j.second.body, point, force, 0});
    loads.push_back({j.first.body, point, -force, 0});
  }
}

double largest_force(const LinkageForces& f) {
  double largest = 0;
  for (const JointReaction& r : f.joints)
    largest = std::max({largest, std::abs(r.force.x), std::abs(r.force.y)});
  return largest;
}

// The sizes z of the frictions: z = t g(z) with t = 1, where g is of the joint forces that z makes.
class Frictions {
 public:
  Frictions(const Linkage& l, std::vector<Sliding> sliding, const std::function<void()>& balance,
            LinkageForces& f)
      : l_(l), sliding_(std::move(sliding)), balance_(balance), f_(f), others_(f.loads.size()), z_(count()) {
    base_ = f.joints;
    measure_ = largest_force(f) > 0 ? largest_force(f) : 1;
    for (std::size_t k = 0; k < count(); ++k) {
      std::vector<double> one(count(), 0.0);
      one[k] = measure_;
      put(one);
      unit_.push_back(f_.joints);
      for (std::size_t j = 0; j < base_.size(); ++j) {
        JointReaction& r = unit_[k][j];
        r.force = (1 / measure_) * (r.force - base_[j].force);
        r.moment = (r.moment - base_[j].moment) / measure_;
      }
    }
  }

  Status settle() {
    if (!by_passes() && !by_growth()) return Status::self_locking;
    put(z_);
    return Status::done;
  }

 private:
  std::size_t count() const { return sliding_.size(); }
  void put(const std::vector<double>& z) {
    f_.loads.resize(others_);
    for (std::size_t k = 0; k < count(); ++k)
      friction_load(l_.joints[sliding_[k].joint], sliding_[k], base_[sliding_[k].joint].point, z[k],
                    f_.loads);
    balance_();
  }
  double size_at(std::size_t k, const std::vector<double>& z) const {
    const std::size_t joint = sliding_[k].joint;
    JointReaction r = base_[joint];
    for (std::size_t i = 0; i < count(); ++i) {
      r.force = r.force + z[i] * unit_[i][joint].force;
      r.moment += z[i] * unit_[i][joint].moment;
    }
    return friction_size(l_.joints[joint], r, sliding_[k].along, sliding_[k].sense);
  }
  double largest(const std::vector<double>& z) const {
    double out = measure_;
    for (const double v : z) out = std::max(out, std::abs(v));
    return out;
  }

  // The friction of the last sizes, again and again: a contraction while friction is moderate.
  bool by_passes() {
    std::vector<double> next(count());
    for (f_.iterations = 1; f_.iterations <= 200; ++f_.iterations) {
      double change = 0;
      for (std::size_t k = 0; k < count(); ++k) {
        next[k] = size_at(k, z_);
        change = std::max(change, std::abs(next[k] - z_[k]));
      }
      z_ = next;
      if (!std::isfinite(change) || change > 1e6 * measure_) return false;
      if (change <= 1e-14 * largest(z_)) return true;
    }
    return false;
  }

  // From t = 0, without friction, z is followed as the coefficients grow together; Newton's method takes each
  // step. Where z goes to infinity before t = 1, or the solutions meet and turn back, friction blocks.
  bool by_growth() {
    std::fill(z_.begin(), z_.end(), 0.0);
    double t = 0, step = 0.25;
    while (t < 1) {
      const double next = std::min(1.0, t + step);
      std::vector<double> trial = z_;
      double determinant = 0;
      const bool good = newton(next, trial, determinant) && determinant > 0 &&
                        std::all_of(trial.begin(), trial.end(), [](double v) { return v >= 0; });
      if (good) {
        z_ = std::move(trial);
        t = next;
        step *= 2;
      } else if ((step *= 0.5) < 1e-9) {
        return false;
      }
    }
    return true;
  }

  // I - t dg/dz at z, by central differences of what is piecewise a norm; and its determinant by elimination.
  bool newton(double t, std::vector<double>& z, double& determinant) const {
    const std::size_t n = count();
    std::vector<double> matrix(n * n), right(n);
    for (int i = 0; i < 50; ++i) {
      const double size = largest(z);
      for (std::size_t k = 0; k < n; ++k) {
        right[k] = t * size_at(k, z) - z[k];
        for (std::size_t m = 0; m < n; ++m) {
          std::vector<double> more = z, less = z;
          const double h = 1e-6 * size;
          more[m] += h, less[m] -= h;
          matrix[k * n + m] = (k == m ? 1 : 0) - t * (size_at(k, more) - size_at(k, less)) / (2 * h);
        }
      }
      double wrong = 0;
      for (const double v : right) wrong = std::max(wrong, std::abs(v));
      determinant = 1;
      for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c + 1; r < n; ++r)
          if (std::abs(matrix[r * n + c]) > std::abs(matrix[best * n + c])) best = r;
        if (best != c) {
          for (std::size_t m = 0; m < n; ++m) std::swap(matrix[c * n + m], matrix[best * n + m]);
          std::swap(right[c], right[best]);
          determinant = -determinant;
        }
        const double pivot = matrix[c * n + c];
        determinant *= pivot;
        if (pivot == 0) return false;
        for (std::size_t r = c + 1; r < n; ++r) {
          const double share = matrix[r * n + c] / pivot;
          for (std::size_t m = c; m < n; ++m) matrix[r * n + m] -= share * matrix[c * n + m];
          right[r] -= share * right[c];
        }
      }
      for (std::size_t c = n; c-- > 0;) {
        for (std::size_t m = c + 1; m < n; ++m) right[c] -= matrix[c * n + m] * right[m];
        right[c] /= matrix[c * n + c];
      }
      if (wrong <= 1e-14 * size || (i > 5 && wrong <= 1e-12 * size)) return true;
      for (std::size_t k = 0; k < n; ++k) z[k] += right[k];
    }
    return false;
  }

  const Linkage& l_;
  std::vector<Sliding> sliding_;
  const std::function<void()>& balance_;
  LinkageForces& f_;
  std::size_t others_;
  double measure_ = 1;
  std::vector<JointReaction> base_;               // without friction
  std::vector<std::vector<JointReaction>> unit_;  // forces added by a unit of each friction
  std::vector<double> z_;
};

}  // namespace

Status settle_friction(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                       const std::function<void()>& balance, LinkageForces& f) {
  std::vector<Sliding> sliding = sliding_joints(l, plan, motion, f.joints);
  if (sliding.empty()) return Status::done;
  return Frictions(l, std::move(sliding), balance, f).settle();
}

}  // namespace linkwright::planar
