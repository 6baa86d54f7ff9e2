// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/nine_point_starts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/exact/detail/certificate.h"

namespace linkwright::planar {
namespace {

constexpr std::uint64_t nine_point_seed = 1;
constexpr double trace_test_tolerance = 1e-9;
constexpr std::string_view finding_starts = "nine-point starts";
// The format of the file; its number goes up when what follows it, or how it is found, changes.
constexpr std::string_view starts_signature = "linkwright nine-point starts 1\n";

using NineStarts = StartSet<NinePoints>;
constexpr std::size_t doubles_of_starts = 2 * (NinePoints::data + nine_point_classes * NinePoints::unknowns);

bool all_starts_certified(const NineStarts& set, RunContext& context) {
  const ExactNinePoints p = widened(set.base);
  std::vector<CertifiedIdentity> identities(set.points.size());
  std::atomic<bool> all{true};
  optimise::parallel_for(set.points.size(), context.threads(), [&](std::size_t i) {
    if (context.interrupted() || !all) return;
    if (const auto ball = certify(p, set.points[i])) {
      identities[i] = certified_identity(set.points[i], *ball);
      return;
    }
    ComplexFourBar<math::DoubleDouble> fine = widened(set.points[i]);
    polish(NinePoints(), p, fine, 1e-26);
    if (const auto ball = certify(p, fine))
      identities[i] = certified_identity(fine, *ball);
    else
      all = false;
  });
  if (!all || context.interrupted()) return false;
  for (std::size_t i = 0; i < identities.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double reach = identities[i].radius + identities[j].radius;
      if (!(math::norm(identities[i].identity - identities[j].identity) > reach * reach)) return false;
    }
  return true;
}

std::filesystem::path starts_file(const std::filesystem::path& cache) {
  return cache / ("nine-point-starts-" + std::to_string(nine_point_seed) + ".bin");
}

}  // namespace

TraceTest trace_test(const NineStarts& starts, RunContext& context, int without) {
  RandomStream stream({.seed = 3, .run = 6});
  NinePointsTrace::Form moved, traced;
  for (NinePointsTrace::Form* form : {&moved, &traced})
    for (std::size_t m = 0; m < NinePointsTrace::forms; ++m)
      form->d[m] = random_complex(stream), form->D[m] = random_complex(stream),
      form->weight[m] = random_complex(stream);
  const auto value_of = [](const NinePointsTrace::Form& form, const SystemPoint<NinePoints>& z) {
    ComplexNumber sum;
    for (std::size_t m = 0; m < NinePointsTrace::forms; ++m)
      sum = sum + form.weight[m] * CurveEquation<ComplexNumber>(z.data(), form.d[m], form.D[m]).value;
    return sum;
  };

  Paths<NinePointsTrace> paths;
  for (std::size_t i = 0; i < starts.points.size(); ++i)
    if (static_cast<int>(i) != without) paths.push_back({.z = starts.points[i]});
  const NinePointsTrace system{&moved};
  const ComplexNumber step(0.11, 0.07);
  SystemData<NinePointsTrace> from{}, to{};
  std::copy(starts.base.begin(), starts.base.end(), from.begin());
  std::copy(starts.base.begin(), starts.base.end(), to.begin());
  const std::size_t moving = 2 * NinePointsTrace::others;
  TraceTest out;
  bool lost = false;
  std::vector<ComplexNumber> share[3];  // shares of each class
  for (int position = 0; position < 3; ++position) {
    if (position > 0) {
      to[moving] = static_cast<double>(position) * step;
      const Paths<NinePointsTrace> before = paths;
      paths = follow(system, from, to, before, {}, context);
      for (std::size_t i = 0; i < paths.size(); ++i) {
        auto& path = paths[i];
        if (!path.arrived && !context.interrupted()) {
          const auto again = follow(system, from, to,
                                    Paths<NinePointsTrace, math::DoubleDouble>{{.z = widened(before[i].z)}},
                                    careful, context)[0];
          path.arrived = again.arrived;
          path.z = rounded(again.z);
        }
        take_smaller_cognate(path.z, 0.95);
        lost = lost || !path.arrived || !(polish_as_needed(system, to, path.z, 1e-13) < 1e-9);
        path.at = 0;
      }
      from = to;
    }
    for (const auto& path : paths)
      share[position].push_back(value_of(traced, path.z) * math::inverse(value_of(moved, path.z)));
  }
  ComplexNumber first, second;
  double least = -1;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const ComplexNumber change = share[1][i] - share[0][i], bend = share[2][i] - share[1][i] - change;
    first = first + change;
    second = second + bend;
    if (least < 0 || math::norm(bend) < least) least = math::norm(bend);
  }
  out.first = std::sqrt(math::norm(first));
  out.second = std::sqrt(math::norm(second));
  out.least = std::sqrt(std::max(least, 0.0));
  out.passed = !lost && out.second <= trace_test_tolerance * out.first;
  return out;
}

std::optional<NineStarts> read_nine_point_starts(const std::filesystem::path& cache) {
  NineStarts set;
  std::ifstream in(starts_file(cache), std::ios::binary);
  std::string head(starts_signature.size(), '\0');
  std::vector<double> numbers(doubles_of_starts);
  if (!in.read(head.data(), static_cast<std::streamsize>(head.size())) || head != starts_signature)
    return std::nullopt;
  if (!in.read(reinterpret_cast<char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(double))) ||
      in.peek() != std::ifstream::traits_type::eof())
    return std::nullopt;
  std::size_t next = 0;
  const auto take = [&](ComplexNumber& value) {
    value = {numbers[next], numbers[next + 1]};
    next += 2;
  };
  for (ComplexNumber& value : set.base) take(value);
  set.points.resize(nine_point_classes);
  Identities identities;
  for (auto& point : set.points) {
    for (ComplexNumber& value : point) take(value);
    SystemPoint<NinePoints> corrected = point;
    if (!(newton_step(NinePoints(), set.base, corrected) < 1e-9)) return std::nullopt;
    const ComplexNumber identity = NinePoints::identity(point);
    if (identities.find(identity) >= 0) return std::nullopt;
    identities.add(identity);
  }
  return set;
}

void write_nine_point_starts(const std::filesystem::path& cache, const NineStarts& set) {
  std::vector<double> numbers;
  numbers.reserve(doubles_of_starts);
  const auto put = [&](const ComplexNumber& value) {
    numbers.push_back(value.re);
    numbers.push_back(value.im);
  };
  for (const ComplexNumber& value : set.base) put(value);
  for (const auto& point : set.points)
    for (const ComplexNumber& value : point) put(value);
  std::error_code failed;
  std::filesystem::create_directories(cache, failed);
  if (failed) return;
  // Under a name of its own first, so that another program never reads half a file.
  const std::filesystem::path file = starts_file(cache);
  std::filesystem::path part = file;
  part +=
      "." + std::to_string(reinterpret_cast<std::uintptr_t>(&numbers) ^
                           static_cast<std::uintptr_t>(RunContext::Clock::now().time_since_epoch().count()));
  {
    std::ofstream out(part, std::ios::binary);
    out.write(starts_signature.data(), static_cast<std::streamsize>(starts_signature.size()));
    out.write(reinterpret_cast<const char*>(numbers.data()),
              static_cast<std::streamsize>(numbers.size() * sizeof(double)));
    if (!out.flush()) failed = std::make_error_code(std::errc::io_error);
  }
  if (!failed) std::filesystem::rename(part, file, failed);
  if (failed) std::filesystem::remove(part, failed);
}

std::shared_ptr<const NineStarts> nine_point_starts(const std::filesystem::path& cache, RunContext& context) {
  static std::mutex one_at_a_time;
  static std::shared_ptr<const NineStarts> kept;
  const std::lock_guard lock(one_at_a_time);
  if (kept) return kept;
  auto set = std::make_shared<NineStarts>();
  if (!cache.empty())
    if (auto found = read_nine_point_starts(cache)) {
      *set = std::move(*found);
      return kept = set;
    }
  *set = find_starts<NinePoints>(nine_point_seed, nine_point_classes, context, finding_starts);
  if (set->status != Status::done) return set;
  if (!trace_test(*set, context).passed || !all_starts_certified(*set, context)) {
    set->status = context.interrupted() ? context.interruption() : Status::not_converged;
    return set;
  }
  if (!cache.empty()) write_nine_point_starts(cache, *set);
  return kept = set;
}

std::filesystem::path user_cache_folder() {
  for (const auto& [variable, below] : {std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")})
    if (const char* folder = std::getenv(variable); folder && *folder)
      return std::filesystem::path(folder) / below / "linkwright";
  return {};
}

}  // namespace linkwright::planar
