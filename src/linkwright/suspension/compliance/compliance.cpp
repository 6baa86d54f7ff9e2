// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/compliance.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/suspension/compliance/elastic_assembly.h"

namespace linkwright::suspension {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Block = Eigen::Matrix<double, 6, 6>;
using Solution = Eigen::Ref<const VectorXd>;  ///< displacements of the bodies, then multipliers
using Row12 = Eigen::Matrix<double, 12, 1>;   ///< a relative displacement: by the first body, by the second

/// Reciprocal condition below which an answer would be rounding.
constexpr double no_rank_of_stiffness = 1e-14;

Eigen::Vector3d eigen(const Vec3& a) { return {a.x, a.y, a.z}; }
Matrix3d skew(const Vec3& a) { return (Matrix3d() << 0, -a.z, a.y, a.z, 0, -a.x, -a.y, a.x, 0).finished(); }

/// weight . (displacement of `point` as one of the body)
Eigen::Matrix<double, 6, 1> point_row(const ElasticAssembly& of, int body, const Vec3& point,
                                      const Vec3& weight) {
  Eigen::Matrix<double, 6, 1> out;
  out << eigen(weight), eigen(cross(of.arm(body, point), weight));
  return out;
}

Row12 bar_row(const ElasticAssembly& of, const ElasticBar& bar) {
  const Vec3 line = unit(bar.to - bar.from);
  Row12 out = Row12::Zero();
  if (bar.first != ground) out.head<6>() = -point_row(of, bar.first, bar.from, line);
  if (bar.second != ground) out.tail<6>() = point_row(of, bar.second, bar.to, line);
  return out;
}

Row12 joint_row(const ElasticAssembly& of, const ElasticJoint& joint, int component) {
  const Vec3 axis = joint.axes.row[component % 3];
  Row12 out = Row12::Zero();
  if (component < 3) {
    if (joint.first != ground) out.head<6>() = -point_row(of, joint.first, joint.point, axis);
    out.tail<6>() = point_row(of, joint.second, joint.point, axis);
  } else {
    if (joint.first != ground) out.segment<3>(3) = -eigen(axis);
    out.segment<3>(9) = eigen(axis);
  }
  return out;
}

/// Stiffness and rigid rows with one unknown each: [K G^T; G 0], divided by the largest stiffness so that
/// both have the same size. Unknowns: displacements of the bodies, then multipliers.
class Saddle {
 public:
  Saddle(ElasticAssembly& of, Support support) : of_(of) {
    size_ = of.displacements();
    for (ElasticJoint& joint : of.joints)
      for (int i = 0; i < 6; ++i) {
        const double stiffness = joint.stiffness.matrix ? 0
                                                        : (i < 3 ? joint.stiffness.translation[i]
                                                                 : joint.stiffness.rotation[i - 3]);
        joint.multiplier[i] = stiffness == rigid ? size_++ : -1;
      }
    for (ElasticBar& bar : of.couplers) bar.multiplier = bar.stiffness == rigid ? size_++ : -1;
    if (of.spring) of.spring->multiplier = support == Support::spring_held ? size_++ : -1;
    height_ = support == Support::wheel_centre_held || support == Support::contact_held ? size_++ : -1;
    for (HeldTurn& turn : of.held_turns) turn.multiplier = size_++;

    matrix_ = MatrixXd::Zero(size_, size_);
    for (const ElasticJoint& joint : of.joints) add_joint(joint);
    for (const ElasticBar& bar : of.couplers) add_bar(bar);
    if (of.spring && (support == Support::spring || support == Support::spring_held)) add_bar(*of.spring);
    if (height_ >= 0) {
      const Vec3 up{0, 0, 1};
      Row12 row = Row12::Zero();
      row.tail<6>() << eigen(up), eigen(cross(of.height_arm, up));
      hold(height_, ground, 0, row);
    }
    for (const HeldTurn& turn : of.held_turns) {
      Row12 row = Row12::Zero();
      row.segment<3>(9) = eigen(turn.about);
      hold(turn.multiplier, ground, turn.body, row);
    }
    const int n = of.displacements();
    scale_ = std::max(1.0, matrix_.topLeftCorner(n, n).diagonal().cwiseAbs().maxCoeff());
  }

  /// Adds to the stiffness between the displacements of two bodies; the transposed block by itself.
  void add(int a, int b, const Block& block) {
    if (a == ground || b == ground) return;
    matrix_.block<6, 6>(6 * a, 6 * b) += block;
    if (a != b) matrix_.block<6, 6>(6 * b, 6 * a) += block.transpose();
  }

  /// False: singular, with the reason.
  bool factor(std::string& reason) {
    const int n = of_.displacements();
    matrix_.topLeftCorner(n, n) /= scale_;
    lu_.compute(matrix_);
    if (lu_.rcond() > no_rank_of_stiffness) return true;
    reason = weakness();
    return false;
  }

  /// Answers to right-hand sides of loads on the displacements and of given relative displacements on the
  /// multipliers; multipliers come out in N and N m.
  MatrixXd solve(MatrixXd right) const {
    const int n = of_.displacements();
    right.topRows(n) /= scale_;
    MatrixXd out = lu_.solve(right);
    out.bottomRows(size_ - n) *= scale_;
    return out;
  }

  /// Twice the elastic energy of a motion of the bodies; after `factor`.
  double work(const VectorXd& motion) const {
    const int n = of_.displacements();
    return scale_ * motion.head(n).dot(matrix_.topLeftCorner(n, n) * motion.head(n));
  }

  int size() const { return size_; }
  int height() const { return height_; }

 private:
  void hold(int multiplier, int first, int second, const Row12& row) {
    for (const auto& [body, part] : {std::pair{first, 0}, std::pair{second, 6}}) {
      if (body == ground) continue;
      matrix_.block<1, 6>(multiplier, 6 * body) += row.segment<6>(part).transpose();
      matrix_.block<6, 1>(6 * body, multiplier) += row.segment<6>(part);
    }
  }

  void add_pair(int first, int second, const Eigen::Matrix<double, 12, 12>& k) {
    add(first, first, k.topLeftCorner<6, 6>());
    add(second, second, k.bottomRightCorner<6, 6>());
    add(first, second, k.topRightCorner<6, 6>());
  }

  void add_joint(const ElasticJoint& joint) {
    Eigen::Matrix<double, 12, 6> rows;
    for (int i = 0; i < 6; ++i) rows.col(i) = joint_row(of_, joint, i);
    Block k = Block::Zero();
    for (int i = 0; i < 6; ++i) {
      if (joint.stiffness.matrix)
        for (int j = 0; j < 6; ++j) k(i, j) = (*joint.stiffness.matrix)[i][j];
      else if (joint.multiplier[i] >= 0)
        hold(joint.multiplier[i], joint.first, joint.second, rows.col(i));
      else
        k(i, i) = i < 3 ? joint.stiffness.translation[i] : joint.stiffness.rotation[i - 3];
    }
    add_pair(joint.first, joint.second, rows * k * rows.transpose());
  }

  void add_bar(const ElasticBar& bar) {
    const Row12 row = bar_row(of_, bar);
    if (bar.multiplier >= 0)
      hold(bar.multiplier, bar.first, bar.second, row);
    else
      add_pair(bar.first, bar.second, bar.stiffness * row * row.transpose());
  }

  /// Says in words what a vector of the null space means: a body that moves without resistance, or rigid
  /// joints that hold against each other.
  std::string weakness() const {
    const Eigen::FullPivLU<MatrixXd> full(matrix_);
    const MatrixXd kernel = full.kernel();
    const VectorXd free = kernel.col(0).normalized();
    const int n = of_.displacements();
    double most = 1e-6;
    int body = -1;
    for (int i = 0; i < static_cast<int>(of_.origin.size()); ++i)
      if (free.segment<6>(6 * i).norm() > most) {
        body = i;
        most = free.segment<6>(6 * i).norm();
      }
    if (free.head(n).norm() < 1e-6)
      return "rigid joints constrain the carrier more than once, so their forces are not determined: give "
             "some of them a stiffness";
    if (free.head<6>().norm() > 1e-6) body = 0;
    return fmt::format("{} can move without resistance: give its joints a stiffness, or hold it by a support",
                       of_.labels[body]);
  }

  ElasticAssembly& of_;
  int size_ = 0, height_ = -1;
  double scale_ = 1;
  MatrixXd matrix_;
  Eigen::PartialPivLU<MatrixXd> lu_;
};

/// Motion of a joint's point on the ground: by the rack, and by the shifts and turns of the subframe.
struct GroundMotion {
  Vec3 shift, turn;
};
GroundMotion ground_motion(const ElasticJoint& joint, std::size_t input) {
  if (input == rack_input) return {joint.by_rack, {}};
  if (!joint.on_subframe) return {};
  const std::size_t i = (input - subframe_input) % 3;
  const Vec3 axis{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
  return input < subframe_input + 3 ? GroundMotion{axis, {}} : GroundMotion{cross(axis, joint.point), axis};
}
/// Its component in the axes of the joint.
double along(const ElasticJoint& joint, const GroundMotion& motion, int component) {
  return dot(joint.axes.row[component % 3], component < 3 ? motion.shift : motion.turn);
}

/// The inputs whose answers a suspension has.
std::size_t inputs_of(const ElasticAssembly& of) {
  return of.droplink ? elastic_inputs : of.has_subframe ? droplink_input : subframe_input;
}

/// Right-hand sides: unit loads on the carrier, ground that takes body joints along, a force of the droplink.
MatrixXd right_sides(const ElasticAssembly& of, const Saddle& saddle) {
  const std::size_t count = inputs_of(of);
  MatrixXd out = MatrixXd::Zero(saddle.size(), static_cast<Eigen::Index>(count));
  out.topLeftCorner<6, 6>().setIdentity();
  for (const ElasticJoint& joint : of.joints) {
    if (joint.by_rack == Vec3{} && !joint.on_subframe) continue;
    for (std::size_t input = rack_input; input < std::min(count, droplink_input); ++input) {
      const GroundMotion motion = ground_motion(joint, input);
      const auto column = static_cast<Eigen::Index>(input);
      for (int i = 0; i < 6; ++i) {
        if (joint.multiplier[i] >= 0) {
          out(joint.multiplier[i], column) = along(joint, motion, i);
          continue;
        }
        double pull = 0;
        if (joint.stiffness.matrix)
          for (int j = 0; j < 6; ++j) pull += (*joint.stiffness.matrix)[i][j] * along(joint, motion, j);
        else
          pull = (i < 3 ? joint.stiffness.translation[i] : joint.stiffness.rotation[i - 3]) *
                 along(joint, motion, i);
        out.block<6, 1>(6 * joint.second, column) += pull * joint_row(of, joint, i).tail<6>();
      }
    }
  }
  if (of.droplink)
    out.block<6, 1>(6 * of.droplink->body, droplink_input) =
        point_row(of, of.droplink->body, of.droplink->at, of.droplink->along);
  return out;
}

double elongation(const Row12& row, int first, int second, const Solution& x) {
  double out = 0;
  if (first != ground) out += row.head<6>().dot(x.segment<6>(6 * first));
  if (second != ground) out += row.tail<6>().dot(x.segment<6>(6 * second));
  return out;
}

double tension(const ElasticAssembly& of, const ElasticBar& bar, const Solution& x) {
  return bar.multiplier >= 0 ? x(bar.multiplier)
                             : bar.stiffness * elongation(bar_row(of, bar), bar.first, bar.second, x);
}

/// Displacement of the second body against the first one, in the axes of the joint.
double relative(const ElasticAssembly& of, const ElasticJoint& joint, int component, const Solution& x) {
  return elongation(joint_row(of, joint, component), joint.first, joint.second, x);
}

/// The force of a characteristic, more than at the displacement from which the motion counts.
SpringForce beyond_offset(const ElasticJoint& joint, int component, double relative) {
  const ForceCurve& curve = *joint.stiffness.curves[component];
  SpringForce out = force_of(curve, joint.offset[component] + relative);
  out.force -= force_of(curve, joint.offset[component]).force;
  return out;
}

/// Force and moment on the second body; `moved` is the motion of the first one where that is the ground.
std::array<Vec3, 2> joint_force(const ElasticAssembly& of, const ElasticJoint& joint, const Solution& x,
                                const GroundMotion& moved = {}) {
  std::array<double, 6> relative{};
  for (int i = 0; i < 6; ++i) {
    relative[i] = elongation(joint_row(of, joint, i), joint.first, joint.second, x) - along(joint, moved, i);
  }
  std::array<Vec3, 2> out{};
  for (int i = 0; i < 6; ++i) {
    double force = 0;
    if (joint.stiffness.matrix)
      for (int j = 0; j < 6; ++j) force -= (*joint.stiffness.matrix)[i][j] * relative[j];
    else if (joint.multiplier[i] >= 0)
      force = -x(joint.multiplier[i]);
    else if (joint.stiffness.curves[i])
      force = -beyond_offset(joint, i, relative[i]).force;
    else
      force = -(i < 3 ? joint.stiffness.translation[i] : joint.stiffness.rotation[i - 3]) * relative[i];
    out[i / 3] += force * joint.axes.row[i % 3];
  }
  if (joint.first == ground)  // a U joint that holds the link's spin
    for (const HeldTurn& turn : of.held_turns)
      if (turn.link == joint.link && turn.body == joint.second) out[1] += -x(turn.multiplier) * turn.about;
  return out;
}

/// Second derivative of force . (shift of the end of the arm) by the turn of the arm, the force keeping its
/// direction.
Matrix3d turning_arm(const Vec3& force, const Vec3& arm) {
  const Eigen::Vector3d f = eigen(force), r = eigen(arm);
  return 0.5 * (f * r.transpose() + r * f.transpose()) - f.dot(r) * Matrix3d::Identity();
}

Block turn_block(const Matrix3d& m) {
  Block out = Block::Zero();
  out.bottomRightCorner<3, 3>() = m;
  return out;
}

/// Geometric stiffness: second derivatives of the work of the forces that the position holds in balance.
/// Forces of a joint act in its axes, which turn with the carrier (joints there) or are at rest.
void add_geometric(const ElasticAssembly& of, const Solution& x, const PointLoad& load, Saddle& to) {
  to.add(0, 0, -turn_block(turning_arm(load.force, of.arm(0, load.point))));
  for (const ElasticJoint& joint : of.joints) {
    const auto [on_second, turning] = joint_force(of, joint, x);
    const Vec3 force = -on_second;  // derivative of the energy by the relative displacement
    const int a = joint.first, b = joint.second;
    const Vec3 rb = of.arm(b, joint.point);
    to.add(b, b, turn_block(turning_arm(force, rb)));
    if (a == ground) continue;  // its axes are at rest, and a moment has no arm
    const Vec3 ra = of.arm(a, joint.point);
    to.add(a, a, -turn_block(turning_arm(force, ra)));
    // The axes turn with the second body (the carrier): - turn . (force x relative shift).
    const Matrix3d f = skew(force);
    Block own = Block::Zero(), other = Block::Zero();
    own.bottomLeftCorner<3, 3>() = f;
    own.bottomRightCorner<3, 3>() = -f * skew(rb);
    other.bottomLeftCorner<3, 3>() = -f;
    other.bottomRightCorner<3, 3>() = f * skew(ra);
    to.add(b, b, own + own.transpose());
    to.add(b, a, other);
    to.add(a, b, turn_block(-0.5 * skew(turning)));
  }
  // A U joint keeps its axes across each other: standing . exp(turn) turning = 0, to second order.
  for (const HeldTurn& turn : of.held_turns) {
    if (turn.link < 0) continue;
    const Eigen::Vector3d a = eigen(turn.standing), b = eigen(turn.turning);
    to.add(turn.body, turn.body,
           turn_block(0.5 * x(turn.multiplier) * (a * b.transpose() + b * a.transpose())));
  }
  const auto add_bar = [&](const ElasticBar& bar) {
    const double pull = tension(of, bar, x), length = norm(bar.to - bar.from);
    const Vec3 line = unit(bar.to - bar.from);
    const auto motion = [&](int body, const Vec3& point) {
      Eigen::Matrix<double, 3, 6> out;
      out << Matrix3d::Identity(), -skew(of.arm(body, point));
      return out;
    };
    const Matrix3d across = pull / length * (Matrix3d::Identity() - eigen(line) * eigen(line).transpose());
    const auto end = [&](int body, const Vec3& point, double sign) {
      if (body == ground) return;
      const auto m = motion(body, point);
      to.add(body, body, m.transpose() * across * m);
      to.add(body, body, turn_block(sign * turning_arm(pull * line, of.arm(body, point))));
    };
    end(bar.first, bar.from, -1);
    end(bar.second, bar.to, 1);
    if (bar.first != ground && bar.second != ground)
      to.add(bar.first, bar.second,
             -motion(bar.first, bar.from).transpose() * across * motion(bar.second, bar.to));
  };
  for (const ElasticBar& bar : of.couplers) add_bar(bar);
  if (of.spring) add_bar(*of.spring);
}

Matrix6 plain(const Block& from) {
  Matrix6 out{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out[i][j] = from(i, j);
  return out;
}

/// Component of a joint that has a characteristic.
struct CurvedComponent {
  ElasticJoint* joint = nullptr;
  int component = 0;

  double& stiffness() const { return joint->stiffness.component(component); }
};

std::vector<CurvedComponent> curved_components(ElasticAssembly& of) {
  std::vector<CurvedComponent> out;
  for (ElasticJoint& joint : of.joints)
    for (int i = 0; i < 6; ++i)
      if (joint.stiffness.curves[i]) out.push_back({&joint, i});
  return out;
}

/// Takes the slopes of the characteristics at a solution for stiffnesses, from which further motion counts.
void count_from(ElasticAssembly& of, const Solution& x) {
  for (const CurvedComponent& c : curved_components(of)) {
    const double moved = relative(of, *c.joint, c.component, x);
    c.stiffness() = beyond_offset(*c.joint, c.component, moved).stiffness;
    c.joint->offset[c.component] += moved;
  }
}

/// From here on the joints are linear.
void forget_curves(ElasticAssembly& of) {
  for (const CurvedComponent& c : curved_components(of)) c.joint->stiffness.curves[c.component].reset();
}

constexpr int most_iterations = 60;
/// A share of the displacements on the characteristics; rounding stays below it.
constexpr double settled = 1e-9;

/// The motion by a load on the carrier: Newton's method with steps that never pass the least of the energy,
/// which is convex, for characteristics ascend. Without characteristics it is one linear solution.
///
/// @param saddle makes the equations with the stiffnesses that the joints have now
/// @returns displacements and multipliers; nothing when singular, with the reason, or not converged
template <class MakeSaddle>
std::optional<VectorXd> motion_by(ElasticAssembly& of, const WheelLoad& load, MakeSaddle&& saddle,
                                  std::string& reason) {
  const std::vector<CurvedComponent> curved = curved_components(of);
  VectorXd x;
  std::vector<double> at(curved.size(), 0), to(curved.size(), 0);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Saddle equations = saddle();
    if (!equations.factor(reason)) return {};
    MatrixXd right = MatrixXd::Zero(equations.size(), 1);
    right.topRows(3) = eigen(load.force);
    right.block<3, 1>(3, 0) = eigen(load.moment);
    for (std::size_t i = 0; i < curved.size(); ++i) {
      const CurvedComponent& c = curved[i];
      const double excess = c.stiffness() * at[i] - beyond_offset(*c.joint, c.component, at[i]).force;
      const Row12 row = joint_row(of, *c.joint, c.component);
      if (c.joint->first != ground) right.block<6, 1>(6 * c.joint->first, 0) += excess * row.head<6>();
      right.block<6, 1>(6 * c.joint->second, 0) += excess * row.tail<6>();
    }
    const VectorXd next = equations.solve(right);
    if (curved.empty()) return next;
    if (x.size() == 0) x = VectorXd::Zero(next.size());
    for (std::size_t i = 0; i < curved.size(); ++i)
      to[i] = relative(of, *curved[i].joint, curved[i].component, next);
    // The next step is smaller by the square of this one.
    double change = 0, size = 0;
    for (std::size_t i = 0; i < curved.size(); ++i) {
      change = std::max(change, std::abs(to[i] - at[i]));
      size = std::max(size, std::abs(to[i]));
    }
    if (change <= settled * size) return next;
    const VectorXd step = next - x;
    const double slope = -equations.work(step);
    // Slope of the energy along the step, at a share of it.
    const auto slope_at = [&](double share) {
      double out = (1 - share) * slope;
      for (std::size_t i = 0; i < curved.size(); ++i) {
        const CurvedComponent& c = curved[i];
        const double along = to[i] - at[i];
        out += along * (beyond_offset(*c.joint, c.component, at[i] + share * along).force -
                        beyond_offset(*c.joint, c.component, at[i]).force - share * c.stiffness() * along);
      }
      return out;
    };
    double share = 1;
    for (double low = 0, high = 1; slope_at(share) > -0.5 * slope && high - low > 1e-6;
         share = (low + high) / 2)
      (slope_at(share) > 0 ? high : low) = share;
    x += share * step;
    for (std::size_t i = 0; i < curved.size(); ++i) {
      at[i] += share * (to[i] - at[i]);
      curved[i].stiffness() = beyond_offset(*curved[i].joint, curved[i].component, at[i]).stiffness;
    }
  }
  reason = fmt::format("the characteristics of the joints do not settle in {} steps", most_iterations);
  return {};
}

/// A suspension at a position, loaded by its preload.
struct AtRest {
  Compliance compliance;     ///< of the place; without an answer, or with the reason why there is none
  ElasticAssembly assembly;  ///< with stiffnesses at the preload
  std::vector<JointForce> held;
  ElasticAssembly preloaded;  ///< its multipliers are numbered with the spring held
  VectorXd loaded;            ///< by the preload

  Saddle saddle(const std::optional<PointLoad>& preload) {
    Saddle out(assembly, compliance.support);
    if (preload) add_geometric(preloaded, loaded, *preload, out);
    return out;
  }
};

/// Empty, or why there is no answer to ask for.
std::string problem_of(const Suspension& suspension, const CornerElasticity& elasticity, Support support,
                       bool preload) {
  for (const Diagnostics& problems : {check(suspension), check(suspension, elasticity)})
    if (!problems.empty())
      return fmt::format("{} problems, the first: {}", problems.size(), to_string(problems.front()));
  const bool by_spring = support == Support::spring || support == Support::spring_held;
  if (!suspension.spring && by_spring)
    return fmt::format("the support is '{}', and the suspension has no spring", name_of(support));
  if (!suspension.spring && preload) return "the preload needs a spring that carries it";
  if (suspension.spring && !acts_directly(*suspension.spring) && (by_spring || preload))
    return "the spring acts through a rocker, which the elastic joints do not hold";
  return {};
}

AtRest at_rest(const Suspension& suspension, const CornerPlace& place, double rack,
               const CornerElasticity& elasticity, Support support, const std::optional<PointLoad>& preload) {
  AtRest out{.compliance = {.support = support, .side = suspension.side, .centre = place.carrier.centre},
             .assembly = assemble(suspension, place, rack, elasticity)};
  Compliance& at = out.compliance;
  at.angles = wheel_angles(suspension.side, suspension.wheel, place.carrier.rotation);
  const Vec3 to_contact = contact_offset(suspension.side, suspension.wheel.tyre_diameter, at.angles);
  at.contact = at.centre + to_contact;
  if (support == Support::contact_held) out.assembly.height_arm = to_contact;
  if (!preload) return out;
  const auto found = motion_by(
      out.assembly, load_at(at.centre, preload->point, preload->force),
      [&] { return Saddle(out.assembly, Support::spring_held); }, at.reason);
  if (!found) {
    at.status = Status::singular;
    return out;
  }
  out.loaded = *found;
  for (const ElasticJoint& joint : out.assembly.joints) {
    const auto [force, moment] = joint_force(out.assembly, joint, out.loaded);
    out.held.push_back({joint.link, joint.at_carrier, joint.point, force, moment});
  }
  out.preloaded = out.assembly;
  count_from(out.assembly, out.loaded);
  return out;
}

/// The answer to small loads with the stiffnesses that the joints have now.
Compliance linear_answer(AtRest& rest, const std::optional<PointLoad>& preload) {
  Compliance out = rest.compliance;
  ElasticAssembly& assembly = rest.assembly;
  forget_curves(assembly);
  Saddle saddle = rest.saddle(preload);
  if (!saddle.factor(out.reason)) {
    out.status = Status::singular;
    return out;
  }
  const MatrixXd right = right_sides(assembly, saddle), x = saddle.solve(right);
  const std::size_t count = inputs_of(assembly);

  Block centre = x.topLeftCorner<6, 6>();
  centre = 0.5 * (centre + centre.transpose()).eval();
  Block shifted = Block::Identity();
  shifted.topRightCorner<3, 3>() = -skew(out.contact - out.centre);
  out.at_centre = plain(centre);
  out.at_contact = plain(shifted * centre * shifted.transpose());
  for (int i = 0; i < 6; ++i) out.by_rack[i] = x(i, 6);

  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const ElasticJoint& joint = assembly.joints[i];
    JointTransfer& transfer = out.joints.emplace_back();
    transfer.joint = preload ? rest.held[i] : JointForce{joint.link, joint.at_carrier, joint.point, {}, {}};
    for (std::size_t input = 0; input < count; ++input) {
      const bool of_ground = input >= rack_input && input < droplink_input;
      const auto [force, moment] = joint_force(assembly, joint, x.col(static_cast<Eigen::Index>(input)),
                                               of_ground ? ground_motion(joint, input) : GroundMotion{});
      const std::array<double, 6> all{force.x, force.y, force.z, moment.x, moment.y, moment.z};
      for (std::size_t k = 0; k < 6; ++k) transfer.by[k][input] = all[k];
      // Rack and subframe push with what the links give to them.
      for (std::size_t other = rack_input; of_ground && other < std::min(count, droplink_input); ++other) {
        const GroundMotion by = ground_motion(joint, other);
        out.ground_stiffness[other - rack_input][input - rack_input] +=
            dot(force, by.shift) + dot(moment, by.turn);
      }
    }
  }
  out.rack_stiffness = out.ground_stiffness[0][0];
  if (count > subframe_input)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) out.by_subframe[i][j] = x(i, subframe_input + j);
  if (const auto& end = assembly.droplink) {
    const auto row = point_row(assembly, end->body, end->at, end->along);
    const auto moved = [&](std::size_t input) {
      return row.dot(x.col(static_cast<Eigen::Index>(input)).segment<6>(6 * end->body));
    };
    for (int i = 0; i < 6; ++i) out.by_droplink[i] = x(i, droplink_input);
    for (std::size_t i = 0; i < 7; ++i) out.droplink_by_ground[i] = moved(rack_input + i);
    out.droplink_compliance = moved(droplink_input);
  }
  constexpr double none = nan;
  const bool by_spring = out.support == Support::spring || out.support == Support::spring_held;
  out.couplers.resize(assembly.couplers.size());
  if (!by_spring) out.spring.fill(none);
  if (saddle.height() < 0) out.height.fill(none);
  for (std::size_t input = 0; input < count; ++input) {
    const auto column = x.col(static_cast<Eigen::Index>(input));
    for (std::size_t i = 0; i < assembly.couplers.size(); ++i)
      out.couplers[i][input] = tension(assembly, assembly.couplers[i], column);
    if (by_spring) out.spring[input] = -tension(assembly, *assembly.spring, column);
    if (saddle.height() >= 0) out.height[input] = -column(saddle.height());
  }
  return out;
}

/// Motion of the carrier in the terms of a wheel.
ElasticResponse response_of(const Compliance& at, const Vec3& shift, const Vec3& turn) {
  ElasticResponse out{.shift = shift, .turn = turn};
  out.contact_shift = out.shift + cross(out.turn, at.contact - at.centre);
  const WheelAngles change = angle_rates(at.side, at.angles, out.turn);
  out.toe = change.toe;
  out.camber = change.camber;
  return out;
}

}  // namespace

Compliance solve_compliance(const Suspension& suspension, const CornerPlace& place, double rack,
                            const CornerElasticity& elasticity, Support support,
                            const std::optional<PointLoad>& preload) {
  const std::string problem = problem_of(suspension, elasticity, support, preload.has_value());
  LINKWRIGHT_REQUIRE(problem.empty(), "{}", problem);
  AtRest rest = at_rest(suspension, place, rack, elasticity, support, preload);
  return rest.compliance.status == Status::done ? linear_answer(rest, preload) : rest.compliance;
}

LoadedCompliance solve_loaded(const Suspension& suspension, const CornerPlace& place, double rack,
                              const CornerElasticity& elasticity, Support support, const WheelLoad& load,
                              const std::optional<PointLoad>& preload) {
  const std::string problem = problem_of(suspension, elasticity, support, preload.has_value());
  LINKWRIGHT_REQUIRE(problem.empty(), "{}", problem);
  AtRest rest = at_rest(suspension, place, rack, elasticity, support, preload);
  LoadedCompliance out{.response = {}, .compliance = rest.compliance};
  if (out.compliance.status != Status::done) return out;
  const auto x = motion_by(
      rest.assembly, load, [&] { return rest.saddle(preload); }, out.compliance.reason);
  if (!x) {
    out.compliance.status = Status::singular;
    return out;
  }
  ElasticAssembly& assembly = rest.assembly;
  out.response = response_of(rest.compliance, {(*x)(0), (*x)(1), (*x)(2)}, {(*x)(3), (*x)(4), (*x)(5)});
  for (const ElasticJoint& joint : assembly.joints) {
    const auto [force, moment] = joint_force(assembly, joint, *x);
    out.response.joints.push_back({joint.link, joint.at_carrier, joint.point, force, moment});
  }
  for (const ElasticBar& bar : assembly.couplers) out.response.couplers.push_back(tension(assembly, bar, *x));
  const bool by_spring = support == Support::spring || support == Support::spring_held;
  out.response.spring_force = by_spring ? -tension(assembly, *assembly.spring, *x) : nan;
  const int height = rest.saddle(preload).height();
  out.response.height_force = height >= 0 ? -(*x)(height) : nan;
  count_from(assembly, *x);
  out.compliance = linear_answer(rest, preload);
  return out;
}

ElasticResponse respond(const Compliance& compliance, const WheelLoad& load, double rack) {
  return respond(compliance, ElasticRow{load.force.x, load.force.y, load.force.z, load.moment.x,
                                        load.moment.y, load.moment.z, rack});
}

ElasticResponse respond(const Compliance& compliance, const ElasticRow& inputs) {
  LINKWRIGHT_REQUIRE(compliance.status == Status::done, "the compliance is {}: {}",
                     to_string(compliance.status), compliance.reason);
  const auto sum = [&](const ElasticRow& row) {
    double out = 0;
    for (std::size_t i = 0; i < elastic_inputs; ++i) out += row[i] * inputs[i];
    return out;
  };
  std::array<double, 6> moved{};
  for (std::size_t i = 0; i < 6; ++i) {
    moved[i] =
        compliance.by_rack[i] * inputs[rack_input] + compliance.by_droplink[i] * inputs[droplink_input];
    for (std::size_t j = 0; j < 6; ++j)
      moved[i] +=
          compliance.at_centre[i][j] * inputs[j] + compliance.by_subframe[i][j] * inputs[subframe_input + j];
  }
  ElasticResponse out =
      response_of(compliance, {moved[0], moved[1], moved[2]}, {moved[3], moved[4], moved[5]});
  out.spring_force = sum(compliance.spring);
  out.height_force = sum(compliance.height);
  for (const JointTransfer& transfer : compliance.joints) {
    JointForce joint = transfer.joint;
    joint.force = {sum(transfer.by[0]), sum(transfer.by[1]), sum(transfer.by[2])};
    joint.moment = {sum(transfer.by[3]), sum(transfer.by[4]), sum(transfer.by[5])};
    out.joints.push_back(joint);
  }
  for (const ElasticRow& row : compliance.couplers) out.couplers.push_back(sum(row));
  return out;
}

}  // namespace linkwright::suspension
