#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "drivers/system/clock.hpp"
#include "drivers/system/log.hpp"
#include "drivers/system/memory_lock.hpp"
#include "drivers/system/progress_watch.hpp"
#include "drivers/system/prompt_thread.hpp"
#include "drivers/system/service_notifier.hpp"
#include "drivers/system/signals.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// Sets an environment variable for as long as it lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { unsetenv(name_); }

 private:
  const char* name_;
};

/// A socket as systemd would hold it, in the abstract namespace.
class NotifySocket {
 public:
  NotifySocket() : descriptor_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    name = "@graspd-test-" + std::to_string(getpid());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof(address.sun_path) - 1);
    address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(bind(descriptor_, reinterpret_cast<sockaddr*>(&address), size), 0);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;
  ~NotifySocket() { close(descriptor_); }
  [[nodiscard]] std::string receive() const {
    std::array<char, 1024> text{};
    const ssize_t size = recv(descriptor_, text.data(), text.size(), 0);
    return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
  }
  std::string name;

 private:
  int descriptor_;
};

TEST(ServiceNotifier, SpeaksTheProtocolOfSystemd) {
  const NotifySocket systemd;
  const Variable socket_name("NOTIFY_SOCKET", systemd.name);
  const Variable interval("WATCHDOG_USEC", "3000000");
  const Variable process("WATCHDOG_PID", std::to_string(getpid()));
  ServiceNotifier notifier;
  ASSERT_TRUE(notifier.is_connected());
  EXPECT_EQ(notifier.watchdog_interval_ns(), 3'000'000'000);
  notifier.ready();
  EXPECT_EQ(systemd.receive(), "READY=1");
  notifier.watchdog();
  EXPECT_EQ(systemd.receive(), "WATCHDOG=1");
  notifier.status("%d banks, camera\n%s", 3, "lost");
  EXPECT_EQ(systemd.receive(), "STATUS=3 banks, camera lost");
  notifier.stopping();
  EXPECT_EQ(systemd.receive(), "STOPPING=1");
}

TEST(ServiceNotifier, IsQuietWithoutSystemd) {
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  ServiceNotifier notifier;
  EXPECT_FALSE(notifier.is_connected());
  EXPECT_EQ(notifier.watchdog_interval_ns(), 0);
  notifier.ready();
  for (const char* bad : {"", "relative/path", "/no/such/socket", "@"}) {
    const Variable socket_name("NOTIFY_SOCKET", bad);
    EXPECT_FALSE(ServiceNotifier().is_connected()) << bad;
  }
}

TEST(ServiceNotifier, WatchdogOfAnotherProcessIsNotOurs) {
  const Variable interval("WATCHDOG_USEC", "3000000");
  const Variable process("WATCHDOG_PID", "1");
  EXPECT_EQ(ServiceNotifier().watchdog_interval_ns(), 0);
}

TEST(ProgressWatch, IsContentOnlyWhenEveryWorkerMoved) {
  ProgressWatch watch;
  std::array<std::uint64_t, 3> counters{1, 1, 1};
  EXPECT_TRUE(watch.all_moved(counters));
  counters = {2, 2, 1};
  EXPECT_FALSE(watch.all_moved(counters));
  EXPECT_EQ(watch.first_stuck(), 2U);
  EXPECT_FALSE(watch.all_moved(counters));
  counters[2] = 2;
  EXPECT_TRUE(watch.all_moved(counters)) << "movement since the last time all was well counts";
  EXPECT_EQ(watch.first_stuck(), 3U);
  EXPECT_FALSE(watch.all_moved(counters));
}

TEST(Log, WritesOneLine) {
  std::array<char, 256> buffer{};
  std::size_t size = format_log_line(buffer, LogLevel::error, "E101", "cannot bind port=502", true);
  EXPECT_EQ(std::string(buffer.data(), size), "<3>code=E101 cannot bind port=502\n");
  size = format_log_line(buffer, LogLevel::info, "I110", "a\nb\tc\x1b[1m", false);
  EXPECT_EQ(std::string(buffer.data(), size), "graspd info: code=I110 a b c [1m\n");
}

TEST(Log, CutsALineThatIsTooLong) {
  std::array<char, 32> buffer{};
  const std::size_t size = format_log_line(buffer, LogLevel::warning, "W118", std::string(100, 'x'), true);
  EXPECT_EQ(size, buffer.size());
  EXPECT_EQ(buffer.back(), '\n');
}

TEST(Log, TellsTheJournalFromATerminal) {
  struct stat status {};
  ASSERT_EQ(fstat(STDERR_FILENO, &status), 0);
  {
    const Variable stream("JOURNAL_STREAM", std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino));
    EXPECT_TRUE(stderr_is_journal());
  }
  {
    const Variable stream("JOURNAL_STREAM", std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino + 1));
    EXPECT_FALSE(stderr_is_journal());
  }
  unsetenv("JOURNAL_STREAM");
  EXPECT_FALSE(stderr_is_journal());
}

/// Standard error as a pipe, for as long as it lives.
class PipedStandardError {
 public:
  PipedStandardError() : before_(dup(STDERR_FILENO)) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_NONBLOCK) != 0) return;
    read_end_ = ends[0];
    // Blocking, as standard error is.
    fcntl(ends[1], F_SETFL, 0);
    dup2(ends[1], STDERR_FILENO);
    close(ends[1]);
  }
  ~PipedStandardError() {
    dup2(before_, STDERR_FILENO);
    close(before_);
    close(read_end_);
  }
  PipedStandardError(const PipedStandardError&) = delete;
  PipedStandardError& operator=(const PipedStandardError&) = delete;

  [[nodiscard]] std::string take() const {
    std::string text;
    std::array<char, 4096> some{};
    for (ssize_t count = 0; (count = read(read_end_, some.data(), some.size())) > 0;) {
      text.append(some.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

 private:
  int before_;
  int read_end_ = -1;
};

TEST(Log, LosesLinesRatherThanWaitForAReader) {
  const PipedStandardError log;
  constexpr int lines = 5000;
  for (int i = 0; i < lines; ++i) log_event(LogLevel::info, "I110", "line %d of many", i);
  const std::string first = log.take();
  const auto came = std::count(first.begin(), first.end(), '\n');
  EXPECT_GT(came, 100);
  EXPECT_LT(came, lines);
  EXPECT_TRUE(first.ends_with("\n"));
  log_event(LogLevel::info, "I110", "there again");
  const std::string then = log.take();
  EXPECT_THAT(then, HasSubstr("code=W007 " + std::to_string(lines - came) + " lines before this one are lost"));
  EXPECT_TRUE(then.ends_with("code=I110 there again\n")) << then;
  log_event(LogLevel::info, "I110", "said once");
  EXPECT_EQ(log.take(), "graspd info: code=I110 said once\n");
}

TEST(LogThrottle, HoldsBackAndSaysHowMany) {
  LogThrottle throttle(2, 1000);
  std::uint32_t suppressed = 0;
  EXPECT_TRUE(throttle.allow(0, suppressed));
  EXPECT_TRUE(throttle.allow(10, suppressed));
  EXPECT_FALSE(throttle.allow(20, suppressed));
  EXPECT_FALSE(throttle.allow(999, suppressed));
  EXPECT_EQ(suppressed, 0U);
  EXPECT_TRUE(throttle.allow(1000, suppressed));
  EXPECT_EQ(suppressed, 2U);
  EXPECT_TRUE(throttle.allow(1001, suppressed));
  EXPECT_EQ(suppressed, 0U);
}

TEST(Clock, OnlyGoesForward) {
  const std::int64_t before = monotonic_ns();
  std::this_thread::sleep_for(2ms);
  const std::int64_t passed = monotonic_ns() - before;
  EXPECT_GE(passed, 2'000'000);
  EXPECT_LT(passed, 2'000'000'000);
}

// In a process of their own: signals are blocked and memory is locked for good.
using SystemDeathTest = testing::Test;

TEST(SystemDeathTest, SignalsArriveOneByOne) {
  EXPECT_EXIT(
      {
        Result<SignalWaiter> signals = SignalWaiter::make();
        const bool quiet = signals.value().wait(1ms) == Signal::none;
        std::raise(SIGHUP);
        const bool reloads = signals.value().wait(1000ms) == Signal::reload;
        std::raise(SIGTERM);
        const bool stops = signals.value().wait(1000ms) == Signal::stop;
        std::raise(SIGPIPE);
        std::_Exit(quiet && reloads && stops ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(SystemDeathTest, LocksMemoryOrSaysWhichLimitToRaise) {
  EXPECT_EXIT(
      {
        const Status status = lock_memory();
        const bool clear = status.code() == StatusCode::memory_limit &&
                           status.message().find("LimitMEMLOCK") != std::string_view::npos;
        std::_Exit(status.ok() || clear ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

/// What the kernel keeps of the calling thread's scheduling, as words of 32 bits.
[[nodiscard]] std::array<std::uint32_t, 12> scheduling() {
  std::array<std::uint32_t, 12> words{};
  EXPECT_EQ(syscall(SYS_sched_getattr, 0, words.data(), sizeof(words), 0), 0);
  return words;
}

TEST(PromptThread, AsksForShortSlicesAndForNothingElse) {
  constexpr std::size_t policy = 1;
  constexpr std::size_t niceness = 4;
  constexpr std::size_t slice_ns = 6;
  std::array<std::uint32_t, 12> before{};
  std::array<std::uint32_t, 12> after{};
  std::thread([&] {
    ASSERT_EQ(setpriority(PRIO_PROCESS, 0, 3), 0);
    before = scheduling();
    make_thread_prompt();
    after = scheduling();
  }).join();
  if (before[slice_ns] == 0) GTEST_SKIP() << "before Linux 6.12 slices are the kernel's own affair";
  EXPECT_NE(before[slice_ns], 100'000U);
  EXPECT_EQ(after[slice_ns], 100'000U);
  EXPECT_EQ(after[policy], before[policy]);
  EXPECT_EQ(after[niceness], 3U);
}

TEST(PromptThread, LeavesARealTimePolicyAlone) {
  std::thread([] {
    sched_param parameters{};
    parameters.sched_priority = 5;
    if (sched_setscheduler(0, SCHED_RR, &parameters) != 0) GTEST_SKIP() << "a real-time policy is not allowed here";
    make_thread_prompt();
    EXPECT_EQ(sched_getscheduler(0), SCHED_RR);
  }).join();
}

}  // namespace
}  // namespace graspd
