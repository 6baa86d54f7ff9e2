// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "planar/studies.h"
#include "support/published.h"

// Strokes that studies of planar.any take from drawings.
namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

/// A folder with files that are written into it; it is removed at the end.
class Folder {
 public:
  explicit Folder(const char* name) : path_(std::filesystem::temp_directory_path() / name) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void write(const char* name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string study_of(const std::string& file, const std::string& more = "") {
  return "schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = \"planar.any\"\n[target]\ntype = "
         "\"path_points\"\npoints_file = \"" +
         file + "\"\n" + more + "[optimiser]\nevaluations = 20000\n";
}

const std::string& drawing_text(const char* id) {
  return linkwright::test::published_case("drawings.json", id).find("text")->as_string();
}

TEST(AnyPathDrawings, GiveTheStroke) {
  const Folder folder("linkwright-drawings");
  folder.write("page.svg",
               "<svg width='210mm' viewBox='0 0 420 594'><g transform='translate(10 20)'><rect "
               "width='80' height='60'/></g></svg>");
  folder.write("slot.dxf", drawing_text("dxf_slot"));
  std::string messages;
  const auto page = test::prepare(study_of("page.svg"), messages, folder.path());
  ASSERT_TRUE(page) << messages;
  EXPECT_EQ(messages, "");
  const Value& target = *page->canonical.find("target");
  EXPECT_TRUE(target.find("closed")->as_bool());
  const auto& corners = target.find("points_m")->as_array();
  ASSERT_EQ(corners.size(), 8U);  // two a side, since five points make a stroke
  EXPECT_NEAR(corners[0].as_array()[0].as_number(), 0.005, 1e-12);
  EXPECT_NEAR(corners[0].as_array()[1].as_number(), -0.010, 1e-12);
  EXPECT_NEAR(corners[4].as_array()[0].as_number(), 0.045, 1e-12);
  EXPECT_NEAR(corners[4].as_array()[1].as_number(), -0.040, 1e-12);
  const auto slot = test::prepare(study_of("slot.dxf"), messages, folder.path());
  ASSERT_TRUE(slot) << messages;
  EXPECT_THAT(messages, HasSubstr("'slot.dxf' names no unit of length: its numbers are taken as mm"));
  EXPECT_EQ(slot->canonical.find("target")->find("points_m")->as_array().size(), 98U);
  const auto open = test::prepare(study_of("slot.dxf", "closed = false\n"), messages, folder.path());
  ASSERT_TRUE(open) << messages;
  EXPECT_EQ(open->canonical.find("target")->find("points_m")->as_array().size(), 99U);
}

TEST(AnyPathDrawings, LeadToMachines) {
  const Folder folder("linkwright-drawn-machines");
  folder.write("path.svg", drawing_text("path_data"));
  const study::Result result = test::run_text(study_of("path.svg"), folder.path());
  EXPECT_FALSE(result.solutions.empty());
}

TEST(AnyPathDrawings, SayWhatIsWrong) {
  const Folder folder("linkwright-wrong-drawings");
  for (const char* id : {"svg_several", "svg_number_missing", "dxf_cut", "dxf_empty", "svg_text_alone"}) {
    folder.write("wrong", drawing_text(id));
    const std::string& text =
        linkwright::test::published_case("drawings.json", id).find("diagnostic")->as_string();
    const std::string said = test::problems_of(study_of("wrong"), folder.path());
    EXPECT_THAT(said, HasSubstr(text.substr(text.find("error: ") + 7))) << id;
    EXPECT_EQ(said.find("error:"), said.rfind("error:")) << said;
  }
  folder.write("empty.svg", "");
  const std::string empty = test::problems_of(study_of("empty.svg"), folder.path());
  EXPECT_THAT(empty, HasSubstr("empty.svg"));
  folder.write("line.svg", "M0 0L10 10");
  std::string messages;
  EXPECT_TRUE(test::prepare(study_of("line.svg"), messages, folder.path()));
  EXPECT_THAT(messages, HasSubstr("the stroke is a straight line"));
  folder.write(
      "many.svg", "<svg width='9mm' viewBox='0 0 9 9'><path d='M0 0" + [] {
        std::string out;
        for (int k = 0; k < 60'000; ++k) out += "h1v1";
        return out + "'/></svg>";
      }());
  EXPECT_TRUE(test::prepare(study_of("many.svg"), messages, folder.path())) << messages;
  EXPECT_THAT(messages, HasSubstr("has 120001 points: taken at 99999 equal steps"));
}

// Other path studies meet single points.
TEST(AnyPathDrawings, AreRefusedByStudiesOfSinglePoints) {
  const Folder folder("linkwright-refused-drawings");
  folder.write("path.svg", drawing_text("svg_polygon"));
  std::string text = study_of("path.svg");
  text.replace(text.find("planar.any"), 10, "planar.four_bar");
  text.resize(text.find("[optimiser]"));
  EXPECT_THAT(test::problems_of(text, folder.path()), HasSubstr("'path.svg' is a drawing"));
}

}  // namespace
}  // namespace linkwright::planar
