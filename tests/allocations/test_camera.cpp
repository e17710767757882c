#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "tests/allocations/allocation_guard.hpp"
#include "tests/drivers/camera/camera_on_the_wire.hpp"

namespace graspd {
namespace {

/// A simulated camera in a process of its own, so that what it allocates is not counted here.
class CameraProcess {
 public:
  CameraProcess() {
    std::array<int, 2> said{};
    std::array<int, 2> life{};
    if (pipe(said.data()) != 0 || pipe(life.data()) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      close(life[1]);
      const auto camera = SimulatedCamera::start({}, numbered_frames(4));
      char word = camera.ok() ? 'y' : 'n';
      if (write(said[1], &word, 1) == 1) static_cast<void>(!read(life[0], &word, 1));
      _exit(0);
    }
    close(said[1]);
    close(life[0]);
    life_ = life[1];
    char word = 'n';
    started_ = read(said[0], &word, 1) == 1 && word == 'y';
    close(said[0]);
  }
  ~CameraProcess() {
    if (life_ >= 0) close(life_);
    if (pid_ > 0) waitpid(pid_, nullptr, 0);
  }
  CameraProcess(const CameraProcess&) = delete;
  CameraProcess& operator=(const CameraProcess&) = delete;

  [[nodiscard]] bool started() const { return started_; }

 private:
  pid_t pid_ = -1;
  int life_ = -1;
  bool started_ = false;
};

std::size_t median(std::span<std::size_t> counts) {
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

TEST(CameraAllocations, OursAreNoneAndThoseOfAravisAsManyForEveryFrame) {
  enter_private_network();
  const CameraProcess camera;
  ASSERT_TRUE(camera.started());
  GenicamOptions options;
  options.device = "127.0.0.1";
  options.limits = {128, 96};
  options.timeout_ns = 10'000'000'000;
  GenicamSource source(options, LoadedFrame{});
  ASSERT_TRUE(source.wait_connected(30'000'000'000));
  std::vector<float> storage(128 * 96);
  DepthFrame frame;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(source.grab(storage, frame).ok());

  std::array<std::size_t, 100> counts{};
  for (std::size_t& count : counts) {
    testing::AllocationGuard guard;
    const Status grabbed = source.grab(storage, frame);
    count = guard.stop();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    EXPECT_EQ(guard.on_this_thread(), 0U) << guard.report();
    EXPECT_EQ(guard.by_new(), 0U) << "graspd's own\n" << guard.report();
  }
  // Its heartbeat, and packets that it asks for again, come on top now and then.
  const std::size_t early = median(std::span(counts).first(counts.size() / 2));
  const std::size_t late = median(std::span(counts).last(counts.size() / 2));
  std::printf("Aravis allocates %zu times a frame, at most %zu times\n", late, *std::ranges::max_element(counts));
  EXPECT_EQ(early, late);
  EXPECT_GT(std::ranges::count(counts, late), std::ssize(counts) / 2);
}

}  // namespace
}  // namespace graspd
