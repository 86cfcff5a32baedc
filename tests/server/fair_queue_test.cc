#include "server/fair_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "support/eventually.h"

namespace clearway {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;
using testing_support::Eventually;

bool Never() { return false; }

// Takes turns in a thread of its own, as often as it is told to.
class Worker {
 public:
  Worker(FairQueue& turns, const std::string& client)
      : call_(std::make_unique<FairQueue::Call>(turns, client)), thread_([this] { Run(); }) {}
  ~Worker() { End(); }
  void End() {
    end_ = true;
    if (thread_.joinable()) thread_.join();
    call_.reset();
  }
  int turns_taken() const { return taken_; }
  bool asks() const { return asks_; }
  void Go() { ++wanted_; }

 private:
  void Run() {
    while (!end_) {
      if (taken_ >= wanted_) {
        std::this_thread::yield();
        continue;
      }
      asks_ = true;
      if (!call_->Take([this] { return end_.load(); })) return;
      asks_ = false;
      ++taken_;
    }
  }

  std::unique_ptr<FairQueue::Call> call_;
  std::atomic<int> taken_ = 0, wanted_ = 1;
  std::atomic<bool> end_ = false, asks_ = false;
  std::thread thread_;
};

TEST(FairQueue, EmptyAndAlone) {
  FairQueue dut(1, nanoseconds(0));
  { const FairQueue::Call never_asks(dut, "a"); }
  FairQueue::Call alone(dut, "a");
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(alone.Take(Never));
}

TEST(FairQueue, NoMoreThanSoManyAtOnce) {
  FairQueue dut(2, hours(1));
  Worker a(dut, "a"), b(dut, "b");
  ASSERT_TRUE(Eventually([&] { return a.turns_taken() == 1 && b.turns_taken() == 1; }));
  Worker c(dut, "c");
  ASSERT_TRUE(Eventually([&] { return c.asks(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_EQ(c.turns_taken(), 0);
  a.End();  // it is done
  EXPECT_TRUE(Eventually([&] { return c.turns_taken() == 1; }));
}

TEST(FairQueue, OneWhoseTurnWasLongEnoughLetsOthersIn) {
  FairQueue dut(1, nanoseconds(0));
  Worker a(dut, "a");
  ASSERT_TRUE(Eventually([&] { return a.turns_taken() == 1; }));
  Worker b(dut, "b");
  ASSERT_TRUE(Eventually([&] { return b.asks(); }));
  a.Go();  // b gets the turn, and keeps it
  ASSERT_TRUE(Eventually([&] { return b.turns_taken() == 1 && a.asks(); }));
  EXPECT_EQ(a.turns_taken(), 1);
  b.Go();
  EXPECT_TRUE(Eventually([&] { return a.turns_taken() == 2; }));
}

TEST(FairQueue, ClientsTakeTurnsHoweverManyCallsTheyHave) {
  FairQueue dut(1, nanoseconds(0));
  FairQueue::Call busy(dut, "busy");
  ASSERT_TRUE(busy.Take(Never));
  std::vector<std::unique_ptr<Worker>> many;
  for (int i = 0; i < 5; ++i) {
    many.push_back(std::make_unique<Worker>(dut, "many"));
    ASSERT_TRUE(Eventually([&] { return many.back()->asks(); }));
  }
  Worker single(dut, "single");
  ASSERT_TRUE(Eventually([&] { return single.asks(); }));
  std::thread ends([&] { EXPECT_TRUE(busy.Take(Never)); });  // its turn goes to one of the many
  ASSERT_TRUE(Eventually([&] { return many[0]->turns_taken() == 1; }));
  many[0]->Go();  // the next is the single client's
  ASSERT_TRUE(Eventually([&] { return single.turns_taken() == 1; }));
  for (int i = 1; i < 5; ++i) EXPECT_EQ(many[i]->turns_taken(), 0);
  single.End();
  ends.join();  // of three clients, it was the next
  for (auto& worker : many) worker->End();
}

TEST(FairQueue, AClientsCallsAreDoneOneAfterTheOther) {
  FairQueue dut(1, nanoseconds(0));
  Worker a(dut, "a");
  ASSERT_TRUE(Eventually([&] { return a.turns_taken() == 1; }));
  Worker second(dut, "a");
  ASSERT_TRUE(Eventually([&] { return second.asks(); }));
  for (int turn = 2; turn <= 4; ++turn) {
    a.Go();
    ASSERT_TRUE(Eventually([&] { return a.turns_taken() == turn; }));
    EXPECT_EQ(second.turns_taken(), 0);
  }
  a.End();
  EXPECT_TRUE(Eventually([&] { return second.turns_taken() == 1; }));
}

TEST(FairQueue, OneWhoseClientHasGoneWaitsNoLonger) {
  FairQueue dut(1, hours(1));
  auto first = std::make_unique<FairQueue::Call>(dut, "a");
  ASSERT_TRUE(first->Take(Never));
  FairQueue::Call gone(dut, "b");
  EXPECT_FALSE(gone.Take([] { return true; }));
  first.reset();
  FairQueue::Call next(dut, "c");
  EXPECT_TRUE(next.Take(Never));
}

}  // namespace
}  // namespace clearway
