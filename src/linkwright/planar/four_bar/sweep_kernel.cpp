// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/detail/sweep_kernel.h"

#include "linkwright/core/tolerance.h"
#include "linkwright/math/simd.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/four_bar/detail/forces_kernel.h"

namespace linkwright::planar {

/// The data that stay the same over the angles, for the machines of a register or for one in all its lanes.
template <class Batch>
struct FourBarSweepMachine {
  Batch fx, fy;
  FourBarShape<Batch> shape;
  FourBarBases<Batch> bases;
  Batch nearest;  ///< R^2 below which the coupler has no direction
  Batch gravity;
};

template <class Batch>
LINKWRIGHT_KERNEL FourBarSweepMachine<Batch> load_machine(const FourBarSweepTask& task, std::size_t lane) {
  const auto row = [&](std::size_t k) __attribute__((always_inline)) {
    return task.over_machines ? Batch::load_unaligned(task.constants + k * task.width + lane)
                              : Batch(task.constants[k * task.width]);
  };
  const auto base = [&](std::size_t k) __attribute__((always_inline)) {
    return LinkBase<Batch>{row(k), row(k + 1), row(k + 2), row(k + 3)};
  };
  FourBarSweepMachine<Batch> m;
  m.fx = row(0), m.fy = row(1);
  const Batch ground = row(2), coupler = row(4), rocker = row(5);
  m.shape = four_bar_shape<Batch>(ground * m.fx, ground * m.fy, row(3), coupler, rocker, row(6));
  m.bases = {base(7), base(11), base(15)};
  const Batch nearest = Batch(tolerance::closure) * (coupler + rocker);
  m.nearest = nearest * nearest;
  m.gravity = Batch(task.gravity);
  return m;
}

/// One register of samples with the crank along (e1x, e1y), written from `out` on; returns 1 where the result
/// holds.
template <class Batch>
LINKWRIGHT_KERNEL Batch four_bar_sample(const FourBarSweepTask& task, const FourBarSweepMachine<Batch>& m,
                                        const Batch& e1x, const Batch& e1y, const Batch& rate,
                                        const Batch& acceleration, double* out) {
  using S = math::Scalar<Batch>;
  const FourBarShape<Batch>& l = m.shape;
  const Closure<Batch> closure = close_at_crank(l, e1x, e1y);
  const Batch size = sine_size(l, closure);
  // One division for 1 / R^2 and 1 / sine; R^2 over the lengths, so that the product stays in range.
  const Batch relative = closure.r2 * l.by_both;
  const Batch inverse = Batch(1.0) / (relative * size);
  const Batch half = Batch(0.5) * l.by_both * (inverse * size), by_sine = l.sign * (inverse * relative);
  const FourBarDirections<Batch> e = four_bar_directions(l, e1x, e1y, closure, half);
  const auto put = [&](FourBarRow row, const Batch& value) __attribute__((always_inline)) {
    value.store_unaligned(out + task.first[static_cast<std::size_t>(row)] * task.lanes);
  };
  using R = FourBarRow;
  if (task.wanted.directions) {
    put(R::crank_x, e.e1x), put(R::crank_y, e.e1y);
    put(R::coupler_x, e.e2x), put(R::coupler_y, e.e2y);
    put(R::rocker_x, e.e3x), put(R::rocker_y, e.e3y);
    put(R::transmission_sine, l.sign * size);
  }
  const bool forces = task.wanted.forces || task.wanted.shaking;
  if (task.wanted.rates || forces) {
    const FourBarTurning<Batch> t = four_bar_turning(l, e, by_sine, rate, acceleration);
    if (task.wanted.rates) {
      put(R::coupler_speed, t.w2), put(R::rocker_speed, t.w3);
      put(R::coupler_acceleration, t.a2), put(R::rocker_acceleration, t.a3);
    }
    if (forces) {
      const FourBarForces<Batch> f = four_bar_forces(l, e, by_sine, t, m.bases, m.gravity);
      if (task.wanted.forces) {
        put(R::ground_on_crank_x, f.ground_on_crank_x), put(R::ground_on_crank_y, f.ground_on_crank_y);
        put(R::crank_on_coupler_x, f.crank_on_coupler_x), put(R::crank_on_coupler_y, f.crank_on_coupler_y);
        put(R::rocker_on_coupler_x, f.rocker_on_coupler_x),
            put(R::rocker_on_coupler_y, f.rocker_on_coupler_y);
        put(R::ground_on_rocker_x, f.ground_on_rocker_x), put(R::ground_on_rocker_y, f.ground_on_rocker_y);
      }
      if (task.wanted.shaking) {
        put(R::drive_torque, f.drive_torque);
        put(R::shaking_force_x, f.shaking_x), put(R::shaking_force_y, f.shaking_y);
        put(R::shaking_moment, f.shaking_moment);
        put(R::shaking_moment_with_drive, f.shaking_moment_with_drive);
      }
    }
  }
  const auto good = (size >= Batch(tolerance::toggle_angle)) & (closure.r2 > m.nearest);
  return S::choose(good, Batch(1.0), Batch(0.0));
}

/// Drives the kernel over registers of angles or of machines. The smallest of all `good` says whether all
/// are.
template <class Batch>
LINKWRIGHT_KERNEL bool four_bar_sweep_with(const FourBarSweepTask& task) {
  using S = math::Scalar<Batch>;
  Batch all(1.0);
  if (task.over_machines) {
    for (std::size_t k = task.begin; k < task.end; k += Batch::size) {
      const FourBarSweepMachine<Batch> m = load_machine<Batch>(task, k);
      for (std::size_t i = 0; i < task.angles; ++i) {
        const Batch ux(task.cosine[i]), uy(task.sine[i]);
        const Batch good =
            four_bar_sample<Batch>(task, m, m.fx * ux - m.fy * uy, m.fx * uy + m.fy * ux, Batch(task.rate[i]),
                                   Batch(task.acceleration[i]), task.data + i * task.rows * task.lanes + k);
        good.store_unaligned(task.good + i * task.lanes + k);
        all = S::min(all, good);
      }
    }
  } else {
    const FourBarSweepMachine<Batch> m = load_machine<Batch>(task, 0);
    for (std::size_t k = task.begin; k < task.end; k += Batch::size) {
      const Batch angle = Batch::load_unaligned(task.angle + k);
      Batch e1x, e1y;
      math::sincos(angle, e1y, e1x);
      const Batch found = four_bar_sample<Batch>(task, m, e1x, e1y, Batch::load_unaligned(task.rate + k),
                                                 Batch::load_unaligned(task.acceleration + k), task.data + k);
      const Batch good = S::choose(S::abs(angle) <= Batch(1e5), found, Batch(0.0));  // range of sincos
      good.store_unaligned(task.good + k);
      all = S::min(all, good);
    }
  }
  double lanes[Batch::size];
  all.store_unaligned(lanes);
  for (const double lane : lanes)
    if (lane == 0) return false;
  return true;
}

bool LINKWRIGHT_COMPILED(four_bar_sweep)(const FourBarSweepTask& task) {
  return four_bar_sweep_with<math::KernelBatch>(task);
}

}  // namespace linkwright::planar
