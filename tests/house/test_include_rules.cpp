#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/house/include_rules.hpp"

namespace graspd::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(IncludeRules, HouseKeepsThem) {
  const SourceFiles house = read_house(GRASPD_SOURCE_DIR);
  ASSERT_GT(house.size(), 20U);
  EXPECT_THAT(broken_include_rules(house), IsEmpty());
}

TEST(IncludeRules, NothingOnTheLineNeedsTraining) {
  const SourceFiles house = read_house(GRASPD_SOURCE_DIR);
  const std::vector<std::string> line = files_needed_by(house, "firmware_app/run_command.cpp");
  ASSERT_THAT(line, Contains("core/detect/detector.cpp")) << "the subcommand run reaches the detector";
  EXPECT_THAT(line, Not(Contains(StartsWith("core/train/"))));
}

TEST(IncludeRules, CoreLooksDownOnly) {
  EXPECT_THAT(broken_include_rules({{"core/bank/bank.hpp", "#pragma once\n#include \"core/detect/detector.hpp\"\n"}}),
              ElementsAre("core/bank/bank.hpp:2: core/detect/detector.hpp: core/bank may not look at core/detect"));
  EXPECT_THAT(broken_include_rules({{"core/detect/vote.cpp", "#include \"core/train/views.hpp\""}}), SizeIs(1));
  EXPECT_THAT(broken_include_rules({{"core/detect/vote.cpp", "#include \"core/grasp/pick.hpp\""}}), SizeIs(1));
  EXPECT_THAT(broken_include_rules({{"core/train/views.cpp", "#include \"core/detect/detector.hpp\""}}), IsEmpty());
  EXPECT_THAT(broken_include_rules({{"core/grasp/plan.cpp", "#include \"core/status.hpp\""}}), IsEmpty());
  EXPECT_THAT(broken_include_rules({{"core/attic/old.cpp", "#include \"core/status.hpp\""}}), SizeIs(1));
}

TEST(IncludeRules, WingsPointOneWay) {
  EXPECT_THAT(broken_include_rules({{"core/detect/vote.cpp", "  #  include \"drivers/files/picture.hpp\""}}),
              ElementsAre(HasSubstr("core includes nothing but core")));
  EXPECT_THAT(broken_include_rules({{"drivers/plc/server.cpp", "#include \"firmware_app/daemon.hpp\""}}), SizeIs(1));
  EXPECT_THAT(broken_include_rules({{"drivers/plc/server.cpp", "#include \"core/train/views.hpp\""}}), SizeIs(1));
  EXPECT_THAT(broken_include_rules({{"drivers/plc/server.cpp", "#include \"server.hpp\""}}),
              ElementsAre(HasSubstr("from the root")));
  EXPECT_THAT(broken_include_rules({{"drivers/plc/server.cpp", "#include \"core/grasp/pick.hpp\""}}), IsEmpty());
}

TEST(IncludeRules, CoreDoesNotTouchTheOutsideWorld) {
  for (const char* header : {"iostream", "fstream", "thread", "chrono", "sys/mman.h"}) {
    EXPECT_THAT(broken_include_rules({{"core/bank/bank.cpp", "#include <" + std::string(header) + ">"}}), SizeIs(1));
  }
  EXPECT_THAT(broken_include_rules({{"core/bank/bank.cpp", "#include <cstdint>"}}), IsEmpty());
  EXPECT_THAT(broken_include_rules({{"drivers/system/clock.cpp", "#include <chrono>"}}), IsEmpty());
}

TEST(IncludeRules, NeededFilesFollowHeadersToTheirSources) {
  const SourceFiles files = {
      {"firmware_app/run_command.cpp", "#include \"core/detect/detector.hpp\"\n#include <vector>"},
      {"core/detect/detector.hpp", ""},
      {"core/detect/detector.cpp", "#include \"core/train/views.hpp\""},
      {"core/train/views.hpp", ""},
      {"core/train/unused.cpp", ""}};
  EXPECT_THAT(files_needed_by(files, "firmware_app/run_command.cpp"),
              ElementsAre("core/detect/detector.cpp", "core/detect/detector.hpp", "core/train/views.hpp",
                          "firmware_app/run_command.cpp"));
}

}  // namespace
}  // namespace graspd::testing
