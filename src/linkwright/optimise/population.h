// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace linkwright::optimise {

/// Read-only matrix of candidates, one row per variable, so that a vector register holds one variable of
/// several candidates. Rows start at multiples of 64 bytes and may be read (not used) up to `stride`.
struct PopulationView {
  const double* data = nullptr;
  std::size_t dimension = 0;  ///< variables
  std::size_t size = 0;       ///< candidates
  std::size_t stride = 0;     ///< distance of two rows, a multiple of 8

  const double* row(std::size_t variable) const { return data + variable * stride; }
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  /// Candidates [first, first + count); first must be a multiple of 8.
  PopulationView slice(std::size_t first, std::size_t count) const {
    return {data + first, dimension, count, stride};
  }
};

/// Owns a matrix of candidates in the layout of PopulationView; padding candidates hold zeros at first.
class Population {
 public:
  Population() = default;
  Population(std::size_t dimension, std::size_t size);

  std::size_t dimension() const { return dimension_; }
  std::size_t size() const { return size_; }
  double* row(std::size_t variable) { return data_.get() + variable * stride_; }
  const double* row(std::size_t variable) const { return data_.get() + variable * stride_; }
  double& operator()(std::size_t variable, std::size_t candidate) { return row(variable)[candidate]; }
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  PopulationView view() const { return {data_.get(), dimension_, size_, stride_}; }

  void set(std::size_t candidate, std::span<const double> x);
  void get(std::size_t candidate, std::span<double> x) const;

 private:
  struct Free {
    void operator()(double* p) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t dimension_ = 0, size_ = 0, stride_ = 0;
};

}  // namespace linkwright::optimise
