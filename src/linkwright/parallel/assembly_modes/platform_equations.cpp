// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace linkwright::parallel {
namespace {

// Product of two complex numbers, without the look for infinities that std::complex makes.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Six operator+(const Six& a, const Six& b) {
  Six out;
  for (int i = 0; i < 6; ++i) out.re[i] = a.re[i] + b.re[i], out.im[i] = a.im[i] + b.im[i];
  return out;
}
Six operator-(const Six& a, const Six& b) {
  Six out;
  for (int i = 0; i < 6; ++i) out.re[i] = a.re[i] - b.re[i], out.im[i] = a.im[i] - b.im[i];
  return out;
}
Six operator*(double s, const Six& a) {
  Six out;
  for (int i = 0; i < 6; ++i) out.re[i] = s * a.re[i], out.im[i] = s * a.im[i];
  return out;
}
// to += a * b
void add(Six& to, const Six& a, const Six& b) {
  for (int i = 0; i < 6; ++i) {
    to.re[i] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
    to.im[i] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
}
void add(Six& to, const Complex& a, const Six& b) {
  const double re = a.real(), im = a.imag();
  for (int i = 0; i < 6; ++i) {
    to.re[i] += re * b.re[i] - im * b.im[i];
    to.im[i] += re * b.im[i] + im * b.re[i];
  }
}
Six same(const Complex& a) {
  Six out;
  for (int i = 0; i < 6; ++i) out.re[i] = a.real(), out.im[i] = a.imag();
  return out;
}

using Quaternions = std::array<Six, 4>;

// e b - a e = (d . v, -w d + v x s) for e = (w, v), d = a - b, s = a + b.
struct Arms {
  std::array<Six, 3> d, s;

  explicit Arms(const PlatformLegs& legs) {
    for (int k = 0; k < 3; ++k) {
      d[k] = legs.base[k] - legs.platform[k];
      s[k] = legs.base[k] + legs.platform[k];
    }
  }
  void add_to(Quaternions& out, const PlatformPoint& x) const {
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      add(out[0], x[1 + k], d[k]);
      add(out[1 + k], -x[0], d[k]);
      add(out[1 + k], x[1 + l], s[m]);
      add(out[1 + k], -x[1 + m], s[l]);
    }
  }
};

// w of all legs.
Quaternions arms_at(const Arms& arms, const PlatformPoint& x) {
  Quaternions out{};
  arms.add_to(out, x);
  return out;
}

Complex product(const PlatformPoint& a, int first, const PlatformPoint& b, int second) {
  Complex out = 0;
  for (int k = 0; k < 4; ++k) out += times(a[first + k], b[second + k]);
  return out;
}

}  // namespace

PlatformLegs sum(const PlatformLegs& first, double factor, const PlatformLegs& second) {
  PlatformLegs out;
  for (int k = 0; k < 3; ++k) {
    out.base[k] = first.base[k] + factor * second.base[k];
    out.platform[k] = first.platform[k] + factor * second.platform[k];
  }
  out.square = first.square + factor * second.square;
  return out;
}

PlatformLegs scaled(const PlatformLegs& legs, Complex factor) {
  PlatformLegs out{};
  for (int k = 0; k < 3; ++k) {
    add(out.base[k], factor, legs.base[k]);
    add(out.platform[k], factor, legs.platform[k]);
  }
  add(out.square, factor * factor, legs.square);
  return out;
}

Six squares_through(const PlatformLegs& legs, const PlatformPoint& point) {
  const Quaternions w = arms_at(Arms(legs), point);
  Six sum, out;
  for (int k = 0; k < 4; ++k) add(sum, w[k], w[k] + 2.0 * same(point[4 + k]));
  const Complex first = product(point, 4, point, 4);
  sum.re[0] = first.real(), sum.im[0] = first.imag();
  add(out, 1.0 / product(point, 0, point, 0), sum);
  return out;
}

double length(const PlatformPoint& point) {
  double square = 0;
  for (const Complex& c : point) square += std::norm(c);
  return std::sqrt(square);
}

PlatformPoint normalised(const PlatformPoint& point) {
  PlatformPoint out = point;
  const double inverse = 1 / length(point);
  for (Complex& c : out) c *= inverse;
  return out;
}

PlatformPoint scaled(const PlatformPoint& point, Complex factor) {
  PlatformPoint out = point;
  for (int k = 4; k < 8; ++k) out[k] *= factor;
  return out;
}

double distance(const PlatformPoint& a, const PlatformPoint& b) {
  // |b - (a* . b) a|: exact also for small angles.
  const PlatformPoint u = normalised(a), v = normalised(b);
  Complex along = 0;
  for (int k = 0; k < 8; ++k) along += times(std::conj(u[k]), v[k]);
  double square = 0;
  for (int k = 0; k < 8; ++k) square += std::norm(v[k] - times(along, u[k]));
  return std::sqrt(square);
}

PlatformPoint conjugate(const PlatformPoint& point) {
  PlatformPoint out;
  for (int k = 0; k < 8; ++k) out[k] = std::conj(point[k]);
  return out;
}

bool EightLu::factor(const Eight& matrix) {
  lu_ = matrix;
  for (int k = 0; k < 8; ++k) {
    int pivot = k;
    double largest = -1;
    for (int i = k; i < 8; ++i) {
      const double square = lu_.re[k][i] * lu_.re[k][i] + lu_.im[k][i] * lu_.im[k][i];
      if (square > largest) largest = square, pivot = i;
    }
    if (!(largest > 0 && std::isfinite(largest))) return false;
    swapped_[k] = pivot;
    if (pivot != k)
      for (int j = 0; j < 8; ++j) {
        std::swap(lu_.re[j][k], lu_.re[j][pivot]);
        std::swap(lu_.im[j][k], lu_.im[j][pivot]);
      }
    const double re = inverse_re_[k] = lu_.re[k][k] / largest;
    const double im = inverse_im_[k] = -lu_.im[k][k] / largest;
    double* const column_re = lu_.re[k];
    double* const column_im = lu_.im[k];
    for (int i = k + 1; i < 8; ++i) {
      const double old = column_re[i];
      column_re[i] = old * re - column_im[i] * im;
      column_im[i] = old * im + column_im[i] * re;
    }
    for (int j = k + 1; j < 8; ++j) {
      const double a = lu_.re[j][k], b = lu_.im[j][k];
      for (int i = k + 1; i < 8; ++i) {
        lu_.re[j][i] -= column_re[i] * a - column_im[i] * b;
        lu_.im[j][i] -= column_re[i] * b + column_im[i] * a;
      }
    }
  }
  return true;
}

void EightLu::solve(PlatformPoint& right) const {
  double re[8], im[8];
  for (int i = 0; i < 8; ++i) re[i] = right[i].real(), im[i] = right[i].imag();
  for (int k = 0; k < 8; ++k) {
    std::swap(re[k], re[swapped_[k]]);
    std::swap(im[k], im[swapped_[k]]);
  }
  for (int k = 0; k < 8; ++k)
    for (int i = k + 1; i < 8; ++i) {
      re[i] -= lu_.re[k][i] * re[k] - lu_.im[k][i] * im[k];
      im[i] -= lu_.re[k][i] * im[k] + lu_.im[k][i] * re[k];
    }
  for (int k = 7; k >= 0; --k) {
    const double old = re[k];
    re[k] = old * inverse_re_[k] - im[k] * inverse_im_[k];
    im[k] = old * inverse_im_[k] + im[k] * inverse_re_[k];
    for (int i = 0; i < k; ++i) {
      re[i] -= lu_.re[k][i] * re[k] - lu_.im[k][i] * im[k];
      im[i] -= lu_.re[k][i] * im[k] + lu_.im[k][i] * re[k];
    }
  }
  for (int i = 0; i < 8; ++i) right[i] = {re[i], im[i]};
}

void evaluate(const PlatformLegs& legs, const PlatformPoint& x, const PlatformPoint& chart,
              PlatformValues& out) {
  const Arms arms(legs);
  const Quaternions w = arms_at(arms, x);
  Quaternions v;  // h + w
  Six f;
  for (int k = 0; k < 4; ++k) {
    const Six h = same(x[4 + k]);
    v[k] = w[k] + h;
    add(f, w[k], v[k] + h);
  }
  add(f, -product(x, 0, x, 0), legs.square);
  const Complex first = product(x, 4, x, 4);
  f.re[0] += first.real();
  f.im[0] += first.imag();
  // Half the columns: over e the transposed of e -> w on h + w, less s e; over h it is w, of the first leg h.
  Six columns[8];
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    Six& c = columns[1 + k];
    add(columns[0], v[1 + k], arms.d[k]);
    add(c, v[0], arms.d[k]);
    add(c, v[1 + m], arms.s[l]);
    Six minus;
    add(minus, v[1 + l], arms.s[m]);
    c = c - minus;
  }
  columns[0] = -1.0 * columns[0];
  for (int k = 0; k < 4; ++k) {
    add(columns[k], -x[k], legs.square);
    columns[4 + k] = w[k];
    columns[4 + k].re[0] = x[4 + k].real();
    columns[4 + k].im[0] = x[4 + k].imag();
  }
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 6; ++i) {
      out.jacobian.re[k][i] = 2 * columns[k].re[i];
      out.jacobian.im[k][i] = 2 * columns[k].im[i];
    }
    const Complex& other = x[(k + 4) % 8];
    out.jacobian.re[k][6] = other.real();
    out.jacobian.im[k][6] = other.imag();
    out.jacobian.re[k][7] = chart[k].real();
    out.jacobian.im[k][7] = -chart[k].imag();
  }
  for (int i = 0; i < 6; ++i) out.value[i] = {f.re[i], f.im[i]};
  out.value[6] = product(x, 0, x, 4);
  out.value[7] = 0;
  for (int k = 0; k < 8; ++k) out.value[7] += times(std::conj(chart[k]), x[k] - chart[k]);
}

void expand(const PlatformLegs& legs, const PlatformLegs& rate, const PlatformPoint& x, const EightLu& lu,
            PlatformSeries& out) {
  const Arms arms(legs), change(rate);
  std::array<Quaternions, series_order + 1> w, z;  // z = w + 2 h
  std::array<Complex, series_order + 1> n;
  const auto finish = [&](int k) {
    for (int q = 0; q < 4; ++q) z[k][q] = w[k][q] + 2.0 * same(out[k][4 + q]);
  };
  out[0] = x;
  w[0] = arms_at(arms, x);
  n[0] = product(x, 0, x, 0);
  finish(0);
  for (int k = 1; k <= series_order; ++k) {
    // The part of order k that the terms below give; the Jacobian times term k makes up the rest.
    Quaternions known{};
    change.add_to(known, out[k - 1]);
    Six f;
    for (int q = 0; q < 4; ++q) {
      add(f, known[q], w[0][q] + z[0][q]);
      for (int j = 1; j < k; ++j) add(f, w[j][q], z[k - j][q]);
    }
    Complex squares = 0, study = 0, first = 0;
    for (int j = 1; j < k; ++j) {
      squares += product(out[j], 0, out[k - j], 0);
      study += product(out[j], 0, out[k - j], 4);
      first += product(out[j], 4, out[k - j], 4);
    }
    add(f, -squares, legs.square);
    add(f, -n[k - 1], rate.square);
    f.re[0] += first.real();
    f.im[0] += first.imag();
    for (int i = 0; i < 6; ++i) out[k][i] = {-f.re[i], -f.im[i]};
    out[k][6] = -study;
    out[k][7] = 0;
    lu.solve(out[k]);
    arms.add_to(known, out[k]);
    w[k] = known;
    n[k] = squares + 2.0 * product(out[0], 0, out[k], 0);
    finish(k);
  }
}

}  // namespace linkwright::parallel
