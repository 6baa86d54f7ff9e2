// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/samples.h"

#include <gmock/gmock.h>

#include <set>

#include "linkwright/app/catalogue.h"

namespace linkwright::app {
namespace {

TEST(Samples, AllAreTakenByAMechanismOfTheCatalogue) {
  std::set<std::string> names, mechanisms;
  for (const study::Kind& kind : catalogue()) mechanisms.insert(kind.mechanism);
  for (const Sample& sample : samples()) {
    EXPECT_TRUE(names.insert(sample.name).second) << sample.name << " stands twice";
    EXPECT_FALSE(sample.summary.empty()) << sample.name;
    for (const std::string& mechanism : sample.mechanisms) EXPECT_TRUE(mechanisms.contains(mechanism));
  }
  EXPECT_TRUE(names.contains("jansen_leg"));
  EXPECT_TRUE(names.contains("2RS-US"));
}

}  // namespace
}  // namespace linkwright::app
