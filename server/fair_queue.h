// Who computes when more want to than there are processors.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <string>

namespace clearway {

// Calls that compute for long take turns, a few at once, the clients one after the other: however
// many calls a client sends, the others' get their share, and short calls never wait. Of a client's
// calls the one that came first has the next turn, so that it is done before the others begin. Any
// thread may call any method.
class FairQueue {
 public:
  // How many compute at once, and for how long before they let others in.
  FairQueue(int at_once, std::chrono::nanoseconds length) : at_once_(at_once), length_(length) {}

  // The turns of one call. One thread at a time; must not outlive the queue.
  class Call {
   public:
    // Calls of one client share its turns.
    Call(FairQueue& queue, std::string client) : queue_(queue), client_(std::move(client)) {}
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    // Called by one that has computed for a while and is about to go on: waits for its turn, and
    // ends its turn when that was long enough and others wait. False if `gone` became true
    // meanwhile.
    bool Take(const std::function<bool()>& gone);
    // Ends its turn, if it has one.
    void Rest();

   private:
    friend class FairQueue;
    FairQueue& queue_;
    const std::string client_;
    bool has_turn_ = false;  // guarded by the queue's mutex, as long as the call waits
    std::condition_variable granted_;
    std::chrono::steady_clock::time_point since_;
  };

 private:
  struct Client {
    std::string name;
    std::deque<Call*> waiting;
  };

  // All with the lock held.
  bool WaitFor(Call& call, std::unique_lock<std::mutex>& lock, const std::function<bool()>& gone);
  enum class End { kFront, kBack };
  void Enqueue(Call& call, End end);  // of its client's calls
  void Withdraw(Call& call);
  void Grant(Call& call);
  // Gives a turn that has ended to whoever is next.
  void PassOn();

  const int at_once_;
  const std::chrono::nanoseconds length_;
  std::mutex mutex_;
  int taken_ = 0;
  std::list<Client> clients_;  // with calls that wait; the next one first
};

}  // namespace clearway
