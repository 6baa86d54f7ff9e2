// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/stiffness.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"
#include "support/generators.h"

namespace linkwright::parallel {
namespace {

using math::radians;
using test::between;
using test::log_between;
using test::number_at;
using test::numbers;

TEST(PiStiffness, TrussOfTheReference) {
  const Value &given = inputs("pi-truss"), &expected = computed("pi-truss");
  const PiBars bars{.arm = number_at(given, "k_arm_N_m"),
                    .coupler = number_at(given, "k_coupler_N_m"),
                    .diagonal = number_at(given, "k_diag_N_m")};
  for (const auto& [name, share] : {std::pair{"wA=1", 1.0}, {"wA=0.5", 0.5}, {"wA=0", 0.0}}) {
    const auto forces = numbers(*test::at(expected, "member_force_per_Nm_OC_BA_CA_OA").find(name));
    const PiBarForces found = bar_forces(pi_prototype(), radians(20), share);
    expect_same(found.arm_base, forces[0]);
    expect_same(found.arm_top, forces[1]);
    expect_same(found.coupler, forces[2]);
    expect_same(found.diagonal, forces[3]);
    expect_same(compliance(pi_prototype(), bars, radians(20), share),
                test::at(expected, "compliance_rad_per_Nm").find(name)->as_number());
  }
}

// Rigid arms: stiffness of the prototype where its mean is the published one.
TEST(PiStiffness, PrototypeWithAnElasticDiagonal) {
  const Value& expected = computed("pi-stiffness");
  const PiBars bars{.diagonal = number_at(expected, "k_d_rigid_arms_N_m")};
  const auto at = numbers(test::at(expected, "K_theta_at_deg"));
  const auto stiff = numbers(test::at(expected, "K_theta_Nm_rad"));
  for (std::size_t i = 0; i < at.size(); ++i)
    expect_same(stiffness(pi_prototype(), bars, radians(at[i])), stiff[i]);
}

// Turn of the arms per torque from a stiffness matrix assembled of bars, pins C and A free.
double assembled_compliance(const PiJoint& joint, const PiBars& bars, double angle, double share) {
  using Point = Eigen::Vector2d;
  const Point normal(-std::sin(angle), std::cos(angle));
  const Point o(0, 0), b(0, base_length(joint));
  const Point c = joint.arm * Point(std::cos(angle), std::sin(angle)), a = b + c;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  // Places 0 and 2 of the unknowns are C and A; -1 is fixed.
  const auto bar = [&](const Point& from, int at_from, const Point& to, int at_to, double stiff) {
    const Point along = (to - from).normalized();
    const Eigen::Matrix2d k = stiff * along * along.transpose();
    if (at_from >= 0) matrix.block<2, 2>(at_from, at_from) += k;
    if (at_to >= 0) matrix.block<2, 2>(at_to, at_to) += k;
    if (at_from >= 0 && at_to >= 0) {
      matrix.block<2, 2>(at_from, at_to) -= k;
      matrix.block<2, 2>(at_to, at_from) -= k;
    }
  };
  bar(o, -1, c, 0, bars.arm);
  bar(b, -1, a, 2, bars.arm);
  bar(c, 0, a, 2, bars.coupler);
  bar(o, -1, a, 2, 1 / (1 / bars.diagonal + (a - o).norm() / bars.screw));
  Eigen::Vector4d load;
  load << (1 - share) / joint.arm * normal, share / joint.arm * normal;
  // The torque works along the turn that its forces see.
  return load.dot(matrix.fullPivLu().solve(load));
}

RC_GTEST_PROP(PiStiffnessProperty, AgreesWithAnAssembledTruss, ()) {
  const PiJoint joint{.arm = *between(0.1, 0.5), .ratio = *between(0.2, 1.6)};
  const PiBars bars{.arm = *log_between(1e6, 1e9),
                    .coupler = *log_between(1e6, 1e9),
                    .diagonal = *log_between(1e6, 1e9),
                    .screw = *log_between(1e6, 1e8)};
  const double angle = *between(-1.4, 1.4), share = *between(0, 1);
  const double found = compliance(joint, bars, angle, share);
  // Rounding of 1e-16 times the condition of the matrix: stiffnesses a thousandfold apart, and 1 / sin(mu)^2.
  RC_ASSERT(std::abs(found - assembled_compliance(joint, bars, angle, share)) < 1e-9 * found);
}

TEST(PiStiffness, YieldsAtTheEndsAndIsRigidWithRigidBars) {
  EXPECT_EQ(stiffness(pi_prototype(), {}, 0.2), INFINITY);
  EXPECT_EQ(stiffness(pi_prototype(), {.diagonal = 1e7}, -pi / 2), 0);
  EXPECT_EQ(stiffness(pi_prototype(), {}, -pi / 2), 0);
  // Next to the end like J^2, which is J'^2 times the square of the way from it.
  EXPECT_LT(stiffness(pi_prototype(), {.diagonal = 1e7}, pi / 2 - 1e-6), 1e-6);
}

TEST(PiStiffness, TellsWhatIsWrong) {
  EXPECT_EQ(problem(PiBars{}), std::nullopt);
  EXPECT_EQ(problem(PiBars{.arm = 0}), "stiffness of the arms = 0 N/m");
  EXPECT_EQ(problem(PiBars{.coupler = -1}), "stiffness of the coupler = -1 N/m");
  EXPECT_EQ(problem(PiBars{.diagonal = NAN}), "stiffness of the diagonal = nan N/m");
  EXPECT_EQ(problem(PiBars{.screw = 0}), "stiffness of the screw = 0 N");
}

}  // namespace
}  // namespace linkwright::parallel
