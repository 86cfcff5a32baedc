#include "scan_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "clearway/client/frame_sender.h"
#include "drive_server.h"

namespace clearway::bench {
namespace {

constexpr std::chrono::milliseconds kPeriod(100);
constexpr int kUntilStopped = -1;

void Must(bool done) {
  if (done) return;
  std::perror("scan process");
  std::abort();
}

void Put(int file, int number) { Must(write(file, &number, sizeof number) == sizeof number); }

// None at the end of the file.
std::optional<int> Take(int file) {
  int number = 0;
  if (read(file, &number, sizeof number) != sizeof number) return std::nullopt;
  return number;
}

bool Ready(int file) {
  pollfd waiting{file, POLLIN, 0};
  return poll(&waiting, 1, 0) > 0;
}

std::string TakeAddress(int file) {
  std::string address(Take(file).value_or(0), '\0');
  Must(read(file, address.data(), address.size()) == std::ssize(address));
  return address;
}

// Does what it is told: a number of scans, or scans until the next number.
void Serve(Drive drive, int in, int out) {
  const std::string address = TakeAddress(in);
  if (address.empty()) return;  // there is no server
  auto connection = Connection::Open(address);
  Must(connection.ok());
  FrameSender sender(*connection);
  while (const auto wanted = Take(in)) {
    int pushed = 0;
    auto next = std::chrono::steady_clock::now();
    while (*wanted == kUntilStopped ? !Ready(in) : pushed < *wanted) {
      Must(sender.Push(drive.Next()).ok());
      ++pushed;
      if (*wanted != kUntilStopped) continue;
      next = std::max(next + kPeriod, std::chrono::steady_clock::now());
      std::this_thread::sleep_until(next);
    }
    if (*wanted == kUntilStopped) Take(in);
    Put(out, pushed);
  }
}

}  // namespace

ScanProcess::ScanProcess() {
  std::array<int, 2> down{}, up{};
  Must(pipe2(down.data(), O_CLOEXEC) == 0 && pipe2(up.data(), O_CLOEXEC) == 0);
  pid_ = fork();
  Must(pid_ >= 0);
  if (pid_ == 0) {
    close(down[1]);
    close(up[0]);
    Serve(Drive(), down[0], up[1]);
    _exit(0);
  }
  close(down[0]);
  close(up[1]);
  to_child_ = down[1];
  from_child_ = up[0];
}

ScanProcess::~ScanProcess() {
  close(to_child_);  // which ends it
  close(from_child_);
  waitpid(pid_, nullptr, 0);
}

void ScanProcess::Connect(const std::string& address) {
  Put(to_child_, static_cast<int>(address.size()));
  Must(write(to_child_, address.data(), address.size()) == std::ssize(address));
}

void ScanProcess::Push(int scans) {
  Put(to_child_, scans);
  Must(Take(from_child_) == scans);
}

void ScanProcess::Start() { Put(to_child_, kUntilStopped); }

int ScanProcess::Stop() {
  Put(to_child_, 0);
  return Take(from_child_).value_or(0);
}

}  // namespace clearway::bench
