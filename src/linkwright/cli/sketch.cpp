// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/sketch.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/examples.h"
#include "linkwright/cli/terminal.h"
#include "linkwright/core/units.h"
#include "linkwright/planar/sketch/sketch.h"
#include "linkwright/study/study.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

/// "0.01mm", "0.01 mm" or "0.01", which is in mm; none for another text or what is not positive.
std::optional<double> length_of(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(stop - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  const Unit* found = find_unit(Dimension::length, unit.empty() ? "mm" : unit);
  if (!found) return std::nullopt;
  value = found->to_si(value);
  return value > 0 && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

const char* plural(std::size_t count) { return count == 1 ? "" : "s"; }

/// How the drawing was read, before anything was assumed.
void print_reading(const planar::Sketch& sketch, bool has_unit) {
  using planar::SketchBodyType;
  const auto bodies = [&](SketchBodyType type) {
    std::size_t count = 0;
    for (const planar::SketchBody& body : sketch.bodies) count += body.type == type ? 1 : 0;
    return count;
  };
  if (!has_unit) fmt::print("The drawing names no unit: its numbers are taken as millimetres.\n");
  const std::size_t bars = bodies(SketchBodyType::bar), plates = bodies(SketchBodyType::plate),
                    blocks = bodies(SketchBodyType::block), pins = count(sketch, planar::JointType::revolute),
                    slides = count(sketch, planar::JointType::prismatic),
                    welds = count(sketch, planar::JointType::fixed), wheels = bodies(SketchBodyType::wheel),
                    gears = sketch.gears.size(), belts = sketch.belts.size();
  const std::string belt_words = belts == 0 ? "" : fmt::format(", {} belt{}", belts, plural(belts));
  const std::string wheel_words = wheels == 0 ? "" : fmt::format(", {} wheel{}", wheels, plural(wheels));
  const std::string gear_words = gears == 0 ? "" : fmt::format(", {} pair{} of gears", gears, plural(gears));
  fmt::print("{} bar{}, {} plate{}, {} block{}{}, {}; {} pin{}, {} slide{}, {} weld{}{}{}\n", bars,
             plural(bars), plates, plural(plates), blocks, plural(blocks), wheel_words,
             bodies(SketchBodyType::ground) > 0 ? "the ground" : "no ground", pins, plural(pins), slides,
             plural(slides), welds, plural(welds), gear_words, belt_words);
}

/// The linkage of a drawing or of a file of the program Linkage; `has_unit` receives whether it says in which
/// unit its numbers are. None, with one error in `diagnostics`, where it cannot be read.
std::optional<planar::Sketch> read_sketch(const std::string& text, const std::string& file, double tolerance,
                                          const planar::SketchAnswers& answers, bool& has_unit,
                                          Diagnostics& diagnostics) {
  if (planar::is_linkage_file(text)) return planar::read_linkage_file(text, file, diagnostics);
  const auto drawing = planar::read_shapes(text, file, diagnostics);
  if (!drawing) return std::nullopt;
  has_unit = drawing->has_unit;
  return planar::sketched_linkage(drawing->shapes, tolerance, answers);
}

}  // namespace

int sketch(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const auto refused = [&](int code) {
    print_diagnostics(diagnostics);
    return code;
  };
  const auto problem = [&](std::string message, std::string hint) {
    diagnostics.push_back(
        {.file = arguments.drawing, .message = std::move(message), .hint = std::move(hint)});
    return refused(bad_input);
  };
  const std::optional<double> tolerance = length_of(arguments.tolerance);
  if (!tolerance)
    return problem(fmt::format("--tolerance '{}' is not a positive length", arguments.tolerance),
                   "write a number with its unit, such as 0.01mm or 0.0005in");
  const std::string text = study::load_file(arguments.drawing, diagnostics);
  if (has_errors(diagnostics)) return refused(bad_input);
  planar::SketchAnswers answers{.ends = {}, .ground = arguments.ground, .driven = arguments.driven};
  if (!arguments.ends.empty()) {
    for (const auto& [end, name, summary] : names(planar::SketchEnd{}))
      if (name == arguments.ends) answers.ends = end;
    if (!answers.ends)
      return problem(fmt::format("--ends '{}' is none of: weld, pin, nothing", arguments.ends),
                     "say what an end on the middle of another line is");
  }
  bool has_unit = true;
  std::optional<planar::Sketch> found =
      read_sketch(text, arguments.drawing, *tolerance, answers, has_unit, diagnostics);
  if (!found) return refused(bad_input);
  planar::Sketch& read = *found;
  if (read.bodies.empty())
    return problem(
        read.left_out.empty() ? "no line of the drawing is a link" : read.left_out.front(),
        "draw links as lines or closed polylines on a layer that is not called ground, slide, drive, "
        "trace or construction");
  if (arguments.file != "-") print_reading(read, has_unit);
  if (const auto name = unknown_point(read, answers)) {
    std::string all;
    for (const planar::SketchPoint& point : read.points) all += (all.empty() ? "" : ", ") + point.name;
    return problem(fmt::format("the drawing has no point '{}'", *name),
                   fmt::format("its points, from left to right, are {}", all));
  }
  if (!read.bodies.empty() && read.bodies[0].type == planar::SketchBodyType::ground &&
      !answers.ground.empty())
    return problem("--ground names fixed points, and the drawing has a ground",
                   "leave the option out, or the layer ground");
  complete(read, answers);
  const fs::path source(arguments.drawing);
  const std::string study = sketch_study(read, "the linkage drawn in " + source.filename().string());
  if (arguments.file == "-") {
    fmt::print("{}", study);
    return 0;
  }
  fmt::print("mobility {}\n", mobility(read));
  for (const planar::SketchQuestion& question : read.questions)
    fmt::print("Question: {}\n  Assumed: {}.\n", question.text, question.assumed);
  if (!read.questions.empty()) fmt::print("The options --ground, --drive and --ends answer otherwise.\n");
  for (const std::string& sentence : read.left_out) fmt::print("Not read: {}.\n", sentence);
  const std::string file = arguments.file.empty() ? source.stem().string() + ".toml" : arguments.file;
  const app::Copied copied = app::write_new(file, study, diagnostics);
  if (copied == app::Copied::refused) return refused(bad_input);
  if (copied == app::Copied::unwritten) return refused(not_written);
  fmt::print("{} {}; run it with: linkwright run {}\n", file,
             copied == app::Copied::written ? "written" : "is here already", file);
  flush_output();
  // The study may need more than the drawing says, such as another drive.
  study::prepare(study::read_text(study, study::Syntax::toml, file, diagnostics), file, {}, kinds,
                 diagnostics);
  if (has_errors(diagnostics)) print_diagnostics(diagnostics);
  return 0;
}

}  // namespace linkwright::cli
