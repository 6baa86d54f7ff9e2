// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/optimise/levy_flight.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/optimise/rounds.h"

namespace linkwright::optimise {

/// The common base of fireflies and cuckoos: members with their costs, moved one after the other, so that a
/// generation has as many rounds as moves. Distances and steps are those of the unit cube, in parts of the
/// width of the box.
///
/// Random numbers are those of a stream for each member and use, not of one sequence: numbers that a move
/// does not draw shift no others.
class SwarmBase : public Optimiser {
 public:
  PopulationView members() const override { return members_.view(); }

 protected:
  SwarmBase(std::span<const Variable> variables, int population, const Seed& seed, std::size_t objectives);

  void propose(const GenerationKey&) final;
  std::size_t proposed() const final { return made_; }
  void accept(const double* cost, const double* violation) final;
  bool goes_on() const final { return made_ != Rounds::generation_over; }
  void visit_state(StateVisitor visit) final;

  /// Iterations finished: t = 0 in the generation after the first.
  double iteration() const { return generation() - 1.0; }

  /// Streams of this generation. `use` 0 and 1 have one for each member, 2 one for all.
  RandomStream random(std::uint32_t use, std::size_t member = 0) const;

  /// Makes `order` a random permutation of 0, 1, ...
  static void shuffle(std::span<std::uint32_t> order, RandomStream& random);

  bool member_better(std::size_t a, std::size_t b) const {
    return better(member_costs(a), violation_[a], member_costs(b), violation_[b]);
  }
  /// True if member a comes before member b in the order from the best to the worst. With one objective this
  /// is the order of member_better; with several, where that is no order, feasible ones by the mean of their
  /// costs relative to those of the best so far, infeasible ones by violation.
  bool member_ranks_before(std::size_t a, std::size_t b) const;
  /// True if candidate c, now evaluated, is better than member i.
  bool candidate_better(std::size_t c, std::size_t i) const {
    return better({answer_cost_ + c * objectives(), objectives()}, answer_violation_[c], member_costs(i),
                  violation_[i]);
  }
  bool candidate_feasible(std::size_t c) const { return !(answer_violation_[c] > 0); }
  /// Member i becomes candidate c, now evaluated.
  void replace(std::size_t i, std::size_t c);

  /// Candidate c = a Levy flight of member i, Eq. (2.130).
  void fly(std::size_t c, std::size_t i, const LevyFlight& flight, double scale, RandomStream& random);

  /// The loop of the method; a derived class sets it at the end of its construction.
  Rounds rounds_;
  Population members_;
  std::vector<double> cost_, violation_;       ///< costs of a member one after the other
  std::vector<double> width_, inverse_width_;  ///< width of the box; the inverse of 0 is 0

 private:
  std::span<const double> member_costs(std::size_t i) const {
    return {cost_.data() + i * objectives(), objectives()};
  }

  std::size_t made_ = 0;
  const double *answer_cost_ = nullptr, *answer_violation_ = nullptr;
};

}  // namespace linkwright::optimise
