// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/program.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {

constexpr std::array<int, 9> parameters_of{0, 1, 2, 2, 2, 2, 2, 2, 4};  // in the order of PointOperation

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
  p.parameters += 4;
  return p;
}

PointProgram slider_crank() {
  PointProgram p = begin_program(MachineFamily::slider_crank, "slider_crank", 4);
  const int slider = add_step(p, PointOperation::slide, 0);
  p.bodies.push_back({{0, slider}});
  return end_program(std::move(p), 2);
}

PointProgram inverted_slider() {
  PointProgram p = begin_program(MachineFamily::inverted_slider, "inverted_slider", 4);
  const int along = add_step(p, PointOperation::sleeve, 0);
  p.bodies.push_back({{0, along}});
  return end_program(std::move(p), 2);
}

PointProgram geared_five_bar(int ratio) {
  PointProgram p = begin_program(MachineFamily::geared_five_bar, fmt::format("geared_five_bar:{}", ratio), 5);
  p.gear_ratio = ratio;
  const int geared = add_step(p, PointOperation::geared_crank);
  add_pair(p, 0, geared);
  return end_program(std::move(p), 2);
}

// The graph of a machine of pairs: links as vertices, pins as edges.
using Edges = std::vector<std::pair<int, int>>;

Edges edges_of(std::span<const PairOfBars> pairs) {
  Edges out{{0, 1}};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const int first = 2 * static_cast<int>(k) + 2, second = first + 1;
    out.emplace_back(pairs[k][0], first);
    out.emplace_back(pairs[k][1], second);
    out.emplace_back(first, second);
  }
  return out;
}

/// Least list of edges over all numberings of the bars that keep ground, crank and traced bar: equal for
/// isomorphs.
Edges canonical(const Edges& edges, int links, int traced) {
  std::vector<int> others;
  for (int link = 2; link < links; ++link)
    if (link != traced) others.push_back(link);
  std::vector<int> number(static_cast<std::size_t>(links));
  Edges least;
  std::vector<int> order(others.size());
  std::iota(order.begin(), order.end(), 3);
  do {
    number[0] = 0, number[1] = 1, number[static_cast<std::size_t>(traced)] = 2;
    for (std::size_t i = 0; i < others.size(); ++i) number[static_cast<std::size_t>(others[i])] = order[i];
    Edges renumbered;
    for (const auto& [a, b] : edges) {
      const auto [low, high] =
          std::minmax(number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)]);
      renumbered.emplace_back(low, high);
    }
    std::sort(renumbered.begin(), renumbered.end());
    if (least.empty() || renumbered < least) least = renumbered;
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

/// True if `traced` follows from the links `known` by pairs other than `left_out`; `used` becomes the pairs
/// needed.
bool follows(std::span<const PairOfBars> pairs, std::vector<int> known, int left_out, int traced,
             std::vector<bool>* used = nullptr) {
  const auto is_known = [&](int link) { return std::find(known.begin(), known.end(), link) != known.end(); };
  for (int k = 0; k < static_cast<int>(pairs.size()); ++k)
    if (k != left_out && is_known(pairs[static_cast<std::size_t>(k)][0]) &&
        is_known(pairs[static_cast<std::size_t>(k)][1])) {
      known.push_back(2 * k + 2);
      known.push_back(2 * k + 3);
    }
  if (used) {
    used->assign(pairs.size(), false);
    std::vector<int> open{traced};
    while (!open.empty()) {
      const int link = open.back();
      open.pop_back();
      if (link < 2 || (*used)[static_cast<std::size_t>(link / 2 - 1)]) continue;
      (*used)[static_cast<std::size_t>(link / 2 - 1)] = true;
      for (const int input : pairs[static_cast<std::size_t>(link / 2 - 1)]) open.push_back(input);
    }
  }
  return is_known(traced);
}

/// True if the traced bar needs every pair and does not move with a smaller chain behind one ground-hinged
/// bar.
bool is_worth_tracing(std::span<const PairOfBars> pairs, int traced) {
  std::vector<bool> used;
  follows(pairs, {0, 1}, -1, traced, &used);
  if (std::find(used.begin(), used.end(), false) != used.end()) return false;
  for (int k = 0; k < static_cast<int>(pairs.size()); ++k)
    for (int side = 0; side < 2; ++side) {
      const int hinged = 2 * k + 2 + side;
      if (pairs[static_cast<std::size_t>(k)][static_cast<std::size_t>(side)] != 0) continue;
      if (hinged == traced || follows(pairs, {0, hinged}, k, traced)) return false;
    }
  return true;
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

/// Programs that are not of pairs alone, and those of pairs that represent their isomorphs.
struct Catalogue {
  std::deque<PointProgram> others;
  std::array<std::vector<const PointProgram*>, names(MachineFamily{}).size()> families;
  std::set<std::pair<int, Edges>> graphs;

  void add(const PointProgram& p) { families[static_cast<std::size_t>(p.family)].push_back(&p); }
  void add_other(PointProgram p) { add(others.emplace_back(std::move(p))); }

  void add_pairs(std::vector<PairOfBars>& pairs, std::size_t count) {
    const int links = 2 * static_cast<int>(pairs.size()) + 2;
    if (pairs.size() == count) {
      for (const bool second : {false, true}) {
        const int traced = links - 2 + (second ? 1 : 0);
        if (!is_worth_tracing(pairs, traced)) continue;
        if (graphs.emplace(links, canonical(edges_of(pairs), links, traced)).second)
          add(pair_program(pairs, second));
      }
      return;
    }
    for (int a = 0; a < links; ++a)
      for (int b = a + 1; b < links; ++b) {
        pairs.push_back({a, b});
        add_pairs(pairs, count);
        pairs.pop_back();
      }
  }

  Catalogue() {
    std::vector<PairOfBars> pairs{{1, 0}};
    add_pairs(pairs, 1);
    add_other(slider_crank());
    add_other(inverted_slider());
    for (const int ratio : {1, -1, 2, -2, 3, -3}) add_other(geared_five_bar(ratio));
    add_pairs(pairs, 2);
    add_pairs(pairs, 3);
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

}  // namespace

namespace {

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
  PointProgram p = begin_program(family, std::move(name), 2 * static_cast<int>(pairs.size()) + 2);
  const int ground = add_step(p, PointOperation::ground_on_axis);
  p.bodies[0].points = {ground};
  add_pair(p, 0, ground);
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const int first = add_point(p, pairs[k][0]), second = add_point(p, pairs[k][1]);
    add_pair(p, first, second);
  }
  p.pairs.assign(pairs.begin(), pairs.end());
  p.trace_second = trace_second;
  const int traced = p.links - 2 + (trace_second ? 1 : 0);
  return end_program(std::move(p), traced);
}

}  // namespace

const PointProgram& pair_program(std::span<const PairOfBars> pairs, bool trace_second) {
  static std::mutex mutex;
  static std::map<std::pair<std::vector<PairOfBars>, bool>, std::unique_ptr<const PointProgram>> known;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const PointProgram>& program = known[{{pairs.begin(), pairs.end()}, trace_second}];
  if (!program) program = std::make_unique<const PointProgram>(make_pair_program(pairs, trace_second));
  return *program;
}

std::span<const PointProgram* const> programs_of(MachineFamily family) {
  return catalogue().families[static_cast<std::size_t>(family)];
}

int links_of(MachineFamily family) {
  return family == MachineFamily::ten_bar ? 10 : programs_of(family).front()->links;
}

const PointProgram* program_named(std::string_view name) {
  for (const auto& family : catalogue().families)
    for (const PointProgram* p : family)
      if (p->name == name) return p;
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return nullptr;
  const auto pairs = pairs_of_digits(name.substr(colon + 1));
  if (!pairs) return nullptr;
  const PointProgram& found = pair_program(pairs->first, pairs->second);
  return found.name == name ? &found : nullptr;
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
