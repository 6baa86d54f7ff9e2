// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/detail/ode_vectors.h"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>

namespace linkwright::math {
namespace {

// Element by element, so that results may take the place of operands.

int linear_combination(int count, realtype* factors, N_Vector* x, N_Vector out) {
  constexpr sunindextype width = 8;
  double* z = NV_DATA_S(out);
  const sunindextype n = NV_LENGTH_S(out);
  sunindextype j = 0;
  for (; j + width <= n; j += width) {
    double sum[width] = {};
    for (int i = 0; i < count; ++i) {
      const double factor = factors[i];
      if (factor == 0) continue;  // a quarter of the weights of a pair
      const double* values = NV_DATA_S(x[i]) + j;
      for (sunindextype k = 0; k < width; ++k) sum[k] += factor * values[k];
    }
    std::copy_n(sum, width, z + j);
  }
  for (; j < n; ++j) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += factors[i] * NV_DATA_S(x[i])[j];
    z[j] = sum;
  }
  return 0;
}

void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  for (sunindextype j = 0; j < NV_LENGTH_S(z); ++j)
    NV_DATA_S(z)[j] = a * NV_DATA_S(x)[j] + b * NV_DATA_S(y)[j];
}

void scale(realtype factor, N_Vector x, N_Vector z) {
  const double* from = NV_DATA_S(x);
  double* to = NV_DATA_S(z);
  const sunindextype n = NV_LENGTH_S(z);
  if (factor == 1) {
    if (from != to) std::copy_n(from, n, to);
    return;
  }
  for (sunindextype j = 0; j < n; ++j) to[j] = factor * from[j];
}

realtype root_mean_square(N_Vector x, N_Vector weights) {
  const double* values = NV_DATA_S(x);
  const double* w = NV_DATA_S(weights);
  const sunindextype n = NV_LENGTH_S(x);
  double sum = 0;
  for (sunindextype j = 0; j < n; ++j) sum += (values[j] * w[j]) * (values[j] * w[j]);
  return std::sqrt(sum / static_cast<double>(n));
}

void magnitude(N_Vector x, N_Vector z) {
  std::transform(NV_DATA_S(x), NV_DATA_S(x) + NV_LENGTH_S(x), NV_DATA_S(z),
                 [](double v) { return std::abs(v); });
}

void inverse(N_Vector x, N_Vector z) {
  std::transform(NV_DATA_S(x), NV_DATA_S(x) + NV_LENGTH_S(x), NV_DATA_S(z), [](double v) { return 1 / v; });
}

void add_constant(N_Vector x, realtype b, N_Vector z) {
  std::transform(NV_DATA_S(x), NV_DATA_S(x) + NV_LENGTH_S(x), NV_DATA_S(z), [b](double v) { return v + b; });
}

}  // namespace

void use_our_loops(_generic_N_Vector* vector) {
  auto& ops = *vector->ops;
  ops.nvlinearcombination = linear_combination;
  ops.nvlinearsum = linear_sum;
  ops.nvscale = scale;
  ops.nvwrmsnorm = root_mean_square;
  ops.nvabs = magnitude;
  ops.nvinv = inverse;
  ops.nvaddconst = add_constant;
}

}  // namespace linkwright::math
