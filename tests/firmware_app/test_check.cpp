#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "drivers/files/atomic_file.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What `graspd check` says of the angle bar's bank with this added to the configuration.
std::string checked(const std::string& more) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_file(folder.path("bar.bank"), shared_angle_bar_bank()).ok());
  const std::filesystem::path scene = write_bop_scene(folder.path("data"), angle_bar_scene());
  const std::string configuration =
      folder.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"" +
                                      scene.string() + "\"\n" + more);
  const GraspdOutcome outcome = run_graspd(folder, {"check", "--config", configuration});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  return outcome.output;
}

TEST(Check, TellsWhichToolTakesEachGrasp) {
  const std::string jaws = "[[tool]]\nkind = \"parallel\"\nnumber = ";
  EXPECT_THAT(checked(""), HasSubstr(" grasp 1: tool 1\n"));
  EXPECT_THAT(checked(jaws + "4\nmaximum_opening = 5.0\n" + jaws + "9\n"), HasSubstr(" grasp 1: tool 9\n"));
  const std::string narrow = checked(jaws + "4\nmaximum_opening = 5.0\n");
  EXPECT_THAT(narrow, HasSubstr("note: grasp 1 will never be used: no tool opens that wide\n"));
  EXPECT_THAT(narrow, Not(HasSubstr("tool 4")));
  EXPECT_THAT(checked("[[tool]]\nkind = \"suction\"\nnumber = 1\n"),
              HasSubstr("note: grasp 1 will never be used: no tool is of its kind and number\n"));
}

/// What `graspd check` says of frames with a camera and this in its section.
std::string checked_camera(const std::string& more) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_file(folder.path("bar.bank"), shared_angle_bar_bank()).ok());
  const std::string configuration =
      folder.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"genicam\"\nmaximum_width = 320\n" +
                                      ("maximum_height = 240\n" + more));
  return run_graspd(folder, {"check", "--config", configuration}).output;
}

TEST(Check, NotesACameraTimeoutThatTheWatchdogDoesNotBear) {
  EXPECT_THAT(checked_camera("timeout = 15.0\n"), AllOf(HasSubstr("frames  "), Not(HasSubstr("WatchdogSec"))));
  EXPECT_THAT(checked_camera("timeout = 15.5\n"), HasSubstr("note: camera.timeout is 15.5 s: graspd.service with its "
                                                            "WatchdogSec of 30 s will not start\n"));
}

}  // namespace
}  // namespace graspd
