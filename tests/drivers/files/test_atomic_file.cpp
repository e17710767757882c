#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/resident_file.hpp"
#include "drivers/files/whole_file.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, ReplacesTheWholeFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out.csv";
  ASSERT_TRUE(write_file(path, std::string_view("a long first content")).ok());
  ASSERT_TRUE(write_file(path, std::string_view("short")).ok());
  EXPECT_EQ(read_file(path).value(), "short");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(AtomicFile, FailureNamesPathAndReasonAndKeepsTheOldFile) {
  const TemporaryFolder folder;
  const Status missing = write_file(folder.path() / "no" / "out.csv", std::string_view("x"));
  EXPECT_EQ(missing.code(), StatusCode::cannot_write);
  EXPECT_THAT(std::string(missing.message()), HasSubstr("no/out.csv: No such file or directory: create the folder"));

  fs::create_directory(folder.path() / "taken");
  const Status is_folder = write_file(folder.path() / "taken", std::string_view("x"));
  EXPECT_EQ(is_folder.code(), StatusCode::cannot_write);
  EXPECT_THAT(std::string(is_folder.message()), HasSubstr("Is a directory"));

  const Status below_file = write_file(folder.write("file", "content") / "out", std::string_view("x"));
  EXPECT_EQ(below_file.code(), StatusCode::cannot_write);
  EXPECT_EQ(read_file(folder.path() / "file").value(), "content");
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(AtomicFile, DeviceIsWrittenToAndNotReplaced) {
  ASSERT_TRUE(write_file("/dev/null", std::string_view("x")).ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, FullDiskIsReported) {
  // Without this device there is no full disk to be had without the rights to make one.
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "the system has no /dev/full";
  const Status status = write_file("/dev/full", std::string_view("x"));
  EXPECT_EQ(status.code(), StatusCode::cannot_write);
  EXPECT_THAT(std::string(status.message()), HasSubstr("No space left"));
}

TEST(AtomicFile, LinkKeepsStanding) {
  const TemporaryFolder folder;
  const fs::path target = folder.write("deep/target", "old");
  fs::create_symlink(target, folder.path() / "link");
  ASSERT_TRUE(write_file(folder.path() / "link", std::string_view("new")).ok());
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(read_file(target).value(), "new");

  fs::create_symlink("deep/to_come", folder.path() / "early");
  ASSERT_TRUE(write_file(folder.path() / "early", std::string_view("there")).ok());
  EXPECT_TRUE(fs::is_symlink(folder.path() / "early"));
  EXPECT_EQ(read_file(folder.path() / "deep" / "to_come").value(), "there");
}

TEST(AtomicFile, FolderMayStillHaveToBeMade) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_folder(folder.path()).ok());
  EXPECT_TRUE(check_folder(folder.path() / "to" / "come").ok());
  EXPECT_EQ(files_in(folder.path()), 0U);
  const fs::path file = folder.write("file", "content");
  EXPECT_EQ(check_folder(file).code(), StatusCode::cannot_write);
  EXPECT_THAT(std::string(check_folder(file / "below").message()), HasSubstr("Not a directory"));
}

TEST(AtomicFile, WritableIsKnownBeforeTheWork) {
  const TemporaryFolder folder;
  EXPECT_TRUE(check_writable(folder.path() / "out").ok());
  EXPECT_EQ(files_in(folder.path()), 0U);
  EXPECT_EQ(check_writable(folder.path() / "no" / "out").code(), StatusCode::cannot_write);
  EXPECT_EQ(check_writable(folder.path()).code(), StatusCode::cannot_write);
  if (::geteuid() != 0) {
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(check_writable(folder.path() / "out").code(), StatusCode::cannot_write);
    fs::permissions(folder.path(), fs::perms::owner_all);
  }
}

TEST(AtomicFile, WritableAsksForTheFolderInWhichFilesAreReplaced) {
  const TemporaryFolder folder;
  fs::create_symlink(folder.path() / "no" / "out", folder.path() / "link");
  EXPECT_EQ(check_writable(folder.path() / "link").code(), StatusCode::cannot_write);
  EXPECT_TRUE(check_writable("/dev/null").ok());

  const fs::path file = folder.write("kept/out", "old");
  fs::permissions(folder.path(), fs::perms(0755));
  fs::permissions(file.parent_path(), fs::perms(0555));
  fs::permissions(file, fs::perms(0666));
  const auto refused = [&] {
    // Nothing is forbidden to root.
    if (::geteuid() == 0 && ::setuid(65534) != 0) std::_Exit(2);
    std::_Exit(check_writable(file).code() == StatusCode::cannot_write ? 0 : 1);
  };
  EXPECT_EXIT(refused(), testing::ExitedWithCode(0), "");
  fs::permissions(file.parent_path(), fs::perms::owner_all);
}

TEST(WholeFile, MissingFileAndFolderAreRefused) {
  const TemporaryFolder folder;
  const Result<std::string> missing = read_file(folder.path() / "none.toml", StatusCode::bad_configuration);
  EXPECT_EQ(missing.status().code(), StatusCode::bad_configuration);
  EXPECT_THAT(std::string(missing.status().message()), HasSubstr("none.toml: No such file"));
  EXPECT_EQ(read_file(folder.path()).status().code(), StatusCode::bad_file);
}

TEST(WholeFile, WhatHasNoEndIsRefused) {
  EXPECT_THAT(std::string(read_file("/dev/zero").status().message()), HasSubstr("/dev/zero: it is not a file"));
  const TemporaryFolder folder;
  const fs::path file = folder.write("huge", "");
  // A file with a hole takes no room on the disk.
  fs::resize_file(file, (std::uintmax_t{2} << 30U) + 1);
  EXPECT_THAT(std::string(read_file(file).status().message()), HasSubstr("huge: it holds more than 2 GiB"));
}

TEST(WholeFile, APipeIsReadToItsEnd) {
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string sent(10'000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << sent; });
  EXPECT_EQ(read_file(pipe).value(), sent);
  writer.join();
}

TEST(ResidentFile, HoldsTheBytesUntilItGoes) {
  const TemporaryFolder folder;
  Result<ResidentFile> opened = ResidentFile::open(folder.write("bank", "0123456789"));
  ASSERT_TRUE(opened.ok());
  ResidentFile moved = std::move(opened).value();
  ASSERT_EQ(moved.bytes().size(), 10U);
  EXPECT_EQ(moved.bytes()[9], std::byte{'9'});
}

TEST(ResidentFile, StaysAsItIsWhateverBecomesOfTheFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("bank", "0123456789");
  const Result<ResidentFile> opened = ResidentFile::open(path);
  ASSERT_TRUE(opened.ok());
  std::ofstream(path, std::ios::in | std::ios::out) << "new";
  EXPECT_EQ(opened.value().bytes()[0], std::byte{'0'});
  fs::resize_file(path, 0);
  EXPECT_EQ(opened.value().bytes()[9], std::byte{'9'});
}

TEST(ResidentFile, MissingEmptyAndFolderAreRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(ResidentFile::open(folder.path() / "none").status().code(), StatusCode::bad_bank);
  EXPECT_EQ(ResidentFile::open(folder.path()).status().code(), StatusCode::bad_bank);
  EXPECT_THAT(std::string(ResidentFile::open(folder.write("void", "")).status().message()), HasSubstr("empty"));
}

}  // namespace
}  // namespace graspd
