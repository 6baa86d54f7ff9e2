// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Vectors of the plane, written as numbers and not as std::complex, whose product looks for infinities.
namespace linkwright::flexible {

/// A vector of the plane.
struct Vec2 {
  double x = 0,  ///< along the first axis
      y = 0;     ///< along the second axis
  /// Compares two vectors. @returns true if both components are equal
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// The sum of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a + b
constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }

/// The difference of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a - b
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }

/// The opposite vector.
///
/// @param a a vector
/// @returns -a
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }

/// A vector times a number.
///
/// @param k a number
/// @param a a vector
/// @returns k a
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }

/// Adds a vector to another.
///
/// @param a the vector that is changed
/// @param b the vector that is added
/// @returns a
constexpr Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }

/// The scalar product of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a . b
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

/// The third component of the vector product.
///
/// @param a a vector
/// @param b another
/// @returns a.x b.y - a.y b.x
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// A vector turned by a right angle, counter-clockwise.
///
/// @param a a vector
/// @returns the turned vector
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }

/// A vector turned by the angle of a unit vector.
///
/// @param e the unit vector
/// @param a the vector
/// @returns the turned vector
constexpr Vec2 turned(Vec2 e, Vec2 a) { return {e.x * a.x - e.y * a.y, e.y * a.x + e.x * a.y}; }

/// A vector turned back by the angle of a unit vector.
///
/// @param e the unit vector
/// @param a the vector
/// @returns the turned vector
constexpr Vec2 turned_back(Vec2 e, Vec2 a) { return {e.x * a.x + e.y * a.y, e.x * a.y - e.y * a.x}; }

}  // namespace linkwright::flexible
