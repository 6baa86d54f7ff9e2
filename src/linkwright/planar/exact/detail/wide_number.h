#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "linkwright/math/ball.h"

namespace linkwright::planar {

/// A number of 64 digits, twice those of DoubleDouble and some fifty times as slow.
using WideNumber = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<212, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

}  // namespace linkwright::planar

template <>
inline constexpr double linkwright::math::rounding_bound<linkwright::planar::WideNumber> = 0x1p-211;
