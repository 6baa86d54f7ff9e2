// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/program.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/planar/chains/pair_order.h"

namespace linkwright::planar {
namespace {

constexpr std::array<int, 10> parameters_of{0, 1, 2, 2, 2, 2, 2, 2, 4, 2};  // in the order of PointOperation

/// Appends an operation and returns the index of its point.
int add_step(PointProgram& p, PointOperation operation, int first = -1, int second = -1) {
  PointStep step{.operation = operation, .first = first, .second = second, .parameter = p.parameters};
  if (operation == PointOperation::pair || operation == PointOperation::sleeve) step.sign = p.signs++;
  p.parameters += parameters_of[static_cast<std::size_t>(operation)];
  p.steps.push_back(step);
  return static_cast<int>(p.steps.size()) - 1;
}

/// A new point of a link that is not one of its first pins.
int add_point(PointProgram& p, int link) {
  ProgramLink& body = p.bodies[static_cast<std::size_t>(link)];
  const int point = link == 0   ? add_step(p, PointOperation::ground)
                    : link == 1 ? add_step(p, PointOperation::crank_plate)
                                : add_step(p, PointOperation::plate, body.points[0], body.points[1]);
  body.points.push_back(point);
  return point;
}

/// Joins points of two links by a pair of bars.
void add_pair(PointProgram& p, int first, int second) {
  const int pin = add_step(p, PointOperation::pair, first, second);
  p.bodies.push_back({{first, pin}});
  p.bodies.push_back({{second, pin}});
}

PointProgram begin_program(MachineFamily family, std::string name, int links) {
  PointProgram p;
  p.name = std::move(name), p.family = family, p.links = links;
  p.bodies.resize(2);
  p.bodies[1].points = {add_step(p, PointOperation::crank_pin)};
  return p;
}

/// Ends a program with the traced point on a link.
PointProgram end_program(PointProgram p, int link) {
  add_point(p, link);
  p.traced_bar = link;
  p.parameters += 4;
  return p;
}

/// Ends a program whose last step is its output already: a point of a link, its angle, or a slider at its
/// end.
PointProgram end_at_output(PointProgram p, int link, MachineOutput output) {
  p.output = output, p.traced_bar = link;
  p.parameters += 4;
  return p;
}

/// Joins a slider on the ground to a point of a link by a rod.
void add_slider(PointProgram& p, int point) {
  const int slider = add_step(p, PointOperation::slide, point);
  p.bodies.push_back({{point, slider}});
}

PointProgram slider_crank() {
  PointProgram p = begin_program(MachineFamily::slider_crank, "slider_crank", 4);
  add_slider(p, 0);
  return end_program(std::move(p), 2);
}

PointProgram inverted_slider(const char* name) {
  PointProgram p = begin_program(MachineFamily::inverted_slider, name, 4);
  const int along = add_step(p, PointOperation::sleeve, 0);
  p.bodies.push_back({{0, along}});
  return p;
}

PointProgram geared_five_bar(int ratio) {
  PointProgram p = begin_program(MachineFamily::geared_five_bar, fmt::format("geared_five_bar:{}", ratio), 5);
  p.gear_ratio = ratio;
  const int geared = add_step(p, PointOperation::geared_crank);
  add_pair(p, 0, geared);
  return end_program(std::move(p), 2);
}

/// A link on a ground pivot and a link on the crank pin, which two bars join.
PointProgram stephenson_2(bool trace_bar) {
  PointProgram p =
      begin_program(MachineFamily::stephenson_2, fmt::format("stephenson_2:{}", trace_bar ? 'b' : 'a'), 6);
  const int pivot = add_step(p, PointOperation::ground);
  p.bodies[0].points = {pivot};
  p.group = static_cast<int>(p.steps.size());
  std::array<int, 4> pins{};
  for (std::size_t i = 0; i < 4; ++i) pins[i] = add_step(p, PointOperation::group_point, i < 2 ? pivot : 0);
  p.bodies.push_back({{pivot, pins[0], pins[1]}});
  p.bodies.push_back({{0, pins[2], pins[3]}});
  p.bodies.push_back({{pins[0], pins[2]}});
  p.bodies.push_back({{pins[1], pins[3]}});
  if (trace_bar) return end_program(std::move(p), 4);
  // The hinge and the first pin give the direction of the traced link.
  const int traced = add_step(p, PointOperation::group_point, 0, pins[2]);
  p.bodies[3].points.push_back(traced);
  return end_at_output(std::move(p), 3, MachineOutput::point);
}

std::string digits(std::span<const PairOfBars> pairs) {
  std::string out;
  for (std::size_t k = 1; k < pairs.size(); ++k)
    for (const int link : pairs[k]) out += static_cast<char>('0' + link);
  return out;
}

MachineFamily six_bar_family(PairOfBars pair) {
  std::sort(pair.begin(), pair.end());
  if (pair == PairOfBars{2, 3} || pair == PairOfBars{1, 2}) return MachineFamily::watt_1;
  if (pair == PairOfBars{0, 3}) return MachineFamily::watt_2;
  return pair == PairOfBars{1, 3} ? MachineFamily::stephenson_1 : MachineFamily::stephenson_3;
}

/// Six-bars have short names; with a pair in the other order, which other parameters go with, that of the
/// pair.
std::string six_bar_name(PairOfBars pair, bool trace_second) {
  const char bar = trace_second ? 'b' : 'a';
  if (pair == PairOfBars{2, 3}) return fmt::format("watt_1:{}", bar);
  if (pair == PairOfBars{1, 2}) return fmt::format("watt_1:{}'", bar);
  if (pair == PairOfBars{1, 3}) return fmt::format("stephenson_1:{}", bar);
  if (pair == PairOfBars{0, 2} && trace_second) return "stephenson_3:a";
  return fmt::format("{}:{}{}{}", name_of(six_bar_family(pair)), pair[0], pair[1], bar);
}

constexpr std::array outputs{MachineOutput::point, MachineOutput::angle, MachineOutput::slide};

/// The second pair of machines of eight links whose output is on the ground: on links that need the first.
constexpr std::array<PairOfBars, 5> second_pairs{{{2, 3}, {1, 2}, {1, 3}, {0, 2}, {0, 3}}};

/// Crank, ground and the first pair of bars; further pairs behind it.
PointProgram pairs_behind(PointProgram p, PointOperation pivot, std::span<const PairOfBars> pairs) {
  const int ground = add_step(p, pivot);
  p.bodies[0].points = {ground};
  add_pair(p, 0, ground);
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const int first = add_point(p, pairs[k][0]), second = add_point(p, pairs[k][1]);
    add_pair(p, first, second);
  }
  p.pairs.assign(pairs.begin(), pairs.end());
  return p;
}

/// The angle of the link on the ground in the last pair: of the first pair its second bar, else its first.
PointProgram angle_program(std::span<const PairOfBars> pairs) {
  MachineFamily family = MachineFamily::four_bar;
  std::string name = "four_bar:angle";
  if (pairs.size() == 2) family = six_bar_family(pairs[1]), name = fmt::format("{}:angle", name_of(family));
  if (pairs.size() == 3)
    family = MachineFamily::eight_bar, name = fmt::format("eight_bar:{}:angle", digits(pairs));
  const int links = 2 * static_cast<int>(pairs.size()) + 2;
  PointProgram p =
      pairs_behind(begin_program(family, std::move(name), links), PointOperation::ground_on_axis, pairs);
  return end_at_output(std::move(p), pairs.size() == 1 ? 3 : links - 2, MachineOutput::angle);
}

/// The travel of a slider whose rod hangs on a link behind pairs of bars. The line of the slider is along the
/// real axis, and so the ground of the first pair is anywhere.
PointProgram slide_program(std::span<const PairOfBars> pairs, int link) {
  const bool six = pairs.size() == 1;
  const MachineFamily family = !six        ? MachineFamily::eight_bar
                               : link == 3 ? MachineFamily::watt_2
                                           : MachineFamily::stephenson_3;
  PointProgram p = begin_program(family,
                                 six ? fmt::format("{}:slide", name_of(family))
                                     : fmt::format("eight_bar:{}{}:slide", digits(pairs), link),
                                 six ? 6 : 8);
  p = pairs_behind(std::move(p), PointOperation::ground, pairs);
  p.trace_second = link % 2 == 1;
  add_slider(p, add_point(p, link));
  return end_at_output(std::move(p), static_cast<int>(p.bodies.size()) - 1, MachineOutput::slide);
}

/// The types of each family.
struct Catalogue {
  std::deque<PointProgram> others;  ///< those that are not of pairs alone
  std::array<std::array<std::vector<const PointProgram*>, names(MachineFamily{}).size()>, outputs.size()>
      families;

  void add(const PointProgram& p) {
    families[static_cast<std::size_t>(p.output)][static_cast<std::size_t>(p.family)].push_back(&p);
  }
  void add_other(PointProgram p) { add(others.emplace_back(std::move(p))); }
  void add_pairs(int count) {
    for (const PairProgram& machine : traced_pair_machines(count, true))
      add(program_of_pairs(machine.pairs, *machine.traced % 2 == 1));
  }

  Catalogue() {
    add_pairs(1);
    add_other(slider_crank());
    add_other(end_program(inverted_slider("inverted_slider"), 2));
    for (const int ratio : {1, -1, 2, -2, 3, -3}) add_other(geared_five_bar(ratio));
    add_pairs(2);
    add_pairs(3);
    for (const bool trace_bar : {false, true}) add_other(stephenson_2(trace_bar));
    add_angles();
    add_slides();
  }

  void add_angles() {
    const PairOfBars first{1, 0};
    add_other(angle_program({&first, 1}));
    add_other(end_at_output(inverted_slider("inverted_slider:angle"), 2, MachineOutput::angle));
    for (const int link : {2, 3}) add_other(angle_program(std::array{first, PairOfBars{0, link}}));
    for (const PairOfBars& second : second_pairs)
      for (const int link : {4, 5}) add_other(angle_program(std::array{first, second, PairOfBars{0, link}}));
  }

  void add_slides() {
    const PairOfBars first{1, 0};
    PointProgram p = begin_program(MachineFamily::slider_crank, "slider_crank:slide", 4);
    add_slider(p, 0);
    add_other(end_at_output(std::move(p), 2, MachineOutput::slide));
    for (const int link : {2, 3}) add_other(slide_program({&first, 1}, link));
    for (const PairOfBars& second : second_pairs)
      for (const int link : {4, 5}) add_other(slide_program(std::array{first, second}, link));
  }
};

const Catalogue& catalogue() {
  static const Catalogue all;
  return all;
}

/// The pairs of a name as "1315b"; nothing when it is not one.
std::optional<std::pair<std::vector<PairOfBars>, bool>> pairs_of_digits(std::string_view text) {
  if (text.size() % 2 == 0 || text.size() > 7 || (text.back() != 'a' && text.back() != 'b'))
    return std::nullopt;
  std::vector<PairOfBars> out{{1, 0}};
  for (std::size_t i = 0; i + 2 < text.size(); i += 2) {
    const int links = 2 * static_cast<int>(out.size()) + 2;
    const PairOfBars pair{text[i] - '0', text[i + 1] - '0'};
    if (std::min(pair[0], pair[1]) < 0 || std::max(pair[0], pair[1]) >= links || pair[0] == pair[1])
      return std::nullopt;
    out.push_back(pair);
  }
  return std::pair(out, text.back() == 'b');
}

PointProgram make_pair_program(std::span<const PairOfBars> pairs, bool trace_second) {
  LINKWRIGHT_REQUIRE(!pairs.empty() && pairs.size() <= 4 && pairs[0] == (PairOfBars{1, 0}),
                     "{} pairs of bars, must be 1 to 4 of which the first joins crank and ground",
                     pairs.size());
  MachineFamily family = MachineFamily::four_bar;
  std::string name = "four_bar";
  const char bar = trace_second ? 'b' : 'a';
  if (pairs.size() == 2) family = six_bar_family(pairs[1]), name = six_bar_name(pairs[1], trace_second);
  if (pairs.size() == 3)
    family = MachineFamily::eight_bar, name = fmt::format("eight_bar:{}{}", digits(pairs), bar);
  if (pairs.size() == 4)
    family = MachineFamily::ten_bar, name = fmt::format("ten_bar:{}{}", digits(pairs), bar);
  PointProgram p =
      pairs_behind(begin_program(family, std::move(name), 2 * static_cast<int>(pairs.size()) + 2),
                   PointOperation::ground_on_axis, pairs);
  p.trace_second = trace_second;
  const int traced = p.links - 2 + (trace_second ? 1 : 0);
  return end_program(std::move(p), traced);
}

}  // namespace

const PointProgram& program_of_pairs(std::span<const PairOfBars> pairs, bool trace_second) {
  static std::mutex mutex;
  static std::map<std::pair<std::vector<PairOfBars>, bool>, std::unique_ptr<const PointProgram>> known;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const PointProgram>& program = known[{{pairs.begin(), pairs.end()}, trace_second}];
  if (!program) program = std::make_unique<const PointProgram>(make_pair_program(pairs, trace_second));
  return *program;
}

const PointProgram* angle_program_of_pairs(std::span<const PairOfBars> pairs) {
  for (const auto& family : catalogue().families[static_cast<std::size_t>(MachineOutput::angle)])
    for (const PointProgram* p : family)
      if (std::equal(p->pairs.begin(), p->pairs.end(), pairs.begin(), pairs.end())) return p;
  return nullptr;
}

std::span<const PointProgram* const> programs_of(MachineFamily family, MachineOutput output) {
  return catalogue().families[static_cast<std::size_t>(output)][static_cast<std::size_t>(family)];
}

int links_of(MachineFamily family) {
  for (const MachineOutput output : outputs)
    if (const auto programs = programs_of(family, output); !programs.empty()) return programs.front()->links;
  return 10;
}

const PointProgram* program_named(std::string_view name) {
  for (const auto& output : catalogue().families)
    for (const auto& family : output)
      for (const PointProgram* p : family)
        if (p->name == name) return p;
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return nullptr;
  const auto pairs = pairs_of_digits(name.substr(colon + 1));
  if (!pairs) return nullptr;
  const PointProgram& found = program_of_pairs(pairs->first, pairs->second);
  return found.name == name ? &found : nullptr;
}

std::vector<GroundPivot> ground_pivots(const PointProgram& program) {
  std::vector<GroundPivot> out{{}};
  for (const PointStep& step : program.steps) {
    const PointOperation operation = step.operation;
    if (operation == PointOperation::ground_on_axis || operation == PointOperation::sleeve)
      out.push_back({step.parameter, true});
    if (operation == PointOperation::ground || operation == PointOperation::geared_crank)
      out.push_back({step.parameter, false});
  }
  return out;
}

std::complex<double> own_place_of(const GroundPivot& pivot, std::span<const double> x) {
  if (pivot.parameter < 0) return 0;
  const auto i = static_cast<std::size_t>(pivot.parameter);
  return {x[i], pivot.on_axis ? 0 : x[i + 1]};
}

std::complex<double> place_of(const GroundPivot& pivot, const PointProgram& program,
                              std::span<const double> x) {
  const auto p = static_cast<std::size_t>(program.place()), s = static_cast<std::size_t>(program.scale());
  return std::complex<double>(x[p], x[p + 1]) + std::complex<double>(x[s], x[s + 1]) * own_place_of(pivot, x);
}

MachineShape mirrored(const MachineShape& machine) {
  const PointProgram& program = *machine.program;
  MachineShape out = machine;
  const auto negate = [&](int i) { out.x[static_cast<std::size_t>(i)] *= -1; };
  for (const PointStep& step : program.steps) {
    if (step.operation == PointOperation::pair) out.signs ^= 1u << static_cast<unsigned>(step.sign);
    switch (step.operation) {
      case PointOperation::crank_pin:
      case PointOperation::ground_on_axis:
      case PointOperation::pair:
        break;
      case PointOperation::ground:
      case PointOperation::crank_plate:
      case PointOperation::plate:
      case PointOperation::slide:
      case PointOperation::sleeve:
      case PointOperation::group_point:
        negate(step.parameter + 1);
        break;
      case PointOperation::geared_crank:
        negate(step.parameter + 1), negate(step.parameter + 3);
        break;
    }
  }
  negate(program.place() + 1);
  negate(program.scale() + 1);
  return out;
}

}  // namespace linkwright::planar
