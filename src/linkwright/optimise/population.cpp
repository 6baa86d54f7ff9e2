// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <new>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {
namespace {
constexpr std::align_val_t alignment{64};
}

void Population::Free::operator()(double* p) const { ::operator delete[](p, alignment); }

Population::Population(std::size_t dimension, std::size_t size)
    : dimension_(dimension), size_(size), stride_((size + 7) / 8 * 8) {
  const std::size_t count = dimension_ * stride_;
  data_.reset(
      static_cast<double*>(::operator new[](std::max<std::size_t>(count, 8) * sizeof(double), alignment)));
  std::fill_n(data_.get(), count, 0.0);
}

void Population::set(std::size_t candidate, std::span<const double> x) {
  LINKWRIGHT_REQUIRE(candidate < size_ && x.size() == dimension_,
                     "candidate {} of {}, {} values for {} variables", candidate, size_, x.size(),
                     dimension_);
  for (std::size_t i = 0; i < dimension_; ++i) (*this)(i, candidate) = x[i];
}

void Population::get(std::size_t candidate, std::span<double> x) const {
  LINKWRIGHT_REQUIRE(candidate < size_ && x.size() == dimension_,
                     "candidate {} of {}, {} values for {} variables", candidate, size_, x.size(),
                     dimension_);
  for (std::size_t i = 0; i < dimension_; ++i) x[i] = (*this)(i, candidate);
}

}  // namespace linkwright::optimise
