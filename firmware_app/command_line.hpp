#pragma once

namespace graspd {

/// Reads the command line, runs the subcommand that it names and returns the process' exit code: 0 or
/// the number of a StatusCode. Errors go to stderr as one line, "graspd: what is wrong".
[[nodiscard]] int run_command_line(int argument_count, const char* const* arguments);

}  // namespace graspd
