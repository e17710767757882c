#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware_app/configuration.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view smallest =
    "banks = [\"part.bank\"]\n"
    "[camera]\n"
    "source = \"recorded\"\n"
    "path = \"scene\"\n";

class ConfigurationFile : public testing::Test {
 protected:
  Result<Configuration> read(std::string_view text) { return read_configuration(folder_.write("graspd.toml", text)); }

  /// The message that `text` provokes, without the folder.
  std::string complaint(std::string_view text) {
    const Result<Configuration> result = read(text);
    if (result.ok()) return "(accepted)";
    EXPECT_EQ(result.status().code(), StatusCode::bad_configuration);
    const std::string message(result.status().message());
    EXPECT_THAT(message, StartsWith(folder_.path("")));
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line only";
    return message.substr(std::min(message.size(), folder_.path("").size()));
  }

  TemporaryFolder folder_;
};

TEST_F(ConfigurationFile, SmallestOneTakesDefaultsAndResolvesPaths) {
  const Result<Configuration> result = read(smallest);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result.value().banks, std::vector<std::string>{folder_.path("part.bank")});
  EXPECT_EQ(result.value().camera.recorded.path, folder_.path("scene"));
  EXPECT_FALSE(result.value().calibrated);
  EXPECT_TRUE(result.value().picture.empty());
}

TEST_F(ConfigurationFile, MissingFileIsNamed) {
  const Result<Configuration> result = read_configuration(folder_.path("nowhere.toml"));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.status().code(), StatusCode::bad_configuration);
  EXPECT_THAT(std::string(result.status().message()), HasSubstr("nowhere.toml: cannot be opened: No such file"));
}

TEST_F(ConfigurationFile, FolderInPlaceOfAFileIsNamed) {
  const Result<Configuration> result = read_configuration(folder_.path(""));
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(std::string(result.status().message()), EndsWith("is a folder, not a TOML file"));
}

TEST_F(ConfigurationFile, FileWithoutEndIsRefused) {
  const Result<Configuration> result = read_configuration("/dev/zero");
  EXPECT_EQ(result.status().code(), StatusCode::bad_configuration);
  EXPECT_THAT(std::string(result.status().message()), HasSubstr("larger than 1 MiB"));
}

TEST_F(ConfigurationFile, MalformedTomlNamesTheLine) {
  EXPECT_THAT(complaint("banks = [\"a\"]\n[camera\nsource = 1\n"), StartsWith("graspd.toml:2: not valid TOML: "));
}

TEST_F(ConfigurationFile, UnknownKeyNamesTheNearestOne) {
  EXPECT_EQ(complaint(std::string(smallest) + "[modbus]\nadress = \"::\"\n"),
            "graspd.toml:6: unknown key modbus.adress; did you mean modbus.address?");
  EXPECT_EQ(complaint(std::string(smallest) + "[memroy]\nbudget = \"1 GiB\"\n"),
            "graspd.toml:5: unknown key memroy; did you mean memory?");
  EXPECT_EQ(complaint(std::string(smallest) + "[output]\nxyzzy = 1\n"),
            "graspd.toml:6: unknown key output.xyzzy; remove it");
  EXPECT_EQ(complaint("bnks = \"a.bank\"\n"), "graspd.toml:1: unknown key bnks; did you mean banks?");
}

TEST_F(ConfigurationFile, UnknownKeyNamesAPoseToo) {
  EXPECT_EQ(complaint(std::string(smallest) + "[calibration]\nrobot_form_camera = [0, 0, 0, 0, 0, 0, 1]\n"),
            "graspd.toml:6: unknown key calibration.robot_form_camera; did you mean calibration.robot_from_camera?");
}

TEST_F(ConfigurationFile, WhatTheLineToThePlcCannotTakeIsRefused) {
  const auto modbus = [&](const std::string& keys) { return complaint(std::string(smallest) + "[modbus]\n" + keys); };
  EXPECT_EQ(modbus("address = \"localhost\"\n"),
            "graspd.toml:6: modbus.address must be an IP address as a number, as in \"192.168.1.10\", but is "
            "\"localhost\"");
  EXPECT_EQ(modbus("allow = [\"10.0.0.1\", \"10.0.0.0/40\"]\n"),
            "graspd.toml:6: modbus.allow cannot be used: allowed client '10.0.0.0/40': the prefix must be 0 to 32");
  EXPECT_EQ(modbus("heartbeat_timeout = 0.0001\n"),
            "graspd.toml:6: modbus.heartbeat_timeout must be 0, or at least 0.001");
  const std::string client = "role = \"client\"\n[modbus.client]\naddress = \"192.168.0.1\"\n";
  EXPECT_THAT(modbus("role = \"client\"\n[modbus.client]\naddress = \"plc\"\n"),
              StartsWith("graspd.toml:8: modbus.client.address must be an IP address"));
  EXPECT_EQ(modbus(client + "poll_period = 0.0\n"),
            "graspd.toml:9: modbus.client.poll_period must lie between 0.001 and 86400, but is 0");
  EXPECT_EQ(modbus(client + "response_timeout = 11.0\n"),
            "graspd.toml:9: modbus.client.response_timeout must lie between 0.01 and 10, but is 11");
  EXPECT_EQ(modbus(client + "unit = 248\n"), "graspd.toml:9: modbus.client.unit must lie between 0 and 247, or be 255");
  EXPECT_THAT(modbus(client + "unit = 254\n"), StartsWith("graspd.toml:9: modbus.client.unit must"));
  EXPECT_EQ(modbus(client + "unit = 247\nresponse_timeout = 10.0\n"), "(accepted)");
  EXPECT_THAT(modbus(client + "result_address = 65000\n"), StartsWith("graspd.toml:9: modbus.client.result_address"));
  EXPECT_EQ(modbus(client + "request_address = 990\n"),
            "graspd.toml:9: modbus.client.request_address must leave room: the 37 request registers and the 611 of "
            "the results overlap");
}

TEST_F(ConfigurationFile, WrongTypeSaysWhatIsExpected) {
  EXPECT_EQ(complaint(std::string(smallest) + "[modbus]\nport = \"502\"\n"),
            "graspd.toml:6: modbus.port must be a whole number, but is a text in quotes");
  EXPECT_EQ(complaint(std::string(smallest) + "[detect]\nsegmentation = 1\n"),
            "graspd.toml:6: detect.segmentation must be true or false, but is a whole number");
}

TEST_F(ConfigurationFile, ValueOutOfRangeSaysTheRange) {
  EXPECT_EQ(complaint(std::string(smallest) + "[modbus]\nport = 70000\n"),
            "graspd.toml:6: modbus.port must lie between 0 and 65535, but is 70000");
  EXPECT_EQ(complaint(std::string(smallest) + "[detect]\nminimum_score = nan\n"),
            "graspd.toml:6: detect.minimum_score must lie between 0 and 1, but is nan");
}

TEST_F(ConfigurationFile, MissingKeySaysWhatItIsFor) {
  EXPECT_EQ(complaint("banks = [\"a.bank\"]\n"),
            "graspd.toml:1: camera is missing: the section [camera] says where frames come from");
  EXPECT_EQ(complaint("banks = [\"a.bank\"]\n[camera]\nsource = \"recorded\"\n"),
            "graspd.toml:2: camera.path is missing: name the recorded frames: a BOP scene folder, a folder of frames "
            "or one frame");
}

TEST_F(ConfigurationFile, UnknownChoiceListsWhatIsAllowed) {
  EXPECT_EQ(complaint("banks = [\"a.bank\"]\n[camera]\nsource = \"webcam\"\npath = \"a\"\n"),
            "graspd.toml:3: camera.source must be one of \"recorded\", \"genicam\", but is \"webcam\"");
}

TEST_F(ConfigurationFile, TopmostProblemOfTheFileIsTold) {
  EXPECT_THAT(complaint("banks = 5\n[camera]\nsource = \"recorded\"\npath = 7\n"),
              StartsWith("graspd.toml:1: banks must"));
}

TEST_F(ConfigurationFile, BudgetNeedsAUnit) {
  const Result<Configuration> result = read(std::string(smallest) + "[memory]\nbudget = \"1.5 GiB\"\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result.value().memory_budget, std::size_t{1536} << 20U);
  for (const char* wrong : {"512", "512 MB", "-1 MiB", "MiB", "1 MiBs"}) {
    EXPECT_THAT(complaint(std::string(smallest) + "[memory]\nbudget = \"" + wrong + "\"\n"),
                StartsWith("graspd.toml:6: memory.budget must be a size such as"))
        << wrong;
  }
}

TEST_F(ConfigurationFile, CalibrationAsQuaternionAndAsMatrixAgree) {
  const Result<Configuration> quaternion =
      read(std::string(smallest) + "[calibration]\nrobot_from_camera = [100, 200, 300, 1, 0, 0, 0]\n");
  const Result<Configuration> matrix = read(std::string(smallest) +
                                            "[calibration]\nrobot_from_camera = [1, 0, 0, 100,\n 0, -1, 0, 200,\n"
                                            " 0, 0, -1, 300,\n 0, 0, 0, 1]\n");
  ASSERT_TRUE(quaternion.ok()) << quaternion.status().message();
  ASSERT_TRUE(matrix.ok()) << matrix.status().message();
  const Vector3 p(0.01F, 0.02F, 0.5F);
  const Vector3 expected(0.11F, 0.18F, -0.2F);
  EXPECT_TRUE((quaternion.value().grasp.parameters.robot_from_camera * p).isApprox(expected, 1e-5F));
  EXPECT_TRUE((matrix.value().grasp.parameters.robot_from_camera * p).isApprox(expected, 1e-5F));
}

TEST_F(ConfigurationFile, CalibrationThatIsNoRotationIsRefused) {
  EXPECT_THAT(complaint(std::string(smallest) + "[calibration]\nrobot_from_camera = [0, 0, 0, 1, 1, 0, 0]\n"),
              EndsWith("must hold a quaternion (x, y, z, w) of length 1"));
  EXPECT_THAT(complaint(std::string(smallest) +
                        "[calibration]\nrobot_from_camera = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"),
              HasSubstr("right-handed"));
  EXPECT_THAT(complaint(std::string(smallest) + "[calibration]\nrobot_from_camera = [1, 2, 3]\n"),
              EndsWith("must be a list of 16 numbers, but has 3"));
}

TEST_F(ConfigurationFile, BoxIsGivenInTheRobotsFrame) {
  const Result<Configuration> result =
      read(std::string(smallest) +
           "[calibration]\nrobot_from_camera = [0, 0, 1000, 1, 0, 0, 0]\n"
           "[detect]\nbackground = \"box\"\n[detect.box]\ncentre = [0, 0, 200]\nsize = [400, 300, 100]\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  const PreprocessParameters& preprocess = result.value().detect.parameters.preprocess;
  const Vector3 centre_in_camera(0, 0, 0.8F);
  EXPECT_LT((preprocess.box_from_camera * centre_in_camera).norm(), 1e-6F);
  EXPECT_TRUE(preprocess.box_half_size.isApprox(Vector3(0.2F, 0.15F, 0.05F)));
}

TEST_F(ConfigurationFile, RegionsAreNumberedInTheirOrder) {
  const std::string region = "[[region]]\ncentre = [0, 0, 700]\nsize = [200, 100, 50]\n";
  const Result<Configuration> result =
      read(std::string(smallest) + ("[[region]]\ncentre = [1, 2, 3]\nsize = [1, 1, 1]\n" + region));
  ASSERT_TRUE(result.ok()) << result.status().message();
  ASSERT_EQ(result.value().regions.size(), 2U);
  EXPECT_TRUE(result.value().regions[1].half_size.isApprox(Vector3(0.1F, 0.05F, 0.025F)));
  EXPECT_TRUE(result.value().regions[1].reference_from_box.translation.isApprox(Vector3(0, 0, 0.7F)));
  std::string many(smallest);
  for (int i = 0; i < 17; ++i) many += region;
  EXPECT_THAT(complaint(many), HasSubstr("region may be given at most 16 times"));
}

TEST_F(ConfigurationFile, ClientRoleNeedsThePlcsAddress) {
  EXPECT_THAT(complaint(std::string(smallest) + "[modbus]\nrole = \"client\"\n"),
              HasSubstr("modbus.role \"client\" needs [modbus.client] with the address of the PLC"));
  const Result<Configuration> result =
      read(std::string(smallest) +
           "[modbus]\nrole = \"client\"\nword_order = \"cdab\"\nheartbeat_timeout = 2.0\n"
           "[modbus.client]\naddress = \"192.168.0.1\"\nresult_address = 4000\npoll_period = 0.02\n");
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result.value().modbus_role, ModbusRole::client);
  EXPECT_EQ(result.value().plc.address, "192.168.0.1");
  EXPECT_EQ(result.value().plc.result_address, 4000);
  EXPECT_EQ(result.value().plc.poll_period, std::chrono::milliseconds(20));
  EXPECT_EQ(result.value().plc.format.word_order, WordOrder::cdab) << "shared with the server's role";
  EXPECT_EQ(result.value().plc.heartbeat_timeout, std::chrono::seconds(2));
}

}  // namespace
}  // namespace graspd
