// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/nine_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/exact/detail/certificate.h"
#include "linkwright/planar/exact/detail/nine_point_starts.h"

namespace linkwright::planar {
namespace {

using FineFourBar = ComplexFourBar<math::DoubleDouble>;
constexpr std::string_view following = "paths", proving_classes = "certificates";
constexpr double class_settled = 1e-13, fine_from = 1e-11, fine_settled = 1e-17;
constexpr double nearly_real = 1e-7;
// Identities that differ by less than the first, in their size, may be those of one class: with twice the
// digits they differ by less than the second, or they are not.
constexpr double perhaps_same = 1e-6, surely_same = 1e-10;

// More classes than these that are missing are those of special points: they are not sought by other means.
constexpr std::size_t max_sought = 24;

// A solution in the units of the target, where conjugates are exact.
struct FoundClass {
  FineFourBar fine;
  ComplexFourBar<> z;
  bool extended = false;
  ComplexNumber identity;
  bool identified = false, settled = false;  // states with twice the digits
};

// The target in units of a power of two near its size: the differences to the first point are exact.
struct NineTarget {
  ExactNinePoints fine;
  SystemData<NinePoints> p;
  double unit = 1;  // m

  explicit NineTarget(std::span<const std::complex<double>> points) {
    double size = 0;
    for (std::size_t j = 1; j < points.size(); ++j) size = std::max(size, std::abs(points[j] - points[0]));
    unit = std::exp2(std::floor(std::log2(size)));
    const auto difference = [&](double a, double b) {
      const math::DoubleDouble exact = math::DoubleDouble::sum(a, -b);
      return math::DoubleDouble(exact.high / unit, exact.low / unit);
    };
    for (std::size_t j = 0; j < NinePoints::others; ++j) {
      const std::complex<double>&point = points[j + 1], &first = points[0];
      fine[j] = {difference(point.real(), first.real()), difference(point.imag(), first.imag())};
      fine[NinePoints::others + j] = math::conj(fine[j]);
    }
    p = rounded(fine);
  }
};

// True if both pins of one half lie in the coupler point, but for rounding to `digits`: there whole families
// solve the equations: Newton's method comes to them from afar, and what it finds there is one of them unless
// a certificate says otherwise.
bool is_of_a_family(const NineTarget& target, const FineFourBar& z, double digits) {
  const double first = static_cast<double>(math::norm(z[pin_x]) + math::norm(z[pin_y])),
               second = static_cast<double>(math::norm(z[pin_X]) + math::norm(z[pin_Y]));
  if (std::min(first, second) > digits * digits * std::max(first, second)) return false;
  return !prove_class(target.fine, z, false, false);
}

// Newton's method to the last digits, with more of them where doubles do not converge; nullopt where
// solutions meet or there is none.
std::optional<FoundClass> finish_class(const NineTarget& target, ComplexFourBar<> z) {
  NinePoints::settle(z);
  FoundClass out;
  const double length = polish(NinePoints(), target.p, z, class_settled, 10);
  out.extended = !(length < fine_from);
  out.fine = widened(z);
  if (out.extended) {
    if (!(polish(NinePoints(), target.fine, out.fine, 1e-26, 14) < fine_settled)) return std::nullopt;
    z = rounded(out.fine);
  }
  if (is_of_a_family(target, out.fine, 1e-14)) return std::nullopt;
  out.z = z;
  out.identity = NinePoints::identity(z);
  if (!std::isfinite(math::norm(out.identity))) return std::nullopt;
  return out;
}
// The same of a place that is known with twice the digits, where doubles would lead away.
std::optional<FoundClass> finish_class(const NineTarget& target, FineFourBar fine) {
  take_smaller_cognate(fine, 0.95);
  if (!(polish(NinePoints(), target.fine, fine, 1e-26, 20) < fine_settled)) return std::nullopt;
  if (is_of_a_family(target, fine, 1e-24)) return std::nullopt;
  FoundClass out{.fine = fine, .z = rounded(fine), .extended = true, .identity = {}};
  out.identity = NinePoints::identity(out.z);
  if (!std::isfinite(math::norm(out.identity))) return std::nullopt;
  return out;
}

// Takes the identity with twice the digits, which it needs where links are long or classes near each other.
// False where Newton's method does not converge: there classes coincide.
bool identify(const NineTarget& target, FoundClass& found) {
  if (found.identified) return found.settled;
  found.identified = true;
  FineFourBar fine = found.fine;
  if (!(polish(NinePoints(), target.fine, fine, 1e-26, 8) < fine_settled)) return false;
  DoubleDoubleComplex above, below;
  NinePoints::identity_parts(fine.data(), above, below);
  const DoubleDoubleComplex ratio = above * math::inverse(below);
  const ComplexNumber identity(static_cast<double>(ratio.re), static_cast<double>(ratio.im));
  if (!std::isfinite(math::norm(identity))) return false;
  found.fine = fine;
  found.identity = identity;
  return found.settled = true;
}

bool is_real_class(const ComplexFourBar<>& z) {
  double off = 0;
  for (std::size_t i = 0; i < 4; ++i) off += math::norm(z[i + 4] - math::conj(z[i]));
  return off < nearly_real * nearly_real * squared_size(z);
}

// The classes that are known, with the paths that led to them.
class ClassCollection {
 public:
  explicit ClassCollection(const NineTarget& target) : target_(target) {}

  // False: known already.
  bool add(FoundClass found, int path) {
    int known = -1;
    for (const int near : near_to(found.identity)) {
      const bool alike = same_identity(found_[at(near)].identity, found.identity);
      // Both are taken to more digits, whatever comes of one.
      const bool this_one = identify(target_, found), other = identify(target_, found_[at(near)]);
      if (this_one && other ? apart(found_[at(near)].identity, found.identity) < surely_same : alike)
        known = near;
    }
    if (known >= 0) {
      if (path >= 0) {
        collided_.push_back(path);
        if (paths_[at(known)] >= 0) collided_.push_back(paths_[at(known)]);
      }
      return false;
    }
    order_.emplace(found.identity.re, static_cast<int>(found_.size()));
    paths_.push_back(path);
    found_.push_back(std::move(found));
    return true;
  }
  // Points are real: the conjugate of a solution is one as well.
  void add_conjugates(const NineTarget& target) {
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (const ComplexFourBar<> other = conjugate_four_bar(found_[i].z); !has(NinePoints::identity(other)))
        if (auto partner = finish_class(target, other)) add(std::move(*partner), -1);
  }
  std::vector<int> take_collided() {
    std::sort(collided_.begin(), collided_.end());
    collided_.erase(std::unique(collided_.begin(), collided_.end()), collided_.end());
    return std::exchange(collided_, {});
  }
  bool full() const { return found_.size() >= nine_point_classes; }
  std::vector<FoundClass>& found() { return found_; }

 private:
  static double apart(const ComplexNumber& a, const ComplexNumber& b) {
    return std::sqrt(math::norm(a - b)) / (1 + std::sqrt(math::norm(a)));
  }
  // The classes that may be the same; the real part of an identity may since have changed by rounding.
  std::vector<int> near_to(const ComplexNumber& identity) const {
    const double reach = 3 * perhaps_same * (1 + std::sqrt(math::norm(identity)));
    std::vector<int> out;
    for (auto i = order_.lower_bound(identity.re - reach);
         i != order_.end() && i->first <= identity.re + reach; ++i)
      if (apart(found_[at(i->second)].identity, identity) < perhaps_same) out.push_back(i->second);
    return out;
  }
  bool has(const ComplexNumber& identity) const {
    const std::vector<int> near = near_to(identity);
    return std::any_of(near.begin(), near.end(),
                       [&](int k) { return same_identity(found_[at(k)].identity, identity); });
  }

  const NineTarget& target_;
  std::multimap<double, int> order_;  // by the real part of the identity
  std::vector<FoundClass> found_;
  std::vector<int> paths_, collided_;
};

// Follows all classes of the start set to a target and collects what they become.
class NineSearch {
 public:
  NineSearch(const StartSet<NinePoints>& starts, const NineTarget& target, RunContext& context)
      : classes(target), starts_(starts), target_(target), context_(context), scaled_(target.p) {
    scaling_ = scale_towards<NinePoints>(starts.base, scaled_);
    back_ = {math::inverse(scaling_.place), math::inverse(scaling_.partner)};
  }

  void run(NinePointSolutions& out) {
    std::vector<int> all(starts_.points.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<int> open = attempt(all, {}, following);
    out.first_lost = static_cast<int>(open.size());
    classes.add_conjugates(target_);
    if (open.empty() || classes.full() || context_.interrupted()) return;
    open = attempt(open, small_steps, {});
    classes.add_conjugates(target_);
    if (open.empty() || classes.full() || context_.interrupted()) return;
    last_attempt(open, out);
    classes.add_conjugates(target_);
    const std::size_t missing = nine_point_classes - std::min(nine_point_classes, classes.found().size());
    if (missing == 0 || missing > max_sought || context_.interrupted()) return;
    by_another_way();
    classes.add_conjugates(target_);
  }

  ClassCollection classes;

 private:
  template <class T>
  ComplexFourBar<T> to_target(ComplexFourBar<T> z) const {
    const math::Complex<T> place(back_.place), partner(back_.partner);
    for (std::size_t i = 0; i < 4; ++i) z[i] = place * z[i], z[i + 4] = partner * z[i + 4];
    return z;
  }

  // Returns the paths that have not led to a class of their own; both of two that led to the same.
  std::vector<int> attempt(const std::vector<int>& which, const math::TrackerOptions& options,
                           std::string_view stage) {
    Paths<NinePoints> paths;
    for (const int i : which) paths.push_back({.z = starts_.points[at(i)]});
    paths = follow(NinePoints(), starts_.base, scaled_, paths, options, context_, stage);
    std::vector<std::optional<FoundClass>> ends(paths.size());
    optimise::parallel_for(paths.size(), context_.threads(), [&](std::size_t i) {
      if (paths[i].arrived) ends[i] = finish_class(target_, to_target(paths[i].z));
    });
    std::vector<int> open;
    stopped_.clear();
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (ends[i]) {
        classes.add(std::move(*ends[i]), which[i]);
      } else {
        open.push_back(which[i]);
        stopped_.push_back(paths[i]);
      }
    }
    for (const int i : classes.take_collided())
      if (std::find(open.begin(), open.end(), i) == open.end()) {
        open.push_back(i);
        stopped_.push_back({.z = starts_.points[at(i)]});
      }
    return open;
  }

  // All paths through other points: ends that were missed, because paths crossed unseen or came to a place
  // too near a singular one, are others there.
  void by_another_way() {
    RandomStream stream({.seed = 1443});
    SystemData<NinePoints> other;
    for (ComplexNumber& value : other) value = random_complex(stream);
    scale_towards<NinePoints>(starts_.base, other);
    Paths<NinePoints> paths;
    for (const SystemPoint<NinePoints>& z : starts_.points) paths.push_back({.z = z});
    paths = follow(NinePoints(), starts_.base, other, paths, small_steps, context_);
    std::erase_if(paths, [](const auto& path) { return !path.arrived; });
    for (auto& path : paths) path.at = 0;
    paths = follow(NinePoints(), other, scaled_, paths, small_steps, context_);
    std::vector<std::optional<FoundClass>> ends(paths.size());
    optimise::parallel_for(paths.size(), context_.threads(), [&](std::size_t i) {
      if (paths[i].arrived) ends[i] = finish_class(target_, to_target(paths[i].z));
    });
    for (auto& end : ends)
      if (end) classes.add(std::move(*end), -1);
  }

  // Continues with twice the digits from the point where doubles stopped; the end of a path that does not
  // arrive says why.
  void last_attempt(const std::vector<int>& open, NinePointSolutions& out) {
    enum class End { found, infinite, singular, lost };
    std::vector<End> ends(open.size(), End::lost);
    std::vector<std::optional<FoundClass>> found(open.size());
    optimise::parallel_for(open.size(), context_.threads(), [&](std::size_t i) {
      if (context_.interrupted()) return;
      math::TrackedPath<math::DoubleDouble, NinePoints::unknowns> path{.z = widened(stopped_[i].z),
                                                                       .at = stopped_[i].at};
      RunContext alone;  // the loop over paths is interrupted, not a path
      alone.set_threads(1);
      // Doubles also stop at ends that are only far out, where they cannot distinguish them from infinite
      // ones.
      if (!stopped_[i].arrived)
        path = follow(NinePoints(), starts_.base, scaled_, Paths<NinePoints, math::DoubleDouble>{path},
                      careful, alone)[0];
      const ComplexFourBar<> z = rounded(path.z);
      if (path.at >= 1 - nearly_there) found[i] = finish_class(target_, to_target(z));
      if (path.at >= 1 - nearly_there && !found[i]) found[i] = finish_class(target_, to_target(path.z));
      ComplexFourBar<> smallest = z;
      take_smaller_cognate(smallest, 1);
      ends[i] = found[i]                                     ? End::found
                : path.at < 1 - nearly_there                 ? End::lost
                : squared_size(smallest) > far_out * far_out ? End::infinite
                                                             : End::singular;
    });
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (ends[i] == End::found) classes.add(std::move(*found[i]), -1);
      if (ends[i] == End::infinite) ++out.infinite;
      if (ends[i] == End::lost) ++out.lost;
    }
  }

  const StartSet<NinePoints>& starts_;
  const NineTarget& target_;
  RunContext& context_;
  SystemData<NinePoints> scaled_;
  Scaling scaling_, back_;
  Paths<NinePoints> stopped_;
};

// A class with its certificate.
struct ClassProof {
  CurveClass curve;
  std::optional<CertifiedIdentity> identity;
};

std::vector<ClassProof> classify_classes(const NineTarget& target, const std::vector<FoundClass>& found,
                                         bool certify_them, RunContext& context) {
  std::vector<ClassProof> proofs(found.size());
  std::atomic<std::size_t> done{0};
  optimise::parallel_for(found.size(), context.threads(), [&](std::size_t i) {
    ClassProof& proof = proofs[i];
    proof.curve.extended = found[i].extended;
    proof.curve.real = is_real_class(found[i].z);
    const ComplexFourBar<> z = proof.curve.real ? real_four_bar(found[i].z) : found[i].z;
    for (std::size_t k = 0; k < z.size(); ++k) proof.curve.four_bar[k] = target.unit * standard_complex(z[k]);
    proof.identity = CertifiedIdentity{found[i].identity, infinity};
    if (!certify_them || context.interrupted()) return;
    if (const auto identity = prove_class(target.fine, found[i].fine, found[i].extended, proof.curve.real)) {
      proof.identity = identity;
      proof.curve.certified = true;
    }
    if (++done % 64 == 0)
      context.report(
          {proving_classes, static_cast<double>(done.load()) / static_cast<double>(found.size()), nan});
  });
  // Certified ones are different from each other if their identities are.
  std::sort(proofs.begin(), proofs.end(), [](const ClassProof& a, const ClassProof& b) {
    return std::pair(a.identity->identity.re, a.identity->identity.im) <
           std::pair(b.identity->identity.re, b.identity->identity.im);
  });
  double widest = 0;
  for (const ClassProof& p : proofs)
    if (p.curve.certified) widest = std::max(widest, p.identity->radius);
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    if (!proofs[i].curve.certified) continue;
    for (std::size_t j = i; j-- > 0;) {
      if (proofs[i].identity->identity.re - proofs[j].identity->identity.re >
          proofs[i].identity->radius + widest)
        break;
      if (!proofs[j].curve.certified) continue;
      const double reach = proofs[i].identity->radius + proofs[j].identity->radius;
      if (math::norm(proofs[i].identity->identity - proofs[j].identity->identity) <= reach * reach)
        proofs[i].curve.certified = false;
    }
  }
  std::stable_partition(proofs.begin(), proofs.end(), [](const ClassProof& p) { return p.curve.real; });
  return proofs;
}

}  // namespace

NinePointSolutions solve_nine_points(std::span<const std::complex<double>> points,
                                     const NinePointOptions& options, RunContext& context) {
  LINKWRIGHT_REQUIRE(points.size() == 9, "needs 9 points, got {}", points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    LINKWRIGHT_REQUIRE(std::isfinite(std::abs(points[i])), "point {} is not finite", i + 1);
  const PointObstacle blocked = obstacle(points);
  LINKWRIGHT_REQUIRE(blocked.kind == PointObstacle::none, "{} points are repeated, on a line or on a circle",
                     blocked.points.size());
  NinePointSolutions out;
  const auto starts = nine_point_starts(options.cache, context);
  if (starts->status != Status::done) {
    out.status = starts->status;
    return out;
  }
  const NineTarget target(points);
  NineSearch search(*starts, target, context);
  search.run(out);
  std::vector<ClassProof> proofs = classify_classes(target, search.classes.found(), options.certify, context);
  // If paths end without a class, or there are too many, a class that cannot be proved to be a simple
  // solution is a place where several meet.
  if (options.certify && proofs.size() != nine_point_classes && !context.interrupted())
    std::erase_if(proofs, [](const ClassProof& proof) { return !proof.curve.certified; });
  for (const ClassProof& proof : proofs) {
    out.classes.push_back(proof.curve);
    out.certified += proof.curve.certified;
    out.real += proof.curve.real;
  }
  // Each class takes one path. Of the others, some end at infinity, some got lost unless a conjugate made up
  // for them; the rest ended where classes meet.
  const int missing =
      std::max(0, static_cast<int>(nine_point_classes) - static_cast<int>(out.classes.size()));
  out.infinite = std::min(out.infinite, missing);
  out.lost = std::min(out.lost, missing - out.infinite);
  out.singular = missing - out.infinite - out.lost;
  const bool all = out.classes.size() == nine_point_classes;
  out.completeness = all && out.certified == static_cast<int>(nine_point_classes) ? Completeness::complete
                     : all           ? Completeness::complete_uncertified
                     : out.lost == 0 ? Completeness::special_target
                                     : Completeness::incomplete;
  out.status = context.interruption();
  if (out.status != Status::done) {
    out.completeness = Completeness::incomplete;
    out.infinite = out.singular = out.lost = 0;  // nobody knows: they were not followed to their end
  }
  return out;
}

std::vector<TracingFourBar> cognates_of(const CurveClass& curve, std::complex<double> first_point) {
  std::vector<TracingFourBar> out;
  ComplexFourBar<> z;
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = complex_number(curve.four_bar[k]);
  for (int i = 0; i < 3; ++i, z = next_cognate(z)) {
    const auto place = [&](FourBarUnknown which) { return first_point + standard_complex(z[which]); };
    const TracingFourBar bars{place(pivot_a), place(pin_x), place(pin_y), place(pivot_b)};
    const double size = std::sqrt(squared_size(z));
    if (std::isfinite(size) && std::abs(bars.crank_pin - bars.rocker_pin) > 0) out.push_back(bars);
  }
  return out;
}

PointObstacle obstacle(std::span<const std::complex<double>> points) {
  const int n = static_cast<int>(points.size());
  std::complex<double> centre;
  for (const auto& p : points) centre += p / static_cast<double>(n);
  double size = 0;
  for (const auto& p : points) size = std::max(size, std::abs(p - centre));
  const double same = 1e-9 * size;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(points[at(i)] - points[at(j)]) <= same) return {PointObstacle::repeated, {j, i}};
  constexpr std::size_t too_many = 7;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const std::complex<double> along = points[at(j)] - points[at(i)];
      std::vector<int> on;
      for (int k = 0; k < n; ++k)
        if (std::abs((std::conj(along) * (points[at(k)] - points[at(i)])).imag()) <= same * std::abs(along))
          on.push_back(k);
      if (on.size() >= too_many) return {PointObstacle::collinear, on};
    }
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        // Centre of the circle through three points, from the first one.
        const std::complex<double> u = points[at(j)] - points[at(i)], v = points[at(k)] - points[at(i)];
        const double area = 2 * (std::conj(u) * v).imag();
        if (std::abs(area) <= 1e-6 * std::abs(u) * std::abs(v)) continue;
        const std::complex<double> middle =
            std::complex<double>(0, 1) * (std::norm(v) * u - std::norm(u) * v) / area;
        std::vector<int> on;
        for (int m = 0; m < n; ++m)
          if (std::abs(std::abs(points[at(m)] - points[at(i)] - middle) - std::abs(middle)) <= same)
            on.push_back(m);
        if (on.size() >= too_many) return {PointObstacle::concyclic, on};
      }
  return {};
}

}  // namespace linkwright::planar
