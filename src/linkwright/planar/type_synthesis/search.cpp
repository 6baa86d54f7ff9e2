// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/type_synthesis/atlas.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/grow.h"
#include "linkwright/planar/type_synthesis/detail/machine_list.h"
#include "linkwright/planar/type_synthesis/detail/search_state.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/function_starts.h"
#include "linkwright/planar/type_synthesis/place.h"
#include "linkwright/planar/type_synthesis/pose_starts.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t trials_a_round = 16, elite_size = 8, pool_size = 1500, archive_size = 40;
constexpr std::ptrdiff_t max_kin = 2;     // machines of the elite that are of one kin
constexpr std::size_t exact_starts = 96;  // of dyads through poses
constexpr double pool_patience = 4;       // a start may lie this much further off than a hop, and is kept
constexpr int first_rounds = 3;           // of each family, before the better ones get more

enum class TrialKind { pool, hop, grow };

/// One machine to polish.
struct Trial {
  TrialKind kind{};
  FittedMachine machine;
  double best = infinity;
  std::int64_t origin = 0;
  std::optional<CrankPart> part = {};  ///< of the turn, of a shape of the pool
  bool placed = false;                 ///< a machine of the pool is where it belongs already
  bool accepted = false, inside = false;
  MachineMeasures measures;
  std::int64_t curves = 0;
};

bool is_of_pairs(MachineFamily family, MachineOutput output) {
  const auto programs = programs_of(family, output);
  return programs.empty() ? family == MachineFamily::ten_bar : !programs.front()->pairs.empty();
}

/// One has come from the other by hops, or both are of one type on one branch.
bool is_kin(const FoundMachine& a, const FoundMachine& b) {
  const MachineShape &s = a.machine.shape, &t = b.machine.shape;
  return a.origin == b.origin || (s.program == t.program && s.signs == t.signs);
}

class TypeSearch {
 public:
  TypeSearch(const MotionTarget& target, const TypeSearchOptions& options, RunContext& context)
      : target_(target), options_(options), context_(context), last_save_(RunContext::Clock::now()) {
    state_.turns = target.turns;
    for (std::size_t k = 0; k < trials_a_round; ++k) fitters_.emplace_back(target, options.limits);
    for (const MachineFamily family : searched_families(target, options)) {
      FamilyState& state = state_.families.emplace_back();
      state.report.family = family, state.links = links_of(family);
    }
  }

  TypeSearchAnswer run() {
    Status status = Status::done;
    if (Checkpoint* checkpoint = context_.checkpoint())
      if (const Value value = checkpoint->find(options_.saved_as); !value.is_null())
        load_state(value, state_);
    while (!state_.families.empty()) {
      status = context_.interruption();
      if (status != Status::done || (options_.max_curves > 0 && state_.curves >= options_.max_curves)) break;
      FamilyState& family = state_.families[choose_family()];
      if (!prepare(family)) continue;
      round(family);
      ++state_.rounds;
      save();
      const double share = options_.max_curves > 0
                               ? static_cast<double>(state_.curves) / static_cast<double>(options_.max_curves)
                               : 0;
      context_.report(
          {.stage = name_of(family.report.family), .fraction = std::min(1.0, share), .best = best_error()});
    }
    if (status != Status::cancelled && target_.output == MachineOutput::point && !target_.oriented)
      close_gaps();
    return answer(status);
  }

 private:
  /// Between two rounds; one that was cut short is done again.
  void save() {
    Checkpoint* checkpoint = context_.checkpoint();
    const auto now = RunContext::Clock::now();
    if (!checkpoint || now - last_save_ < checkpoint->interval() || context_.interrupted()) return;
    checkpoint->keep(options_.saved_as, saved_state(state_));
    last_save_ = now;
  }

  double best_error() const {
    double best = infinity;
    for (const FamilyState& f : state_.families) best = std::min(best, f.report.error);
    return best;
  }

  std::size_t choose_family() {
    for (int turn = 0; turn < first_rounds; ++turn)
      for (std::size_t i = 0; i < state_.families.size(); ++i)
        if (state_.families[i].rounds == turn) return i;
    double total = 0;
    std::vector<double> weight;
    for (const FamilyState& f : state_.families) {
      double w = 0.15 + std::min(1.0, 4 * f.last_gain);
      w *= f.links >= 8 ? 2.5 : f.links == 6 ? 1.6 : 1;
      for (const FamilyState& smaller : state_.families)
        if (smaller.links < f.links && smaller.report.error < 0.9 * f.report.error) {
          w *= 0.35;
          break;
        }
      if (f.pooled() == 0 && f.elite.empty() && f.links < 10) w *= 0.1;
      w /= static_cast<double>(f.report.curves) * f.links + 3e5;
      weight.push_back(w);
      total += w;
    }
    double at = total * random(0).uniform();
    for (std::size_t i = 0; i < weight.size(); ++i)
      if ((at -= weight[i]) < 0) return i;
    return state_.families.size() - 1;
  }

  RandomStream random(std::uint32_t individual) const {
    return RandomStream({.seed = options_.seed,
                         .run = 77,
                         .generation = static_cast<std::uint32_t>(state_.rounds),
                         .individual = individual});
  }

  bool prepare(FamilyState& f) {
    if (f.prepared) return true;
    if (target_.output != MachineOutput::point) {
      f.starts = function_starts(target_, options_.limits, f.report.family, pool_size, context_);
      f.report.atlas_entries = static_cast<std::int64_t>(f.starts.size());
      return f.prepared = !context_.interrupted();
    }
    if (f.report.family != MachineFamily::ten_bar) {
      // Shapes that turn may rock as well.
      f.atlases = {family_atlas(f.report.family, context_)};
      if (!target_.turns) f.atlases.push_back(rocking_atlas(f.report.family, context_));
      if (!f.atlases.front() || !f.atlases.back()) return false;
      f.pool = pool_of(f);
      if (target_.oriented && !target_.timed)
        f.exact = pose_starts(target_, options_.limits, f.report.family, exact_starts, context_);
      if (context_.interrupted()) return false;
      f.report.atlas_entries = 0;
      for (const auto& atlas : f.atlases)
        f.report.atlas_entries += static_cast<std::int64_t>(atlas->entries.size());
    }
    return f.prepared = true;
  }

  /// The shapes of the atlases that come nearest. They know paths alone: where more is asked, more shapes are
  /// placed and compared.
  std::vector<AtlasMatch> pool_of(const FamilyState& f) {
    const bool path_alone = !target_.timed && !target_.oriented;
    const std::size_t wanted = path_alone ? pool_size : 2 * pool_size;
    const auto nearest_first = [](std::vector<AtlasMatch>& list, std::size_t count) {
      std::sort(list.begin(), list.end(), [](const AtlasMatch& a, const AtlasMatch& b) {
        return std::tuple(a.score, a.atlas, a.entry) < std::tuple(b.score, b.atlas, b.entry);
      });
      if (list.size() > count) list.resize(count);
    };
    std::vector<AtlasMatch> found;
    for (std::size_t i = 0; i < f.atlases.size(); ++i)
      for (AtlasMatch& match : match_atlas(*f.atlases[i], target_.stroke, wanted, context_))
        match.atlas = i, found.push_back(match);
    nearest_first(found, wanted);
    if (path_alone) return found;
    optimise::parallel_for(fitters_.size(), context_.threads(), [&](std::size_t part) {
      for (std::size_t i = part; i < found.size() && !context_.interrupted(); i += fitters_.size()) {
        FittedMachine machine{.shape = shape_of(f, found[i])};
        const bool placed = place_on(target_, machine, part_of(f, found[i])) < infinity;
        found[i].score = placed ? fitters_[part].turn_body(machine) : infinity;
      }
    });
    nearest_first(found, pool_size);
    return found;
  }

  static MachineShape shape_of(const FamilyState& f, const AtlasMatch& match) {
    MachineShape shape = f.atlas_of(match).shape(match.entry);
    return match.mirrored ? mirrored(shape) : shape;
  }

  static std::optional<CrankPart> part_of(const FamilyState& f, const AtlasMatch& match) {
    std::optional<CrankPart> part = f.atlas_of(match).part(match.entry);
    if (part && match.mirrored) part->from = -part->from, part->range = -part->range;
    return part;
  }

  /// The best machine of pairs with two links less, null if there is none.
  const FoundMachine* smaller_machine(const FamilyState& f) const {
    const FoundMachine* best = nullptr;
    // The new pair hangs at the traced point; that of a Stephenson I joins crank and rocker.
    if (!is_of_pairs(f.report.family, target_.output) || f.report.family == MachineFamily::stephenson_1)
      return nullptr;
    for (const FamilyState& s : state_.families)
      if (s.links == f.links - 2 && is_of_pairs(s.report.family, target_.output) && !s.elite.empty() &&
          (!best || s.elite[0].measures.error < best->measures.error))
        best = &s.elite[0];
    return best;
  }

  void hop(FittedMachine& m, RandomStream& random) const {
    const double u = random.uniform(), sigma = 0.005 + 0.3 * u * u;
    const bool all = random.uniform() < 0.5;
    for (double& x : m.shape.x) {
      const double chance = random.uniform(), change = random.normal();
      if (all || chance < 0.35) x += sigma * (std::abs(x) + 0.1) * change;
    }
    for (const PointStep& step : m.shape.program->steps)
      if (step.operation == PointOperation::pair)
        for (int k = 0; k < 2; ++k) {
          double& length = m.shape.x[static_cast<std::size_t>(step.parameter + k)];
          length = std::max(std::abs(length), 1e-3);
        }
  }

  /// The next shape of the pool. While a family has no machine within the limits, the pool begins again,
  /// changed at random.
  void take_from_pool(FamilyState& f, Trial& t, RandomStream& random) const {
    const bool again = f.next_in_pool >= f.pooled();
    const std::size_t next = f.next_in_pool++ % f.pooled(), of_pool = next - std::min(next, f.exact.size());
    t.kind = TrialKind::pool;
    if (next < f.exact.size())
      t.machine = f.exact[next], t.placed = true;
    else if (f.starts.empty())
      t.machine.shape = shape_of(f, f.pool[of_pool]), t.part = part_of(f, f.pool[of_pool]);
    else
      t.machine.shape = f.starts[of_pool].shape, t.machine.angle[0] = f.starts[of_pool].from;
    if (again) hop(t.machine, random);
  }

  std::vector<Trial> trials_of(FamilyState& f) {
    std::vector<Trial> out;
    RandomStream choice = random(1);
    const FoundMachine* smaller = smaller_machine(f);
    const bool grow = smaller && (smaller->measures.error < f.grown_from ||
                                  f.report.family == MachineFamily::ten_bar || choice.uniform() < 0.2);
    for (std::size_t k = 0; k < trials_a_round; ++k) {
      RandomStream stream = random(static_cast<std::uint32_t>(2 + k));
      Trial t;
      t.best = f.report.error;
      t.origin = state_.rounds * static_cast<std::int64_t>(trials_a_round) + static_cast<std::int64_t>(k) + 1;
      const bool left = f.next_in_pool < f.pooled();
      const bool from_pool = f.elite.empty() ? f.pooled() > 0 : left && stream.uniform() < 0.5;
      if (grow && k < 4) {
        auto machine = grown_in(f.report.family, smaller->machine, stream);
        if (!machine) continue;
        t.kind = TrialKind::grow, t.machine = std::move(*machine);
        // What was grown traces the curve of the smaller machine, which may be far from this family's best.
        t.best = infinity;
      } else if (from_pool) {
        take_from_pool(f, t, stream);
        t.best *= pool_patience;
      } else if (!f.elite.empty()) {
        const double rank = -1.5 * std::log(1 - stream.uniform());
        const FoundMachine& from = f.elite[std::min(static_cast<std::size_t>(rank), f.elite.size() - 1)];
        t.kind = TrialKind::hop, t.machine = from.machine, t.origin = from.origin;
        t.best = from.measures.error;
        hop(t.machine, stream);
      } else {
        continue;
      }
      out.push_back(std::move(t));
    }
    if (grow) f.grown_from = smaller->measures.error;
    return out;
  }

  /// A machine of a family with one pair more that moves nearly as a smaller one does.
  std::optional<FittedMachine> grown_in(MachineFamily family, const FittedMachine& from,
                                        RandomStream& random) const {
    if (target_.output == MachineOutput::point)
      return grown_machine(
          from, [family](MachineFamily other) { return other == family; }, random, used_part(target_, from));
    return grown_by_parallelogram(from, family, random);
  }

  bool place(Trial& t, MachineFitter& fitter) const {
    FittedMachine& machine = t.machine;
    if (target_.output == MachineOutput::point) return place_on(target_, machine, t.part) < infinity;
    return begin_function(target_, fitter, machine.angle[0], machine) < infinity;
  }

  void work(Trial& t, MachineFitter& fitter, bool polished = true) const {
    const std::int64_t before = fitter.curves();
    const bool possible =
        ground_pivots(*t.machine.shape.program).size() >= options_.limits.ground_pivots.size();
    const bool placed = possible && (t.kind != TrialKind::pool || t.placed || place(t, fitter));
    // The body sits on another bar than before.
    if (placed && target_.oriented && t.kind != TrialKind::hop) fitter.turn_body(t.machine);
    if (placed && (!polished || fitter.polish(t.machine, t.best))) {
      t.measures = fitter.measure(t.machine);
      t.accepted = std::isfinite(t.measures.error);
      if (t.measures.error <= target_.met)
        t.measures.error = target_.met * (1 - t.measures.min_pair_angle / (pi / 2));
      t.inside = t.measures.defect == MachineDefect::none;
    }
    t.curves = fitter.curves() - before + (t.kind == TrialKind::pool ? 1 : 0);  // and that of its placing
  }

  void round(FamilyState& f) {
    std::vector<Trial> trials = trials_of(f);
    optimise::parallel_for(trials.size(), context_.threads(), [&](std::size_t i) {
      if (!context_.interrupted()) work(trials[i], fitters_[i]);
    });
    const double before = f.report.error;
    for (Trial& t : trials) count_and_take(f, t);
    f.last_gain = before == 0             ? 0
                  : std::isfinite(before) ? 1 - f.report.error / before
                  : f.elite.empty()       ? 0
                                          : 1;
    ++f.rounds;
  }

  void count_and_take(FamilyState& f, Trial& t) {
    state_.curves += t.curves;
    f.report.curves += t.curves;
    (t.kind == TrialKind::hop    ? f.report.hops
     : t.kind == TrialKind::grow ? f.report.grown
                                 : f.report.polished) += 1;
    if (t.accepted) take(f, std::move(t));
  }

  FamilyState* state_of(MachineFamily family) {
    const auto found = std::find_if(state_.families.begin(), state_.families.end(),
                                    [&](const FamilyState& f) { return f.report.family == family; });
    return found == state_.families.end() ? nullptr : &*found;
  }

  /// The best machine of pairs with so many links, null if there is none.
  const FoundMachine* best_of_pairs(int links) const {
    const FoundMachine* best = nullptr;
    for (const FamilyState& f : state_.families)
      if (f.links == links && is_of_pairs(f.report.family, target_.output) && !f.elite.empty() &&
          (!best || f.elite[0].measures.error < best->measures.error))
        best = &f.elite[0];
    return best;
  }

  /// The machine with as many pairs more as make so many links; the last pair makes a family of the search.
  std::optional<FittedMachine> grown_to(const FittedMachine& from, int links, RandomStream& random) {
    std::optional<FittedMachine> out = from;
    while (out && out->shape.program->links < links)
      out = grown_machine(
          *out, [&](MachineFamily family) { return links_of(family) < links || state_of(family); }, random,
          used_part(target_, from));
    return out;
  }

  /// At the end, machines of pairs with more links are not worse than those with fewer: where they are, the
  /// best smaller one is grown and polished. If that is in vain, it is grown once more with the traced point
  /// on the pin of the new pair, so that the curve is the same one.
  void close_gaps() {
    const FoundMachine* smaller = best_of_pairs(4);
    for (const int links : {6, 8, 10}) {
      const auto is_behind = [&] {
        const FoundMachine* own = best_of_pairs(links);
        return smaller && (!own || own->measures.error > smaller->measures.error);
      };
      constexpr int polished_rounds = 2, rounds_on_the_pin = 6;
      for (int turn = 0; turn < polished_rounds + rounds_on_the_pin && is_behind(); ++turn, ++state_.rounds)
        grow_round(smaller->machine, links, turn >= polished_rounds);
      if (const FoundMachine* own = best_of_pairs(links); own && !is_behind()) smaller = own;
    }
  }

  void grow_round(const FittedMachine& from, int links, bool on_the_pin) {
    std::vector<Trial> trials;
    for (std::size_t k = 0; k < trials_a_round; ++k) {
      RandomStream stream = random(static_cast<std::uint32_t>(2 + k));
      auto machine = grown_to(from, links, stream);
      if (!machine) continue;
      Trial& t = trials.emplace_back();
      t.kind = TrialKind::grow, t.machine = std::move(*machine);
      t.origin = state_.rounds * static_cast<std::int64_t>(trials_a_round) + static_cast<std::int64_t>(k) + 1;
      if (on_the_pin) trace_first_pin(t.machine);
    }
    optimise::parallel_for(trials.size(), context_.threads(),
                           [&](std::size_t i) { work(trials[i], fitters_[i], !on_the_pin); });
    for (Trial& t : trials)
      if (FamilyState* f = state_of(t.machine.shape.program->family)) count_and_take(*f, t);
  }

  void take(FamilyState& f, Trial&& t) {
    FoundMachine found{.machine = std::move(t.machine), .measures = t.measures, .origin = t.origin};
    if (!t.inside) {
      if (!f.outside || found.measures.error < f.outside->measures.error) f.outside = std::move(found);
      return;
    }
    if (found.measures.error < f.report.error) {
      f.report.error = found.measures.error, f.report.best_at = state_.curves;
      state_.progress.push_back(
          {.curves = state_.curves, .family = f.report.family, .error = found.measures.error});
    }
    insert_machine(f.archive, found, archive_size, true);
    insert_machine(f.elite, found, elite_size, false);
    keep_kin_apart(f.elite);
  }

  /// Keeps few of each kin, so that hops do not all end in one optimum.
  static void keep_kin_apart(std::vector<FoundMachine>& elite) {
    for (std::size_t i = 0; i < elite.size(); ++i) {
      const auto here = elite.begin() + static_cast<std::ptrdiff_t>(i);
      const auto kin =
          std::count_if(elite.begin(), here, [&](const FoundMachine& m) { return is_kin(m, *here); });
      if (kin == max_kin) elite.erase(here), --i;
    }
  }

  TypeSearchAnswer answer(Status status) {
    TypeSearchAnswer out;
    out.status = status;
    out.curves = state_.curves, out.progress = std::move(state_.progress);
    std::vector<FoundMachine> all;
    for (FamilyState& f : state_.families) {
      out.families.push_back(f.report);
      const std::vector<FoundMachine> chosen = chosen_of_family(f.archive);
      all.insert(all.end(), chosen.begin(), chosen.end());
      if (f.archive.empty() && f.outside) out.outside.push_back(*f.outside);
    }
    out.machines = chosen_of_all(all, options_.max_solutions);
    if (target_.dense)
      for (FoundMachine& found : out.machines) found.chamfer = chamfer_of(target_, found.machine);
    return out;
  }

  MotionTarget target_;
  TypeSearchOptions options_;
  RunContext& context_;
  SearchState state_;
  std::vector<MachineFitter> fitters_;  ///< one a trial of a round
  RunContext::Clock::time_point last_save_;
};

}  // namespace

double chamfer_of(const MotionTarget& target, const FittedMachine& m) {
  constexpr std::size_t count = 2000;
  std::vector<double> angle(count), x(count), y(count);
  const double from = m.angle.front(), to = target.stroke.closed ? from + m.sense * 2 * pi : m.angle.back();
  for (std::size_t k = 0; k < count; ++k)
    angle[k] = from + (to - from) * static_cast<double>(k) / (target.stroke.closed ? count : count - 1);
  compute_curve({.program = m.shape.program,
                 .x = m.shape.x.data(),
                 .signs = m.shape.signs,
                 .angle = angle.data(),
                 .count = count,
                 .px = x.data(),
                 .py = y.data()});
  std::vector<std::complex<double>> curve;
  for (std::size_t k = 0; k < count; ++k) curve.emplace_back(x[k], y[k]);
  return chamfer_distance(curve, target.stroke.closed, target.stroke.polyline, target.stroke.closed);
}

std::vector<MachineFamily> searched_families(const MotionTarget& target, const TypeSearchOptions& options) {
  std::vector<MachineFamily> out;
  for (const auto& family : names(MachineFamily{})) {
    const auto& wanted = options.families;
    const bool asked =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), family.value) != wanted.end();
    // Machines of ten links are grown, and so have no programs of their own in the list.
    const bool has_output = !programs_of(family.value, target.output).empty() ||
                            (family.value == MachineFamily::ten_bar && target.output == MachineOutput::point);
    if (asked && links_of(family.value) <= options.max_links && has_output) out.push_back(family.value);
  }
  return out;
}

TypeSearchAnswer search_types(const MotionTarget& target, const TypeSearchOptions& options,
                              RunContext& context) {
  return TypeSearch(target, options, context).run();
}

}  // namespace linkwright::planar
