// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cma_es.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/s11n.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/pagmo_bridge.h"

namespace linkwright::optimise {
namespace {

// Steps and differences of candidates smaller than this share of the box are nothing any more. Far below, the
// numbers of pagmo would be none.
constexpr double nothing = 1e-25;

/// The exchange that gives pagmo's problem its costs. pagmo evaluates one candidate after the other, although
/// it makes a whole generation before it evaluates the first. A generation therefore runs twice with the same
/// random numbers: once to note the candidates, left by an exception with the last of them, and once more
/// with their costs.
///
/// pagmo sees the unit box, so that neither thin nor huge ranges lose digits in its covariances.
struct Exchange {
  std::vector<double> lower, upper;
  Population* candidates = nullptr;
  const double* costs = nullptr;  ///< nullptr: candidates are noted
  std::size_t next = 0;
  pagmo::vector_double first;
  bool finite = true;    ///< all candidates noted were
  bool coincide = true;  ///< they are all the same

  double from_unit(std::size_t j, double u) const {
    return std::clamp(lower[j] * (1 - u) + upper[j] * u, lower[j], upper[j]);
  }
  double to_unit(std::size_t j, double x) const {
    // Halves, as the range may be too large for a number.
    return lower[j] < upper[j] ? (x / 2 - lower[j] / 2) / (upper[j] / 2 - lower[j] / 2) : 0.5;
  }
};
struct AllNoted {};

struct ExchangeProblem {
  Exchange* exchange = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& u) const {
    Exchange& e = *exchange;
    const std::size_t i = e.next++;
    if (e.costs) return {e.costs[i]};
    if (i == 0) e.first = u;
    for (std::size_t j = 0; j < u.size(); ++j) {
      e.finite &= std::isfinite(u[j]);
      e.coincide &= std::abs(u[j] - e.first[j]) < nothing;
      // Not a number goes to the bound as well: candidates lie in the box whatever happens.
      (*e.candidates)(j, i) = u[j] > 0 ? e.from_unit(j, u[j]) : e.lower[j];
    }
    if (e.next == e.candidates->size()) throw AllNoted{};
    return {0};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const std::size_t n = exchange->lower.size();
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
};

/// The numbers that pagmo's CMA-ES continues with, through its text archive: there is no other access to
/// them. In the archive every floating-point number has a decimal point (or is not finite) and nothing else
/// has; they come in this order: seven options, sigma, mean (n), scratch (n), candidates (lambda n, made
/// again in every generation), B, D, C and C^-1/2 (n^2 each), the paths p_c and p_sigma (n each), and then
/// two counters of evaluations.
class Archive {
 public:
  Archive(const pagmo::algorithm& algorithm, std::size_t n, std::size_t lambda) : n_(n) {
    std::ostringstream stream;
    {
      boost::archive::text_oarchive archive(stream, boost::archive::no_header);
      archive << algorithm;
    }
    const std::string text = stream.str();
    for (std::size_t first = 0; first <= text.size();) {
      const std::size_t end = std::min(text.find(' ', first), text.size());
      words_.push_back(text.substr(first, end - first));
      first = end + 1;
    }
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < words_.size(); ++k)
      if (words_[k].find('.') != std::string::npos || words_[k].ends_with("inf") ||
          words_[k].ends_with("nan"))
        all.push_back(k);
    const std::size_t skipped = n + lambda * n;
    LINKWRIGHT_REQUIRE(all.size() == 8 + n + skipped + 4 * n * n + 2 * n && all.back() + 2 < words_.size(),
                       "the archive of pagmo's CMA-ES has {} numbers, which is not as in pagmo 2.18",
                       all.size());
    const auto at = [&](std::size_t k) { return all.begin() + static_cast<std::ptrdiff_t>(k); };
    numbers_.assign(at(7), at(8 + n));
    numbers_.insert(numbers_.end(), at(8 + n + skipped), all.end());
    // The scratch was never written to.
    for (auto k = at(8 + n); k != at(8 + n + skipped); ++k) words_[*k] = "0.0";
    deviations_ = 1 + n + n * n;
    counters_ = all.back() + 1;
  }

  std::vector<double> numbers() const {
    std::vector<double> values;
    for (const std::size_t k : numbers_) values.push_back(value(k));
    return values;
  }
  /// Standard deviation of the longest axis.
  double step() const {
    double longest = 0;
    for (std::size_t k = 0; k < n_; ++k)
      longest = std::max(longest, std::abs(value(numbers_[deviations_ + k * (n_ + 1)])));
    return value(numbers_[0]) * longest;
  }
  std::vector<double> counters() const { return {value(counters_), value(counters_ + 1)}; }

  void write(std::span<const double> numbers, std::span<const double> counters, pagmo::algorithm& algorithm) {
    for (std::size_t k = 0; k < numbers.size(); ++k) words_[numbers_[k]] = fmt::format("{:.17e}", numbers[k]);
    for (std::size_t k = 0; k < 2; ++k)
      words_[counters_ + k] = fmt::format("{}", static_cast<std::uint64_t>(counters[k]));
    std::istringstream stream(fmt::format("{}", fmt::join(words_, " ")));
    boost::archive::text_iarchive archive(stream, boost::archive::no_header);
    archive >> algorithm;
  }

 private:
  double value(std::size_t k) const {
    double v = 0;
    std::from_chars(words_[k].data(), words_[k].data() + words_[k].size(), v);
    return v;
  }

  std::size_t n_;
  std::vector<std::string> words_;
  std::vector<std::size_t> numbers_;  ///< places in `words_`
  std::size_t deviations_ = 0;        ///< index in `numbers_` where D begins
  std::size_t counters_ = 0;
};

class CmaEs final : public Optimiser {
 public:
  CmaEs(std::span<const Variable> variables, const CmaEsOptions& options, std::size_t population,
        const Seed& seed)
      : Optimiser(variables, population, seed), initial_step_(options.initial_step), costs_(population) {
    exchange_.lower = lower_;
    exchange_.upper = upper_;
    exchange_.candidates = &candidates_;
    begin();
  }

  PopulationView members() const override { return candidates_.view(); }

 protected:
  void propose(const GenerationKey& key) override {
    if (exhausted_ > 0) return;
    // Half of the streams are kept for uses like this one, see Optimiser::Optimiser.
    generation_seed_ = RandomStream({key.seed, key.run, key.generation, 1u << 31}).bits();
    note_candidates();
    // Candidates may also coincide because all of them were moved to the same bounds.
    if (!exchange_.finite || (exchange_.coincide && !(archive().step() >= nothing))) exhausted_ = 1;
  }
  std::size_t proposed() const override { return exhausted_ > 0 ? 0 : population(); }

  void accept(const double* cost, const double* violation) override {
    if (exhausted_ > 0) return;
    for (std::size_t i = 0; i < population(); ++i)
      costs_[i] = cost_by_feasibility_rules(cost[i], violation[i]);
    if (generation() == 0) return begin();
    exchange_.costs = costs_.data();
    exchange_.next = 0;
    algorithm_.set_seed(generation_seed_);
    members_ = algorithm_.evolve(members_);
  }

  void visit_state(StateVisitor visit) override {
    constexpr double largest = std::numeric_limits<double>::max(), exact = 9007199254740992;  // 2^53
    Archive words = archive();
    std::vector<double> numbers = words.numbers(), counters = words.counters();
    if (exhausted_ > 0)  // nothing of it is used any more
      for (double& v : numbers) v = 0;
    const std::vector<double> numbers_before = numbers, counters_before = counters;
    visit(numbers, -largest, largest);
    visit(counters, 0, exact);
    visit({&exhausted_, 1}, 0, 1);
    visit_population(candidates_, visit);
    const bool finite =
        std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }) &&
        std::all_of(counters.begin(), counters.end(), [](double v) { return v >= 0 && v <= exact; });
    if (finite && exhausted_ == 0 && (numbers != numbers_before || counters != counters_before))
      words.write(numbers, counters, algorithm_);
  }

 private:
  /// From the candidates and `costs_`, without a memory. pagmo shapes its memory when it first runs, which
  /// must not be left to `visit_state`.
  void begin() {
    // Nothing ends by tolerances of pagmo, and nothing leaves the bounds, which is not its default.
    constexpr double automatic = -1, never = 0;
    algorithm_ = pagmo::algorithm(pagmo::cmaes(1, automatic, automatic, automatic, automatic, initial_step_,
                                               never, never, true, true, 0));
    members_ = pagmo::population(pagmo::problem(ExchangeProblem{&exchange_}), 0, 0);
    std::vector<double> u(dimension());
    for (std::size_t i = 0; i < population(); ++i) {
      for (std::size_t j = 0; j < dimension(); ++j) u[j] = exchange_.to_unit(j, candidates_(j, i));
      members_.push_back(u, {costs_[i]});
    }
    Population kept(dimension(), population());
    exchange_.candidates = &kept;
    note_candidates();
    exchange_.candidates = &candidates_;
  }

  Archive archive() {
    algorithm_.set_seed(0);  // it is set again before it is used
    return Archive(algorithm_, dimension(), population());
  }

  void note_candidates() {
    exchange_.costs = nullptr;
    exchange_.next = 0;
    exchange_.finite = exchange_.coincide = true;
    algorithm_.set_seed(generation_seed_);
    try {
      algorithm_.evolve(members_);
    } catch (const AllNoted&) {
    }
  }

  double initial_step_;
  std::vector<double> costs_;
  Exchange exchange_;
  pagmo::algorithm algorithm_;
  pagmo::population members_;
  unsigned generation_seed_ = 0;
  /// 1 when steps have become nothing: there are no candidates any more.
  double exhausted_ = 0;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const CmaEsOptions& options,
                                          const Seed& seed) {
  require_in_range("cma_es", options);
  LINKWRIGHT_REQUIRE(options.population == 0 || options.population >= 5,
                     "cma_es: population must be 0 or at least 5, got {}", options.population);
  const double by_dimension = 4 + std::floor(3 * std::log(static_cast<double>(variables.size())));
  const auto population = options.population > 0
                              ? static_cast<std::size_t>(options.population)
                              : static_cast<std::size_t>(variables.empty() ? 5 : std::max(by_dimension, 5.0));
  return std::make_unique<CmaEs>(variables, options, population, seed);
}

}  // namespace linkwright::optimise
