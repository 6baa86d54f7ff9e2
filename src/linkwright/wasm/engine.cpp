// SPDX-License-Identifier: BSD-3-Clause
#include <emscripten/emscripten.h>

#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "linkwright/app/example_scene.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/view.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

// The program behind the functions of C that a page can call. Each answers with a document: engine_json() and
// engine_numbers() show it until the next call.
namespace {

using namespace linkwright;

app::View answer;

// An exception becomes the member `failure` of the answer: the page has nobody to catch it.
template <class Ask>
void give(Ask&& ask) {
  std::string failure;
  try {
    answer = ask();
    return;
  } catch (const std::bad_alloc&) {
    failure = "the page has no more memory for this study; run it with the program";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  Value out = Value::object();
  out["failure"] = failure;
  answer = {study::to_json(out), {}};
}

// The worker of the page hears how far a run is.
EM_JS(void, tell_progress, (const char* stage, int length, double fraction, double best), {
  if (Module["onProgress"]) Module["onProgress"](UTF8ToString(stage, length), fraction, best);
});

// Likewise what the run keeps, for the runs that go before or after it, and that others can help it.
EM_JS(void, hand_on, (const char* text, int length), {
  if (Module["onKept"]) Module["onKept"](UTF8ToString(text, length));
});
EM_JS(void, tell_leaves, (), {
  if (Module["onLeaves"]) Module["onLeaves"]();
});

/// From the document of a page: `index` and `count` of the runs that share the study, and what they `kept`.
app::Sharing read_sharing(std::string_view text) {
  app::Sharing out;
  Diagnostics ignored;
  const Value asked = study::read_text(text, study::Syntax::json, "sharing", ignored);
  const Value *index = asked.find("index"), *count = asked.find("count"), *kept = asked.find("kept");
  if (index && count && index->is_integer() && count->is_integer() && index->as_integer() >= 0 &&
      index->as_integer() < count->as_integer())
    out.shard = {static_cast<std::size_t>(index->as_integer()),
                 static_cast<std::size_t>(count->as_integer())};
  if (kept && kept->is_array())
    for (const Value& one : kept->as_array())
      if (one.is_string()) out.kept.push_back(one.as_string());
  out.hand_on = [](const std::string& one) { hand_on(one.data(), static_cast<int>(one.size())); };
  out.leaves = [] { tell_leaves(); };
  return out;
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* engine_json() { return answer.json.data(); }
EMSCRIPTEN_KEEPALIVE int engine_json_size() { return static_cast<int>(answer.json.size()); }
EMSCRIPTEN_KEEPALIVE const double* engine_numbers() { return answer.numbers.data(); }
EMSCRIPTEN_KEEPALIVE int engine_numbers_count() { return static_cast<int>(answer.numbers.size()); }

/// app::catalogue_document()
EMSCRIPTEN_KEEPALIVE void engine_catalogue() {
  give([] { return app::View{study::to_json(app::catalogue_document()), {}}; });
}

/// app::example_scene() of the example at a place of the list; null behind the last.
EMSCRIPTEN_KEEPALIVE void engine_example_scene(int place) {
  give([&] {
    const auto all = app::examples();
    const bool there = place >= 0 && place < static_cast<int>(all.size());
    return app::View{study::to_json(there ? app::example_scene(all[place], "/study") : Value()), {}};
  });
}

/// app::schema_document()
EMSCRIPTEN_KEEPALIVE void engine_schema(const char* kind, int size) {
  give([&] {
    return app::View{study::to_json(app::schema_document({kind, static_cast<std::size_t>(size)})), {}};
  });
}

/// app::run_text(); files are looked for in "/study". Ends after `seconds` with the best so far; 0 = never.
/// `sharing`: a document as read_sharing() has it, or empty.
EMSCRIPTEN_KEEPALIVE void engine_run(const char* text, int size, const char* edits, int edits_size,
                                     const char* sharing, int sharing_size, double seconds) {
  give([&] {
    RunContext context;
    if (seconds > 0) context.set_time_limit(std::chrono::duration<double>(seconds));
    context.set_progress([](const Progress& p) {
      tell_progress(p.stage.data(), static_cast<int>(p.stage.size()), p.fraction, p.best);
    });
    return app::run_text(
        {text, static_cast<std::size_t>(size)}, {edits, static_cast<std::size_t>(edits_size)}, "/study",
        context,
        sharing_size > 0 ? read_sharing({sharing, static_cast<std::size_t>(sharing_size)}) : app::Sharing());
  });
}

}  // extern "C"
