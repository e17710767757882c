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

}  // namespace

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
