#include <gtest/gtest.h>
#include <malloc.h>

#include <Eigen/Core>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "tests/allocations/allocation_guard.hpp"

namespace graspd::testing {
namespace {

// Keeps the compiler from taking a pair of malloc and free away.
template <class T>
void keep(T* pointer) {
  asm volatile("" : : "g"(pointer) : "memory");
}

std::size_t allocations_in(const std::function<void()>& work) {
  AllocationGuard guard;
  work();
  return guard.stop();
}

TEST(AllocationGuard, CountsNothingWhereNothingIsAllocated) {
  std::vector<int> numbers(100, 1);
  EXPECT_EQ(allocations_in([&] {
              for (int& number : numbers) number *= 3;
              Eigen::Matrix4f matrix = Eigen::Matrix4f::Constant(static_cast<float>(numbers[3]));
              keep(&matrix);
            }),
            0U);
}

TEST(AllocationGuard, CountsTheMallocFamily) {
  const auto counted = [](auto allocate) {
    return allocations_in([&] {
      void* block = allocate();
      keep(block);
      std::free(block);
    });
  };
  EXPECT_EQ(counted([] { return std::malloc(10); }), 1U);
  EXPECT_EQ(counted([] { return std::calloc(10, 3); }), 1U);
  EXPECT_EQ(counted([] { return std::realloc(nullptr, 10); }), 1U);
  EXPECT_EQ(counted([] { return reallocarray(nullptr, 10, 3); }), 1U);
  EXPECT_EQ(counted([] { return std::aligned_alloc(64, 128); }), 1U);
  EXPECT_EQ(counted([] { return memalign(64, 128); }), 1U);
  EXPECT_EQ(counted([] { return valloc(128); }), 1U);
  EXPECT_EQ(counted([] { return pvalloc(128); }), 1U);
  EXPECT_EQ(counted([] {
              void* block = nullptr;
              return posix_memalign(&block, 64, 128) == 0 ? block : nullptr;
            }),
            1U);
  EXPECT_EQ(counted([] { return static_cast<void*>(strdup("a string of its own")); }), 1U);
}

TEST(AllocationGuard, CountsOperatorNew) {
  struct alignas(64) Wide {
    char bytes[64];
  };
  EXPECT_EQ(allocations_in([] { keep(std::make_unique<int>(3).get()); }), 1U);
  EXPECT_EQ(allocations_in([] { keep(std::make_unique<int[]>(30).get()); }), 1U);
  EXPECT_EQ(allocations_in([] { keep(std::make_unique<Wide>().get()); }), 1U);
  EXPECT_EQ(allocations_in([] {
              int* number = new (std::nothrow) int(3);
              keep(number);
              delete number;
            }),
            1U);
}

TEST(AllocationGuard, TellsNewFromTheMallocFamilyAndItsThreadFromOthers) {
  AllocationGuard guard;
  for (int i = 0; i < 3; ++i) {
    void* block = std::malloc(10);
    keep(block);
    std::free(block);
  }
  keep(std::make_unique<int>(3).get());
  struct alignas(64) Wide {
    char bytes[64];
  };
  keep(std::make_unique<Wide[]>(2).get());
  EXPECT_EQ(guard.stop(), 5U);
  EXPECT_EQ(guard.by_new(), 2U);
  EXPECT_EQ(guard.on_this_thread(), 5U);
  std::thread([&guard] { EXPECT_EQ(guard.on_this_thread(), 0U); }).join();
}

TEST(AllocationGuard, CountsWhatLibrariesAllocate) {
  EXPECT_EQ(allocations_in([] {
              const Eigen::MatrixXf matrix = Eigen::MatrixXf::Ones(20, 20);
              keep(matrix.data());
            }),
            1U);
  EXPECT_GE(allocations_in([] { keep(std::string(100, 'x').data()); }), 1U);
}

TEST(AllocationGuard, CountsEveryThread) {
  EXPECT_GE(allocations_in([] { std::thread([] { keep(std::make_unique<int>(3).get()); }).join(); }), 2U)
      << "the thread's own state and what it allocates";
}

int threads_of_a_region(bool allocate) {
  int threads = 0;
#pragma omp parallel num_threads(2) reduction(+ : threads)
  {
    ++threads;
    if (allocate) keep(std::make_unique<int>(3).get());
  }
  return threads;
}

TEST(AllocationGuard, CountsTheThreadsOfOpenMP) {
  ASSERT_EQ(threads_of_a_region(false), 2);
  EXPECT_EQ(allocations_in([] { threads_of_a_region(true); }), 2U);
  EXPECT_EQ(allocations_in([] { threads_of_a_region(false); }), 0U) << "a second region reuses its threads";
}

}  // namespace

// Outside the unnamed namespace, so that the program exports its name.
[[gnu::noinline]] void allocate_where_the_report_can_name_it() { keep(std::make_unique<int>(3).get()); }

namespace {

TEST(AllocationGuard, ReportNamesTheCaller) {
  AllocationGuard guard;
  allocate_where_the_report_can_name_it();
  EXPECT_EQ(guard.stop(), 1U);
  EXPECT_NE(guard.report().find("allocate_where_the_report_can_name_it"), std::string::npos) << guard.report();
}

}  // namespace
}  // namespace graspd::testing
