// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/arm_links.h"

#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> told(const Diagnostics& problems) {
  std::vector<std::string> out;
  for (const auto& problem : problems) out.push_back(to_string(problem));
  return out;
}

// The messages about links with these names; "" is a link without one. The names are then complete.
std::vector<std::string> said_of(std::vector<std::string>& names) {
  std::string text = "[mechanism]\n";
  for (const std::string& name : names)
    text += name.empty() ? "[[mechanism.link]]\n" : "[[mechanism.link]]\nname = \"" + name + "\"\n";
  if (names.empty()) text += "link = []\n";
  Diagnostics problems;
  const Value document = read_text(text, Syntax::toml, "arm.toml", problems);
  DocumentReader reader(document, "arm.toml", problems);
  ObjectReader root = reader.root();
  auto mechanism = root.table("mechanism");
  std::vector<std::string*> places;
  for (std::string& name : names) places.push_back(&name);
  complete_arm_links(*mechanism, places);
  return told(problems);
}

TEST(CompleteArmLinks, NamesThoseWithoutAName) {
  std::vector<std::string> names = {"", "fore", ""};
  EXPECT_THAT(said_of(names), IsEmpty());
  EXPECT_THAT(names, ElementsAre("link1", "fore", "link3"));
}

TEST(CompleteArmLinks, RefusesNamesThatNoColumnCanHaveOrThatTwoLinksHave) {
  std::vector<std::string> names = {"link2", "2nd", "", "upper arm", "link2"};
  EXPECT_THAT(
      said_of(names),
      ElementsAre(
          "arm.toml:4:1: error: mechanism.link[1].name: is '2nd', must begin with a letter and contain "
          "letters, digits and _ only; it becomes the beginning of column names",
          "arm.toml:7:1: error: mechanism.link[3].name: is 'upper arm', must begin with a letter and contain "
          "letters, digits and _ only; it becomes the beginning of column names",
          "arm.toml:9:1: error: mechanism.link[4].name: 'link2' is also the name of another link"));
}

TEST(CompleteArmLinks, AnArmHasOneToTwentyLinks) {
  std::vector<std::string> none;
  EXPECT_THAT(said_of(none),
              ElementsAre("arm.toml:2:8: error: mechanism.link: an arm has at least one link; add "
                          "[[mechanism.link]]"));
  std::vector<std::string> many(21);
  EXPECT_THAT(said_of(many),
              ElementsAre("arm.toml:2:1: error: mechanism.link: has 21 links, at most 20 are allowed"));
  std::vector<std::string> most(20);
  EXPECT_THAT(said_of(most), IsEmpty());
}

TEST(DrivenLink, FindsTheLinkOrSaysThatThereIsNone) {
  Diagnostics problems;
  const Value document = read_text("[[drive]]\nlink = \"fore\"\n[[drive]]\nlink = \"for\"\n[[drive]]\n",
                                   Syntax::toml, "arm.toml", problems);
  DocumentReader reader(document, "arm.toml", problems);
  ObjectReader root = reader.root();
  std::vector<ObjectReader> drives = root.tables("drive");
  const std::vector<std::string_view> links = {"upper", "fore"};
  EXPECT_EQ(driven_link(drives[0], "fore", links), 1u);
  EXPECT_EQ(driven_link(drives[2], "", links), std::nullopt);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(driven_link(drives[1], "for", links), std::nullopt);
  EXPECT_THAT(told(problems),
              ElementsAre("arm.toml:4:8: error: drive[1].link: there is no link 'for'; did you mean "
                          "'fore'?"));
}

}  // namespace
}  // namespace linkwright::study
