#include "clearway/base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace clearway {

using Body = std::function<void(int, std::size_t, std::size_t)>;

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable work_ready;
  std::condition_variable work_done;
  const Body* body = nullptr;  // of the loop at hand, as its size
  std::size_t size = 0;
  int generation = 0;
  int running = 0;
  std::exception_ptr thrown;  // by the body
  bool stop = false;
  std::vector<std::thread> threads;

  void RunShare(int worker, int workers);
};

void ThreadPool::State::RunShare(int worker, int workers) {
  const std::size_t begin = size * worker / workers;
  const std::size_t end = size * (worker + 1) / workers;
  if (begin >= end) return;
  try {
    (*body)(worker, begin, end);
  } catch (...) {
    std::lock_guard lock(mutex);
    if (thrown == nullptr) thrown = std::current_exception();
  }
}

ThreadPool::ThreadPool(int threads) : threads_(threads), state_(std::make_unique<State>()) {
  for (int worker = 1; worker < threads_; ++worker) {
    state_->threads.emplace_back([state = state_.get(), worker, threads] {
      int seen = 0;
      while (true) {
        std::unique_lock lock(state->mutex);
        state->work_ready.wait(lock, [&] { return state->stop || state->generation != seen; });
        if (state->stop) return;
        seen = state->generation;
        lock.unlock();
        state->RunShare(worker, threads);
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
  {
    std::lock_guard lock(state_->mutex);
    state_->body = &body;
    state_->size = size;
    state_->running = threads_ - 1;
    ++state_->generation;
  }
  state_->work_ready.notify_all();
  state_->RunShare(0, threads_);
  {
    std::unique_lock lock(state_->mutex);
    state_->work_done.wait(lock, [&] { return state_->running == 0; });
  }
  if (state_->thrown != nullptr) std::rethrow_exception(std::exchange(state_->thrown, nullptr));
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
