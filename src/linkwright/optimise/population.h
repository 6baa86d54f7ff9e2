// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace linkwright::optimise {

/// Read-only matrix of candidates, one row per variable, so that a vector register holds one variable of
/// several candidates. Rows start at multiples of 64 bytes and may be read (not used) up to `stride`.
struct PopulationView {
  const double* data = nullptr;  ///< first row
  std::size_t dimension = 0;     ///< variables
  std::size_t size = 0;          ///< candidates
  std::size_t stride = 0;        ///< distance of two rows, a multiple of 8

  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  const double* row(std::size_t variable) const { return data + variable * stride; }
  /// A variable of a candidate.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  /// The candidates [first, first + count).
  ///
  /// @param first index of the first candidate, a multiple of 8
  /// @param count number of candidates
  /// @returns a view of them
  PopulationView slice(std::size_t first, std::size_t count) const {
    return {data + first, dimension, count, stride};
  }
};

/// Owns a matrix of candidates in the layout of PopulationView; padding candidates hold zeros at first.
class Population {
 public:
  /// An empty population.
  Population() = default;
  /// A population whose variables are all zero.
  ///
  /// @param dimension number of variables
  /// @param size number of candidates
  Population(std::size_t dimension, std::size_t size);

  /// The number of variables. @returns the number
  std::size_t dimension() const { return dimension_; }
  /// The number of candidates. @returns the number
  std::size_t size() const { return size_; }
  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  double* row(std::size_t variable) { return data_.get() + variable * stride_; }
  /// The row of a variable.
  ///
  /// @param variable index of the variable
  /// @returns its values, one a candidate
  const double* row(std::size_t variable) const { return data_.get() + variable * stride_; }
  /// A variable of a candidate, to be changed.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double& operator()(std::size_t variable, std::size_t candidate) { return row(variable)[candidate]; }
  /// A variable of a candidate.
  ///
  /// @param variable index of the variable
  /// @param candidate index of the candidate
  /// @returns its value
  double operator()(std::size_t variable, std::size_t candidate) const { return row(variable)[candidate]; }
  /// The population as a matrix to be read. @returns the view; valid as long as the population
  PopulationView view() const { return {data_.get(), dimension_, size_, stride_}; }

  /// Sets the variables of a candidate.
  ///
  /// @param candidate index of the candidate
  /// @param x its variables
  /// @throws ContractError unless there is such a candidate and a value for each variable
  void set(std::size_t candidate, std::span<const double> x);
  /// Reads the variables of a candidate.
  ///
  /// @param candidate index of the candidate
  /// @param x receives its variables
  /// @throws ContractError unless there is such a candidate and room for each variable
  void get(std::size_t candidate, std::span<double> x) const;

 private:
  struct Free {
    void operator()(double* p) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t dimension_ = 0, size_ = 0, stride_ = 0;
};

}  // namespace linkwright::optimise
