#include "linkwright/app/examples.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
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
