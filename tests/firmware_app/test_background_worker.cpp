#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware_app/background_worker.hpp"

namespace graspd {
namespace {

constexpr std::chrono::seconds patience(10);

TEST(BackgroundWorker, DoesOneJobAtATime) {
  std::promise<void> started;
  std::promise<void> may_end;
  std::promise<void> ended;
  int worked_on = 0;
  int prepared = 0;
  BackgroundWorker worker(
      [&]() -> Status {
        started.set_value();
        may_end.get_future().wait();
        worked_on = prepared;
        return {};
      },
      [&](const Status& status) {
        EXPECT_TRUE(status.ok());
        ended.set_value();
      });
  EXPECT_TRUE(worker.offer([&] { prepared = 7; }));
  ASSERT_EQ(started.get_future().wait_for(patience), std::future_status::ready);
  EXPECT_FALSE(worker.offer([&] { prepared = 8; })) << "the first is not done";
  may_end.set_value();
  ASSERT_EQ(ended.get_future().wait_for(patience), std::future_status::ready);
  EXPECT_EQ(worked_on, 7);
}

TEST(BackgroundWorker, TakesTheNextOnceItHasToldOfTheLast) {
  constexpr int jobs = 200;
  int done = 0;
  std::vector<std::promise<void>> told(jobs);
  int number = 0;
  BackgroundWorker worker(
      [&]() -> Status {
        ++done;
        return {};
      },
      [&](const Status&) { told[static_cast<std::size_t>(done - 1)].set_value(); });
  for (int i = 0; i < jobs; ++i) {
    ASSERT_TRUE(worker.offer([&] { number = i; })) << i;
    ASSERT_EQ(told[static_cast<std::size_t>(i)].get_future().wait_for(patience), std::future_status::ready) << i;
  }
  EXPECT_EQ(done, jobs);
  EXPECT_EQ(number, jobs - 1);
}

TEST(BackgroundWorker, FinishesWhatItTookBeforeItEnds) {
  int done = 0;
  {
    BackgroundWorker worker(
        [&]() -> Status {
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          ++done;
          return {};
        },
        [](const Status&) {});
    EXPECT_TRUE(worker.offer([] {}));
  }
  EXPECT_EQ(done, 1);
}

TEST(BackgroundWorker, TellsOfFailuresAndExceptions) {
  std::string message;
  {
    BackgroundWorker worker([]() -> Status { throw std::runtime_error("the disk is full"); },
                            [&](const Status& status) { message = status.message(); });
    EXPECT_TRUE(worker.offer([] {}));
  }
  EXPECT_EQ(message, "the disk is full");
  StatusCode code = StatusCode::ok;
  {
    BackgroundWorker worker([] { return Status(StatusCode::bad_file, "no"); },
                            [&](const Status& status) { code = status.code(); });
    EXPECT_TRUE(worker.offer([] {}));
  }
  EXPECT_EQ(code, StatusCode::bad_file);
}

}  // namespace
}  // namespace graspd
