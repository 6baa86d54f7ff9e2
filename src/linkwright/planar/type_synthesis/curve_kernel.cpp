// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/simd.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/program_kernel.h"

namespace linkwright::planar {
namespace {

using Batch = math::KernelBatch;

/// One register of crank angles from sample `k` on.
template <bool with_tangent>
LINKWRIGHT_KERNEL void curve_at(const CurveTask& task, std::size_t k,
                                program_kernel::ProgramState<Batch>& s) {
  const PointProgram& program = *task.program;
  const std::size_t last = program.steps.size() - 1;
  program_kernel::forward<with_tangent>(program, task.x, task.signs, Batch::load_unaligned(task.angle + k),
                                        s);
  const double *place = task.x + program.place(), *scale = task.x + program.scale();
  const Batch sx(scale[0]), sy(scale[1]);
  const auto& c = s.steps[last];
  if (task.px) {
    (Batch(place[0]) + sx * c.x - sy * c.y).store_unaligned(task.px + k);
    (Batch(place[1]) + sx * c.y + sy * c.x).store_unaligned(task.py + k);
  }
  if constexpr (with_tangent) {
    (sx * c.dx - sy * c.dy).store_unaligned(task.tx + k);
    (sx * c.dy + sy * c.dx).store_unaligned(task.ty + k);
  }
  if (task.bx) {
    const auto pins = program.traced_pins();
    const auto &from = s.steps[pins[0]], &to = s.steps[pins[1]];
    const Batch dx = to.x - from.x, dy = to.y - from.y;
    (sx * dx - sy * dy).store_unaligned(task.bx + k);
    (sx * dy + sy * dx).store_unaligned(task.by + k);
    if constexpr (with_tangent)
      ((dx * (to.dy - from.dy) - dy * (to.dx - from.dx)) / (dx * dx + dy * dy))
          .store_unaligned(task.rate + k);
  }
  if (task.quality) {
    Batch least, where;
    program_kernel::worst_pair(program, s, least, where);
    least.store_unaligned(task.quality + k);
    where.store_unaligned(task.worst + k);
  }
  if (task.points)
    for (std::size_t i = 0; i <= last; ++i) {
      s.steps[i].x.store_unaligned(task.points + 2 * i * task.count + k);
      s.steps[i].y.store_unaligned(task.points + (2 * i + 1) * task.count + k);
    }
}

/// The rows of the derivative for one register.
LINKWRIGHT_KERNEL void rows_at(const CurveTask& task, std::size_t k, program_kernel::ProgramState<Batch>& s) {
  const PointProgram& program = *task.program;
  const std::size_t last = program.steps.size() - 1;
  const double* scale = task.x + program.scale();
  const Batch sx(scale[0]), sy(scale[1]);
  const Batch nx = Batch::load_unaligned(task.nx + k), ny = Batch::load_unaligned(task.ny + k);
  program_kernel::clear_reverse(program, s);
  auto& c = s.steps[last];
  c.bx = sx * nx + sy * ny, c.by = sx * ny - sy * nx;
  if (task.na) {
    const auto pins = program.traced_pins();
    auto &from = s.steps[pins[0]], &to = s.steps[pins[1]];
    const Batch dx = to.x - from.x, dy = to.y - from.y,
                by = Batch::load_unaligned(task.na + k) / (dx * dx + dy * dy);
    to.bx = to.bx - by * dy, to.by = to.by + by * dx;
    from.bx = from.bx + by * dy, from.by = from.by - by * dx;
  }
  const auto row = [&](int parameter) __attribute__((always_inline)) {
    return task.rows + static_cast<std::size_t>(parameter) * task.stride + k;
  };
  // Each parameter belongs to one step, and so is written once.
  program_kernel::reverse(
      program, task.x, s, last, [&](int parameter, const Batch& value) __attribute__((always_inline)) {
        value.store_unaligned(row(parameter));
      });
  nx.store_unaligned(row(program.place())), ny.store_unaligned(row(program.place() + 1));
  Batch re = c.x * nx + c.y * ny, im = c.x * ny - c.y * nx;
  if (task.na) {
    const Batch by = Batch::load_unaligned(task.na + k) / (sx * sx + sy * sy);
    re = re - by * sy, im = im + by * sx;
  }
  re.store_unaligned(row(program.scale()));
  im.store_unaligned(row(program.scale() + 1));
}

void curve(const CurveTask& task) {
  program_kernel::ProgramState<Batch> s;
  if (task.program->group >= 0) s.turn = &link_group::turn_of(*task.program, task.x);
  for (std::size_t k = 0; k < task.count; k += Batch::size) {
    if (task.tx)
      curve_at<true>(task, k, s);
    else
      curve_at<false>(task, k, s);
    if (task.rows) rows_at(task, k, s);
  }
}

void products(const ProductsTask& task) {
  double* out = task.out;
  for (std::size_t i = 0; i < task.columns; ++i) {
    const double* a = task.rows + i * task.stride;
    std::size_t j = 0;
    for (; j + 4 <= i + 1; j += 4) {
      const double* b = task.rows + j * task.stride;
      Batch s0(0.0), s1(0.0), s2(0.0), s3(0.0);
      for (std::size_t k = 0; k < task.count; k += Batch::size) {
        const Batch v = Batch::load_unaligned(a + k);
        s0 = math::Scalar<Batch>::multiply_add(v, Batch::load_unaligned(b + k), s0);
        s1 = math::Scalar<Batch>::multiply_add(v, Batch::load_unaligned(b + task.stride + k), s1);
        s2 = math::Scalar<Batch>::multiply_add(v, Batch::load_unaligned(b + 2 * task.stride + k), s2);
        s3 = math::Scalar<Batch>::multiply_add(v, Batch::load_unaligned(b + 3 * task.stride + k), s3);
      }
      *out++ = xsimd::hadd(s0), *out++ = xsimd::hadd(s1), *out++ = xsimd::hadd(s2), *out++ = xsimd::hadd(s3);
    }
    for (; j <= i; ++j) {
      const double* b = task.rows + j * task.stride;
      Batch sum(0.0);
      for (std::size_t k = 0; k < task.count; k += Batch::size)
        sum = math::Scalar<Batch>::multiply_add(Batch::load_unaligned(a + k), Batch::load_unaligned(b + k),
                                                sum);
      *out++ = xsimd::hadd(sum);
    }
  }
}

}  // namespace

const CurveKernel LINKWRIGHT_COMPILED(machine_curve) = {&curve, &products};

}  // namespace linkwright::planar
