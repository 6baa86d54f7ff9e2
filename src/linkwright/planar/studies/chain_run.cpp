// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/chains.h"
#include "linkwright/planar/chains/names.h"
#include "linkwright/planar/chains/pair_order.h"
#include "linkwright/planar/studies/chain.h"
#include "linkwright/planar/studies/chain_scene.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// Mechanisms are drawn one by one up to this number; of more, the chains alone are.
constexpr std::size_t max_figures = 240;
// The pairs of bars whose traced machines are listed: up to eight links.
constexpr int max_traced_links = 8;

// A chain with all that it becomes.
struct Family {
  Chain chain;
  std::vector<Marking> mechanisms;  // with all marks that were asked for
  int arrangements = 0;             // of sliders and gears
  int inversions = 0;               // these with a ground
  int by_pairs = 0;                 // mechanisms of pairs of bars alone
};

std::string row_name(const Family& family, const Marking& marking) {
  const std::string name = mechanism_name(family.chain, marking),
                    common = common_name(family.chain.graph, marking);
  return common.empty() ? name : fmt::format("{} ({})", common, name);
}

// The name in a drawing: "8-07/3/5" for ground 3 and driven link 5.
std::string figure_name(const Family& family, const Marking& marking) {
  std::string out = common_name(family.chain.graph, marking);
  if (!out.empty()) return out;
  out = mechanism_name(family.chain, marking);
  for (const std::string_view word : {"sliders ", "gears ", "ground ", "driver "})
    if (const std::size_t place = out.find(word); place != std::string::npos) out.erase(place, word.size());
  return out;
}

// The driver of a mechanism of one freedom decides the groups in which it is solved.
bool has_groups(const ChainMechanism& asked) {
  return asked.freedoms == 1 && asked.ground && asked.driver && !asked.gear_pair;
}

class ChainReport {
 public:
  ChainReport(const ChainMechanism& asked, RunContext& context)
      : m_(asked),
        choice_(marking_choice(asked)),
        context_(context),
        pins_(asked.sliders == 0 && !asked.gear_pair),
        is_marked_(!pins_ || asked.ground),
        is_driven_(has_groups(asked)) {}

  study::Result make() {
    collect();
    result_.status = context_.interruption();
    if (result_.status != Status::done) {
      result_.headline = "Stopped before all chains were found.";
      return std::move(result_);
    }
    chain_table();
    if (is_marked_) mechanism_table();
    if (is_driven_ && pins_ && m_.links <= max_traced_links) pair_table();
    counts_table();
    draw();
    findings();
    return std::move(result_);
  }

 private:
  void collect() {
    std::vector<Chain> all = chains(m_.links, m_.freedoms, context_);
    if (m_.fractionated)
      for (Chain& chain : fractionated_chains(m_.links, m_.freedoms, context_))
        all.push_back(std::move(chain));
    for (Chain& chain : all) {
      if (context_.interrupted()) return;
      Family family;
      family.mechanisms = markings(chain, choice_);
      family.arrangements = count(chain, false);
      family.inversions = choice_.ground ? count(chain, true) : 0;
      for (const Marking& marking : family.mechanisms)
        family.by_pairs += is_driven_ && pins_ && pair_program(chain.graph, marking).has_value();
      family.chain = std::move(chain);
      families_.push_back(std::move(family));
    }
  }
  int count(const Chain& chain, bool ground) const {
    const MarkingChoice choice{.sliders = choice_.sliders, .gear = choice_.gear, .ground = ground};
    return static_cast<int>(markings(chain, choice).size());
  }

  template <class Number>
  std::vector<double> of_families(const Number& number) const {
    std::vector<double> out;
    for (const Family& f : families_) out.push_back(static_cast<double>(number(f)));
    return out;
  }
  template <class Number>
  int sum(const Number& number) const {
    double out = 0;
    for (const double v : of_families(number)) out += v;
    return static_cast<int>(out);
  }

  void chain_table() {
    Table table{.name = "chains"};
    std::size_t degrees = 3;
    for (const Family& f : families_) {
      table.names.push_back(f.chain.name);
      degrees = std::max(degrees, assortment(f.chain.graph).size());
    }
    const auto add = [&](std::string key, std::string label, const auto& number) {
      table.add(std::move(key), std::move(label), of_families(number));
    };
    add("links", "links", [](const Family& f) { return f.chain.graph.links; });
    add("joints", "joints", [](const Family& f) { return f.chain.graph.joints(); });
    add("freedoms", "degrees of freedom", [](const Family& f) { return freedoms(f.chain.graph); });
    constexpr const char* names[] = {"binary", "ternary", "quaternary", "quinary", "senary"};
    for (std::size_t d = 0; d < std::min(degrees, std::size(names)); ++d)
      add(names[d], fmt::format("{} links", names[d]), [d](const Family& f) {
        const std::vector<int> numbers = assortment(f.chain.graph);
        return d < numbers.size() ? numbers[d] : 0;
      });
    add("automorphisms", "automorphisms", [](const Family& f) { return f.chain.automorphisms.size(); });
    if (!pins_) add("arrangements", "arrangements of sliders and gears", arrangements);
    if (choice_.ground) add("inversions", "choices of the ground", inversions);
    if (choice_.driver) add("mechanisms", "choices of ground and driver", mechanisms);
    if (is_driven_ && pins_) add("by_pairs", "of these by pairs of bars", by_pairs);
    result_.tables.push_back(std::move(table));
  }

  void mechanism_table() {
    Table table{.name = "mechanisms"};
    std::map<std::string, std::pair<std::string, std::vector<double>>> columns;
    std::vector<std::string> order;
    const auto put = [&](const char* key, const char* label, double value) {
      auto [place, is_new] = columns.try_emplace(key, label, std::vector<double>{});
      if (is_new) order.emplace_back(key);
      place->second.second.push_back(value);
    };
    for (const Family& f : families_)
      for (const Marking& marking : f.mechanisms) {
        table.names.push_back(row_name(f, marking));
        row_of(f, marking, put);
      }
    for (const std::string& key : order) table.add(key, columns[key].first, std::move(columns[key].second));
    result_.tables.push_back(std::move(table));
  }

  template <class Put>
  void row_of(const Family& f, const Marking& marking, const Put& put) const {
    const ChainGraph& graph = f.chain.graph;
    put("chain", "number of the chain", f.chain.rank);
    if (marking.gear) {
      const Mobility mobile = mobility(graph, marking.sliders, marking.gear);
      put("carrier", "link that carries the gears", marking.gear->carrier + 1);
      put("first_gear", "first geared link", marking.gear->first + 1);
      put("second_gear", "second geared link", marking.gear->second + 1);
      put("freedoms", "degrees of freedom", mobile.freedoms);
      put("locks_a_part", "1 if the gears lock a part", mobile.freedoms != 1 || !mobile.each_joint_moves);
    }
    if (marking.ground) {
      put("ground", "ground", *marking.ground + 1);
      put("ground_joints", "joints of the ground", graph.degree(*marking.ground));
    }
    if (!marking.driver) return;
    put("driven_link", "driven link", driven_link(graph, marking) + 1);
    if (!is_driven_) return;
    const std::vector<int> groups = driven_groups(graph, marking);
    put("groups", "Assur groups", static_cast<double>(groups.size()));
    put("largest_group", "links of the largest group", *std::max_element(groups.begin(), groups.end()));
  }

  // Machines in the order of their pairs of bars, with the bar whose points they trace.
  void pair_table() {
    Table table{.name = "traced_machines"};
    const int pairs = m_.links / 2 - 1;
    const std::vector<PairProgram> all = traced_pair_machines(pairs, false),
                                   own = traced_pair_machines(pairs, true);
    std::vector<double> traced, has_own_curves;
    for (const PairProgram& program : all) {
      table.names.push_back(program_name(program));
      traced.push_back(*program.traced);
      has_own_curves.push_back(std::binary_search(own.begin(), own.end(), program));
    }
    table.add("traced_bar", "traced bar, ground and crank being 0 and 1", std::move(traced));
    table.add("own_curves", "1 if no smaller chain traces its curves", std::move(has_own_curves));
    for (int k = 1; k < pairs; ++k)
      for (const std::size_t end : {0u, 1u}) {
        std::vector<double> links;
        for (const PairProgram& program : all) links.push_back(program.pairs[at(k)][end]);
        table.add(fmt::format("pair_{}_link_{}", k + 1, end + 1),
                  fmt::format("{} link that pair {} joins", end == 0 ? "first" : "second", k + 1),
                  std::move(links));
      }
    traced_ = static_cast<int>(all.size()), own_curves_ = static_cast<int>(own.size());
    result_.tables.push_back(std::move(table));
  }

  void counts_table() {
    Table table{.name = "counts"};
    table.status = {"done"};
    const auto add = [&](const char* key, const char* label, int value) {
      table.add(key, label, {static_cast<double>(value)});
    };
    const int joints = (3 * (m_.links - 1) - m_.freedoms) / 2;
    add("graphs", "graphs without cut link, those with rigid parts among them",
        static_cast<int>(two_connected_graphs(m_.links, joints).size()));
    add("chains", "chains", sum([](const Family& f) { return !f.chain.fractionated; }));
    if (m_.fractionated)
      add("fractionated", "chains with cut links", sum([](const Family& f) { return f.chain.fractionated; }));
    if (!pins_) add("arrangements", "arrangements of sliders and gears", sum(arrangements));
    if (m_.gear_pair) add("locked", "of these with gears that lock a part", locked());
    if (choice_.ground) add("inversions", "choices of the ground", sum(inversions));
    if (choice_.driver) add("mechanisms", "choices of ground and driver", sum(mechanisms));
    if (is_driven_ && pins_) add("by_pairs", "of these by pairs of bars", sum(by_pairs));
    if (traced_ > 0) {
      add("traced_machines", "these with a traced bar that needs every pair", traced_);
      add("own_curves", "whose curves no smaller chain traces", own_curves_);
    }
    result_.tables.insert(result_.tables.begin(), std::move(table));
  }

  int locked() const {
    int out = 0;
    for (const Family& f : families_)
      for (const Marking& marking : markings(f.chain, {.sliders = m_.sliders, .gear = true})) {
        const Mobility mobile = mobility(f.chain.graph, marking.sliders, marking.gear);
        out += mobile.freedoms != 1 || !mobile.each_joint_moves;
      }
    return out;
  }

  void draw() {
    std::vector<ChainFigure> figures;
    const bool each = is_marked_ && at(sum(mechanisms)) <= max_figures;
    for (const Family& f : families_) {
      if (each)
        for (const Marking& marking : f.mechanisms)
          figures.push_back({&f.chain, marking, figure_name(f, marking)});
      else
        figures.push_back({&f.chain, {}, f.chain.name});
    }
    result_.scenes = chain_sheets(figures);
  }

  Sentence chains_in_words() const {
    const auto number = static_cast<int>(families_.size());
    return say("{} chain{} of {} links with {} degree{} of freedom", number, number == 1 ? "" : "s", m_.links,
               m_.freedoms, m_.freedoms == 1 ? "" : "s");
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    Sentence text = chains_in_words();
    if (!pins_) text += say(": {} with {}", sum(arrangements), marks_in_words());
    if (choice_.ground) text += say("; {} mechanisms by their ground", sum(inversions));
    if (choice_.driver) text += say(", {} with a driven joint", sum(mechanisms));
    result_.headline = text + Sentence(".");
    fact("chains", say("{}", static_cast<int>(families_.size())));
    fact("assortments", assortments());
    if (choice_.ground) fact("choices of the ground", say("{}", sum(inversions)));
    if (choice_.driver) fact("choices of ground and driver", say("{}", sum(mechanisms)));
    if (is_driven_ && pins_) fact("of these by pairs of bars alone", say("{}", sum(by_pairs)));
    if (traced_ > 0)
      fact("machines of pairs with a traced bar",
           say("{}, {} of them with curves of their own", traced_, own_curves_));
    if (m_.gear_pair) fact("arrangements whose gears lock a part", say("{}", locked()));
  }
  std::string marks_in_words() const {
    std::string out;
    if (m_.sliders > 0) out = fmt::format("{} slider{}", m_.sliders, m_.sliders == 1 ? "" : "s");
    if (m_.gear_pair) out += out.empty() ? "a gear pair" : " and a gear pair";
    return out;
  }

  // "9 of 3333 2222, 5 of 433 22222": numbers of chains by the joints of their links.
  Sentence assortments() const {
    std::vector<std::pair<std::string, int>> found;
    for (const Family& f : families_) {
      const std::string links = assortment_text(f.chain.graph);
      const auto known =
          std::find_if(found.begin(), found.end(), [&](const auto& entry) { return entry.first == links; });
      known == found.end() ? void(found.emplace_back(links, 1)) : void(++known->second);
    }
    Sentence out;
    for (const auto& [links, number] : found)
      out += say("{}{} of {}", out.empty() ? "" : ", ", number, links);
    return out;
  }

  static int arrangements(const Family& f) { return f.arrangements; }
  static int inversions(const Family& f) { return f.inversions; }
  static std::size_t mechanisms(const Family& f) { return f.mechanisms.size(); }
  static int by_pairs(const Family& f) { return f.by_pairs; }

  const ChainMechanism& m_;
  const MarkingChoice choice_;
  RunContext& context_;
  const bool pins_, is_marked_, is_driven_;
  std::vector<Family> families_;
  int traced_ = 0, own_curves_ = 0;
  study::Result result_;
};

}  // namespace

study::Result run_chain_study(const ChainMechanism& asked, RunContext& context) {
  return ChainReport(asked, context).make();
}

}  // namespace linkwright::planar
