// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a study ends with a tree or with diagnostics, and what was read can be written and
// read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "linkwright/app/catalogue.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (study::Syntax syntax : {study::Syntax::toml, study::Syntax::json}) {
    Diagnostics diagnostics;
    const Value document = study::read_text(text, syntax, "input", diagnostics);
    if (document.is_null() != has_errors(diagnostics)) std::abort();
    for (const Diagnostic& diagnostic : diagnostics)
      if (to_string(diagnostic).empty()) std::abort();
    if (!document.is_object()) continue;

    Diagnostics again;
    study::read_text(study::to_toml(document), study::Syntax::toml, "again", again);
    const Value from_json = study::read_text(study::to_json(document), study::Syntax::json, "again", again);
    if (syntax == study::Syntax::json && !(from_json == document)) std::abort();

    const auto prepared = study::prepare(document, "input", ".", app::catalogue(), diagnostics);
    if (prepared.has_value() == has_errors(diagnostics)) std::abort();
  }
  return 0;
}
