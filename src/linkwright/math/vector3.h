#pragma once

#include <array>
#include <cmath>

namespace linkwright::math {

/// A point or a direction of space.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// NaN for a vector of no length.
inline Vec3 unit(const Vec3& a) { return (1 / norm(a)) * a; }

/// Two unit vectors across the unit vector `a`, so that a, first, second are right-handed.
inline std::array<Vec3, 2> across(const Vec3& a) {
  const Vec3 away = std::abs(a.x) < std::abs(a.y)
                        ? (std::abs(a.x) < std::abs(a.z) ? Vec3{1, 0, 0} : Vec3{0, 0, 1})
                        : (std::abs(a.y) < std::abs(a.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  const Vec3 first = unit(cross(a, away));
  return {first, cross(a, first)};
}

/// 3 x 3, by rows. As a rotation it takes coordinates of the turned body to fixed ones.
struct Mat3 {
  std::array<Vec3, 3> row{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  friend bool operator==(const Mat3&, const Mat3&) = default;
};

constexpr Vec3 operator*(const Mat3& m, const Vec3& a) {
  return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)};
}
constexpr Mat3 transposed(const Mat3& m) {
  const auto& [a, b, c] = m.row;
  return {{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}};
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 t = transposed(b);
  return {{t * a.row[0], t * a.row[1], t * a.row[2]}};
}

/// Right-handed turns about the axes (rad).
inline Mat3 turn_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{1, 0, 0}, Vec3{0, c, -s}, Vec3{0, s, c}}};
}
inline Mat3 turn_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}}};
}
inline Mat3 turn_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
}

/// Turn about the vector `turn` by its length (rad): exp of its cross-product matrix.
Mat3 turn_about(const Vec3& turn);

/// The rotation nearest to `m`, which is one but for rounding: an error e leaves e^2.
Mat3 rectified(const Mat3& m);

/// Mirror image in the plane y = 0 of a point or direction; of a rotation vector (angular velocity) it is the
/// opposite; of a rotation S m S.
constexpr Vec3 mirrored(const Vec3& a) { return {a.x, -a.y, a.z}; }
constexpr Mat3 mirrored(const Mat3& m) {
  return {{mirrored(m.row[0]), -mirrored(m.row[1]), mirrored(m.row[2])}};
}

}  // namespace linkwright::math
