// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/joint_kernel.h"
#include "linkwright/math/vector2.h"

/// Equations of motion of hub and chain, in time and memory proportional to the number of cells.
namespace linkwright::flexible {

/// Loads at the tip, in axes of the hub, beside those of inertia, gravity and drive; for links on a driven
/// hub.
struct TipLoad {
  math::Vec2 force;   ///< N; keeps its direction in the axes of the hub
  double couple = 0;  ///< N m
};

/// Forces at an instant, and what is left of the equations of motion.
struct ChainForces {
  /// Reaction of the hub on the link at the weld O1, in axes of the hub (N, N m), from Newton's and Euler's
  /// laws of the whole link. source_linearised: the multipliers of the printed equations; the couple is
  /// lambda_3, without the elastic moment that (3.49) adds to it.
  math::Vec2 reaction;
  double moment = 0;
  double torque = 0;  ///< torque of the drive on the hub that this motion needs (N m)
};

struct ChainEnergy {
  double kinetic = 0, potential = 0;  ///< J; elastic, of the hub's spring and of gravity
  double loss = 0;                    ///< power of all dampers, >= 0 (W)
  double angular_momentum = 0;        ///< about O (N m s)
};

/// Force and moment in the link at a cut.
struct SectionForce {
  double position = 0;  ///< along the undeformed link, from O1 (m)
  double axial = 0;     ///< tension (N)
  double shear = 0;     ///< force of the outer part on the inner one, along the normal of the link (N)
  double moment = 0;    ///< bending moment, > 0 bends towards eta (N m)
};

/// Coefficients of dq = -(bp M + gp C + K)^-1 r.
struct TangentScale {
  double acceleration = 0;  ///< bp (1/s2)
  double rate = 0;          ///< gp (1/s)
  /// Frequency (rad/s) of a vibration about the straight link on a turning hub, whose gyroscopic forces join
  /// bending and extension, a quarter of a period apart; 0: leave them out.
  double gyroscopic = 0;
};

/// Evaluates and solves the equations of one chain; holds the memory for it. Residuals are found by sums from
/// the hub outwards (motion) and back (forces); the tangent is eliminated cell by cell from the tip inwards,
/// as articulated bodies are (Featherstone 1983), with coordinates of the joints, whose stiffnesses then
/// are on the diagonal. The chain must outlive it and stay as it is.
class ChainEquations {
 public:
  explicit ChainEquations(const Chain& chain);

  /// Motion, forces and residuals r = M a + h + K q - Q of the chain's coordinates at a state.
  const ChainForces& evaluate(const ChainState& state, const TipLoad& load = {});
  const ChainForces& forces() const { return forces_; }
  std::span<const double> residual() const { return residual_; }
  /// Largest residual, of forces relative to the largest force in the chain, of couples to the largest
  /// couple.
  double relative_residual() const;
  /// The scale against which a couple at the hub (N m) is small.
  double moment_scale() const { return moment_scale_; }
  /// Tip position in the state evaluated last, from O, in axes of the hub; and the angle of the last bar
  /// against the hub.
  math::Vec2 tip() const;
  double tip_angle() const { return node_.back().angle; }

  /// A motor in joint s = 0, 1, ...: its torque on the outer bar (N m), or a turn that is given, whose row
  /// then has no residual and whose change is 0.
  void set_motor(std::size_t s, double torque) { motor_[s] = torque; }
  void lock_turn(std::size_t s) { locked_[s] = 1; }
  /// Torque (N m) at a locked turn that the motion evaluated last needs.
  double motor_torque(std::size_t s) const { return motor_[s]; }

  /// Energy of the state evaluated last.
  ChainEnergy energy(const ChainState& state) const;
  /// Section forces of the state evaluated last, with its load: cuts at the weld, at all joints and outside
  /// of the tip mass. Damping by mass acts on the link from outside and counts at the joints; at the weld
  /// the load of the hub on the whole is given. Not of source_linearised (ContractError).
  std::vector<SectionForce> sections() const;

  /// Eliminates bp M + gp C + K at the state evaluated last: masses, dampers, stiffnesses, the stiffness that
  /// the forces in the chain and the speed of the hub add; without the gyroscopic terms of the chain. With
  /// `free_hub` for the angle of the hub too. false where a pivot vanishes.
  bool factor(const TangentScale& scale, bool free_hub);
  /// Negative pivots of that: by Sylvester's law its number of negative eigenvalues.
  int negative() const { return negative_; }
  /// The change of coordinates and (free hub, else 0) of the hub's angle that brings residuals to zero.
  double solve(std::span<const double> residual, double hub_residual, std::span<double> change);

 private:
  struct Node {
    math::Vec2 z, v, a;  // from O, in axes of the hub; velocity and acceleration against the ground
    math::Vec2 drift;    // velocity in the hub
    double angle = 0;    // against the hub
    double rate = 0, acceleration = 0;  // against the ground
  };
  struct Joint {
    JointStep step;
    math::Vec2 mean;               // unit vector of the mean direction
    math::Vec2 by_angle;           // derivatives of the displacement: by the angle of the inner bar,
    std::array<math::Vec2, 3> by;  // by the coordinates
    math::Vec2 force;              // inertia force of node s, with its damping
    double couple = 0;
    math::Vec2 outer;  // sum of the forces from node s outwards
  };
  struct Eliminated {
    math::Vec2 by_angle;
    std::array<math::Vec2, 3> by;
    std::array<double, 3> pivot, lower;  // L D L^T of the joint's own block; l10, l20, l21
    std::array<std::array<double, 3>, 3> gain;
  };

  void move(const ChainState& state);
  void move_linearised(const ChainState& state);
  void balance(const ChainState& state, const TipLoad& load);
  void balance_linearised(const ChainState& state);
  void project(const ChainState& state);
  void project_only(std::span<double> out);
  template <int C>
  bool eliminate(const TangentScale& scale);
  template <int C>
  void substitute(std::span<const double> residual, std::span<double> change);
  void substitute(std::span<const double> residual, std::span<double> change);
  bool eliminate_hub(const TangentScale& scale);

  const Chain* chain_;
  bool linearised_;
  ChainForces forces_;
  double force_scale_ = 1, moment_scale_ = 1;
  double natural_force_ = 1, natural_moment_ = 1;
  double hub_rate_ = 0;
  math::Vec2 gravity_;
  TipLoad load_;
  std::vector<Node> node_;
  std::vector<Joint> joint_;
  std::vector<Eliminated> eliminated_;
  std::vector<double> motor_;
  std::vector<char> locked_;
  std::vector<double> residual_, border_column_, border_row_, border_change_;
  bool free_hub_ = false;
  double corner_ = 1;
  int negative_ = 0;
};

}  // namespace linkwright::flexible
