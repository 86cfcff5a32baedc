#include "server/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "absl/strings/str_cat.h"

namespace clearway::testing_support {
namespace {

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, std::vector<std::string> environment) {
  std::vector<std::string> words{CLEARWAY_SERVER_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::array<int, 2> pipe_ends{};
  EXPECT_EQ(pipe(pipe_ends.data()), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);
  EXPECT_EQ(posix_spawn(&id_, CLEARWAY_SERVER_PROGRAM, &actions, nullptr, Pointers(words).data(),
                        Pointers(environment).data()),
            0);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  output_ = fdopen(pipe_ends[0], "r");
}

Process::~Process() {
  if (!ended_) {
    kill(id_, SIGKILL);
    Wait();
  }
  CloseOutput();
}

std::string Process::Address() {
  std::string line;
  while (ReadLine(line)) {
    const std::string sign = "listening on ";
    if (line.rfind(sign, 0) == 0) return line.substr(sign.size());
  }
  return "";
}

std::string Process::RestOfOutput() {
  std::string line, all = seen_;
  while (ReadLine(line)) all += line + "\n";
  return all;
}

void Process::CloseOutput() {
  if (output_ != nullptr) fclose(output_);
  output_ = nullptr;
}

void Process::Signal(int signal) const { kill(id_, signal); }

std::map<int, int> Process::Nicenesses() const {
  std::map<int, int> threads;
  const std::string folder = absl::StrCat("/proc/", id_, "/task");
  for (const auto& task : std::filesystem::directory_iterator(folder)) {
    const int thread = std::stoi(task.path().filename());
    ++threads[getpriority(PRIO_PROCESS, static_cast<id_t>(thread))];
  }
  return threads;
}

int Process::Wait() {
  int status = 0;
  waitpid(id_, &status, 0);
  ended_ = true;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool Process::ReadLine(std::string& line) {
  line.clear();
  for (int c = fgetc(output_); c != EOF; c = fgetc(output_)) {
    if (c == '\n') {
      seen_ += line + "\n";
      return true;
    }
    line += static_cast<char>(c);
  }
  return false;
}

}  // namespace clearway::testing_support
