#include "server/memory_file.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

TEST(MemoryFileTest, IsReadByItsPath) {
  MemoryFile dut;
  ASSERT_TRUE(dut.Replace("first").ok());
  const std::string path = dut.path();
  EXPECT_EQ(BytesOf(path), "first");
  EXPECT_EQ(BytesOf(path), "first") << "from its beginning each time";
  const std::string large(3'000'000, 'x');
  ASSERT_TRUE(dut.Replace(large).ok());
  EXPECT_EQ(dut.path(), path);
  EXPECT_EQ(BytesOf(path), large);
  ASSERT_TRUE(dut.Replace("").ok());
  EXPECT_EQ(BytesOf(path), "");
}

}  // namespace
}  // namespace clearway
