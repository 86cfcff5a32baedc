// What a caller survives.
#include "io/guarded_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Function = std::function<absl::StatusOr<std::string>()>;

constexpr CallLimits kShort = {.max_time = std::chrono::milliseconds(200)};

std::ptrdiff_t OpenDescriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

absl::StatusOr<std::string> Hang() {
  for (volatile std::uint64_t i = 0;;) i = i + 1;
}

// Whatever the call does, neither a descriptor nor a process stays.
class GuardedCall : public testing::Test {
 protected:
  GuardedCall() : descriptors_(OpenDescriptors()) {}
  ~GuardedCall() override {
    EXPECT_EQ(OpenDescriptors(), descriptors_);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
  }

  std::string Error(absl::StatusCode code, const Function& function,
                    const CallLimits& limits = {}) {
    const auto dut = CallGuarded("it", limits, function);
    EXPECT_EQ(dut.status().code(), code) << dut.status();
    return std::string(dut.status().message());
  }

 private:
  std::ptrdiff_t descriptors_;
};

TEST_F(GuardedCall, Empty) {
  const auto dut = CallGuarded("it", {}, [] { return std::string(); });
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, "");
}

TEST_F(GuardedCall, ReturnsWhatTheFunctionReturns) {
  for (const std::size_t size : {1, 65'535, 65'536, 65'537, 100'000'000}) {
    std::string bytes(size, '\0');
    bytes.back() = 'x';
    const auto dut = CallGuarded("it", {}, [&] { return bytes; });
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_TRUE(*dut == bytes) << size;
  }
}

TEST_F(GuardedCall, ReturnsTheErrorsOfTheFunction) {
  EXPECT_EQ(Error(absl::StatusCode::kNotFound, [] { return absl::NotFoundError("no mesh"); }),
            "no mesh");
  EXPECT_EQ(
      Error(absl::StatusCode::kUnauthenticated, [] { return absl::UnauthenticatedError(""); }), "");
}

TEST_F(GuardedCall, MemoryIsNotShared) {
  int number = 1;
  const auto dut = CallGuarded("it", {}, [&] { return std::to_string(++number); });
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, "2");
  EXPECT_EQ(number, 1);
}

TEST_F(GuardedCall, TimeIsLimited) {
  EXPECT_EQ(Error(absl::StatusCode::kDeadlineExceeded, Hang, kShort), "it took more than 0.2 s");
  const auto sleep = [] {
    while (true) pause();
    return std::string();
  };
  EXPECT_EQ(Error(absl::StatusCode::kDeadlineExceeded, sleep, kShort), "it took more than 0.2 s");
}

TEST_F(GuardedCall, CrashesAreErrors) {
  const auto raising = [](int signal) {
    return [signal] {
      raise(signal);
      return std::string();
    };
  };
  const auto aborting = []() -> absl::StatusOr<std::string> { std::abort(); };
  EXPECT_EQ(Error(absl::StatusCode::kAborted, aborting), "it crashed (signal 6)");
  EXPECT_EQ(Error(absl::StatusCode::kAborted, raising(SIGSEGV)), "it crashed (signal 11)");
  EXPECT_EQ(Error(absl::StatusCode::kAborted, raising(SIGFPE)), "it crashed (signal 8)");
  EXPECT_EQ(Error(absl::StatusCode::kDeadlineExceeded, raising(SIGXCPU)), "it took more than 60 s");
  EXPECT_THAT(Error(absl::StatusCode::kResourceExhausted, raising(SIGKILL)), HasSubstr("killed"));
  const auto exiting = []() -> absl::StatusOr<std::string> { _exit(0); };
  EXPECT_EQ(Error(absl::StatusCode::kAborted, exiting), "it crashed");
}

TEST_F(GuardedCall, ExceptionsAreErrors) {
  const auto throwing = []() -> absl::StatusOr<std::string> { throw std::runtime_error("no"); };
  EXPECT_EQ(Error(absl::StatusCode::kAborted, throwing), "it: no");
  const auto throwing_number = []() -> absl::StatusOr<std::string> { throw 7; };
  EXPECT_EQ(Error(absl::StatusCode::kAborted, throwing_number), "it: an unknown exception");
  const auto out_of_memory = []() -> absl::StatusOr<std::string> { throw std::bad_alloc(); };
  EXPECT_THAT(Error(absl::StatusCode::kResourceExhausted, out_of_memory), HasSubstr("memory"));
}

TEST_F(GuardedCall, MemoryIsLimited) {
  if (!GuardsMemory()) GTEST_SKIP() << "not under sanitizers";
  const CallLimits limits = {.max_memory_bytes = 256'000'000};
  const auto allocate = [](std::size_t bytes) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < bytes / 1'000'000; ++i) all.emplace_back(1'000'000, 'x');
    return absl::StrCat(all.size());
  };
  const auto enough = CallGuarded("it", limits, [&] { return allocate(100'000'000); });
  EXPECT_TRUE(enough.ok()) << enough.status();
  EXPECT_THAT(Error(
                  absl::StatusCode::kResourceExhausted,
                  [&] { return allocate(std::size_t{1} << 40); }, limits),
              StartsWith("it takes more memory than there is, or than the limit of 256 MB"));
}

TEST_F(GuardedCall, ResultsAreLimited) {
  const CallLimits limits = {.max_result_bytes = 1'000'000};
  const auto bytes = [](std::size_t size) { return [size] { return std::string(size, 'x'); }; };
  EXPECT_TRUE(CallGuarded("it", limits, bytes(1'000'000)).ok());
  for (const std::size_t size : {1'000'001, 100'000'000}) {
    EXPECT_EQ(Error(absl::StatusCode::kResourceExhausted, bytes(size), limits),
              "it returns more than 1000000 bytes, the limit");
  }
  EXPECT_TRUE(CallGuarded("it", {.max_result_bytes = ~std::uint64_t{0}}, bytes(9)).ok());
}

TEST_F(GuardedCall, NothingOfTheCallerIsOpen) {
  // Standard input, output and errors, the pipe of the result, and the folder itself.
  const auto dut = CallGuarded("it", {}, [] { return absl::StrCat(OpenDescriptors()); });
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(*dut, "5");
}

TEST_F(GuardedCall, HandlersAndMasksOfTheCallerDoNotHold) {
  struct sigaction handler = {}, before;
  handler.sa_handler = SIG_IGN;
  ASSERT_EQ(sigaction(SIGUSR1, &handler, &before), 0);
  sigset_t all, mask;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &mask);
  const auto raise_it = [] {
    raise(SIGUSR1);
    return std::string();
  };
  EXPECT_EQ(Error(absl::StatusCode::kAborted, raise_it),
            absl::StrCat("it crashed (signal ", SIGUSR1, ")"));
  sigset_t still;
  pthread_sigmask(SIG_SETMASK, &mask, &still);
  EXPECT_EQ(sigismember(&still, SIGUSR1), 1);
  sigaction(SIGUSR1, &before, nullptr);
}

// Then nobody can ask how a child ended.
TEST_F(GuardedCall, CallersMayIgnoreTheEndsOfChildren) {
  struct sigaction ignore = {}, before;
  ignore.sa_handler = SIG_IGN;
  ASSERT_EQ(sigaction(SIGCHLD, &ignore, &before), 0);
  const auto dut = CallGuarded("it", {}, [] { return std::string("done"); });
  EXPECT_TRUE(dut.ok()) << dut.status();
  EXPECT_THAT(
      Error(absl::StatusCode::kAborted, []() -> absl::StatusOr<std::string> { std::abort(); }),
      StartsWith("it crashed"));
  EXPECT_EQ(Error(absl::StatusCode::kDeadlineExceeded, Hang, kShort), "it took more than 0.2 s");
  sigaction(SIGCHLD, &before, nullptr);
}

TEST_F(GuardedCall, ManyThreadsMayCall) {
  std::vector<std::thread> threads;
  std::vector<absl::StatusOr<std::string>> results(8);
  for (std::size_t i = 0; i < results.size(); ++i) {
    threads.emplace_back([&results, i] {
      const auto large = [i] { return std::string(1'000'000 * i, 'x'); };
      results[i] = i % 2 == 0 ? CallGuarded("it", {}, large) : CallGuarded("it", kShort, Hang);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (i % 2 == 0) {
      ASSERT_TRUE(results[i].ok()) << results[i].status();
      EXPECT_EQ(results[i]->size(), 1'000'000 * i);
    } else {
      EXPECT_EQ(results[i].status().code(), absl::StatusCode::kDeadlineExceeded);
    }
  }
}

}  // namespace
}  // namespace clearway
