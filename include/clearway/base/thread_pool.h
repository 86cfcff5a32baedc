// A fixed set of threads that share loops.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace clearway {

// Runs loops on a fixed number of threads, the caller's among them. ParallelFor may be called from
// one thread at a time; a pool of one thread starts none and runs everything in the caller.
class ThreadPool {
 public:
  // threads >= 1.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return threads_; }

  // Cuts [0, size) into threads() contiguous ranges and calls body(worker, begin, end) once for
  // each, in parallel; returns when all are done. The cut depends on size and threads() alone.
  // What a body throws (the first to, if many do) is thrown here, once all are done.
  void ParallelFor(std::size_t size,
                   const std::function<void(int worker, std::size_t begin, std::size_t end)>& body);

  // Cuts [0, size) into ranges of at most `chunk` and calls body(worker, begin, end) for each; a
  // thread takes the next one when it is done with its last. Which thread does what is open. Throws
  // as ParallelFor does; the thread on which a body threw takes no more.
  void ParallelChunks(
      std::size_t size, std::size_t chunk,
      const std::function<void(int worker, std::size_t begin, std::size_t end)>& body);

 private:
  struct State;
  int threads_;
  std::unique_ptr<State> state_;
};

}  // namespace clearway
