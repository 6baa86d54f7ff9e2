// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/packed.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>

#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"

namespace linkwright::report {
namespace {

std::string deflated(std::string_view bytes) {
  z_stream stream{};
  constexpr int level = 7;             // 9 is a hundredth smaller and takes three to nine times as long
  constexpr int without_header = -15;  // zlib's code for the largest window, without header
  if (deflateInit2(&stream, level, Z_DEFLATED, without_header, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  // zlib reads through a pointer to bytes that are not const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int end = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) throw std::runtime_error("zlib could not compress the data of the report");
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : letters[three >> (18 - 6 * k) & 63];
  }
  return out;
}

// A list as the text has it: "[1.0, null]".
std::string list_text(const std::vector<double>& numbers, std::string_view separator) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) out += separator;
    out += study::to_json(Value(numbers[i]));
  }
  return out + "]";
}

// The numbers of the list that begins the text, and its length there.
struct FoundList {
  std::vector<double> numbers;
  std::size_t length = 0;
};
std::optional<FoundList> list_at(std::string_view text, std::string_view separator) {
  FoundList out;
  const char* at = text.data() + 1;
  const char* const end = text.data() + text.size();
  constexpr std::string_view none = "null";
  for (;;) {
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    double value = nan;
    if (rest.starts_with(none)) {
      at += none.size();
    } else {
      const auto [after, error] = std::from_chars(at, end, value);
      if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
      at = after;
    }
    out.numbers.push_back(value);
    const std::string_view next(at, static_cast<std::size_t>(end - at));
    if (next.starts_with(']')) {
      out.length = static_cast<std::size_t>(at - text.data()) + 1;
      return out;
    }
    if (!next.starts_with(separator)) return std::nullopt;
    at += separator.size();
  }
}

constexpr double missing_whole = std::numeric_limits<std::int32_t>::min();

// Decimals with which all numbers are whole in 32 bits; nothing when there are none.
std::optional<int> decimals_of(const std::vector<double>& numbers) {
  // Powers of ten up to here are doubles.
  for (int decimals = 0; decimals <= 22; ++decimals) {
    const double power = std::pow(10.0, decimals);
    const auto whole = [power](double v) {
      const double scaled = std::nearbyint(v * power);
      return std::isnan(v) ||
             (std::abs(scaled) < -missing_whole && scaled / power == v && !(v == 0 && std::signbit(v)));
    };
    if (std::all_of(numbers.begin(), numbers.end(), whole)) return decimals;
  }
  return std::nullopt;
}

// Differences of an order, signs last: small ones of either sign are small numbers.
template <class Unsigned>
std::vector<Unsigned> differences(std::vector<Unsigned> bits, int order) {
  for (int k = 0; k < order; ++k)
    for (std::size_t i = bits.size(); i-- > 1;) bits[i] = static_cast<Unsigned>(bits[i] - bits[i - 1]);
  constexpr int last = std::numeric_limits<Unsigned>::digits - 1;
  for (Unsigned& d : bits)
    d = static_cast<Unsigned>(d << 1) ^ static_cast<Unsigned>(d >> last ? ~Unsigned{0} : Unsigned{0});
  return bits;
}

// The bytes of the order that leaves the fewest bits.
template <class Unsigned>
int put_differences(std::string& out, const std::vector<Unsigned>& bits) {
  constexpr int orders = 5;
  std::vector<Unsigned> best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  int chosen = 0;
  for (int order = 0; order < orders; ++order) {
    std::vector<Unsigned> left = differences(bits, order);
    std::size_t cost = 0;
    for (const Unsigned d : left) cost += static_cast<std::size_t>(std::bit_width(d));
    if (cost >= least) continue;
    least = cost;
    best = std::move(left);
    chosen = order;
  }
  for (std::size_t byte = 0; byte < sizeof(Unsigned); ++byte)
    for (const Unsigned d : best) out += static_cast<char>(d >> (8 * byte) & 0xFF);
  return chosen;
}

}  // namespace

std::string packed(std::string_view bytes) { return base64(deflated(bytes)); }

std::string NumberPack::take(std::string_view json, std::string_view separator) {
  std::string out;
  for (std::size_t i = 0; i < json.size();) {
    if (json[i] == '"') {
      std::size_t end = i + 1;
      while (end < json.size() && json[end] != '"') end += json[end] == '\\' ? 2 : 1;
      out += json.substr(i, end + 1 - i);
      i = end + 1;
      continue;
    }
    const auto list = json[i] == '[' ? list_at(json.substr(i), separator) : std::nullopt;
    if (list && list->numbers.size() >= shortest &&
        list_text(list->numbers, separator) == json.substr(i, list->length)) {
      fmt::format_to(std::back_inserter(out), "{{\"\":{}}}", add(list->numbers));
      i += list->length;
      continue;
    }
    out += json[i++];
  }
  return out;
}

std::size_t NumberPack::add(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> bits;
  for (const double v : numbers) bits.push_back(std::bit_cast<std::uint64_t>(std::isnan(v) ? nan : v));
  const auto [entry, fresh] = known_.try_emplace(bits, known_.size());
  if (!fresh) return entry->second;
  int order = 0;
  const auto decimals = decimals_of(numbers);
  if (decimals) {
    const double power = std::pow(10.0, *decimals);
    std::vector<std::uint32_t> wholes;
    for (const double v : numbers)
      wholes.push_back(static_cast<std::uint32_t>(
          static_cast<std::int32_t>(std::isnan(v) ? missing_whole : std::nearbyint(v * power))));
    order = put_differences(bytes_, wholes);
  } else {
    order = put_differences(bytes_, bits);
  }
  index_.pop_back();
  fmt::format_to(std::back_inserter(index_), "{}[{},{},{}]]", entry->second > 0 ? "," : "", numbers.size(),
                 order, decimals ? fmt::format("{}", *decimals) : "null");
  return entry->second;
}

}  // namespace linkwright::report
