// Who may do what on the program itself.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/secret_file.h"
#include "clearway/client/error_details.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/wire/token_table.h"
#include "server/access_matrix.h"
#include "server/process.h"
#include "support/eventually.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing_support::AllMethods;
using testing_support::CodeOf;
using testing_support::Eventually;
using testing_support::IsCodeFor;
using testing_support::Process;
using testing_support::TokenHolder;

const std::string kWrongToken = "Bearer wrong";

class Access : public testing::Test {
 protected:
  void WriteTokens(const std::vector<const TokenHolder*>& clients) const {
    std::string text;
    for (const TokenHolder* client : clients) absl::StrAppend(&text, client->made.line, "\n");
    ASSERT_TRUE(WriteSecretFile(tokens_, text).ok());
  }
  void Start(std::vector<std::string> more = {}) {
    std::vector<std::string> flags{"--listen", "127.0.0.1:0", "--tokens", tokens_};
    flags.insert(flags.end(), more.begin(), more.end());
    dut_ = std::make_unique<Process>(flags);
    address_ = dut_->Address();
    ASSERT_FALSE(address_.empty()) << dut_->RestOfOutput();
  }
  absl::StatusOr<std::shared_ptr<Connection>> Connect(const TokenHolder& client) const {
    const std::string file = (folder_ / "token").string();
    EXPECT_TRUE(WriteSecretFile(file, client.made.token + "\n").ok());
    ConnectionOptions options;
    options.token_file = file;
    return Connection::Open(address_, options);
  }

  const TemporaryFolder folder_;
  const std::string tokens_ = (folder_ / "tokens").string();
  const TokenHolder reader_{"reader", Role::kRead}, pusher_{"pusher", Role::kPush},
      admin_{"admin", Role::kAdmin}, revoked_{"revoked", Role::kAdmin};
  std::unique_ptr<Process> dut_;
  std::string address_;
};

TEST_F(Access, EachMethodByRoleAndToken) {
  WriteTokens({&reader_, &pusher_, &admin_});
  Start();
  const auto channel = grpc::CreateChannel(address_, grpc::InsecureChannelCredentials());
  for (const auto* method : AllMethods()) {
    for (const std::string& authorization :
         {std::string(), kWrongToken, revoked_.authorization()}) {
      EXPECT_EQ(CodeOf(*channel, *method, authorization), grpc::StatusCode::UNAUTHENTICATED)
          << method->full_name() << " " << authorization;
    }
    for (const TokenHolder* holder : {&reader_, &pusher_, &admin_}) {
      const auto code = CodeOf(*channel, *method, holder->authorization());
      EXPECT_TRUE(IsCodeFor(holder->role, *method, code))
          << method->full_name() << " " << ToText(holder->role) << " " << code;
    }
  }
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  const std::string log = dut_->RestOfOutput();
  EXPECT_THAT(log, HasSubstr("audit: Reset by admin (ipv4:127.0.0.1:"));
  EXPECT_THAT(log, HasSubstr("Reset needs the role admin; pusher has push"));
  EXPECT_THAT(log, testing::Not(HasSubstr(admin_.made.token)));
}

TEST_F(Access, ARevokedTokenEndsItsStreamsAndNoOthers) {
  WriteTokens({&reader_, &revoked_});
  Start();
  const auto kept = Connect(reader_), lost = Connect(revoked_);
  ASSERT_TRUE(kept.ok() && lost.ok()) << kept.status() << lost.status();
  const auto kept_mirror = SceneMirror::Follow(*kept), lost_mirror = SceneMirror::Follow(*lost);
  ASSERT_TRUE(kept_mirror.ok() && lost_mirror.ok());
  WriteTokens({&reader_});
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Eventually([&] { return !(*lost_mirror)->state().connected; }));
  EXPECT_TRUE(absl::IsUnauthenticated(SceneClient(*lost).GetStatus().status()));
  EXPECT_TRUE(SceneClient(*kept).GetStatus().ok());
  EXPECT_TRUE((*kept_mirror)->state().connected);
  EXPECT_EQ((*kept_mirror)->state().reconnects, 0u);
  const absl::Status again = Connect(revoked_).status();
  EXPECT_TRUE(absl::IsUnauthenticated(again)) << again;
  EXPECT_EQ(DetailsOf(again).reason, "WRONG_TOKEN");
}

TEST_F(Access, AFileThatCannotBeReadAgainChangesNothing) {
  WriteTokens({&reader_});
  Start();
  folder_.Write("tokens", "nonsense\n");
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Connect(reader_).ok());
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  EXPECT_THAT(dut_->RestOfOutput(), HasSubstr("nothing has changed: tokens: "));
}

TEST_F(Access, TokensThatOthersCanReadAreRefused) {
  WriteTokens({&reader_});
  ASSERT_EQ(chmod(tokens_.c_str(), 0644), 0);
  Process dut({"--listen", "127.0.0.1:0", "--tokens", tokens_});
  EXPECT_EQ(dut.Address(), "");
  EXPECT_EQ(dut.Wait(), 1);
  Process none({"--listen", "127.0.0.1:0", "--tokens", "/nowhere"});
  EXPECT_THAT(none.RestOfOutput(), HasSubstr("tokens: /nowhere: no such file"));
}

TEST_F(Access, TokensGoOutInPlainTextToThisMachineOnly) {
  const std::string file = (folder_ / "token").string();
  ASSERT_TRUE(WriteSecretFile(file, reader_.made.token).ok());
  ConnectionOptions options;
  options.token_file = file;
  options.deadline = options.retry_for = std::chrono::milliseconds(200);
  const absl::Status status = Connection::Open("192.0.2.1:50151", options).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("could read the token"));
  options.insecure = true;
  EXPECT_FALSE(absl::IsInvalidArgument(Connection::Open("192.0.2.1:50151", options).status()));
}

TEST_F(Access, PlainListeningElsewhereIsAskedForByName) {
  Process refused({"--listen", "0.0.0.0:0"});
  EXPECT_THAT(refused.RestOfOutput(), HasSubstr("or insecure if the network itself is safe"));
  EXPECT_EQ(refused.Wait(), 2);
  Process dut({"--listen", "0.0.0.0:0", "--insecure", "true"});
  EXPECT_NE(dut.Address(), "");
}

TEST_F(Access, ASocketsModeIsItsOwnersUnlessGiven) {
  const std::string path = (folder_ / "socket").string();
  const auto mode = [&] {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
  };
  {
    Process dut({"--listen", "unix:" + path});
    ASSERT_NE(dut.Address(), "");
    EXPECT_EQ(mode(), 0600u);
  }
  Process dut({"--listen", "unix:" + path, "--socket-mode", "0660"});
  ASSERT_NE(dut.Address(), "");
  EXPECT_EQ(mode(), 0660u);
  Process wrong({"--socket-mode", "rw"});
  EXPECT_THAT(wrong.RestOfOutput(), HasSubstr("socket_mode: \"rw\" is not three octal digits"));
}

}  // namespace
}  // namespace clearway
