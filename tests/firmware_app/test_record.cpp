#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/plc/modbus_client.hpp"
#include "firmware_app/record_folder.hpp"
#include "firmware_app/record_writer.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds patience{60};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(Record, ReplaysToTheSameBytes) {
  const TemporaryFolder folder;
  const TemporaryFolder client;
  const std::string bank = folder.path("bar.bank");
  ASSERT_TRUE(write_file(bank, shared_angle_bar_bank()).ok());
  const std::filesystem::path scene = write_bop_scene(folder.path("data"), angle_bar_scene());
  const std::string configuration =
      folder.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"" +
                                      scene.string() + "\"\n[detect.match]\nreference_step = 4\n" +
                                      "[modbus]\naddress = \"127.0.0.1\"\nport = 0\n[memory]\nlock = false\n");
  const std::filesystem::path records = folder.path("records");
  GraspdProcess daemon(folder, {"record", "--config", configuration, "-o", records.string()});
  const std::optional<std::string> port = daemon.wait_for(" port=", patience);
  ASSERT_TRUE(port) << daemon.errors();
  Result<ModbusClient> plc =
      ModbusClient::connect("127.0.0.1", static_cast<std::uint16_t>(std::stoi(*port)), BlockFormat{});
  ASSERT_TRUE(plc.ok()) << plc.status().message();
  ClientRequest request;
  request.request_id = 77;
  const Result<ResultBlock> block = plc.value().request_pick(request, patience);
  ASSERT_TRUE(block.ok()) << block.status().message();
  ASSERT_TRUE(daemon.wait_for("code=I017 recorded ", patience)) << daemon.errors();
  daemon.terminate();
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();

  const std::filesystem::path recording = records / "recorded" / "000001";
  const GraspdOutcome replay =
      run_graspd(client, {"detect", (recording / "depth" / "000000.tiff").string(), "--bank", bank, "--config",
                          configuration, "--rejected", "--replayable", "--json", "-"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_EQ(replay.output, text_of(recording / "detections.json"));
  EXPECT_EQ(text_of(recording / "graspd.toml"), text_of(configuration));

  const nlohmann::json record = nlohmann::json::parse(text_of(recording / "record.json"));
  EXPECT_EQ(record["request"]["id"], 77);
  EXPECT_EQ(record["result"]["code"], "ok");
  EXPECT_EQ(record["result"]["instances_found"], 2);
  EXPECT_EQ(record["banks"][0]["part"], 7);
  EXPECT_EQ(record["banks"][0]["digest"].get<std::string>().size(), 16U);

  std::filesystem::create_directories(folder.path("banks"));
  std::filesystem::copy_file(bank, std::filesystem::path(folder.path("banks")) / "obj_000007.bank");
  const GraspdOutcome validated =
      run_graspd(client, {"validate", "--bop", records.string(), "--split", "recorded", "--banks", folder.path("banks"),
                          "-o", folder.path("results.csv")});
  EXPECT_EQ(validated.exit_code, 0) << validated.errors;
  EXPECT_THAT(validated.output, HasSubstr("2 instances reported in 1 images"));
}

TEST(Record, KeepsFailuresByItself) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder.path("bar.bank"), shared_angle_bar_bank()).ok());
  const std::filesystem::path scene = write_bop_scene(folder.path("data"), angle_bar_scene());
  const std::string configuration = folder.write(
      "graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"" + scene.string() +
                         "\"\n[modbus]\naddress = \"127.0.0.1\"\nport = 0\n[memory]\nlock = false\n" +
                         "[record]\nfolder = \"records\"\n");
  GraspdProcess daemon(folder, {"run", "--config", configuration});
  const std::optional<std::string> port = daemon.wait_for(" port=", patience);
  ASSERT_TRUE(port) << daemon.errors();
  Result<ModbusClient> plc =
      ModbusClient::connect("127.0.0.1", static_cast<std::uint16_t>(std::stoi(*port)), BlockFormat{});
  ASSERT_TRUE(plc.ok()) << plc.status().message();
  const auto ask = [&plc](std::uint16_t id, std::uint16_t minimum_score, bool dry_run = false) {
    ClientRequest request;
    if (dry_run) request.options = request_option::dry_run;
    request.request_id = id;
    request.minimum_score = minimum_score;
    const Result<ResultBlock> block = plc.value().request_pick(request, patience);
    EXPECT_TRUE(block.ok()) << block.status().message();
    return block.ok() ? block.value().code : ResultCode::internal;
  };
  EXPECT_EQ(ask(1, 0), ResultCode::ok);
  EXPECT_EQ(ask(2, 10000), ResultCode::no_match);
  ASSERT_TRUE(daemon.wait_for("000001 request=2", patience)) << daemon.errors();
  EXPECT_EQ(ask(3, 0), ResultCode::ok);
  EXPECT_EQ(ask(4, 0, true), ResultCode::dry_run);
  daemon.terminate();
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  EXPECT_FALSE(std::filesystem::exists(folder.path("records/recorded/000002"))) << "of four requests one failed";
  const nlohmann::json record = nlohmann::json::parse(text_of(folder.path("records/recorded/000001/record.json")));
  EXPECT_EQ(record["result"]["code"], "no_match");
}

/// A writer in this process, over a pick cycle.
class RecordedCycle : public testing::Test {
 protected:
  void record(RecordWhen when, const std::vector<const Answer*>& answers) {
    RecordSettings settings;
    settings.folder = folder_.path("records");
    Result<RecordFolder> records = RecordFolder::open(settings);
    ASSERT_TRUE(records.ok()) << records.status().message();
    RecordWriter writer(std::move(records).value(), when, "", LoadedBanks{}, fixture_.source.scene.depth.size(), 100);
    for (const Answer* answer : answers) {
      PlcRequest request;
      request.request_id = answer->block.request_id;
      writer.offer(fixture_.cycle.capture, request, *answer, fixture_.source.empty_bin());
    }
  }
  [[nodiscard]] bool has(const std::string& recording) const {
    return std::filesystem::exists(folder_.path("records/recorded/" + recording + "/record.json"));
  }

  TemporaryFolder folder_;
  PickCycleFixture fixture_{angle_bar_scene()};
};

TEST_F(RecordedCycle, SaysWhatIsLeftOutWhileOneIsBeingWritten) {
  const Answer first = fixture_.ask();
  Answer second = first;
  second.block.request_id = 777;
  testing::internal::CaptureStderr();
  record(RecordWhen::always, {&first, &second});
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("code=W018 not recorded: the last one is still being written request=777\n"));
  EXPECT_TRUE(has("000001"));
  EXPECT_FALSE(has("000002"));
}

TEST_F(RecordedCycle, KeepsAFrameOfNoUse) {
  std::fill(fixture_.source.scene.depth.begin(), fixture_.source.scene.depth.end(), 0.0F);
  const Answer blind = fixture_.ask();
  ASSERT_EQ(blind.block.code, ResultCode::bad_frame);
  record(RecordWhen::failure, {&blind});
  EXPECT_TRUE(has("000001"));
}

TEST_F(RecordedCycle, KeepsNothingThatWasGivenUpOrHasNoFrame) {
  fixture_.plc.wanted = false;
  const Answer given_up = fixture_.ask();
  ASSERT_EQ(given_up.block.code, ResultCode::given_up);
  record(RecordWhen::always, {&given_up});
  fixture_.plc.wanted = true;
  fixture_.source.failure = Status(StatusCode::bad_frame, "it came in part");
  const Answer none = fixture_.ask();
  ASSERT_EQ(none.block.code, ResultCode::bad_frame);
  record(RecordWhen::always, {&none});
  EXPECT_FALSE(has("000001"));
}

TEST(Record, KeepsItsQuota) {
  const TemporaryFolder folder;
  RecordSettings settings;
  settings.folder = folder.path("records");
  settings.maximum_frames = 3;
  settings.maximum_bytes = 5000;
  const auto add = [&](RecordFolder& records, std::size_t bytes) {
    const auto added = records.add({7}, [bytes](const std::filesystem::path& scene) {
      if (Status written = write_file(scene / "depth.tiff", std::string(bytes, 'x')); !written.ok()) return written;
      return write_file(scene / "record.json", std::string_view("{\"banks\": [{\"part\": 7}]}"));
    });
    EXPECT_TRUE(added.ok()) << added.status().message();
  };
  const auto kept = [&] {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(settings.folder + "/recorded")) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  {
    Result<RecordFolder> records = RecordFolder::open(settings);
    ASSERT_TRUE(records.ok()) << records.status().message();
    for (int i = 0; i < 5; ++i) add(records.value(), 100);
    EXPECT_THAT(kept(), testing::ElementsAre("000003", "000004", "000005"));
    const auto failed = records.value().add({7}, [](const std::filesystem::path& scene) {
      std::ofstream(scene / "half") << "half";
      return Status(StatusCode::cannot_write, "disk full");
    });
    EXPECT_EQ(failed.status().code(), StatusCode::cannot_write);
    EXPECT_THAT(kept(), testing::ElementsAre("000003", "000004", "000005")) << "nothing half-written";
  }
  Result<RecordFolder> again = RecordFolder::open(settings);
  ASSERT_TRUE(again.ok()) << again.status().message();
  add(again.value(), 4800);
  EXPECT_THAT(kept(), testing::ElementsAre("000005", "000006")) << "counted on, and within the bytes";
  EXPECT_THAT(text_of(settings.folder + "/recorded_targets_bop19.json"), HasSubstr("\"scene_id\": 6"));
}

/// A folder of recordings that holds these already, each with this record.json.
RecordSettings recordings(const TemporaryFolder& folder, const std::vector<std::pair<std::string, std::string>>& held) {
  RecordSettings settings;
  settings.folder = folder.path("records");
  settings.maximum_frames = 3;
  for (const auto& [name, record] : held) {
    const std::filesystem::path recording = std::filesystem::path(settings.folder) / "recorded" / name;
    std::filesystem::create_directories(recording);
    std::ofstream(recording / "record.json") << record;
  }
  return settings;
}

std::string added_to(RecordFolder& records) {
  const auto added = records.add(
      {7}, [](const std::filesystem::path& scene) { return write_file(scene / "a", std::string_view("x")); });
  return added.ok() ? added.value().filename().string() : std::string(added.status().message());
}

TEST(Record, DamagedRecordingsDoNotKeepTheLineFromRunning) {
  for (const char* record : {"", "[]", "3", "{\"banks\": 3}", "{\"banks\": [1]}", "{\"banks\": [{\"part\": \"x\"}]}"}) {
    const TemporaryFolder folder;
    Result<RecordFolder> records = RecordFolder::open(recordings(folder, {{"000004", record}, {"12", record}}));
    ASSERT_TRUE(records.ok()) << record << ": " << records.status().message();
    EXPECT_EQ(added_to(records.value()), "000005") << record;
  }
}

TEST(Record, NumbersBeginAgainAfterARestart) {
  const TemporaryFolder folder;
  const RecordSettings settings = recordings(folder, {{"000001", "{}"}, {"999998", "{}"}, {"999999", "{}"}});
  Result<RecordFolder> records = RecordFolder::open(settings);
  ASSERT_TRUE(records.ok()) << records.status().message();
  EXPECT_EQ(added_to(records.value()), "000002");
  EXPECT_FALSE(std::filesystem::exists(settings.folder + "/recorded/999998")) << "the oldest";
  EXPECT_TRUE(std::filesystem::exists(settings.folder + "/recorded/000001"));
}

}  // namespace
}  // namespace graspd
