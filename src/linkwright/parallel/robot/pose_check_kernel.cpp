// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "linkwright/core/numbers.h"
#include "linkwright/math/simd.h"
#include "linkwright/math/singular_values.h"
#include "linkwright/math/small_inverse.h"
#include "linkwright/parallel/pi_joint/kernel.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"
#include "linkwright/parallel/robot/pose_check.h"

namespace linkwright::parallel {

/// Steps of the drives, as displacements of the platform point.
template <class Batch, int N>
struct PoseCheckSteps {
  std::array<math::Vector3<Batch>, N> step;
};

/// Largest length of all sums of the steps with either sign.
template <int N, class Batch>
LINKWRIGHT_KERNEL Batch worst_step(const PoseCheckSteps<Batch, N>& s) {
  using S = math::Scalar<Batch>;
  Batch most(0.0);
  // The opposite of a combination has the same length: the first sign stays.
  for (int signs = 0; signs < 1 << (N - 1); ++signs) {
    math::Vector3<Batch> sum = s.step[0];
    for (int i = 1; i < N; ++i) {
      const Batch sign(signs >> (i - 1) & 1 ? -1.0 : 1.0);
      sum = {S::multiply_add(sign, s.step[i].x, sum.x), S::multiply_add(sign, s.step[i].y, sum.y),
             S::multiply_add(sign, s.step[i].z, sum.z)};
    }
    most = S::max(most, dot(sum, sum));
  }
  return sqrt(most);
}

/// One register of poses from number k on.
template <int N, class Batch>
LINKWRIGHT_KERNEL void check_register(const PoseCheckTask& task, std::size_t k) {
  using S = math::Scalar<Batch>;
  using Vector = math::Vector3<Batch>;
  using Mask = typename Batch::batch_bool_type;
  using I = PoseIndex;
  const Batch zero(0.0), one(1.0), not_known(nan);
  const auto wanted = [&](PoseIndex index) __attribute__((always_inline)) {
    return task.wanted[static_cast<std::size_t>(index)];
  };
  const auto put = [&](PoseIndex index, const Mask& known, const Batch& value)
      __attribute__((always_inline)) {
    S::choose(known, value, not_known).store_unaligned(task.index[static_cast<std::size_t>(index)] + k);
  };
  const auto turned = [&](int row, const Vec3& b) __attribute__((always_inline)) {
    if (task.rotations[0]) {
      const auto element = [&](int column) __attribute__((always_inline)) {
        return Batch::load_unaligned(task.rotations[3 * row + column] + k);
      };
      return Batch(element(0) * b.x + element(1) * b.y + element(2) * b.z);
    }
    const Vec3& r = task.rotation.row[row];
    return Batch(r.x * b.x + r.y * b.y + r.z * b.z);
  };

  const Vector p{Batch::load_unaligned(task.position[0] + k), Batch::load_unaligned(task.position[1] + k),
                 Batch::load_unaligned(task.position[2] + k)};
  std::array<Vector, N> rod, lever;
  std::array<Batch, N> drive, rate;  // l s . u', abs(j)
  Mask reaches = one == Batch(1.0), in_travel = reaches, in_elbow = reaches, in_swing = reaches,
       possible = reaches;
  Batch input(1.0), drive_transmission(1.0);
  for (int i = 0; i < N; ++i) {
    const PoseCheckLeg& l = task.leg[i];
    lever[i] = {turned(0, l.leg.platform), turned(1, l.leg.platform), turned(2, l.leg.platform)};
    const LegAt<Batch> found = leg_at(l.leg, p + lever[i], l.sign);
    reaches = reaches & (found.reach >= zero) & (found.cosine == found.cosine);
    rod[i] = found.rod;
    const Batch across = dot(found.rod, found.normal);
    drive[i] = l.leg.arm * across;
    input = S::min(input, S::abs(across) * (1 / l.leg.rod));
    // theta, as a direction
    const Batch cosine = found.cosine * l.zero_cosine + found.sine * l.zero_sine;
    const Batch sine = (found.sine * l.zero_cosine - found.cosine * l.zero_sine) * l.mirror;
    in_travel = in_travel & (cosine * l.centre_cosine + sine * l.centre_sine >= Batch(l.range_cosine));
    rate[i] = one;
    if (l.pi_joint) {
      possible = possible & (cosine >= zero);
      rate[i] = pi_jacobian(pi_terms_of_direction(Batch(l.leg.arm), Batch(l.ratio), sine, cosine));
      drive_transmission = S::min(drive_transmission, rate[i] * (1 / l.leg.arm));
    }
    const Batch elbow = -dot(found.rod, found.arm);
    in_elbow = in_elbow & (elbow >= Batch(l.min_elbow_part)) & (elbow <= Batch(l.max_elbow_part));
    const Vec3& e = l.leg.ahead;
    const Vec3& w = l.leg.aside;
    const Batch swing = found.rod.x * (e.y * w.z - e.z * w.y) + found.rod.y * (e.z * w.x - e.x * w.z) +
                        found.rod.z * (e.x * w.y - e.y * w.x);
    in_swing = in_swing & (S::abs(swing) <= Batch(l.max_swing_part));
  }

  const bool conditions = task.min_conditioning > 0;
  const bool inverse_wanted = wanted(I::transmission) || wanted(I::conditioning) ||
                              wanted(I::axis_resolution) || wanted(I::worst_resolution) || conditions ||
                              task.min_transmission > 0;
  const bool determinant_wanted = wanted(I::rods) || wanted(I::manipulability) || task.assembly != 0;
  if (!xsimd::any(reaches)) {
    Batch(static_cast<double>(Criterion::leg)).store_unaligned(task.criterion + k);
    for (std::size_t index = 0; index < pose_index_count; ++index)
      if (task.wanted[index]) not_known.store_unaligned(task.index[index] + k);
    return;
  }
  if (wanted(I::input_transmission)) put(I::input_transmission, reaches, input);
  const Mask driven = reaches & possible;
  if (wanted(I::drive_transmission)) put(I::drive_transmission, driven, drive_transmission);

  std::array<std::array<Batch, N>, N> jx;
  for (int i = 0; i < N; ++i) {
    jx[i][0] = rod[i].x;
    jx[i][1] = rod[i].y;
    if constexpr (N > 2) jx[i][2] = rod[i].z;
    if constexpr (N == 6) {
      const Vector moment = cross(lever[i], rod[i]);
      jx[i][3] = moment.x;
      jx[i][4] = moment.y;
      jx[i][5] = moment.z;
    }
  }
  Mask same_assembly = one == Batch(1.0), transmits = same_assembly, well_conditioned = same_assembly;
  if (inverse_wanted || determinant_wanted) {
    const auto [inverse, determinant] = math::small_inverse<N>(jx);
    if (task.assembly != 0) same_assembly = determinant * Batch(task.assembly) > zero;
    if (wanted(I::rods)) put(I::rods, reaches, determinant * task.rods_scale);
    if (wanted(I::manipulability)) {
      Batch product(1.0);
      for (int i = 0; i < N; ++i) product = product * drive[i];
      Batch scale(1.0);
      if constexpr (N == 6)
        scale = Batch(task.characteristic_length * task.characteristic_length * task.characteristic_length);
      put(I::manipulability, reaches, scale * S::abs(product / determinant));
    }
    if (wanted(I::transmission) || task.min_transmission > 0) {
      Batch transmission = input;
      for (int i = 0; i < N; ++i) {
        Vector v{inverse[0][i], inverse[1][i], zero};
        if constexpr (N > 2) v.z = inverse[2][i];
        if constexpr (N == 6) v = v + cross(Vector{inverse[3][i], inverse[4][i], inverse[5][i]}, lever[i]);
        const Batch speed = sqrt(dot(v, v));
        // In a singularity the speed is infinite or not known.
        const Batch output = S::choose(speed < Batch(1e300), one / (task.leg[i].leg.rod * speed), zero);
        transmission = S::min(transmission, output);
      }
      if (wanted(I::transmission)) put(I::transmission, reaches, transmission);
      transmits = transmission >= Batch(task.min_transmission);
    }
    if (wanted(I::conditioning) || conditions) {
      std::array<std::array<Batch, N>, N> j;
      for (int row = 0; row < N; ++row)
        for (int i = 0; i < N; ++i)
          j[row][i] = inverse[row][i] * drive[i] * (row < 3 ? 1 : task.characteristic_length);
      const auto values = math::singular_values<N, false>(j).value;
      Batch least = values[0], largest = values[0];
      for (int i = 1; i < N; ++i) {
        least = S::min(least, values[i]);
        largest = S::max(largest, values[i]);
      }
      const Batch conditioning = S::choose(largest < Batch(1e300), least / largest, zero);
      if (wanted(I::conditioning)) put(I::conditioning, reaches, conditioning);
      well_conditioned = conditioning >= Batch(task.min_conditioning);
    }
    if (wanted(I::axis_resolution) || wanted(I::worst_resolution)) {
      PoseCheckSteps<Batch, N> steps;
      Vector bound{zero, zero, zero};
      for (int i = 0; i < N; ++i) {
        const Batch scale = task.leg[i].quantum * drive[i] / rate[i];
        Vector& s = steps.step[i];
        s = {scale * inverse[0][i], scale * inverse[1][i], zero};
        if constexpr (N > 2) s.z = scale * inverse[2][i];
        bound = {bound.x + S::abs(s.x), bound.y + S::abs(s.y), bound.z + S::abs(s.z)};
      }
      if (wanted(I::axis_resolution))
        put(I::axis_resolution, driven, S::max(S::max(bound.x, bound.y), bound.z));
      if (wanted(I::worst_resolution)) put(I::worst_resolution, driven, worst_step<N>(steps));
    }
  }
  Mask held = one == Batch(1.0);
  if constexpr (N == 3) {
    const bool limited = task.least_constraint > 0;
    if (wanted(I::constraint) || wanted(I::constraint_index) || limited || task.constraint != 0) {
      std::array<Vector, 3> row;
      std::array<std::array<Batch, 3>, 3> couples;
      Batch lengths(1.0);
      for (int i = 0; i < 3; ++i) {
        const Vector couple = cross(cross(task.leg[i].leg.ahead, task.leg[i].leg.aside), rod[i]);
        row[i] = (1 / task.leg[i].leg.rod) * couple;
        lengths = lengths * sqrt(dot(row[i], row[i]));
        couples[i] = {row[i].x, row[i].y, row[i].z};
      }
      const Batch volume = dot(row[0], cross(row[1], row[2]));
      if (task.constraint != 0) held = volume * Batch(task.constraint) > zero;
      if (wanted(I::constraint)) put(I::constraint, reaches, volume / lengths);
      if (wanted(I::constraint_index)) {
        const auto values = math::singular_values<3, false>(couples).value;
        put(I::constraint_index, reaches, S::min(values[0], S::min(values[1], values[2])));
      }
      if (limited) {
        // The least singular value is at least x where C C^T - x^2 is positive definite: the signs of its
        // leading minors, without the singular values.
        const Batch square(task.least_constraint * task.least_constraint);
        const Batch a = dot(row[0], row[0]) - square, b = dot(row[1], row[1]) - square,
                    c = dot(row[2], row[2]) - square;
        const Batch d = dot(row[0], row[1]), e = dot(row[0], row[2]), f = dot(row[1], row[2]);
        const Batch second = a * b - d * d;
        const Batch third = c * second - e * (e * b - d * f) - f * (a * f - d * e);
        held = held & (a >= zero) & (second >= zero) & (third >= zero);
      }
    }
  } else {
    for (const auto index : {I::constraint, I::constraint_index})
      if (wanted(index)) put(index, reaches, one);
  }
  if (wanted(I::speed_factor)) {
    Batch most(0.0);
    for (int i = 0; i < N; ++i) {
      Batch sum(0.0);
      for (int r = 0; r < N; ++r) sum = sum + S::abs(jx[i][r]);
      most = S::max(most, sum * S::abs(rate[i] / drive[i]));
    }
    put(I::speed_factor, driven, one / most);
  }

  // The last condition first, so that the first one that fails stays.
  Batch criterion(0.0);
  const auto demand = [&](const Mask& met, Criterion h) __attribute__((always_inline)) {
    criterion = S::choose(met, criterion, Batch(static_cast<double>(h)));
  };
  demand(well_conditioned, Criterion::conditioning);
  demand(transmits, Criterion::transmission);
  if (task.min_drive_transmission > 0)
    demand(drive_transmission >= Batch(task.min_drive_transmission), Criterion::drive_transmission);
  demand(in_swing, Criterion::swing);
  demand(in_elbow, Criterion::elbow);
  demand(in_travel, Criterion::travel);
  demand(held, Criterion::constraint);
  demand(same_assembly, Criterion::assembly);
  demand(reaches, Criterion::leg);
  criterion.store_unaligned(task.criterion + k);
}

template <class Batch>
LINKWRIGHT_KERNEL void pose_check_with(const PoseCheckTask& task) {
  switch (task.freedom) {
    case Freedom::plane_translation:
      for (std::size_t k = 0; k < task.count; k += Batch::size) check_register<2, Batch>(task, k);
      return;
    case Freedom::space_translation:
      for (std::size_t k = 0; k < task.count; k += Batch::size) check_register<3, Batch>(task, k);
      return;
    case Freedom::space:
      for (std::size_t k = 0; k < task.count; k += Batch::size) check_register<6, Batch>(task, k);
      return;
  }
}

void LINKWRIGHT_COMPILED(pose_check)(const PoseCheckTask& task) { pose_check_with<math::KernelBatch>(task); }

}  // namespace linkwright::parallel
