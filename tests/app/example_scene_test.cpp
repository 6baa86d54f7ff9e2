// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/example_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

class ExampleScene : public ::testing::Test {
 protected:
  ExampleScene() { std::filesystem::create_directories(folder_); }
  ~ExampleScene() override { std::filesystem::remove_all(folder_); }

  Value of(std::string_view name) { return example_scene(*find_examples(name).at(0), folder_); }

  const std::string folder_ =
      (std::filesystem::temp_directory_path() / ("linkwright-scene-" + std::to_string(::getpid()))).string();
};

TEST_F(ExampleScene, IsTheFirstThatAReportShows) {
  const Value out = of("hoeken");
  EXPECT_EQ(out.find("name")->as_string(), "hoeken");
  EXPECT_EQ(out.find("title")->as_string(), "Hoeken straight-line linkage");
  EXPECT_EQ(out.find("text")->as_string(), find_examples("hoeken")[0]->text);
  EXPECT_GE(out.find("scene")->find("joints")->as_array().size(), 5u);
  EXPECT_EQ(out.find("scene")->find("traces")->as_array().size(), 1u);
}

TEST_F(ExampleScene, ReadsTheFilesBesideIt) {
  EXPECT_TRUE(of("bump-steer").find("scene")->is_object());
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/hardpoints.txt"));
}

// A search of many seconds shows its state after a fixed number of steps, whatever the time.
TEST_F(ExampleScene, OfASearchIsTheSameEachTime) {
  const Value once = of("fourbar-18-points-grey-wolf");
  EXPECT_TRUE(once.find("scene")->is_object());
  EXPECT_EQ(study::to_json(once), study::to_json(of("fourbar-18-points-grey-wolf")));
}

// A motion that shows nothing before its end is run to its end.
TEST_F(ExampleScene, OfALongMotionIsThere) {
  EXPECT_TRUE(of("clearance-four-bar-regime").find("scene")->is_object());
}

}  // namespace
}  // namespace linkwright::app
