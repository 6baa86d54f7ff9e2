// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/published_four_bars.h"

#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/planar/studies/published.h"
#include "linkwright/study/reproduction.h"

namespace linkwright::planar {
namespace {

template <std::size_t count>
std::array<double, count> numbers_of(const Value& value) {
  const Value::Array& all = value.as_array();
  LINKWRIGHT_REQUIRE(all.size() == count, "{} numbers, expected {}", all.size(), count);
  std::array<double, count> out;
  for (std::size_t k = 0; k < count; ++k) out[k] = all[k].as_number();
  return out;
}

PublishedFourBar four_bar_of(const Value& design) {
  const auto at = [&](std::string_view key) -> const Value& { return *design.find(key); };
  PublishedFourBar out{.label = at("label").as_string(),
                       .design_table = at("design_table").as_string(),
                       .change_table = at("change_table").as_string(),
                       .numbers = numbers_of<16>(at("numbers")),
                       .unsigned_percent = numbers_of<12>(at("unsigned_percent")),
                       .band = numbers_of<12>(at("band")),
                       .repaired = {}};
  if (const Value* repaired = design.find("repaired"))
    out.repaired = {static_cast<std::size_t>(repaired->find("number")->as_integer()),
                    repaired->find("printed")->as_number()};
  return out;
}

}  // namespace

std::span<const PublishedFourBar> published_four_bars() {
  static const std::vector<PublishedFourBar> all = [] {
    std::vector<PublishedFourBar> out;
    const Value document = study::read_published(published::four_bars());
    for (const Value& design : document.find("design")->as_array()) out.push_back(four_bar_of(design));
    return out;
  }();
  return all;
}

}  // namespace linkwright::planar
