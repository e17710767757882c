#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/firmware_app/temporary_folder.hpp"

extern char** environ;

namespace graspd {

/// The built binary, started with its output in files.
class GraspdProcess {
 public:
  GraspdProcess(const TemporaryFolder& folder, std::vector<std::string> arguments)
      : output_(folder.path("stdout.txt")), errors_(folder.path("stderr.txt")) {
    arguments.insert(arguments.begin(), GRASPD_BINARY);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, 1, output_.c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&files, 2, errors_.c_str(), flags, 0600);
    if (posix_spawn(&pid_, GRASPD_BINARY, &files, nullptr, pointers.data(), environ) != 0) pid_ = -1;
    posix_spawn_file_actions_destroy(&files);
    EXPECT_GT(pid_, 0) << "cannot start " << GRASPD_BINARY;
  }
  ~GraspdProcess() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  GraspdProcess(const GraspdProcess&) = delete;
  GraspdProcess& operator=(const GraspdProcess&) = delete;

  void terminate() const { kill(pid_, SIGTERM); }

  /// Waits for the end; the exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    if (pid_ <= 0 || waitpid(pid_, &status, 0) != pid_) return -1000;
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// Waits until stderr holds `text`, and returns what stands behind it up to the next blank or line break.
  std::optional<std::string> wait_for(const std::string& text, std::chrono::seconds timeout) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (std::chrono::steady_clock::now() < end) {
      const std::string so_far = errors();
      const std::size_t place = so_far.find(text);
      if (place != std::string::npos && so_far.find('\n', place) != std::string::npos) {
        const std::size_t start = place + text.size();
        return so_far.substr(start, so_far.find_first_of(" \n", start) - start);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return std::nullopt;
  }

  [[nodiscard]] std::string output() const { return contents(output_); }
  [[nodiscard]] std::string errors() const { return contents(errors_); }

 private:
  static std::string contents(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  std::string output_;
  std::string errors_;
  pid_t pid_ = -1;
};

/// What a subcommand did.
struct GraspdOutcome {
  int exit_code = 0;
  std::string output;
  std::string errors;
};

inline GraspdOutcome run_graspd(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  GraspdProcess process(folder, arguments);
  const int exit_code = process.wait();
  return {exit_code, process.output(), process.errors()};
}

}  // namespace graspd
