#include "firmware_app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "firmware_app/commands.hpp"
#include "firmware_app/nearest_word.hpp"

#ifndef GRASPD_VERSION
#define GRASPD_VERSION "development"
#endif

namespace graspd {
namespace {

constexpr const char* overview =
    "graspd finds parts in a bin with a 3D camera and tells a PLC where to pick them.\n"
    "\n"
    "From a CAD file to a pick:\n"
    "  graspd bank compile part.toml -o part.bank    make a bank from the CAD file\n"
    "  graspd detect frame.png --bank part.bank      try it on a recorded frame\n"
    "  graspd check --config graspd.toml             configuration, banks, memory\n"
    "  graspd run --config graspd.toml               serve the PLC\n"
    "Each subcommand explains itself: graspd detect --help";

constexpr const char* exit_codes =
    "Exit codes (the same numbers stand in the log and in the PLC's result code):\n"
    "   0 fine                          7 memory budget too small\n"
    "   1 fault of graspd itself        8 Modbus address in use\n"
    "   2 command line not understood   9 request for an unknown part\n"
    "   3 configuration or part file   10 camera does not answer\n"
    "   4 mesh, image, cloud, data set 11 frame too old\n"
    "   5 bank                         12 frame without usable depth\n"
    "   6 output cannot be written     13 deadline passed";

/// What to say when the words do not make a command: the subcommand that was probably meant.
std::string advice(const CLI::App& app, const CLI::ParseError& problem, std::span<const char* const> words) {
  const CLI::App* command = &app;
  std::string understood;
  std::size_t next = 1;
  for (; !command->get_subcommands().empty(); ++next) {
    command = command->get_subcommands().front();
    understood += command->get_name() + " ";
  }
  std::vector<std::string> names;
  for (const CLI::App* known : command->get_subcommands(nullptr)) names.push_back(known->get_name());
  if (names.empty() || next >= words.size() || words[next][0] == '-') {
    return std::string(problem.what()) + "; see graspd " + understood + "--help";
  }
  const std::string near = nearest_word(words[next], names);
  return "there is no subcommand " + understood + words[next] +
         (near.empty() ? "; see graspd " + understood + "--help" : "; did you mean " + understood + near + "?");
}

int report(const Status& status) {
  if (!status.ok()) {
    std::fprintf(stderr, "graspd: %.*s\n", static_cast<int>(status.message().size()), status.message().data());
  }
  return static_cast<int>(status.code());
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments) {
  Status outcome;
  CLI::App app(overview, "graspd");
  app.footer(exit_codes);
  app.set_version_flag("--version", "graspd " GRASPD_VERSION);
  app.require_subcommand(1);
  add_run_command(app, outcome);
  add_record_command(app, outcome);
  add_detect_command(app, outcome);
  CLI::App* bank = app.add_subcommand("bank", "Make banks and look into them");
  bank->require_subcommand(1);
  add_bank_compile_command(*bank, outcome);
  add_bank_learn_command(*bank, outcome);
  add_bank_show_command(*bank, outcome);
  add_validate_command(app, outcome);
  add_bench_command(app, outcome);
  add_check_command(app, outcome);
  add_camera_commands(app, outcome);
  add_simulate_command(app, outcome);
  add_calibrate_command(app, outcome);
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::CallForHelp&) {
    return app.exit(CLI::CallForHelp());
  } catch (const CLI::CallForAllHelp&) {
    return app.exit(CLI::CallForAllHelp());
  } catch (const CLI::CallForVersion&) {
    std::puts(app.version().c_str());
    return 0;
  } catch (const CLI::ParseError& problem) {
    return report(
        Status(StatusCode::usage, advice(app, problem, {arguments, static_cast<std::size_t>(argument_count)})));
  } catch (const std::exception& problem) {
    return report(Status::format(StatusCode::internal, "unexpected: %s", problem.what()));
  }
  if (outcome.ok() && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
    outcome = Status(StatusCode::cannot_write, "standard output took only a part: is the disk full?");
  }
  return report(outcome);
}

}  // namespace graspd
