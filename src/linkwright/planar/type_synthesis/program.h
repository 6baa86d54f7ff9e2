// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"

// Types of one-freedom linkages as programs of points: operations that place one pin after the other, from
// the crank to the traced point. The crank and the ground are in a scale of their own, in which the crank has
// the length 1 and turns about the origin; two complex numbers place the plane of the machine in the global
// frame.
namespace linkwright::planar {

/// Operation that gives a point of the plane; its parameters, complex ones as (re, im), are numbers of the
/// machine.
enum class PointOperation {
  crank_pin,       ///< e^(i theta); no parameters
  ground_on_axis,  ///< ground pivot g on the real axis: g
  ground,          ///< ground pivot anywhere: G
  crank_plate,     ///< point c e^(i theta) of the crank: c
  plate,           ///< point P + c (Q - P) of a bar with the pins P and Q: c
  pair,            ///< pin at l1 from P and l2 from Q; sign 0: to the left of P -> Q: l1, l2
  slide,           ///< end of a rod of length L from P on the line Im = h, to the right of P: L, h
  sleeve,          ///< unit step from P along a rod through a sleeve that swings about g, with offset e: g, e
  geared_crank,    ///< pin E + c e^(i rho theta) of a crank that is geared to the first: E, c
  /// Point P + c e^(i phi) of a link of a group of four that is hinged at P and has turned by phi since crank
  /// angle zero: c.
  group_point,
};

/// One operation. `first` and `second` number earlier points, P and Q above.
struct PointStep {
  PointOperation operation{};
  int first = -1, second = -1;
  int parameter = 0;  ///< index of its first parameter
  int sign = -1;      ///< index of its sign bit, -1 if it has none
};

/// What of a machine is to move as it is wanted.
enum class MachineOutput {
  point,  ///< a point of a bar, and the bar with it
  angle,  ///< a link that turns about the ground, or in a sleeve that does, by its angle
  slide,  ///< a slider on the ground, by its travel
};

/// Families of machines in which a search looks for the best.
enum class MachineFamily {
  four_bar,
  slider_crank,
  inverted_slider,
  geared_five_bar,
  watt_1,
  stephenson_1,
  stephenson_3,
  eight_bar,
  ten_bar,
  stephenson_2,  // atlases are drawn from the number of their family: new ones come last
  watt_2,
};
constexpr std::array<EnumName<MachineFamily>, 11> names(MachineFamily) {
  return {
      {{MachineFamily::four_bar, "four_bar", "four-bar linkage"},
       {MachineFamily::slider_crank, "slider_crank", "slider-crank"},
       {MachineFamily::inverted_slider, "inverted_slider",
        "slider-crank whose sleeve swings about the ground"},
       {MachineFamily::geared_five_bar, "geared_five_bar", "five-bar linkage with two geared cranks"},
       {MachineFamily::watt_1, "watt_1", "six-bar linkage of Watt, ternary link on the crank's side"},
       {MachineFamily::stephenson_1, "stephenson_1",
        "six-bar linkage of Stephenson, ternary links in the loop"},
       {MachineFamily::stephenson_2, "stephenson_2",
        "six-bar linkage of Stephenson whose ground and crank are binary links side by side"},
       {MachineFamily::stephenson_3, "stephenson_3", "six-bar linkage of Stephenson with a ternary ground"},
       {MachineFamily::eight_bar, "eight_bar", "eight-bar linkage of three pairs of bars"},
       {MachineFamily::ten_bar, "ten_bar", "ten-bar linkage of four pairs of bars"},
       {MachineFamily::watt_2, "watt_2",
        "six-bar linkage of Watt with a ternary ground, two four-bars in a row: for functions alone"}}};
}

/// A pair of bars that joins two links: bars 2k + 2 and 2k + 3 of pair k. Link 0 is the ground, link 1 the
/// crank.
using PairOfBars = std::array<int, 2>;

/// Links of a machine that have pins: the points that are fixed to it; the first two give its direction.
struct ProgramLink {
  std::vector<int> points;
};

/// The type of a machine. Parameters run in the order of the steps, then the place (re, im) and the scale
/// (re, im).
struct PointProgram {
  std::string name;  ///< "stephenson_3:a", "eight_bar:0213b"
  MachineFamily family{};
  MachineOutput output = MachineOutput::point;
  int links = 4;
  double gear_ratio = 0;          ///< of geared_crank: its turns for each turn of the crank
  std::vector<PairOfBars> pairs;  ///< only of machines of pairs
  bool trace_second =
      false;  ///< the traced point, or the rod of a slider, is on the second bar of the last pair
  std::vector<PointStep> steps;  ///< the last one gives the traced point, or the end of the output link
  std::vector<ProgramLink>
      bodies;  ///< ground, crank and bars; slides and sleeves have no points of their own
  /// Step of the first pin of a group of four links, -1 if there is none. Its pins are the two of the link on
  /// the ground, then those of the link on the crank pin; bars join the first ones and the second ones.
  int group = -1;
  int traced_bar = -1;  ///< body that the traced point belongs to, or whose angle is the output
  int parameters = 0;   ///< with place and scale
  int signs = 0;

  int place() const { return parameters - 4; }
  int scale() const { return parameters - 2; }

  /// The two pins that give the direction of the traced bar: points of steps.
  std::array<std::size_t, 2> traced_pins() const {
    const std::vector<int>& pins = bodies[static_cast<std::size_t>(traced_bar)].points;
    return {static_cast<std::size_t>(pins[0]), static_cast<std::size_t>(pins[1])};
  }
};

/// The parameters of a machine and the signs of its pairs, one bit each.
struct MachineShape {
  const PointProgram* program = nullptr;  ///< lives as long as the process
  unsigned signs = 0;
  std::vector<double> x;
};

/// The types of a family up to eight links, each once: isomorphs by graph, ground, driver and traced link are
/// left out, and machines whose output moves with a chain of fewer links. Few families have all outputs.
std::span<const PointProgram* const> programs_of(MachineFamily family,
                                                 MachineOutput output = MachineOutput::point);

/// Number of links of the machines of a family, the ground among them.
int links_of(MachineFamily family);

/// The program of 1 to 4 pairs, of which the first joins crank and ground, {1, 0}; the same address for the
/// same pairs. Parameters are in the order of these pairs.
const PointProgram& program_of_pairs(std::span<const PairOfBars> pairs, bool trace_second);

/// The program of 1 to 3 pairs whose output is the angle of the link on the ground in the last pair, which is
/// {1, 0} or {0, t}; null where a shorter one does the same.
const PointProgram* angle_program_of_pairs(std::span<const PairOfBars> pairs);

/// The program with a name, also of pairs whose isomorph has another one; null if there is none.
const PointProgram* program_named(std::string_view name);

/// A pivot on the ground: that of the crank, a pin, that of a sleeve or of a geared crank.
struct GroundPivot {
  int parameter = -1;    ///< of its place in the machine's own plane; -1: the origin, where the crank turns
  bool on_axis = false;  ///< one parameter, on the real axis; else a complex one
};

/// The pivots of a type on the ground, that of the crank first. A slide has none.
std::vector<GroundPivot> ground_pivots(const PointProgram& program);

/// Place of a pivot in the machine's own plane and in the plane that it is placed in.
std::complex<double> own_place_of(const GroundPivot& pivot, std::span<const double> x);
std::complex<double> place_of(const GroundPivot& pivot, const PointProgram& program,
                              std::span<const double> x);

/// The mirror image about the real axis: it traces the mirrored curve with the crank turning in the other
/// sense.
MachineShape mirrored(const MachineShape& machine);

}  // namespace linkwright::planar
