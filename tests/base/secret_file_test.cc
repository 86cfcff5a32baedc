#include "clearway/base/secret_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing::HasSubstr;

mode_t ModeOf(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST(SecretFile, WhatOthersCanReadOrWriteIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder.Write("key", "secret");
  for (const mode_t mode : {0400, 0600, 0640, 0440}) {
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    const auto dut = ReadSecretFile(path, 100);
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_EQ(*dut, "secret");
  }
  for (const mode_t mode : {0644, 0604, 0660, 0602, 0601, 0777}) {
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    const absl::Status status = ReadSecretFile(path, 100).status();
    EXPECT_TRUE(absl::IsFailedPrecondition(status)) << std::oct << mode << " " << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr("chmod 6"));
    EXPECT_THAT(std::string(status.message()), HasSubstr(path.string()));
  }
}

TEST(SecretFile, OtherErrorsAreThoseOfFiles) {
  const TemporaryFolder folder;
  EXPECT_TRUE(absl::IsNotFound(ReadSecretFile(folder / "none", 100).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(ReadSecretFile(folder.path(), 100).status()));
  ASSERT_TRUE(WriteSecretFile(folder / "long", "12345").ok());
  EXPECT_TRUE(absl::IsResourceExhausted(ReadSecretFile(folder / "long", 4).status()));
}

TEST(SecretFile, ANewOneIsItsOwnersAndAnOldOneKeepsItsMode) {
  const TemporaryFolder folder;
  const auto path = folder / "tokens";
  ASSERT_TRUE(WriteSecretFile(path, "one").ok());
  EXPECT_EQ(ModeOf(path), 0600u);
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  ASSERT_TRUE(WriteSecretFile(path, "two").ok());
  EXPECT_EQ(ModeOf(path), 0640u);
  EXPECT_EQ(BytesOf(path), "two");
  ASSERT_EQ(chmod(path.c_str(), 0666), 0);
  ASSERT_TRUE(WriteSecretFile(path, "three").ok());
  EXPECT_EQ(ModeOf(path), 0640u) << "no more than is read again";
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
  EXPECT_FALSE(WriteSecretFile(folder / "no" / "folder", "x").ok());
}

}  // namespace
}  // namespace clearway
