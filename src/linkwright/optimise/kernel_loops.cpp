// SPDX-License-Identifier: BSD-3-Clause

// The loops of kernels.h for one instruction set. This source must not use inline functions of other headers:
// where it is compiled for a newer processor, the linker could keep that copy for everybody. Hence it has no
// standard algorithms, and an unnamed namespace.
#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "linkwright/core/kernels.h"
#include "linkwright/optimise/kernels.h"

namespace linkwright::optimise {
namespace {

// Doubles in a register.
#define LINKWRIGHT_LANES_OF_baseline 2
#define LINKWRIGHT_LANES_OF_avx2 4
#define LINKWRIGHT_LANES_OF_avx512 8
#define LINKWRIGHT_LANES LINKWRIGHT_COMPILED(LINKWRIGHT_LANES_OF)
constexpr std::size_t lanes = LINKWRIGHT_LANES;
using Real __attribute__((vector_size(8 * lanes))) = double;
using Word __attribute__((vector_size(8 * lanes))) = std::uint64_t;
using Mask __attribute__((vector_size(8 * lanes))) = std::int64_t;

#define LINKWRIGHT_INLINE __attribute__((always_inline)) inline

LINKWRIGHT_INLINE Real load(const double* p) {
  Real v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
LINKWRIGHT_INLINE void store(double* p, Real v) { __builtin_memcpy(p, &v, sizeof v); }
LINKWRIGHT_INLINE Real splat(double v) { return v - Real{}; }
LINKWRIGHT_INLINE Word splat_word(std::uint64_t v) { return v - Word{}; }
LINKWRIGHT_INLINE Real choose(Mask m, Real a, Real b) { return m ? a : b; }
LINKWRIGHT_INLINE Real absolute(Real v) { return (Real)((Word)v & splat_word(0x7fffffffffffffff)); }

/// Candidates first, first + 1, ... of each lane.
LINKWRIGHT_INLINE Word lane_numbers(std::uint64_t first) {
  Word v;
  for (std::size_t k = 0; k < lanes; ++k) v[k] = first + k;
  return v;
}

/// Product of the low halves.
LINKWRIGHT_INLINE Word multiply_low(Word a, Word b) {
#if defined(__x86_64__) && LINKWRIGHT_LANES == 2
  return (Word)_mm_mul_epu32((__m128i)a, (__m128i)b);
#elif defined(__x86_64__) && LINKWRIGHT_LANES == 4
  return (Word)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#elif defined(__x86_64__) && LINKWRIGHT_LANES == 8
  return (Word)_mm512_mul_epu32((__m512i)a, (__m512i)b);
#else
  const Word low = splat_word(0xffffffff);
  return (a & low) * (b & low);
#endif
}

/// Integers below 2^52 as doubles and back, exactly: the integer is put into the fraction of 2^52.
LINKWRIGHT_INLINE Real to_real(Word v) { return (Real)(v | splat_word(0x4330000000000000)) - 0x1p52; }
LINKWRIGHT_INLINE Word to_word(Real v) { return (Word)(v + 0x1p52) & splat_word(0xfffffffffffff); }

/// Philox4x32-10 (Salmon et al. 2011) for one candidate a lane.
struct Philox {
  struct Block {
    Word word[4];
  };

  explicit LINKWRIGHT_INLINE Philox(const GenerationKey& k)
      : generation(splat_word(k.generation)), run(splat_word(k.run)) {
    auto k0 = static_cast<std::uint32_t>(k.seed), k1 = static_cast<std::uint32_t>(k.seed >> 32);
    for (auto& round : key) {
      round[0] = splat_word(k0);
      round[1] = splat_word(k1);
      k0 += 0x9E3779B9u;
      k1 += 0xBB67AE85u;
    }
  }

  LINKWRIGHT_INLINE Block operator()(Word individual, std::uint32_t block) const {
    // The upper halves hold rubbish on the way: multiplication ignores them.
    Word c0 = splat_word(block), c1 = individual, c2 = generation, c3 = run;
    const Word m0 = splat_word(0xD2511F53u), m1 = splat_word(0xCD9E8D57u);
#pragma GCC unroll 10
    for (int i = 0; i < 10; ++i) {
      const Word p0 = multiply_low(c0, m0), p1 = multiply_low(c2, m1);
      c0 = (p1 >> 32) ^ c1 ^ key[i][0];
      c1 = p1;
      c2 = (p0 >> 32) ^ c3 ^ key[i][1];
      c3 = p0;
    }
    const Word low = splat_word(0xffffffff);
    return {{c0 & low, c1 & low, c2 & low, c3 & low}};
  }

  Word generation, run;
  Word key[10][2];
};

LINKWRIGHT_INLINE Real gather(const double* row, const std::uint64_t* index) {
  Real v;
  for (std::size_t k = 0; k < lanes; ++k) v[k] = row[index[k]];
  return v;
}

/// Uniform integer on [0, count) from 32 random bits: the favour of some results is below count / 2^32.
LINKWRIGHT_INLINE Real below(Word bits, std::size_t count) {
  return to_real(multiply_low(bits, splat_word(count)) >> 32);
}

LINKWRIGHT_INLINE Real smaller(Real a, Real b) { return choose(a < b, a, b); }
LINKWRIGHT_INLINE Real larger(Real a, Real b) { return choose(a > b, a, b); }
/// Passes over a number that is taken.
LINKWRIGHT_INLINE Real skip(Real v, Real taken) { return choose(v >= taken, v + 1.0, v); }

void differential_evolution(const DifferentialEvolutionStep& s) {
  const Philox philox(s.key);
  const std::size_t dimension = s.shape.dimension, size = s.shape.size, stride = s.shape.stride;
  for (std::size_t i = 0; i < size; i += lanes) {
    const Word candidate = lane_numbers(i);
    const Philox::Block choice = philox(candidate, 0);
    // Members from what is left after the earlier ones are taken out.
    const Real self = to_real(candidate);
    const Real r1 = skip(below(choice.word[0], size - 1), self);
    const Real low = smaller(self, r1), high = larger(self, r1);
    const Real r2 = skip(skip(below(choice.word[1], size - 2), low), high);
    const Real first = smaller(low, r2), last = larger(high, r2), middle = larger(low, smaller(high, r2));
    const Real r3 = skip(skip(skip(below(choice.word[2], size - 3), first), middle), last);
    const Real always = below(choice.word[3], dimension);
    std::uint64_t index1[lanes], index2[lanes], index3[lanes];
    const Word w1 = to_word(r1), w2 = to_word(r2), w3 = to_word(r3);
    __builtin_memcpy(index1, &w1, sizeof w1);
    __builtin_memcpy(index2, &w2, sizeof w2);
    __builtin_memcpy(index3, &w3, sizeof w3);

    const Real scale = load(s.scale + i);
    const Real limit = load(s.crossover + i) * 0xffffffffp0;
    for (std::size_t j0 = 0; j0 < dimension; j0 += 4) {
      const Philox::Block crossing =
          philox(candidate, s.crossover_word / 4 + static_cast<std::uint32_t>(j0 / 4));
      const std::size_t count = dimension - j0 < 4 ? dimension - j0 : 4;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t j = j0 + k;
        const double* row = s.population + j * stride;
        const Real base = gather(row, index1);
        Real v = base + scale * (gather(row, index2) - gather(row, index3));
        const Real lower = splat(s.lower[j]), upper = splat(s.upper[j]);
        v = choose(v < lower, 0.5 * (base + lower), choose(v > upper, 0.5 * (base + upper), v));
        const Mask crossed = (to_real(crossing.word[k]) <= limit) | (always == splat(static_cast<double>(j)));
        store(s.trial + j * stride + i, choose(crossed, v, load(row + i)));
      }
    }
  }
}

void self_adaptation(const SelfAdaptationStep& s) {
  const Philox philox(s.key);
  for (std::size_t i = 0; i < s.size; i += lanes) {
    const Philox::Block r = philox(lane_numbers(i), 1);
    const Real scale = s.scale_lower + s.scale_width * (to_real(r.word[0]) * 0x1p-32);
    store(s.trial_scale + i, choose(to_real(r.word[1]) * 0x1p-32 < s.scale_rate, scale, load(s.scale + i)));
    store(s.trial_crossover + i, choose(to_real(r.word[3]) * 0x1p-32 < s.crossover_rate,
                                        to_real(r.word[2]) * 0x1p-32, load(s.crossover + i)));
  }
}

void grey_wolf(const GreyWolfStep& s) {
  const Philox philox(s.key);
  const std::size_t dimension = s.shape.dimension, stride = s.shape.stride;
  const Real a = splat(s.a);
  for (std::size_t i = 0; i < s.shape.size; i += lanes) {
    const Word candidate = lane_numbers(i);
    for (std::size_t j0 = 0; j0 < dimension; j0 += 2) {  // two variables use up three blocks
      Word word[12];
      for (std::size_t b = 0; b < 3; ++b) {
        const Philox::Block block = philox(candidate, static_cast<std::uint32_t>(3 * (j0 / 2) + b));
        for (std::size_t k = 0; k < 4; ++k) word[4 * b + k] = block.word[k];
      }
      for (std::size_t j = j0; j < dimension && j < j0 + 2; ++j) {
        double* row = s.pack + j * stride + i;
        const Real x = load(row);
        Real sum = {};
        for (std::size_t k = 0; k < 3; ++k) {
          const Word* r = word + 6 * (j - j0) + 2 * k;
          const Real leader = splat(s.leaders[k][j]);
          const Real reach = a * (to_real(r[0]) * 0x1p-31 - 1.0);                // A = a (2 r1 - 1)
          const Real distance = absolute(to_real(r[1]) * 0x1p-31 * leader - x);  // C = 2 r2
          const Real near = leader - reach * distance;
          sum += s.absolute_value ? absolute(near) : near;
        }
        const Real lower = splat(s.lower[j]), upper = splat(s.upper[j]);
        store(row, smaller(larger(sum / 3.0, lower), upper));
      }
    }
  }
}

void select(std::size_t size, const double* trial_cost, const double* trial_violation, double* cost,
            double* violation, std::uint64_t* chosen) {
  for (std::size_t i = 0; i < size; i += lanes) {
    const Real ct = load(trial_cost + i), vt = load(trial_violation + i), c = load(cost + i),
               v = load(violation + i);
    const Mask take = (vt < v) | ((vt == v) & (ct <= c));
    store(cost + i, choose(take, ct, c));
    store(violation + i, choose(take, vt, v));
    __builtin_memcpy(chosen + i, &take, sizeof take);
  }
}

void copy_chosen(const KernelShape& shape, const std::uint64_t* chosen, const double* from, double* to) {
  for (std::size_t j = 0; j < shape.dimension; ++j)
    for (std::size_t i = j * shape.stride, m = 0; m < shape.size; i += lanes, m += lanes) {
      Mask take;
      __builtin_memcpy(&take, chosen + m, sizeof take);
      store(to + i, choose(take, load(from + i), load(to + i)));
    }
}

}  // namespace

const Kernels LINKWRIGHT_COMPILED(loops) = {differential_evolution, self_adaptation, grey_wolf, select,
                                            copy_chosen};

}  // namespace linkwright::optimise
