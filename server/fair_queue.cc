#include "server/fair_queue.h"

#include <algorithm>

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kLook(5);  // of those that wait, whether their client is gone

}  // namespace

FairQueue::Call::~Call() { Rest(); }

void FairQueue::Call::Rest() {
  if (!has_turn_) return;
  std::lock_guard lock(queue_.mutex_);
  has_turn_ = false;
  queue_.PassOn();
}

bool FairQueue::Call::Take(const std::function<bool()>& gone) {
  if (has_turn_ && std::chrono::steady_clock::now() - since_ < queue_.length_) return true;
  std::unique_lock lock(queue_.mutex_);
  if (has_turn_) {
    if (queue_.clients_.empty()) return true;
    has_turn_ = false;
    queue_.Enqueue(*this, End::kFront);
    queue_.PassOn();
  } else if (queue_.taken_ < queue_.at_once_) {  // then nobody waits
    ++queue_.taken_;
    queue_.Grant(*this);
  } else {
    queue_.Enqueue(*this, End::kBack);
  }
  return queue_.WaitFor(*this, lock, gone);
}

bool FairQueue::WaitFor(Call& call, std::unique_lock<std::mutex>& lock,
                        const std::function<bool()>& gone) {
  while (!call.has_turn_) {
    call.granted_.wait_for(lock, kLook);
    if (call.has_turn_ || !gone()) continue;
    Withdraw(call);
    return false;
  }
  return true;
}

void FairQueue::Enqueue(Call& call, End end) {
  auto client = std::ranges::find(clients_, call.client_, &Client::name);
  if (client == clients_.end()) client = clients_.insert(clients_.end(), {call.client_, {}});
  auto& waiting = client->waiting;
  waiting.insert(end == End::kFront ? waiting.begin() : waiting.end(), &call);
}

void FairQueue::Withdraw(Call& call) {
  const auto client = std::ranges::find(clients_, call.client_, &Client::name);
  std::erase(client->waiting, &call);
  if (client->waiting.empty()) clients_.erase(client);
}

void FairQueue::Grant(Call& call) {
  call.has_turn_ = true;
  call.since_ = std::chrono::steady_clock::now();
  call.granted_.notify_one();
}

void FairQueue::PassOn() {
  if (clients_.empty()) {
    --taken_;
    return;
  }
  Client& client = clients_.front();
  Grant(*client.waiting.front());
  client.waiting.pop_front();
  // Its other calls come after the other clients'.
  if (client.waiting.empty()) {
    clients_.pop_front();
  } else {
    clients_.splice(clients_.end(), clients_, clients_.begin());
  }
}

}  // namespace clearway
