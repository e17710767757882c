#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "firmware_app/commands.hpp"
#include "firmware_app/daemon.hpp"

namespace graspd {
namespace {

Status run(const std::string& path) {
  const Result<Configuration> configuration = read_configuration(path);
  if (!configuration.ok()) return configuration.status();
  return run_daemon(configuration.value());
}

struct RecordOptions {
  std::string configuration = "/etc/graspd/graspd.toml";
  std::string folder;
};

Status record(const RecordOptions& options) {
  const Result<Configuration> read = read_configuration(options.configuration);
  if (!read.ok()) return read.status();
  Configuration configuration = read.value();
  configuration.record.folder = options.folder;
  configuration.record.when = RecordWhen::always;
  return run_daemon(configuration);
}

}  // namespace

void add_record_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<RecordOptions>();
  CLI::App* command = command_line.add_subcommand("record", "Serve the PLC and save the frames of its triggers");
  command->add_option("--config", options->configuration, "Configuration file")->capture_default_str();
  command->add_option("-o,--output", options->folder, "Folder of recordings; is made when it is not there")->required();
  command->footer(
      "Does what `graspd run` does, and records each trigger that it answers as one scene of a data set in BOP's "
      "form:\n"
      "the frame and the empty bin in every bit, request, result and all rejections, and digests of\n"
      "configuration and banks. Left out are requests that were reset or timed out, that failed for\n"
      "another reason than a bad frame, and those that came while one was being written: the log tells of\n"
      "these. The quota of [record] holds; the oldest recordings go first. With record.folder in the\n"
      "configuration, `graspd run` records failures by itself.\n"
      "\n"
      "Examples:\n"
      "  graspd record --config graspd.toml -o records\n"
      "  graspd detect records/recorded/000001/depth/000000.tiff --bank part.bank \\\n"
      "      --config graspd.toml --rejected --replayable --json -      # equals its detections.json\n"
      "  graspd validate --bop records --split recorded --banks banks -o results.csv");
  command->callback([options, &outcome] { outcome = record(*options); });
}

void add_run_command(CLI::App& command_line, Status& outcome) {
  auto path = std::make_shared<std::string>("/etc/graspd/graspd.toml");
  CLI::App* command = command_line.add_subcommand("run", "Serve the PLC");
  command->add_option("--config", *path, "Configuration file")->capture_default_str();
  command->footer(
      "Reads configuration and banks, takes all memory that it will ever need, opens the camera and\n"
      "the Modbus address, and then answers the PLC until SIGTERM. SIGHUP changes nothing: restart to\n"
      "read the configuration again. Events go to stderr, one a line.\n"
      "\n"
      "Example:\n"
      "  graspd run --config /etc/graspd/graspd.toml");
  command->callback([path, &outcome] { outcome = run(*path); });
}

}  // namespace graspd
