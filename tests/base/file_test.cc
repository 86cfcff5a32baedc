#include "clearway/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kLimit = 1000;

// Each way to read must refuse alike.
void ExpectRefused(const std::filesystem::path& path, absl::StatusCode code,
                   const std::string& what) {
  for (const absl::Status& status :
       {ReadWholeFile(path, kLimit).status(), ReadFileStart(path, 16).status()}) {
    EXPECT_EQ(status.code(), code) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(path.string() + ": " + what));
  }
}

TEST(File, Empty) {
  const TemporaryFolder folder;
  const auto dut = ReadWholeFile(folder.Write("a", ""), kLimit);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, "");
}

TEST(File, ReadsAllBytesOrTheFirstOnes) {
  const TemporaryFolder folder;
  std::string bytes("a\0b\n", 4);
  bytes.resize(1000, 'x');
  const auto path = folder.Write("a", bytes);
  EXPECT_EQ(*ReadWholeFile(path, kLimit), bytes);
  EXPECT_EQ(*ReadFileStart(path, 3), bytes.substr(0, 3));
  EXPECT_EQ(*ReadFileStart(path, 5000), bytes);
}

TEST(File, RefusesMoreThanTheLimit) {
  const TemporaryFolder folder;
  const auto path = folder.Write("a", std::string(1001, 'x'));
  const absl::Status status = ReadWholeFile(path, kLimit).status();
  EXPECT_TRUE(absl::IsResourceExhausted(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("1001 bytes; the limit is 1000 bytes"));
}

TEST(File, ReadsAFileThatClaimsToBeEmpty) {
  const char* const path = "/proc/self/status";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no /proc here";
  const auto dut = ReadWholeFile(path, 100'000);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(*dut, HasSubstr("Name:"));
  EXPECT_TRUE(absl::IsResourceExhausted(ReadWholeFile(path, 10).status()));
}

TEST(File, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  ExpectRefused(folder.path(), absl::StatusCode::kInvalidArgument, "is a folder");
  ExpectRefused(folder / "none", absl::StatusCode::kNotFound, "no such file");
  ExpectRefused(folder.Write("a", "") / "b", absl::StatusCode::kNotFound, "no such file");
  ExpectRefused("/dev/zero", absl::StatusCode::kInvalidArgument, "is a device, not a file");
  ExpectRefused("", absl::StatusCode::kNotFound, "no such file");
}

TEST(File, DoesNotWaitForAPipe) {
  const TemporaryFolder folder;
  const auto path = folder / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  ExpectRefused(path, absl::StatusCode::kInvalidArgument, "is a pipe, not a file");
}

TEST(File, RefusesASocket) {
  const TemporaryFolder folder;
  const auto path = folder / "s";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ExpectRefused(path, absl::StatusCode::kInvalidArgument, "is not a file");
  close(fd);
}

TEST(File, SaysThatAFileMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryFolder folder;
  const auto path = folder.Write("a", "x");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  ExpectRefused(path, absl::StatusCode::kPermissionDenied, "permission denied");
}

TEST(File, FollowsLinksAndNamesLoops) {
  const TemporaryFolder folder;
  folder.Write("a", "x");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  EXPECT_EQ(*ReadWholeFile(folder / "link", kLimit), "x");
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  ExpectRefused(folder / "loop", absl::StatusCode::kUnavailable, "Too many levels");
}

TEST(File, TextLosesItsByteOrderMark) {
  const TemporaryFolder folder;
  EXPECT_EQ(*ReadTextFile(folder.Write("a",
                                       "\xEF\xBB\xBF"
                                       "x"),
                          kLimit),
            "x");
  EXPECT_EQ(*ReadTextFile(folder.Write("b", "x\xEF\xBB\xBF"), kLimit), "x\xEF\xBB\xBF");
  EXPECT_EQ(*ReadTextFile(folder.Write("c", ""), kLimit), "");
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"}) {
    const absl::Status status = ReadTextFile(folder.Write("d", mark + "x"), kLimit).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status));
    EXPECT_THAT(std::string(status.message()), HasSubstr("in UTF-16; save it as UTF-8"));
  }
}

TEST(File, WritesWholeFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteWholeFile(folder / "a", "new").ok());
  EXPECT_EQ(*ReadWholeFile(folder / "a", kLimit), "new");
  EXPECT_TRUE(absl::IsUnavailable(WriteWholeFile(folder / "none/a", "new")));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.partial"));
}

TEST(File, ReplacesFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder / "b.partial").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder / "pipe", folder / "to_pipe");
  std::filesystem::create_symlink(folder / "none", folder / "nowhere");
  const struct {
    const char* name;
    const char* why;
  } cases[] = {{"", ": is a folder"},
               {"pipe", "pipe: is a pipe, not a file"},
               {"to_pipe", "pipe: is a pipe, not a file"},
               {"nowhere", "nowhere: is a symbolic link, not a file"},
               {"b", "b.partial: is a pipe, not a file"}};
  for (const auto& [name, why] : cases) {
    const absl::Status status = WriteWholeFile(folder / name, "new");
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << name << ": " << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(why));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "nowhere"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST(File, WritesThroughALink) {
  const TemporaryFolder folder;
  folder.Write("far/a", "old");
  std::filesystem::create_symlink(folder / "far/a", folder / "link");
  ASSERT_TRUE(WriteWholeFile(folder / "link", "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(*ReadWholeFile(folder / "far/a", kLimit), "new");
}

TEST(File, MovesNothingOntoAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto partial = folder.Write("a.partial", "new");
  EXPECT_TRUE(absl::IsInvalidArgument(MoveInto(partial, folder / "pipe")));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_FALSE(std::filesystem::exists(partial));
}

}  // namespace
}  // namespace clearway
