// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/friction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/stick_efforts.h"

namespace linkwright::planar {
namespace {

double sign_of(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

// Joints with friction that slide or stick, and gears with losses that turn, in which sense. The friction of
// a joint that sticks may have either sign; its sense is 1.
struct Sliding {
  std::size_t joint;
  double sense;
  math::Vec2 along;     // direction of a slide
  double speed = 0;     // in the sense of the joint; of a pin at its rim
  bool sticks = false;  // then its friction is that at rest
};

double coefficient(const LinkageJoint& j, const Sliding& s) {
  return s.sticks ? friction_at_rest(j) : friction_coefficient(j, s.speed);
}

// Friction of a sliding joint, or what a sticking one can bear: N m of a pin or gear, N of a slide.
double friction_size(const LinkageJoint& j, const JointReaction& r, const Sliding& s) {
  const auto& [joint, sense, along, speed, sticks] = s;
  // The second wheel gets the share of what the first one gives, or gives more than the first one gets.
  if (j.type == JointType::gear)
    return std::abs(r.moment) * (r.moment * sense > 0 ? 1 - j.efficiency : 1 / j.efficiency - 1);
  const double mu = coefficient(j, s);
  if (j.type == JointType::revolute) return mu * j.pin_radius * norm(r.force) + j.friction_effort;
  const double normal = cross(along, r.force);
  if (j.guide_length > 0)
    return mu * (std::abs(normal / 2 + r.moment / j.guide_length) +
                 std::abs(normal / 2 - r.moment / j.guide_length)) +
           j.friction_effort;
  return mu * std::abs(normal) + j.friction_effort;
}

std::vector<Sliding> sliding_joints(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                                    const std::vector<JointReaction>& joints, const FrictionStates* states) {
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
    Sliding s{k, 0, {0, 0}};
    double rate = second.speed - first.speed;
    if (j.type != JointType::revolute) {
      s.along = rotate(body_state(plan, motion, j.first.body).direction, math::unit(j.slide_first));
      rate = dot(s.along, velocity_at(second, joints[k].point) - velocity_at(first, joints[k].point));
    }
    s.sense = sign_of(rate);
    if (states && !std::isnan(states->senses[k])) {
      s.sticks = states->senses[k] == 0;
      s.sense = s.sticks ? 1 : states->senses[k];
    }
    s.speed = s.sense * rate * (j.type == JointType::revolute ? j.pin_radius : 1);
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
  Frictions(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
            std::vector<Sliding> sliding, const std::function<void()>& balance, LinkageForces& f,
            FrictionStates* states)
      : l_(l),
        plan_(plan),
        motion_(motion),
        sliding_(std::move(sliding)),
        balance_(balance),
        f_(f),
        states_(states),
        others_(f.loads.size()),
        z_(count()) {
    base_ = f.joints;
    measure_ = largest_force(f) > 0 ? largest_force(f) : 1;
    const bool sticks = any_sticks();
    if (sticks) base_rates_ = accelerations();
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
      if (!sticks) continue;
      unit_rates_.push_back(accelerations());
      for (std::size_t m = 0; m < count(); ++m)
        unit_rates_[k][m] = (unit_rates_[k][m] - base_rates_[m]) / measure_;
    }
    if (sticks) drop_fixed();
  }

  Status settle() {
    if (states_ && states_->decide && any_sticks())
      for (std::size_t pass = 0; pass <= count() && decide() && any_sticks(); ++pass) continue;
    if (!by_passes() && !by_growth()) return Status::self_locking;
    put(z_);
    if (states_) record();
    return Status::done;
  }

 private:
  std::size_t count() const { return sliding_.size(); }
  bool any_sticks() const {
    return std::any_of(sliding_.begin(), sliding_.end(), [](const Sliding& s) { return s.sticks; });
  }
  bool only_sticks() const {
    return std::all_of(sliding_.begin(), sliding_.end(), [](const Sliding& s) { return s.sticks; });
  }
  bool turns(std::size_t k) const { return l_.joints[sliding_[k].joint].type == JointType::revolute; }

  // Accelerations of the joints along their coordinates, as balance() left them.
  std::vector<double> accelerations() const {
    std::vector<double> out;
    for (const Sliding& s : sliding_)
      out.push_back(joint_motion(l_, plan_, motion_, static_cast<int>(s.joint)).acceleration);
    return out;
  }
  double acceleration_at(std::size_t k, const std::vector<double>& z) const {
    double sum = base_rates_[k];
    for (std::size_t i = 0; i < count(); ++i) sum += z[i] * unit_rates_[i][k];
    return sum;
  }
  // What a unit of a joint's friction takes from its own acceleration; 0 where nothing can change that.
  double mobility(std::size_t k) const { return fixed_[k] ? 0 : -unit_rates_[k][k] * sliding_[k].sense; }

  // Joints that no free input moves: their mobility is that of rounding.
  void drop_fixed() {
    fixed_.assign(count(), false);
    std::vector<double> alike;
    for (std::size_t k = 0; k < count(); ++k)
      alike.push_back(mobility(k) * (turns(k) ? 1 : 1 / (plan_.size * plan_.size)));
    const double most = *std::max_element(alike.begin(), alike.end());
    for (std::size_t k = 0; k < count(); ++k) fixed_[k] = !(alike[k] > 1e-13 * most);
  }

  // The joints that stick, and how their accelerations depend on their efforts.
  std::vector<std::size_t> stuck() const {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < count(); ++k)
      if (sliding_[k].sticks) out.push_back(k);
    return out;
  }
  std::vector<double> stick_matrix(const std::vector<std::size_t>& joints) const {
    std::vector<double> out;
    for (const std::size_t k : joints)
      for (const std::size_t i : joints) out.push_back(fixed_[k] || fixed_[i] ? 0.0 : -unit_rates_[i][k]);
    return out;
  }

  // The accelerations of Gauss' principle, with friction of joints at rest within what they bear: efforts are
  // improved one at a time, which always converges while what they bear does not depend on them much. Joints
  // that are accelerated begin to slide. Returns true if there are any.
  bool decide() {
    std::fill(z_.begin(), z_.end(), 0.0);
    const auto bears = [&](std::size_t k) {
      const std::size_t joint = sliding_[k].joint;
      return size_at(k, z_) * (states_->reserve.empty() ? 1 : states_->reserve[joint]);
    };
    for (int pass = 0; pass < 20000; ++pass) {
      double change = 0;
      for (std::size_t k = 0; k < count(); ++k) {
        double next = 0;
        if (!sliding_[k].sticks)
          next = size_at(k, z_);
        else if (const double bound = bears(k); !fixed_[k])
          next = std::clamp(z_[k] + acceleration_at(k, z_) / mobility(k), -bound, bound);
        change = std::max(change, std::abs(next - z_[k]));
        z_[k] = next;
      }
      if (!std::isfinite(change) || change > 1e6 * measure_) break;
      if (change <= 1e-15 * largest(z_)) break;
    }
    bool slides = false;
    double fastest = 0;
    for (std::size_t k = 0; k < count(); ++k)
      fastest = std::max(fastest, std::abs(acceleration_at(k, z_)) * (turns(k) ? plan_.size : 1));
    std::vector<double> senses(count(), 0.0);
    for (std::size_t k = 0; k < count(); ++k) {
      if (!sliding_[k].sticks) continue;
      const double a = acceleration_at(k, z_);
      double terms = std::abs(base_rates_[k]);
      for (std::size_t i = 0; i < count(); ++i) terms += std::abs(z_[i] * unit_rates_[i][k]);
      const double zero = fixed_[k] ? 1e-7 * fastest / (turns(k) ? plan_.size : 1)
                                    : 1e-10 * mobility(k) * bears(k) + 1e-13 * terms;
      if (std::abs(a) > zero) senses[k] = sign_of(a);
    }
    for (std::size_t k = 0; k < count(); ++k) {
      if (senses[k] == 0) continue;
      slides = true;
      Sliding& s = sliding_[k];
      s.sticks = false;
      s.speed = 0;
      states_->senses[s.joint] = senses[k];
      if (senses[k] == s.sense) continue;
      s.sense = senses[k];
      for (JointReaction& r : unit_[k]) r.force = -r.force, r.moment = -r.moment;
      for (double& a : unit_rates_[k]) a = -a;
    }
    std::fill(z_.begin(), z_.end(), 0.0);
    return slides;
  }

  // What is known of the joints with these frictions.
  void record() {
    std::fill(states_->shares.begin(), states_->shares.end(), nan);
    std::fill(states_->normals.begin(), states_->normals.end(), nan);
    for (std::size_t k = 0; k < count(); ++k) {
      const Sliding& s = sliding_[k];
      const LinkageJoint& j = l_.joints[s.joint];
      if (j.type == JointType::prismatic || j.type == JointType::pin_in_slot)
        states_->normals[s.joint] = cross(s.along, f_.joints[s.joint].force);
      if (!s.sticks) continue;
      const double bound = size_at(k, z_), effort = std::abs(z_[k]);
      constexpr double most = 1e6;
      const bool none = effort <= 1e-13 * measure_;
      states_->shares[s.joint] = none ? 0 : bound > 0 ? std::min(effort / bound, most) : most;
    }
    const std::vector<std::size_t> joints = stuck();
    states_->held = joints.empty() ? 0 : stuck_motions(stick_matrix(joints), joints.size());
  }

  // The efforts of the joints that stick, for the sizes of the others in z.
  void stick(std::vector<double>& z) const {
    const std::vector<std::size_t> joints = stuck();
    std::vector<double> wanted, bears;
    for (const std::size_t k : joints) bears.push_back(size_at(k, z));
    for (const std::size_t k : joints) z[k] = 0;
    for (const std::size_t k : joints) wanted.push_back(acceleration_at(k, z));
    const std::vector<double> efforts = stick_efforts(stick_matrix(joints), wanted, bears);
    for (std::size_t i = 0; i < joints.size(); ++i) z[joints[i]] = efforts[i];
  }
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
    return friction_size(l_.joints[joint], r, sliding_[k]);
  }
  double largest(const std::vector<double>& z) const {
    double out = measure_;
    for (const double v : z) out = std::max(out, std::abs(v));
    return out;
  }

  // The friction of the last sizes, again and again: a contraction while friction is moderate.
  bool by_passes() {
    std::vector<double> next(count());
    const bool sticks = any_sticks();
    for (f_.iterations = 1; f_.iterations <= 200; ++f_.iterations) {
      double change = 0;
      for (std::size_t k = 0; k < count(); ++k) next[k] = sliding_[k].sticks ? z_[k] : size_at(k, z_);
      if (sticks) stick(next);
      for (std::size_t k = 0; k < count(); ++k) change = std::max(change, std::abs(next[k] - z_[k]));
      z_ = next;
      if (!std::isfinite(change) || change > 1e6 * measure_) return false;
      if (change <= 1e-14 * largest(z_)) return true;
    }
    return sticks && only_sticks();  // they hold, however the force is shared
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
      bool good = newton(next, trial, determinant) && determinant > 0;
      for (std::size_t k = 0; k < count(); ++k) good = good && (sliding_[k].sticks || trial[k] >= 0);
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
        const bool sticks = sliding_[k].sticks && !fixed_[k];
        right[k] = sticks ? acceleration_at(k, z) / mobility(k) : t * size_at(k, z) - z[k];
        for (std::size_t m = 0; m < n; ++m) {
          if (sticks) {
            matrix[k * n + m] = -unit_rates_[m][k] / mobility(k);
            continue;
          }
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
  const LinkagePlan& plan_;
  const LinkageMotion& motion_;
  std::vector<Sliding> sliding_;
  const std::function<void()>& balance_;
  LinkageForces& f_;
  FrictionStates* states_;
  std::size_t others_;
  double measure_ = 1;
  std::vector<JointReaction> base_;               // without friction
  std::vector<std::vector<JointReaction>> unit_;  // forces added by a unit of each friction
  std::vector<double> base_rates_;  // accelerations of the joints without friction, if any sticks
  std::vector<std::vector<double>> unit_rates_;  // accelerations added by a unit of each friction
  std::vector<bool> fixed_;                      // joints that no free input moves
  std::vector<double> z_;
};

}  // namespace

FrictionStates::FrictionStates(std::size_t joints)
    : senses(joints, nan), reserve(joints, 1.0), shares(joints, nan), normals(joints, nan) {}

double friction_at_rest(const LinkageJoint& joint) {
  const double least = joint.friction_values.empty() ? joint.friction : joint.friction_values.front();
  return std::max(least, joint.friction_static);
}

double friction_coefficient(const LinkageJoint& joint, double speed) {
  if (!joint.friction_values.empty()) {
    const std::vector<double>&v = joint.friction_speeds, &mu = joint.friction_values;
    const auto above = std::upper_bound(v.begin() + 1, v.end(), speed);
    if (above == v.end()) return mu.back();
    const auto i = static_cast<std::size_t>(above - v.begin());
    // Just beyond a change of sense the first line goes on, see below.
    const double share = (std::max(speed, -0.5 * v[1]) - v[i - 1]) / (v[i] - v[i - 1]);
    return std::max(0.0, mu[i - 1] + share * (mu[i] - mu[i - 1]));
  }
  if (joint.friction_speed == 0) return joint.friction;
  // Just beyond a change of sense the curve goes on smoothly, so that steps end at it as accurately as
  // elsewhere.
  const double ratio = std::max(speed / joint.friction_speed, -0.5),
               left =
                   joint.friction_fall == FrictionFall::stribeck ? std::exp(-ratio * ratio) : 1 / (1 + ratio);
  return joint.friction + (joint.friction_static - joint.friction) * left;
}

Status settle_friction(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                       const std::function<void()>& balance, LinkageForces& f, FrictionStates* states) {
  std::vector<Sliding> sliding = sliding_joints(l, plan, motion, f.joints, states);
  if (sliding.empty()) return Status::done;
  return Frictions(l, plan, motion, std::move(sliding), balance, f, states).settle();
}

}  // namespace linkwright::planar
