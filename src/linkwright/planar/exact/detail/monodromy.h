// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "linkwright/planar/exact/detail/follow.h"

namespace linkwright::planar {

/// Generic complex data of a system with all its solutions: where paths to other data start.
template <class System>
struct StartSet {
  SystemData<System> base{};
  std::vector<SystemPoint<System>> points;
  int loops = 0, followed = 0, lost = 0;  ///< number of loops, and of paths followed and lost, to find them
  Status status = Status::done;           ///< not_converged: fewer than expected; or interrupted
};

/// True if two identities are those of one solution.
bool same_identity(const ComplexNumber& a, const ComplexNumber& b);

/// Identities that were met, found again by their neighbours on a line.
class Identities {
 public:
  /// The number of the solution with this identity; -1 if there is none.
  int find(const ComplexNumber& identity) const;
  /// Numbers count up from 0.
  void add(const ComplexNumber& identity);
  int count() const { return count_; }

 private:
  struct Entry {
    ComplexNumber identity;
    int number;
  };
  std::vector<Entry> sorted_;
  int count_ = 0;
};

/// Finds solutions by monodromy: from one linkage, made together with its points, around closed paths through
/// random data, which permute the solutions, until `expected` are known and one more path brings no other.
/// Nothing but the seed goes in.
template <class System>
StartSet<System> find_starts(std::uint64_t seed, std::size_t expected, RunContext& context,
                             std::string_view stage = {}, const System& system = {});

/// The start set of a system with so many solutions, found at its first use and kept: a second at most. Its
/// status says that it was interrupted.
template <class System>
std::shared_ptr<const StartSet<System>> kept_starts(std::size_t expected, RunContext& context,
                                                    const System& system = {});

}  // namespace linkwright::planar
