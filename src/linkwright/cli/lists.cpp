// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/result_schema.h"
#include "linkwright/app/run.h"
#include "linkwright/app/samples.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/cli/terminal.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/units.h"
#include "linkwright/optimise/pieces.h"
#include "linkwright/study/renamed.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

/// One line of a list, under the heading of its group.
struct Entry {
  std::string group, name, text;
};

/// Entries of a group are listed together, in the order in which they come. `beside`: name and text in one
/// line, the texts in a column; else the text below the name.
std::string grouped(const std::vector<Entry>& entries, bool beside) {
  const bool colours = wants_colours(Stream::out);
  std::size_t width = 0;
  for (const Entry& entry : entries) width = std::max(width, entry.name.size());
  std::string text, group;
  for (const Entry& entry : entries) {
    if (entry.group != group)
      text += (text.empty() ? "" : "\n") + paint(entry.group, Colour::bold, colours) + "\n";
    group = entry.group;
    text += beside ? fmt::format("  {:<{}}  {}\n", entry.name, width, entry.text)
                   : fmt::format("  {}\n      {}\n", entry.name, entry.text);
  }
  return text;
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::string with_dashes(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

/// Says so, with a hint and with which other lists hold the words.
int nothing_holds(const std::vector<std::string>& words, std::string hint) {
  const std::string all = joined(words);
  Diagnostic problem;
  problem.message = fmt::format("nothing in the list holds '{}'", all);
  problem.hint = std::move(hint);
  // A six-bar is no kind of study, but there are six-bars.
  const auto samples = app::samples();
  const auto of_samples = std::count_if(samples.begin(), samples.end(), [&](const app::Sample& s) {
    return app::holds_words(words, {s.group, s.name, s.summary});
  });
  if (of_samples > 0) problem.hint += fmt::format("; `linkwright samples {}` finds {}", all, of_samples);
  if (const std::size_t found = app::find_examples(all).size(); found > 0)
    problem.hint += fmt::format("; `linkwright examples {}` finds {}", all, found);
  print_diagnostics({problem});
  return bad_input;
}

/// A subject that people look for under another name, or in vain.
struct Concept {
  std::string_view words;  ///< separated by blanks
  std::string_view answer;
};
constexpr std::array concepts{
    Concept{
        "cam cams nocken",
        "disc cams are analysis/planar.cam, and synthesis/planar.cam finds the smallest one; a cam in a "
        "linkage is [[mechanism.cam]] of analysis/planar.linkage and simulation/planar.linkage, as in the "
        "example overhead-cam-valve"},
    Concept{"geneva maltese",
            "a Geneva drive is a joint of type \"geneva\" in analysis/planar.linkage, as in the example "
            "geneva-drive"},
    Concept{"ratchet", "ratchets are not modelled. Nearest: a dwell (synthesis/planar.six_bar/dwell)"},
    Concept{"gear gears gearing gearbox",
            "a pair of gears is a joint of type \"gear\" in analysis/planar.linkage and "
            "simulation/planar.linkage, "
            "with the ratio of its pitch circles; teeth are not modelled"},
    Concept{
        "rack pinion rackandpinion",
        "a rack with its pinion is a joint of type \"rack\" in analysis/planar.linkage. The steering rack of "
        "a suspension is moved_by = \"rack\" of a link, with [sweep.rack] (analysis/suspension.corner)"},
    Concept{
        "belt belts chain pulley pulleys",
        "belts and chains are [[mechanism.belt]] of analysis/planar.linkage. Kinematic chains are listed by "
        "enumeration/planar.chain"},
    Concept{"screw spindle leadscrew",
            "a screw that drives a slide is a joint of type \"screw\" in analysis/planar.linkage"},
    Concept{"cylinder actuator ram hydraulic",
            "a cylinder is two bodies with a joint of type \"prismatic\" that is driven "
            "(analysis/planar.linkage)"},
    Concept{"rope ropes cable winch tendon",
            "a rope that does not stretch is [[mechanism.belt]] with closed = false "
            "(analysis/planar.linkage); where "
            "its force alone matters, [[mechanism.force]] and [[mechanism.torque]] do, as in the examples "
            "level-luffing-crane and pump-jack"},
    Concept{
        "drawer drawers telescope",
        "what is drawn out is a joint of type \"prismatic\", one for each stage (analysis/planar.linkage)"},
    Concept{
        "panhard watt dedion twistbeam torsionbeam",
        "live axles, de Dion axles and twist beams, with Panhard rods, Watt linkages, A-arms and links, are "
        "analysis/suspension.beam_axle"},
    Concept{"stewart gough hexapod",
            "platforms on six legs of variable length are not modelled. Nearest: analysis/parallel.hexa, six "
            "arms with "
            "rods"},
    Concept{"scara",
            "a SCARA is analysis/planar.serial_arm with two revolute links; its vertical axis is not "
            "modelled. With "
            "Pi-joints: analysis/parallel.serial_pi_arm"},
};

std::string_view answer_for(const std::vector<std::string>& words) {
  if (words.size() != 1) return {};
  std::string word;
  for (const char c : words[0]) {
    if (c >= 'A' && c <= 'Z')
      word += static_cast<char>(c - 'A' + 'a');
    else if (c != '-' && c != '_' && c != ' ')
      word += c;
  }
  for (const Concept& known : concepts)
    for (std::size_t from = 0; from < known.words.size();) {
      const std::size_t end = std::min(known.words.find(' ', from), known.words.size());
      if (known.words.substr(from, end - from) == word) return known.answer;
      from = end + 1;
    }
  return {};
}

int renamed(bool json) {
  if (json) {
    Value::Array all;
    for (const study::Renamed& r : study::renamed()) {
      Value one;
      one["of"] = name_of(r.of);
      one["before"] = r.before;
      one["now"] = r.now;
      if (!r.mechanism.empty()) one["mechanism"] = std::string(r.mechanism) + "*";
      if (!r.kinds.empty()) one["kinds"] = r.kinds;
      all.push_back(std::move(one));
    }
    fmt::print("{}", study::to_json_readable(Value(std::move(all))));
    return 0;
  }
  for (const study::Renamed& r : study::renamed())
    fmt::print("{:<10} {:<24} is now {:<24}{}\n", name_of(r.of), r.before, r.now,
               r.mechanism.empty()
                   ? std::string()
                   : fmt::format(" in {}{}{}*", r.kinds, r.kinds.empty() ? "" : " of ", r.mechanism));
  return 0;
}

/// "did you mean 'excavator'?", or where all examples are listed.
std::string examples_hint(std::string_view text) {
  const std::string near = app::nearest_example_words(text);
  return near.empty() ? "`linkwright examples` lists all" : fmt::format("did you mean '{}'?", near);
}

int copy_example(const Arguments& arguments) {
  const auto refuse = [](std::string message, std::string hint) {
    print_diagnostics({{Diagnostic::Severity::error, {}, {}, {}, std::move(message), std::move(hint)}});
    return bad_input;
  };
  if (arguments.words.empty())
    return refuse("--copy needs the name of an example", "`linkwright examples` lists all");
  const std::string& name = arguments.words[0];
  if (arguments.words.size() > 2)
    return refuse(fmt::format("--copy takes an example and a folder, not {} words", arguments.words.size()),
                  fmt::format("`linkwright examples {}` finds the name", joined(arguments.words)));
  const std::string folder = arguments.words.size() == 2 ? arguments.words[1] : std::string();
  const std::vector<const app::Example*> found = app::find_examples(name);
  if (found.empty()) return refuse(fmt::format("there is no example '{}'", name), examples_hint(name));
  if (found.size() > 1) {
    std::string hint = "write one of:";
    for (const app::Example* example : found)
      hint += fmt::format("\n  {}: {}", example->name, example->title);
    return refuse(fmt::format("several examples fit '{}'", name), hint);
  }
  Diagnostics diagnostics;
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) {
    print_diagnostics({unwritten(folder, error.message())});
    return not_written;
  }
  const app::Example& example = *found.front();
  std::vector<app::EmbeddedFile> files = example.beside;
  const std::string study = example.name + ".toml";
  files.push_back({study, example.text});
  for (const app::EmbeddedFile& file : files) {
    const std::string path = (fs::path(folder) / file.path).string();
    const app::Copied copied = app::write_new(path, file.text, diagnostics);
    switch (copied) {
      case app::Copied::written:
        fmt::print("{} written\n", path);
        break;
      case app::Copied::unchanged:
        fmt::print("{} is here already\n", path);
        break;
      case app::Copied::refused:
      case app::Copied::unwritten:
        print_diagnostics(diagnostics);
        return copied == app::Copied::unwritten ? not_written : bad_input;
    }
  }
  fmt::print("run it with: linkwright run {}\n", (fs::path(folder) / study).string());
  return 0;
}

/// Columns as wide as their longest cell; numbers to the right.
std::string aligned(const std::vector<study::Comparison>& rows) {
  std::vector<std::array<std::string, 5>> cells = {{"", "published", "ours", "verdict", "note"}};
  for (const study::Comparison& c : rows)
    cells.push_back({c.item, std::isnan(c.published) ? "-" : fmt::format("{:.9g}", c.published),
                     std::isnan(c.ours) ? "-" : fmt::format("{:.9g}", c.ours), c.verdict, c.note});
  std::array<std::size_t, 5> width{};
  for (const auto& row : cells)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string text;
  for (const auto& row : cells) {
    std::string line = fmt::format("  {:<{}}  {:>{}}  {:>{}}  {:<{}}  {}", row[0], width[0], row[1], width[1],
                                   row[2], width[2], row[3], width[3], row[4]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace

int list_catalogue(const Arguments& arguments, std::span<const study::Kind> kinds) {
  if (arguments.renamed) return renamed(arguments.json);
  std::vector<Entry> entries;
  Value::Array json;
  for (const study::Kind& kind : kinds) {
    const std::string group(app::group_of(kind.kind, kind.mechanism, kind.target)), name = name_of(kind);
    if (!app::holds_words(arguments.words, {group, name, kind.summary})) continue;
    entries.push_back({group, name, kind.summary});
    Value one;
    one["name"] = name;
    one["group"] = group;
    one["summary"] = kind.summary;
    json.push_back(std::move(one));
  }
  if (arguments.json) {
    fmt::print("{}", study::to_json_readable(Value(std::move(json))));
    return 0;
  }
  // The letters of such a word are found in other words, which would mislead: cam in camber.
  if (const std::string_view known = answer_for(arguments.words); !known.empty()) {
    fmt::print("{}: {}\n", arguments.words[0], known);
    return 0;
  }
  if (entries.empty()) return nothing_holds(arguments.words, "`linkwright catalogue` lists all");
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return app::place_of_group(a.group) < app::place_of_group(b.group);
  });
  fmt::print("{}\nTo begin with one: linkwright new KIND\n", grouped(entries, false));
  return 0;
}

int list_samples(const Arguments& arguments) {
  std::vector<Entry> entries;
  Value::Array json;
  for (const app::Sample& sample : app::samples()) {
    if (!app::holds_words(arguments.words, {sample.group, sample.name, sample.summary})) continue;
    entries.push_back(
        {fmt::format("{} (type = \"{}\")", sample.group, fmt::join(sample.mechanisms, "\" or \"")),
         sample.name, sample.summary});
    Value one;
    one["name"] = sample.name;
    one["mechanisms"] = Value::array();
    for (const std::string& mechanism : sample.mechanisms) one["mechanisms"].push_back(mechanism);
    one["summary"] = sample.summary;
    json.push_back(std::move(one));
  }
  if (arguments.json) {
    fmt::print("{}", study::to_json_readable(Value(std::move(json))));
    return 0;
  }
  if (entries.empty()) return nothing_holds(arguments.words, "`linkwright samples` lists all");
  fmt::print("{}\n`sample = \"NAME\"` in [mechanism] takes one of them, with its dimensions and masses.\n",
             grouped(entries, true));
  return 0;
}

int list_examples(const Arguments& arguments) {
  if (arguments.copy) return copy_example(arguments);
  const std::string asked = joined(arguments.words);
  std::vector<Entry> entries;
  Value::Array json;
  for (const app::Example* example : app::find_examples(asked)) {
    entries.push_back({example->group, example->name, example->title});
    Value one;
    one["name"] = example->name;
    one["title"] = example->title;
    one["group"] = example->group;
    one["words"] = example->words;
    json.push_back(std::move(one));
  }
  if (arguments.json) {
    fmt::print("{}", study::to_json_readable(Value(std::move(json))));
    return 0;
  }
  const std::string_view known = answer_for(arguments.words);
  if (entries.empty() && known.empty()) return nothing_holds(arguments.words, examples_hint(asked));
  if (!entries.empty())
    fmt::print("{}\nTo try one: linkwright examples --copy NAME\n", grouped(entries, true));
  if (!known.empty()) fmt::print("{}{}: {}\n", entries.empty() ? "" : "\n", asked, known);
  return 0;
}

int make_study(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const study::Kind* kind = app::find_kind(arguments.kind, kinds, diagnostics);
  if (!kind) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  const std::string schema = study::schema_file(name_of(*kind));
  const std::string text = fmt::format("#:schema ./{}\n{}", schema, kind->example);
  if (arguments.file == "-") {
    fmt::print("{}", text);
    return 0;
  }
  const std::string file = arguments.file.empty() ? with_dashes(name_of(*kind)) + ".toml" : arguments.file;
  const app::Copied copied = app::write_new(file, text, diagnostics);
  print_diagnostics(diagnostics);
  if (copied == app::Copied::refused) return bad_input;
  if (copied == app::Copied::unwritten) return not_written;
  fmt::print("{} {}; run it with: linkwright run {}\n", file,
             copied == app::Copied::written ? "written" : "is here already", file);
  const fs::path beside = fs::path(file).parent_path() / schema;
  if (!fs::exists(beside))
    fmt::print("for keys completed by your editor: linkwright schema {} -o {}\n", name_of(*kind),
               beside.string());
  return 0;
}

int list_columns(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  std::optional<study::Study> study;
  const std::string extension = fs::path(arguments.kind).extension().string();
  const bool of_kind = extension != ".toml" && extension != ".json" && !fs::is_regular_file(arguments.kind);
  if (!of_kind) {
    study = app::load_study(arguments.kind, {}, kinds, diagnostics);
  } else if (const study::Kind* kind = app::find_kind(arguments.kind, kinds, diagnostics)) {
    const Value document = study::read_text(kind->example, study::Syntax::toml, "template", diagnostics);
    study = study::prepare(document, "template", {}, kinds, diagnostics);
  }
  if (!study) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  std::vector<Entry> entries;
  Value::Array json;
  for (const Table& table : study->tables)
    for (const Column& column : table.columns) {
      entries.push_back({table.name, column.key, column.label});
      const auto unit = split_unit(column.key);
      Value one;
      one["table"] = table.name;
      one["key"] = column.key;
      one["unit"] = unit ? readable_unit(unit->unit->suffix) : std::string();
      one["label"] = column.label;
      json.push_back(std::move(one));
    }
  if (arguments.json) {
    fmt::print("{}", study::to_json_readable(Value(std::move(json))));
    return 0;
  }
  const std::string name = name_of(*study->kind);
  if (entries.empty()) {
    fmt::print("The columns of {} are known from a run alone: result.json and the CSV files name them.\n",
               name);
    return 0;
  }
  fmt::print(
      "{}\n{}A check names them as {}.{}.max.\n", grouped(entries, true),
      of_kind ? fmt::format(
                    "Names of parts are those of `linkwright new {} -`; in a study they are its own. ", name)
              : std::string(),
      entries.back().group, entries.back().name);
  return 0;
}

int print_schema(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Value schema;
  if (arguments.kind == "result") {
    schema = app::result_schema();
  } else if (arguments.kind.empty()) {
    schema = study::schema_of(kinds);
  } else {
    Diagnostics diagnostics;
    const study::Kind* kind = app::find_kind(arguments.kind, kinds, diagnostics);
    print_diagnostics(diagnostics);
    if (!kind) return bad_input;
    schema = study::schema_of(*kind);
  }
  const std::string text = study::to_json_readable(schema);
  if (arguments.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  const std::string problem = app::write_whole(arguments.out, text);
  if (problem.empty()) {
    fmt::print("{} written\n", arguments.out);
    return 0;
  }
  print_diagnostics({unwritten(arguments.out, problem)});
  return not_written;
}

int reproduce(const Arguments& arguments, std::span<const study::Reproduction> all) {
  if (arguments.table.empty()) {
    for (const study::Reproduction& r : all) fmt::print("{}\n    {}\n", r.id, r.title);
    if (!all.empty())
      fmt::print(
          "\nWhich table of which source each one is, and why a few are not here: "
          "docs/published-tables.md\n");
    return 0;
  }
  Diagnostics diagnostics;
  const auto chosen = app::find_reproductions(arguments.table, all, diagnostics);
  if (chosen.empty()) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  RunContext context;
  const Interruptible guard(context);
  context.set_threads(arguments.threads);
  Value json = Value::array();
  const auto show = [&](const study::Reproduction& r, const std::vector<study::Comparison>& rows) {
    if (arguments.json) {
      json.push_back(app::reproduction_json(r, rows));
      return;
    }
    fmt::print("{}: {}\n  {}\n\n{}", r.id, r.title, r.source, aligned(rows));
    for (const std::string& note : r.notes) fmt::print("\n  {}\n", note);
    fmt::print("\n");
    flush_output();
  };
  // Several at once, but shown in their order, each as soon as those before it are.
  std::mutex showing;
  std::vector<std::optional<std::vector<study::Comparison>>> tables(chosen.size());
  std::size_t shown = 0;
  const optimise::PieceLoop loop =
      optimise::for_each_piece(chosen.size(), context, "tables", [&](std::size_t i) {
        std::vector<study::Comparison> rows = chosen[i]->run(context);
        const std::lock_guard lock(showing);
        tables[i] = std::move(rows);
        for (; shown < tables.size() && tables[shown]; ++shown) show(*chosen[shown], *tables[shown]);
        return 0.0;
      });
  if (loop.status != Status::done) return cancelled;
  if (arguments.json) fmt::print("{}", study::to_json_readable(json));
  return 0;
}

}  // namespace linkwright::cli
