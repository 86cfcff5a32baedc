// Signals to the program.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <thread>

#include "clearway/client/connection.h"
#include "clearway/client/scene_client.h"
#include "clearway/v1/map_service.grpc.pb.h"
#include "server/process.h"
#include "support/eventually.h"

namespace clearway {
namespace {

using testing_support::Eventually;
using testing_support::Process;

class Signalled : public testing::Test {
 protected:
  void Start(const std::string& drain_s) {
    dut_ = std::make_unique<Process>(
        std::vector<std::string>{"--listen", "127.0.0.1:0", "--drain-s", drain_s});
    address_ = dut_->Address();
    auto connection = Connection::Open(address_);
    ASSERT_TRUE(connection.ok()) << connection.status();
    connection_ = *std::move(connection);
  }
  bool Answers() const { return SceneClient(connection_).GetStatus().ok(); }
  bool Draining() const {
    const auto status = SceneClient(connection_).GetStatus();
    return status.ok() && status->draining;
  }

  std::unique_ptr<Process> dut_;
  std::string address_;
  std::shared_ptr<Connection> connection_;
};

// A call that would go on for ever: its client sends some pieces, then nothing, and does not go.
class IdleCall {
 public:
  explicit IdleCall(const std::string& address)
      : stub_(grpc::CreateChannel(address, grpc::InsecureChannelCredentials())),
        writer_(stub_.LoadPrior(&context_, &response_)) {
    // More than is taken from a client before its handler reads: the call has begun.
    v1::LoadPriorRequest piece;
    piece.set_format(v1::MAP_FORMAT_BT);
    piece.set_data(std::string(1 << 20, 'x'));
    for (int i = 0; i < 32; ++i) EXPECT_TRUE(writer_->Write(piece));
  }
  ~IdleCall() {
    context_.TryCancel();
    if (!finished_) writer_->Finish();
  }
  grpc::Status Finish() {
    finished_ = true;
    return writer_->Finish();
  }

 private:
  v1::MapService::Stub stub_;
  grpc::ClientContext context_;
  v1::LoadPriorResponse response_;
  std::unique_ptr<grpc::ClientWriter<v1::LoadPriorRequest>> writer_;
  bool finished_ = false;
};

TEST_F(Signalled, SighupAndTheUsersSignalsDoNotEndIt) {
  Start("10");
  for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE}) dut_->Signal(signal);
  EXPECT_TRUE(Answers());
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  EXPECT_THAT(dut_->RestOfOutput(), testing::HasSubstr("SIGHUP: nothing to read again"));
}

TEST_F(Signalled, NobodyHasToReadItsLog) {
  Start("10");
  dut_->CloseOutput();
  dut_->Signal(SIGHUP);  // of which it writes a line
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_TRUE(Answers());
  dut_->Signal(SIGINT);
  EXPECT_EQ(dut_->Wait(), 0);
}

TEST_F(Signalled, CallsGetTheTimeThatIsConfigured) {
  Start("0.3");
  IdleCall idle(address_);
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  const grpc::Status status = idle.Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(status.error_message(), "the server is draining");
}

TEST_F(Signalled, ASecondSignalEndsItAtOnce) {
  Start("600");
  const IdleCall idle(address_);
  dut_->Signal(SIGTERM);
  ASSERT_TRUE(Eventually([&] { return Draining(); }));
  dut_->Signal(SIGHUP);
  EXPECT_TRUE(Draining());
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 3);
}

}  // namespace
}  // namespace clearway
