// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/examples.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace linkwright::app {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Examples, AreTheFilesOfTheRepository) {
  std::size_t studies = 0;
  for (const EmbeddedFile& file : example_files()) {
    const auto path = std::filesystem::path(LINKWRIGHT_SOURCE_DIR "/examples") / file.path;
    EXPECT_TRUE(text_of(path) == file.text) << file.path;
    studies += file.path.ends_with(".toml");
  }
  EXPECT_EQ(examples().size(), studies);
  EXPECT_GE(studies, 80u);
  std::set<std::string> names;
  for (const Example& example : examples()) {
    EXPECT_TRUE(names.insert(example.name).second) << example.name << " stands twice";
    EXPECT_FALSE(example.title.empty()) << example.name;
    EXPECT_NE(example.group, "Other studies") << example.name;
  }
}

TEST(Examples, BeginWithADozenMachinesThatEverybodyKnows) {
  std::vector<std::string> first;
  std::set<std::string> closed;
  std::string group;
  for (const Example& example : examples()) {
    if (example.group != group) {
      EXPECT_TRUE(closed.insert(group).second) << group << " stands twice";
    }
    group = example.group;
    if (group == "Well-known machines") first.push_back(example.name);
  }
  EXPECT_EQ(examples()[0].name, "fourbar-reactions");
  EXPECT_EQ(examples()[0].group, "Well-known machines");
  EXPECT_GE(first.size(), 12u);
  EXPECT_LE(first.size(), 15u);
  for (const char* name : {"engine-slider-crank", "hoeken", "jansen-leg", "toggle-press", "sweep"})
    EXPECT_NE(std::find(first.begin(), first.end(), name), first.end()) << name;
}

TEST(Examples, CarryTheFilesThatTheyRead) {
  const auto beside = [](std::string_view name) {
    const auto found = find_examples(name);
    std::vector<std::string_view> files;
    if (found.size() == 1)
      for (const EmbeddedFile& file : found.front()->beside) files.push_back(file.path);
    return files;
  };
  EXPECT_EQ(beside("bump-steer"), std::vector<std::string_view>{"hardpoints.txt"});
  EXPECT_EQ(beside("suspension-5us-synthesis"), std::vector<std::string_view>{"carrier-poses-5us.csv"});
  EXPECT_EQ(beside("clearance-four-bar-at-once"),
            std::vector<std::string_view>{"clearance-four-bar-path.csv"});
  EXPECT_EQ(beside("strut-suspension-sensitivity"),
            std::vector<std::string_view>{"strut-suspension-sweep.toml"});
  EXPECT_TRUE(beside("hoeken").empty());
}

TEST(Examples, AreFoundByNameOrByPart) {
  const auto names = [](std::string_view text) {
    std::string all;
    for (const Example* example : find_examples(text)) all += example->name + " ";
    return all;
  };
  EXPECT_EQ(names("hoeken"), "hoeken ");
  EXPECT_EQ(names("strandbeest"), "jansen-leg ");
  EXPECT_EQ(names("HOEKEN"), "hoeken tolerances-hoeken ");
  EXPECT_EQ(names("no such thing"), "");
  EXPECT_EQ(find_examples("").size(), examples().size());
}

// Words in which people search; each must find these examples, and perhaps more.
constexpr std::pair<std::string_view, std::string_view> synonyms[] = {
    {"excavator", "excavator-arm excavator-bucket"},
    {"backhoe", "excavator-arm excavator-bucket"},
    {"Diggers", "excavator-arm excavator-bucket"},
    {"loader", "excavator-bucket loading-arm"},
    {"hydraulic cylinder", "excavator-arm inverted-slider-crank tipper"},
    {"gripper", "gripper-poses-and-points parallel-gripper"},
    {"jaws", "gripper-poses-and-points parallel-gripper"},
    {"windshield wiper", "windscreen-wiper"},
    {"wipers", "windscreen-wiper"},
    {"hood", "bonnet-gas-spring bonnet-hinge bonnet-hinge-in-a-box"},
    {"bonnet", "bonnet-gas-spring bonnet-hinge bonnet-hinge-in-a-box"},
    {"trunk", "tailgate"},
    {"scissor lift", "scissor-lift"},
    {"scissor-lifts", "scissor-lift"},
    {"lazy tongs", "scissor-lift"},
    {"landing gear", "landing-gear"},
    {"undercarriage", "landing-gear"},
    {"retraction", "landing-gear"},
    {"quick return", "quick-return shaper whitworth-quick-return"},
    {"quickreturn", "quick-return shaper whitworth-quick-return"},
    {"walking", "jansen-leg klann-leg nine-points-leg"},
    {"legs", "jansen-leg klann-leg nine-points-leg"},
    {"crane", "level-luffing-crane"},
    {"level luffing", "level-luffing-crane"},
    {"dump truck", "tipper"},
    {"lorry", "tipper"},
    {"lorries", "tipper"},
    {"garage door", "garage-door"},
    {"up-and-over", "garage-door"},
    {"toggle clamp", "toggle-clamp"},
    {"toggle", "toggle-clamp toggle-press"},
    {"pumpjack", "pump-jack"},
    {"oil well", "pump-jack"},
    {"nodding donkey", "pump-jack"},
    {"robot arm", "arm-pick-and-place five-bar-robot"},
    {"SCARA", "arm-pick-and-place five-bar-robot"},
    {"folding chair", "folding-chair"},
    {"door closer", "door-closer"},
    {"umbrella", "umbrella"},
    {"sewing machine", "sewing-machine"},
    {"film advance", "film-claw"},
    {"straight line", "beam-engine chebyshev hoeken line-6-points peaucellier"},
    {"straight-line", "beam-engine chebyshev hoeken line-6-points peaucellier"},
    {"steering", "ackermann-steering bump-steer strut-suspension-sweep"},
    {"Ackerman", "ackermann-steering"},
    {"bicycle suspension", "bicycle-rear-linkage"},
    {"mountain bikes", "bicycle-rear-linkage"},
    {"crank press", "flywheel-press"},
    {"knuckle press", "toggle-press"},
    {"presses", "flywheel-press toggle-press"},
    {"shaper", "shaper"},
    {"shaping machines", "shaper whitworth-quick-return"},
    {"beam engine", "beam-engine"},
    {"Watt", "beam-engine watt-1-six-bar watt-2-six-bar"},
    {"parallel motion", "beam-engine"},
    {"elliptical trammel", "elliptical-trammel"},
    {"ellipse", "ellipse-10-points elliptical-trammel"},
    {"cam", "dwell smallest-cam valve-cam"},
    {"geneva", "dwell"},
    {"gear", "epicyclic-train geared-five-bar landing-gear"},
    {"planetary gear", "epicyclic-train"},
    {"sixbar", "watt-1-six-bar stephenson-3-six-bar"},
    {"fourbar", "fourbar-reactions fourbar-18-points"},
    {"piston", "engine-slider-crank balance-engine"},
    {"MacPherson", "strut-suspension-sweep"},
    {"multilink", "suspension-5us-synthesis"},
    {"hexapod", "hexa-pi-joints"},
};

TEST(Examples, AreFoundByTheWordsOfTheTrade) {
  for (const auto& [words, expected] : synonyms) {
    std::set<std::string> found;
    for (const Example* example : find_examples(words)) found.insert(example->name);
    std::istringstream names{std::string(expected)};
    for (std::string name; names >> name;)
      EXPECT_TRUE(found.count(name)) << words << " does not find " << name;
    EXPECT_LE(found.size(), examples().size() / 4) << words;
  }
}

TEST(Examples, AreNotFoundByChance) {
  const auto finds = [](std::string_view words, std::string_view name) {
    for (const Example* example : find_examples(words))
      if (example->name == name) return true;
    return false;
  };
  EXPECT_FALSE(finds("cam", "film-claw"));  // the word for a camera
  EXPECT_FALSE(finds("arm", "clearance-four-bar-lengths-swarm"));
  EXPECT_FALSE(finds("excavator umbrella", "umbrella"));  // every word counts
  EXPECT_TRUE(find_examples("helicopter").empty());
}

TEST(Examples, UnknownWordsHaveANearest) {
  EXPECT_EQ(nearest_example_words("excavater"), "excavator");
  EXPECT_EQ(nearest_example_words("Wndscreen wipers"), "windscreen wipers");
  EXPECT_EQ(nearest_example_words("excavator"), "");   // is known
  EXPECT_EQ(nearest_example_words("helicopter"), "");  // nothing is near
  EXPECT_EQ(nearest_example_words(""), "");
}

TEST(Examples, WordsAreAList) {
  for (const Example& example : examples()) {
    EXPECT_EQ(example.words.empty(), example.text.find("# words:") == std::string_view::npos) << example.name;
    EXPECT_EQ(example.words.find_first_of(".;\r\n"), std::string::npos) << example.name;
  }
  EXPECT_EQ(find_examples("tailgate").front()->words,
            "boot, trunk, hatchback, liftgate, car, lid, body guidance, motion generation");
}

TEST(WriteNew, NeverOverAnotherFile) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("linkwright-new-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "a.toml").string();
  Diagnostics diagnostics;
  EXPECT_EQ(write_new(file, "one", diagnostics), Copied::written);
  EXPECT_EQ(write_new(file, "one", diagnostics), Copied::unchanged);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(write_new(file, "two", diagnostics), Copied::refused);
  EXPECT_EQ(text_of(file), "one");
  EXPECT_EQ(write_new((folder / "none/a.toml").string(), "one", diagnostics), Copied::unwritten);
  ASSERT_EQ(diagnostics.size(), 2u);
  EXPECT_EQ(to_string(diagnostics[0]), file + ": error: already exists and is left unchanged");
  EXPECT_EQ(to_string(diagnostics[1]),
            (folder / "none/a.toml").string() + ": error: cannot be written: No such file or directory");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace linkwright::app
