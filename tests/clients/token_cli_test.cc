// clearway token, and a server that takes the tokens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "clients/run_clearway.h"
#include "clients/server_process.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing::HasSubstr;

class TokenCli : public testing::Test {
 protected:
  Finished Token(std::vector<std::string> words) const {
    words.insert(words.begin(), "token");
    words.push_back("--tokens");
    words.push_back(tokens_);
    return RunClearway(words);
  }
  // Adds a client and returns the file of its token.
  std::string Add(const std::string& name, const std::string& role) const {
    const Finished added = Token({"add", name, "--role", role});
    EXPECT_EQ(added.exit_code, 0) << added.err;
    const std::string file = folder_.Write(name, added.out).string();
    chmod(file.c_str(), 0600);
    return file;
  }

  const TemporaryFolder folder_;
  const std::string tokens_ = (folder_ / "tokens.txt").string();
};

TEST_F(TokenCli, AddsListsAndRevokes) {
  const std::string slam = BytesOf(Add("slam", "push"));
  Add("ops", "admin");
  EXPECT_EQ(Token({"list"}).out, "slam push token\nops admin token\n");
  EXPECT_THAT(BytesOf(tokens_), testing::Not(HasSubstr(slam.substr(0, slam.size() - 1))));
  const Finished again = Token({"add", "slam", "--role", "read"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("is there twice"));
  EXPECT_EQ(Token({"revoke", "slam"}).exit_code, 0);
  EXPECT_EQ(Token({"list"}).out, "ops admin token\n");
  EXPECT_THAT(Token({"revoke", "slam"}).err, HasSubstr("there is no \"slam\""));
  EXPECT_THAT(Token({"add", "x", "--role", "root"}).err, HasSubstr("read, push or admin"));
}

TEST_F(TokenCli, TheServerTakesThem) {
  const std::string reader = Add("planner", "read"), admin = Add("ops", "admin");
  const ServerProcess server({"--tokens", tokens_});
  ASSERT_FALSE(server.address().empty());
  const auto run = [&](const std::string& command, const std::string& token_file) {
    std::vector<std::string> words{command, "--server"};
    words.push_back(server.address());
    if (!token_file.empty()) words.push_back("--token-file");
    if (!token_file.empty()) words.push_back(token_file);
    return RunClearway(words);
  };
  EXPECT_EQ(run("status", reader).exit_code, 0);
  EXPECT_EQ(run("reset", admin).exit_code, 0);
  const Finished refused = run("reset", reader);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("Reset needs the role admin; planner has read"));
  const Finished nobody = run("status", "");
  EXPECT_EQ(nobody.exit_code, 1);
  EXPECT_THAT(nobody.err, HasSubstr("'clearway token add' makes one"));
}

}  // namespace
}  // namespace clearway
