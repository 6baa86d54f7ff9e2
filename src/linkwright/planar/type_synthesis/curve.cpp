// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/curve.h"

#include <algorithm>

#include "linkwright/planar/type_synthesis/detail/program_kernel.h"

namespace linkwright::planar {

KernelSet<const CurveKernel> machine_curve_kernels() { return LINKWRIGHT_KERNEL_SET(machine_curve); }

void compute_curve(const CurveTask& task) { widest_of<machine_curve_kernels>().run->curve(task); }
void compute_products(const ProductsTask& task) { widest_of<machine_curve_kernels>().run->products(task); }

double quality_gradient(const PointProgram& program, std::span<const double> x, unsigned signs, double angle,
                        int step, std::span<double> gradient) {
  program_kernel::ProgramState<double> s;
  if (program.group >= 0) s.turn = &link_group::turn_of(program, x.data());
  program_kernel::forward<false>(program, x.data(), signs, angle, s);
  program_kernel::clear_reverse(program, s);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  const auto add = [&](int parameter, double value) {
    gradient[static_cast<std::size_t>(parameter)] += value;
  };
  const auto i = static_cast<std::size_t>(step);
  program_kernel::reverse_quality(program, x.data(), s, i, add);
  program_kernel::reverse(program, x.data(), s, i, add);
  return s.steps[i].quality;
}

}  // namespace linkwright::planar
