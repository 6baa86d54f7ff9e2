// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/generator.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/planar/dyads/solve.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Pivots nearer than this to where the ground itself is a solution are that one.
constexpr double trivial = 1e-6;
// Links longer than this, in grounds or in sizes of the slide, are slides in truth.
constexpr double endless = 1e7;

Complex coupler(const FunctionGenerator& g, double input, double output) {
  const Complex pin = g.a * std::polar(1.0, input);
  return g.slider ? output + g.b - pin : 1.0 + g.b * std::polar(1.0, output) - pin;
}

// The squared sine that the pair angle has where the branches count as one.
constexpr double min_square = 2 * branches_meet;

// Sine of the angle between coupler and output link, signed by the branch.
double side(const FunctionGenerator& g, double input, double output) {
  const Complex u = coupler(g, input, output);
  if (g.slider) return u.real() / std::abs(u);
  return std::imag(std::conj(1.0 - g.a * std::polar(1.0, input)) * u) / (std::abs(u) * std::abs(g.b));
}

}  // namespace

std::optional<GeneratorOutput> output_at(const FunctionGenerator& g, double input) {
  const Complex turn = std::polar(1.0, input), pin = g.a * turn, i(0, 1);
  GeneratorOutput out;
  Complex u, along;  // coupler; how the output moves its end
  if (g.slider) {
    const double across = g.b.imag() - pin.imag(), square = g.c * g.c - across * across;
    if (!(square > 0)) return std::nullopt;
    out.output = pin.real() - g.b.real() + g.branch * std::sqrt(square);
    u = coupler(g, input, out.output);
    along = 1;
    out.sine = std::abs(u.real()) / g.c;
  } else {
    const Complex d = pin - 1.0;
    const double r = std::abs(d), arm = std::abs(g.b);
    const double cosine = (r * r + arm * arm - g.c * g.c) / (2 * r * arm);
    const double square = ((arm + g.c) * (arm + g.c) - r * r) * (r * r - (arm - g.c) * (arm - g.c));
    if (!(square > 0) || !(r > 0)) return std::nullopt;
    const Complex rocker = arm * (d / r) * Complex(cosine, -g.branch * std::sqrt(square) / (2 * r * arm));
    out.output = std::arg(rocker / g.b);
    u = 1.0 + rocker - pin;
    along = i * rocker;
    out.sine = std::abs(std::imag(std::conj(u) * rocker)) / (std::abs(u) * arm);
  }
  const Complex bar = std::conj(u);
  const double by_output = std::real(bar * along);
  const Complex by_b = g.slider ? Complex(1) : std::polar(1.0, out.output);
  out.slopes = {std::real(bar * turn) / by_output, std::real(bar * i * turn) / by_output,
                -std::real(bar * by_b) / by_output, -std::real(bar * i * by_b) / by_output, g.c / by_output};
  return out;
}

PairCosine pair_cosine(const FunctionGenerator& g, double input) {
  const Complex turn = std::polar(1.0, input), pin = g.a * turn, i(0, 1);
  if (g.slider)
    return {(g.b.imag() - pin.imag()) / g.c,
            -pin.real() / g.c,
            {-turn.imag() / g.c, -turn.real() / g.c, 0, 1 / g.c, (pin.imag() - g.b.imag()) / (g.c * g.c)}};
  const double rocker = std::abs(g.b), below = 2 * g.c * rocker;
  const Complex pull = 2.0 * std::conj(1.0 - pin);  // decrease of the square of the distance by the pin
  PairCosine out;
  out.value = (g.c * g.c + rocker * rocker - std::norm(1.0 - pin)) / below;
  const Complex by_b = (2.0 - out.value * 2 * g.c / rocker) * g.b / below;
  out.slopes = {std::real(pull * turn) / below, std::real(pull * i * turn) / below, by_b.real(), by_b.imag(),
                (2 * g.c - out.value * 2 * rocker) / below};
  out.by_input = std::real(pull * i * pin) / below;
  return out;
}

std::optional<GeneratorPlace> place_at(const FunctionGenerator& g, double input) {
  const double beyond = std::abs(pair_cosine(g, input).value) - 1;
  if (const std::optional<GeneratorOutput> out = output_at(g, input))
    return GeneratorPlace{out->output, out->sine, beyond > -branches_meet};
  if (!(beyond < branches_meet)) return std::nullopt;
  const Complex pin = g.a * std::polar(1.0, input);
  if (g.slider) return GeneratorPlace{pin.real() - g.b.real(), 0, true};
  // Coupler and rocker lie on the line from the crank pin to the rocker pivot: the rocker points back along
  // it unless the coupler is the longer one and reaches over the pivot, or the pin lies inside.
  const Complex d = pin - 1.0;
  const double r = std::abs(d), arm = std::abs(g.b);
  if (!(r > 0)) return std::nullopt;
  const double towards = r * r + arm * arm < g.c * g.c ? -1 : 1;
  return GeneratorPlace{std::arg(towards * (d / r) / g.b), 0, true};
}

std::vector<FunctionGenerator> exact_generators(std::span<const FunctionPair> pairs, bool slider,
                                                const StartAngles& given) {
  LINKWRIGHT_REQUIRE(pairs.size() + given.input.has_value() + given.output.has_value() == 5, "{} pairs",
                     pairs.size());
  LINKWRIGHT_REQUIRE(!(slider && given.output), "a slider has no start angle");
  // Seen from the crank, the rocker (or slider) is a body whose pin stays at the coupler's length from a.
  std::vector<BodyPose> poses;
  double size = 1;
  for (const FunctionPair& p : pairs) {
    if (slider) size = std::max(size, std::abs(p.output));
    poses.push_back(slider ? BodyPose{p.output * std::polar(1.0, -p.input), -p.input}
                           : BodyPose{std::polar(1.0, -p.input), p.output - p.input});
  }
  Prescription prescription;
  if (given.input) prescription.fixed_line = PivotLine{0, std::polar(1.0, *given.input)};
  if (given.output) prescription.moving_line = PivotLine{0, std::polar(1.0, *given.output)};
  std::vector<FunctionGenerator> out;
  const GuidingDyads dyads = solve_dyads(poses, prescription);
  for (const GuidingDyad& dyad : dyads.real()) {
    if (dyad.type != GuidingDyadType::rr || std::abs(dyad.fixed) > endless * size ||
        std::abs(dyad.moving) > endless * size)
      continue;
    if (std::abs(dyad.fixed) < trivial || std::abs(dyad.moving) < (slider ? 0 : trivial)) continue;
    FunctionGenerator g{slider, dyad.fixed, dyad.moving, dyad.length, 1};
    // The side is rounding where the branches meet.
    for (const FunctionPair& p : pairs) {
      const double here = side(g, p.input, p.output);
      if (!(here * here > min_square)) continue;
      g.branch = here < 0 ? -1 : 1;
      break;
    }
    out.push_back(g);
  }
  return out;
}

}  // namespace linkwright::planar
