// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/reproduction.h"

#include "linkwright/core/check.h"
#include "linkwright/study/study.h"

namespace linkwright::study {

Value read_published(std::string_view toml) {
  Diagnostics problems;
  Value document = read_text(toml, Syntax::toml, {}, problems);
  LINKWRIGHT_REQUIRE(problems.empty(), "published tables cannot be read: {}",
                     to_string(problems.front().message));
  return document;
}

std::vector<Reproduction> reproductions_of(std::string_view toml,
                                           const std::map<std::string, ComputeTable>& computed) {
  const Value document = read_published(toml);
  std::vector<Reproduction> out;
  for (const Value& table : document.find("table")->as_array()) {
    const auto text = [&](std::string_view key) { return table.find(key)->as_string(); };
    Reproduction r{text("id"), text("title"), text("source"), {}, {}};
    const Value* shared = table.find("shared_notes");
    for (const Value* notes :
         {table.find("notes"), shared ? document.find("shared_notes")->find(shared->as_string()) : shared})
      if (notes)
        for (const Value& note : notes->as_array()) r.notes.push_back(note.as_string());
    const auto compute = computed.find(r.id);
    LINKWRIGHT_REQUIRE(compute != computed.end(), "no function computes the table '{}'", r.id);
    r.run = [compute = compute->second, source = r.source](RunContext& context) {
      return compute(source, context);
    };
    out.push_back(std::move(r));
  }
  LINKWRIGHT_REQUIRE(out.size() == computed.size(), "{} tables are listed and {} computed", out.size(),
                     computed.size());
  return out;
}

}  // namespace linkwright::study
