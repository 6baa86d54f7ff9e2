// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "linkwright/math/simd.h"
#include "linkwright/math/singular_values.h"
#include "linkwright/parallel/dexterity/dexterity.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"

/// Indices of a pose and their derivatives by the dimensions of a robot, written once for numbers and for
/// SIMD batches of poses.
namespace linkwright::parallel {

/// A leg of a designed robot in one orientation, with what all poses share.
struct PreparedLeg {
  Leg leg;
  Vec3 axis;   ///< e x w
  Vec3 lever;  ///< R b
  double mode = 1, sense = 1;
  struct By {
    Vec3 joint;                               ///< derivative of the platform joint, seen from the pivot
    Vec3 lever;                               ///< derivative of R b
    double along = 0, aside = 0, across = 0;  ///< parts of `joint` along e, w and the axis
    double arm = 0, rod = 0;
  };
  std::array<By, max_dimensions> by{};
};
struct PreparedRobot {
  int count = 0;  ///< dimensions
  bool output = false, constraint = false;
  double per_length = 1;
  double assembly = 1;  ///< sign of det J^-1 where the conditioning is positive
  double turned = 1;    ///< sign of det C where the constraint index is
  Vec3 origin;          ///< origin of the region
  std::array<PreparedLeg, max_legs> leg{};
};

/// Velocity of a platform joint in a twist whose turning is multiplied by a length.
template <int order, class T>
LINKWRIGHT_KERNEL math::Vector3<T> joint_velocity(const std::array<T, order>& twist, const Vec3& lever,
                                                  double per_length) {
  if constexpr (order == 2) {
    return {twist[0], twist[1], T(0.0)};
  } else {
    math::Vector3<T> out{twist[0], twist[1], twist[2]};
    if constexpr (order == 6) {
      const math::Vector3<T> w{twist[3] * per_length, twist[4] * per_length, twist[5] * per_length};
      out = out + cross(w, lever);
    }
    return out;
  }
}

/// By elimination without exchange of rows: for matrices with perpendicular columns, whose pivots vanish in a
/// set of measure 0 only.
template <int order, class T>
LINKWRIGHT_KERNEL T determinant(std::array<std::array<T, order>, order> m) {
  if constexpr (order == 2) {
    return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  } else if constexpr (order == 3) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
           m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  } else {
    T out = m[0][0];
    for (int k = 0; k < order - 1; ++k) {
      const T inverse = T(1.0) / m[k][k];
      for (int i = k + 1; i < order; ++i) {
        const T factor = m[i][k] * inverse;
        for (int j = k + 1; j < order; ++j) m[i][j] = m[i][j] - factor * m[k][j];
      }
      out = out * m[k + 1][k + 1];
    }
    return out;
  }
}

/// `order` = legs. `place` is local to the region.
template <int order, bool derivatives, class T>
LINKWRIGHT_KERNEL void measure(const PreparedRobot& robot, const math::Vector3<T>& place,
                               PoseDexterity<T>& out) {
  using S = math::Scalar<T>;
  using std::sqrt;
  constexpr bool turns = order == 6;
  const int n = robot.count;
  const double per_length = robot.per_length;

  std::array<LegAt<T>, order> at;
  std::array<T, order> drive;                             // l s . u'
  std::array<std::array<T, order>, order> rows, inverse;  // rows of Jx, inverse J^-1 = Jq^-1 Jx
  // Smooth minimum of the squares of an input index and of the leg it belongs to: beyond reach it continues
  // as an index that is less than 0, so that a search finds its way back.
  T least(0.0);
  std::array<T, max_dimensions> least_by;
  for (int j = 0; j < n; ++j) least_by[j] = T(0.0);
  for (int i = 0; i < order; ++i) {
    const PreparedLeg& prepared = robot.leg[i];
    const Leg& leg = prepared.leg;
    const math::Vector3<T> g{place.x + (robot.origin.x + prepared.lever.x),
                             place.y + (robot.origin.y + prepared.lever.y),
                             place.z + (robot.origin.z + prepared.lever.z)};
    const JointSeen<T> seen = joint_seen(leg, g);
    at[i] = leg_at(leg, g, prepared.mode);
    const double per_square = 1 / (leg.rod * leg.rod);
    const auto reached = T(0.0) < at[i].reach;
    drive[i] = leg.arm * dot(at[i].rod, at[i].normal);
    const T side = dot(seen.v, prepared.axis);
    out.input_square[i] = at[i].reach * per_square;
    out.side[i] = S::abs(side) * (1 / leg.rod);
    // An arm that cannot reach points at the joint, or away from one that is too near.
    const T inward = S::choose(seen.c < T(0.0), T(-1.0), T(1.0));
    out.cosine[i] = prepared.sense * S::choose(reached, at[i].cosine, inward * seen.along);
    out.sine[i] = S::choose(reached, at[i].sine, inward * seen.aside);

    const std::array<T, 3> s{at[i].rod.x, at[i].rod.y, at[i].rod.z};
    for (int k = 0; k < (order < 3 ? order : 3); ++k) rows[i][k] = s[k];
    if constexpr (turns) {
      const math::Vector3<T> m = cross(prepared.lever, at[i].rod);
      rows[i][3] = m.x * per_length;
      rows[i][4] = m.y * per_length;
      rows[i][5] = m.z * per_length;
    }
    const T per_drive = T(1.0) / drive[i];
    for (int k = 0; k < order; ++k) inverse[i][k] = rows[i][k] * per_drive;

    const auto lower = out.input_square[i] < least;
    least = S::choose(lower, out.input_square[i], least);
    if constexpr (derivatives) {
      for (int j = 0; j < n; ++j) {
        const PreparedLeg::By& by = prepared.by[j];
        const T dc =
            (dot(seen.v, by.joint) + (leg.arm * by.arm - leg.rod * by.rod) - seen.c * by.arm) * (1 / leg.arm);
        const T reach = 2.0 * (seen.along * by.along + seen.aside * by.aside - seen.c * dc);
        const T input = (reach - at[i].reach * (2 * by.rod / leg.rod)) * per_square;
        out.input_square_by[i][j] = input;
        least_by[j] = S::choose(lower, input, least_by[j]);
        const T turned =
            (dot(at[i].rod, by.joint) - by.arm * dot(at[i].rod, at[i].arm) - leg.rod * by.rod) / drive[i];
        out.angle_by[i][j] = S::choose(reached, prepared.sense * turned, T(0.0));
        const T across(by.across);
        out.side_by[i][j] =
            (S::choose(side < T(0.0), -across, across) - out.side[i] * by.rod) * (1 / leg.rod);
      }
    }
  }

  const auto svd = math::singular_values<order>(inverse);
  // Vectors of the largest and of the least singular value.
  std::array<T, order> first_left, first_right, last_left, last_right;
  T largest = svd.value[0], smallest = svd.value[0];
  for (int i = 0; i < order; ++i) {
    first_left[i] = last_left[i] = svd.left[i][0];
    first_right[i] = last_right[i] = svd.right[i][0];
  }
  for (int k = 1; k < order; ++k) {
    const auto more = largest < svd.value[k];
    const auto less = svd.value[k] < smallest;
    largest = S::choose(more, svd.value[k], largest);
    smallest = S::choose(less, svd.value[k], smallest);
    for (int i = 0; i < order; ++i) {
      first_left[i] = S::choose(more, svd.left[i][k], first_left[i]);
      first_right[i] = S::choose(more, svd.right[i][k], first_right[i]);
      last_left[i] = S::choose(less, svd.left[i][k], last_left[i]);
      last_right[i] = S::choose(less, svd.right[i][k], last_right[i]);
    }
  }
  const auto fits = !(least < T(0.0));
  // V is a product of turns, so that the sign of det J^-1 is that of the left vectors.
  const T conditioning =
      S::choose(determinant<order>(svd.left) < T(0.0), T(-robot.assembly), T(robot.assembly)) * smallest /
      largest;
  out.conditioning = S::choose(fits, conditioning, least);

  out.constraint = T(1.0);
  if constexpr (derivatives)
    for (int j = 0; j < n; ++j) out.constraint_by[j] = T(0.0);
  // Vectors of the least singular value of C.
  [[maybe_unused]] std::array<T, order> couple_left{}, couple_right{};
  [[maybe_unused]] T held(1.0);
  if constexpr (order == 3) {
    if (robot.constraint) {
      std::array<std::array<T, 3>, 3> couples;
      for (int i = 0; i < 3; ++i) {
        const math::Vector3<T> c = cross(robot.leg[i].axis, at[i].rod);
        const double per_rod = 1 / robot.leg[i].leg.rod;
        couples[i] = {c.x * per_rod, c.y * per_rod, c.z * per_rod};
      }
      const auto turns_by = math::singular_values<3>(couples);
      T least_held = turns_by.value[0];
      for (int i = 0; i < 3; ++i) {
        couple_left[i] = turns_by.left[i][0];
        couple_right[i] = turns_by.right[i][0];
      }
      for (int k = 1; k < 3; ++k) {
        const auto less = turns_by.value[k] < least_held;
        least_held = S::choose(less, turns_by.value[k], least_held);
        for (int i = 0; i < 3; ++i) {
          couple_left[i] = S::choose(less, turns_by.left[i][k], couple_left[i]);
          couple_right[i] = S::choose(less, turns_by.right[i][k], couple_right[i]);
        }
      }
      held = S::choose(determinant<3>(couples) < T(0.0), T(-robot.turned), T(robot.turned)) * least_held;
      out.constraint = S::choose(fits, held, least);
    }
  }

  // Twist for a unit of one leg alone, from the same decomposition: Jx^-1 = V S^-1 U^T Jq^-1.
  std::array<std::array<T, order>, order> twist;
  if (robot.output) {
    std::array<T, order> per_square;
    for (int k = 0; k < order; ++k) per_square[k] = T(1.0) / (svd.value[k] * svd.value[k]);
    for (int i = 0; i < order; ++i) {
      for (int r = 0; r < order; ++r) {
        T sum(0.0);
        for (int k = 0; k < order; ++k) sum = sum + svd.right[r][k] * per_square[k] * svd.left[i][k];
        twist[i][r] = sum / drive[i];
      }
    }
    for (int i = 0; i < order; ++i) {
      const T speed = norm(joint_velocity<order>(twist[i], robot.leg[i].lever, per_length));
      out.output[i] = S::choose(fits, T(1.0) / (robot.leg[i].leg.rod * speed), T(0.0));
    }
  }

  if constexpr (derivatives) {
    for (int j = 0; j < n; ++j) {
      std::array<std::array<T, order>, order> changed;  // d rows
      T first(0.0), last(0.0);
      [[maybe_unused]] T turned_by(0.0);
      for (int i = 0; i < order; ++i) {
        const PreparedLeg& prepared = robot.leg[i];
        const PreparedLeg::By& by = prepared.by[j];
        const T turned = prepared.sense * out.angle_by[i][j];
        const T arm_turned = prepared.leg.arm * turned;
        const math::Vector3<T> ds = by.joint - (T(by.arm) * at[i].arm + arm_turned * at[i].normal);
        const T change = by.arm * dot(at[i].rod, at[i].normal) +
                         prepared.leg.arm * (dot(ds, at[i].normal) - turned * dot(at[i].rod, at[i].arm));
        const std::array<T, 3> d{ds.x, ds.y, ds.z};
        if constexpr (order == 3) {
          if (robot.constraint) {
            // d sigma = u . dC v with rows of C = axis x s / L.
            const math::Vector3<T> shrunk = ds - T(by.rod / prepared.leg.rod) * at[i].rod;
            const math::Vector3<T> dc = cross(prepared.axis, shrunk);
            turned_by =
                turned_by + couple_left[i] * (1 / prepared.leg.rod) *
                                (dc.x * couple_right[0] + dc.y * couple_right[1] + dc.z * couple_right[2]);
          }
        }
        for (int k = 0; k < (order < 3 ? order : 3); ++k) changed[i][k] = d[k];
        if constexpr (turns) {
          const math::Vector3<T> m = cross(by.lever, at[i].rod) + cross(prepared.lever, ds);
          changed[i][3] = m.x * per_length;
          changed[i][4] = m.y * per_length;
          changed[i][5] = m.z * per_length;
        }
        // d sigma = u . dK v with rows of K = rows / drive and K v = sigma u; `left` has sigma u.
        T with_first(0.0), with_last(0.0);
        for (int k = 0; k < order; ++k) {
          with_first = with_first + changed[i][k] * first_right[k];
          with_last = with_last + changed[i][k] * last_right[k];
        }
        first = first + first_left[i] * (with_first - first_left[i] * change) / drive[i];
        last = last + last_left[i] * (with_last - last_left[i] * change) / drive[i];
      }
      // So far `first` and `last` have one factor sigma too many.
      const T slope = conditioning * (last / (smallest * smallest) - first / (largest * largest));
      out.conditioning_by[j] = S::choose(fits, slope, least_by[j]);
      // `left` has sigma u; the sign of the index is that of its value.
      if constexpr (order == 3)
        if (robot.constraint) out.constraint_by[j] = S::choose(fits, turned_by / held, least_by[j]);
      if (!robot.output) continue;
      for (int i = 0; i < order; ++i) {
        std::array<T, order> rate;
        for (int r = 0; r < order; ++r) rate[r] = T(0.0);
        for (int h = 0; h < order; ++h) {
          T sum(0.0);
          for (int k = 0; k < order; ++k) sum = sum + changed[h][k] * twist[i][k];
          for (int r = 0; r < order; ++r) rate[r] = rate[r] - twist[h][r] * sum;
        }
        const math::Vector3<T> v = joint_velocity<order>(twist[i], robot.leg[i].lever, per_length);
        math::Vector3<T> dv = joint_velocity<order>(rate, robot.leg[i].lever, per_length);
        if constexpr (turns) {
          const math::Vector3<T> w{twist[i][3] * per_length, twist[i][4] * per_length,
                                   twist[i][5] * per_length};
          dv = dv + cross(w, robot.leg[i].by[j].lever);
        }
        const T grown = dot(v, dv) / dot(v, v) + robot.leg[i].by[j].rod / robot.leg[i].leg.rod;
        out.output_by[i][j] = S::choose(fits, -out.output[i] * grown, T(0.0));
      }
    }
  }
}

/// All poses of a set, a register of them at a time; the rest of the last register repeats the last pose.
template <int order, bool derivatives, class T>
LINKWRIGHT_KERNEL void measure_set(const PreparedRobot& robot, const PoseSet& poses, SetDexterity& out) {
  constexpr std::size_t width = T::size;
  const std::size_t size = poses.size();
  alignas(64) std::array<double, width> lane[3];
  PoseDexterity<T> pose;
  for (std::size_t first = 0; first < size; first += width) {
    const std::size_t count = size - first < width ? size - first : width;
    for (std::size_t l = 0; l < width; ++l) {
      const std::size_t from = first + (l < count ? l : count - 1);
      lane[0][l] = poses.x[from];
      lane[1][l] = poses.y[from];
      lane[2][l] = poses.z[from];
    }
    const math::Vector3<T> place{T::load_unaligned(lane[0].data()), T::load_unaligned(lane[1].data()),
                                 T::load_unaligned(lane[2].data())};
    measure<order, derivatives>(robot, place, pose);
    const auto store = [&](const T& from, std::vector<double>& to) __attribute__((always_inline)) {
      from.store_unaligned(lane[0].data());
      double* at = to.data() + first;
      for (std::size_t l = 0; l < count; ++l) at[l] = lane[0][l];
    };
    store(pose.conditioning, out.conditioning);
    if (robot.constraint) store(pose.constraint, out.constraint);
    for (int i = 0; i < order; ++i) {
      store(pose.input_square[i], out.input_square[i]);
      store(pose.cosine[i], out.cosine[i]);
      store(pose.sine[i], out.sine[i]);
      store(pose.side[i], out.side[i]);
      if (robot.output) store(pose.output[i], out.output[i]);
    }
    if constexpr (derivatives)
      for (int j = 0; j < robot.count; ++j) store(pose.conditioning_by[j], out.conditioning_by[j]);
  }
}

template <class T>
LINKWRIGHT_KERNEL void measure_set(const PreparedRobot& robot, int order, const PoseSet& poses,
                                   bool derivatives, SetDexterity& out) {
  if (order == 3)
    derivatives ? measure_set<3, true, T>(robot, poses, out) : measure_set<3, false, T>(robot, poses, out);
  else if (order == 2)
    derivatives ? measure_set<2, true, T>(robot, poses, out) : measure_set<2, false, T>(robot, poses, out);
  else
    derivatives ? measure_set<6, true, T>(robot, poses, out) : measure_set<6, false, T>(robot, poses, out);
}

using MeasureKernel = void(const PreparedRobot&, int order, const PoseSet&, bool derivatives, SetDexterity&);
MeasureKernel measure_set_baseline, measure_set_avx2;

}  // namespace linkwright::parallel
