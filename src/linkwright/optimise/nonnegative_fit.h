// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

namespace linkwright::optimise {

/// The x >= 0 that makes |A x - b| least, and that least norm: the method of Lawson and Hanson (1974, chapter
/// 23). `columns` holds A column by column, b.size() numbers each, x.size() columns. Columns of zeros get 0.
/// Throws ContractError for spans of wrong length.
double fit_nonnegative(std::span<const double> columns, std::span<const double> b, std::span<double> x);

}  // namespace linkwright::optimise
