#include "clearway/base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace clearway {

using Body = std::function<void(int, std::size_t, std::size_t)>;

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable work_ready;
  std::condition_variable work_done;
  const Body* body = nullptr;
  std::size_t size = 0;
  int generation = 0;
  int running = 0;
  bool stop = false;
  std::vector<std::thread> threads;
};

namespace {

void RunShare(const Body& body, std::size_t size, int worker, int workers) {
  const std::size_t begin = size * worker / workers;
  const std::size_t end = size * (worker + 1) / workers;
  if (begin < end) body(worker, begin, end);
}

}  // namespace

ThreadPool::ThreadPool(int threads) : threads_(threads), state_(std::make_unique<State>()) {
  for (int worker = 1; worker < threads_; ++worker) {
    state_->threads.emplace_back([state = state_.get(), worker, threads] {
      int seen = 0;
      while (true) {
        std::unique_lock lock(state->mutex);
        state->work_ready.wait(lock, [&] { return state->stop || state->generation != seen; });
        if (state->stop) return;
        seen = state->generation;
        const Body& body = *state->body;
        const std::size_t size = state->size;
        lock.unlock();
        RunShare(body, size, worker, threads);
        lock.lock();
        if (--state->running == 0) state->work_done.notify_one();
      }
    });
  }
}

ThreadPool::~ThreadPool() {
  {
    std::lock_guard lock(state_->mutex);
    state_->stop = true;
  }
  state_->work_ready.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

void ThreadPool::ParallelFor(std::size_t size, const Body& body) {
  if (threads_ > 1) {
    std::lock_guard lock(state_->mutex);
    state_->body = &body;
    state_->size = size;
    state_->running = threads_ - 1;
    ++state_->generation;
  }
  state_->work_ready.notify_all();
  RunShare(body, size, 0, threads_);
  if (threads_ > 1) {
    std::unique_lock lock(state_->mutex);
    state_->work_done.wait(lock, [&] { return state_->running == 0; });
  }
}

void ThreadPool::ParallelChunks(std::size_t size, std::size_t chunk, const Body& body) {
  std::atomic<std::size_t> next = 0;
  ParallelFor(threads_, [&](int worker, std::size_t, std::size_t) {
    for (std::size_t begin; (begin = next.fetch_add(chunk)) < size;) {
      body(worker, begin, std::min(begin + chunk, size));
    }
  });
}

}  // namespace clearway
