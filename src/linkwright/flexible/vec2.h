// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Vectors of the plane, written as numbers and not as std::complex, whose product looks for infinities.
namespace linkwright::flexible {

struct Vec2 {
  double x = 0, y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
constexpr Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Third component of a x b.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// a turned by a right angle, counter-clockwise.
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }
/// a turned by the angle of the unit vector e.
constexpr Vec2 turned(Vec2 e, Vec2 a) { return {e.x * a.x - e.y * a.y, e.y * a.x + e.x * a.y}; }
/// a turned back by it.
constexpr Vec2 turned_back(Vec2 e, Vec2 a) { return {e.x * a.x + e.y * a.y, e.x * a.y - e.y * a.x}; }

}  // namespace linkwright::flexible
