#pragma once

#include "core/status.hpp"

namespace CLI {
class App;
}

namespace graspd {

/// Each adds one subcommand to the command line. The subcommand's callback leaves its outcome in
/// `outcome`, which must live until the command line has been run.
void add_run_command(CLI::App& command_line, Status& outcome);
void add_record_command(CLI::App& command_line, Status& outcome);
void add_detect_command(CLI::App& command_line, Status& outcome);
void add_bank_compile_command(CLI::App& bank_command, Status& outcome);
void add_bank_learn_command(CLI::App& bank_command, Status& outcome);
void add_bank_show_command(CLI::App& bank_command, Status& outcome);
void add_validate_command(CLI::App& command_line, Status& outcome);
void add_camera_commands(CLI::App& command_line, Status& outcome);
void add_simulate_command(CLI::App& command_line, Status& outcome);
void add_check_command(CLI::App& command_line, Status& outcome);
void add_calibrate_command(CLI::App& command_line, Status& outcome);
void add_bench_command(CLI::App& command_line, Status& outcome);

}  // namespace graspd
