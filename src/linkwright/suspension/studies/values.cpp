// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/extremes.h"

namespace linkwright::suspension {

constexpr std::size_t max_values = 100000;

bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                Numbers& member) {
  if (found.value->is_array()) return reader.convert(found, field, member.of);
  double one = 0;
  if (!reader.convert(found, field, one)) return false;
  member.of = {one};
  return true;
}
Value write_value(const Numbers& member) { return study::ObjectWriter::to_value(member.of); }
Value schema_value(const Field&, const Numbers&) {
  return study::schema_any_of({study::schema_number(), study::schema_array(study::schema_number())});
}

std::optional<std::vector<double>> values_of(study::ObjectReader& table, const InputValues& v,
                                             std::string_view unit) {
  std::vector<double> out;
  if (v.values) {
    if (v.from || v.to || v.step || v.samples) {
      table.error("values", "are given both as a list and as a range", "keep values, or from, to and step");
      return std::nullopt;
    }
    out = *v.values;
    if (out.empty()) {
      table.error("values", "are none", fmt::format("write values_{} = [...]", unit));
      return std::nullopt;
    }
  } else {
    if (!v.from || !v.to) {
      table.error(v.from ? "to" : "from", "is missing",
                  fmt::format("write from_{0}, to_{0} and step_{0}; or values_{0} = [...]", unit));
      return std::nullopt;
    }
    if (v.step.has_value() == v.samples.has_value()) {
      table.error("step", v.step ? "and samples are both given" : "is missing",
                  fmt::format("give step_{} or samples, one of them", unit));
      return std::nullopt;
    }
    if (*v.to < *v.from) {
      table.error("to", fmt::format("is {:.6g}, below from, {:.6g}", *v.to, *v.from), "exchange them");
      return std::nullopt;
    }
    const double length = *v.to - *v.from;
    const double steps = v.step ? length / *v.step : *v.samples - 1;
    if (!(steps < static_cast<double>(max_values))) {
      table.error("step", fmt::format("makes {:.3g} values, at most {} are allowed", steps + 1, max_values));
      return std::nullopt;
    }
    // The last step may be the shorter one: both ends belong to the values.
    const double whole = std::round(steps);
    const bool even = std::abs(steps - whole) < 1e-6;
    const int count = static_cast<int>(even ? whole : std::floor(steps));
    for (int i = 0; i <= count; ++i)
      out.push_back(even && count > 0 ? *v.from + length * i / count : *v.from + v.step.value_or(0) * i);
    if (!even) out.push_back(*v.to);
    // 0 and -0.09 are meant, not roundings of them.
    for (double& x : out) x = std::round(x * 1e12) / 1e12 + 0.0;
  }
  if (out.size() > max_values) {
    table.error("values", fmt::format("{} of them, at most {} are allowed", out.size(), max_values));
    return std::nullopt;
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::size_t next_to_zero(std::span<const double> values) {
  study::Extreme least;
  for (std::size_t i = 0; i < values.size(); ++i) least.least(std::abs(values[i]), i);
  return least.row;
}

}  // namespace linkwright::suspension
