// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace linkwright {

/// The key of a stream of random numbers: a counter-based stream is a pure function of this key, so a result
/// does not depend on the number of threads or on the order in which candidates are drawn.
struct StreamKey {
  std::uint64_t seed = 0;  ///< given by the user
  std::uint32_t run = 0;   ///< number of the use of the seed: start number, algorithm stage
  std::uint32_t generation = 0;
  std::uint32_t individual = 0;
};

/// Sequence of random numbers of one key (Philox4x32-10 of Salmon et al. 2011 through Random123), with
/// portable transforms of our own: the same numbers with every standard library.
class RandomStream {
 public:
  explicit RandomStream(const StreamKey& key);

  std::uint32_t bits();
  /// Uniform on [0, 1), multiples of 2^-53.
  double uniform();
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
  /// Uniform integer on [0, count), count >= 1, without bias.
  std::uint32_t below(std::uint32_t count);
  /// Standard normal (polar-free Box-Muller, both values used).
  double normal();
  /// Standard Cauchy.
  double cauchy();

 private:
  std::uint32_t key_[2];
  std::uint32_t counter_[4];
  std::uint32_t block_[4];
  int used_ = 4;
  double spare_normal_ = 0;
  bool has_spare_normal_ = false;
};

}  // namespace linkwright
