#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "firmware_app/commands.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {
namespace {

struct CheckOptions {
  std::string configuration = "/etc/graspd/graspd.toml";
};

Status check(const CheckOptions& options) {
  const Result<Configuration> configuration = read_configuration(options.configuration);
  if (!configuration.ok()) return configuration.status();
  std::printf("configuration  %s: fine\n", options.configuration.c_str());
  return {};
}

}  // namespace

void add_check_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = command_line.add_subcommand("check", "Check a configuration, without serving anybody");
  command->add_option("--config", options->configuration, "Configuration file")->capture_default_str();
  command->footer("Example:\n  graspd check --config /etc/graspd/graspd.toml");
  command->callback([options, &outcome] { outcome = check(*options); });
}

}  // namespace graspd
