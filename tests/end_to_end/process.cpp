// SPDX-License-Identifier: Apache-2.0
#include "tests/end_to_end/process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace chiaro::end_to_end {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void become(const std::vector<std::string>& words, const Environment& environment,
                         const fs::path& out, const fs::path& err) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
  const auto to = [](const fs::path& file, int descriptor) {
    ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), descriptor);
  };
  to(out, STDOUT_FILENO);
  to(err, STDERR_FILENO);
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& words, const Environment& environment,
                 const fs::path& folder, const std::string& name)
    : pid_(-1), out_(folder / (name + ".out")), err_(folder / (name + ".err")) {
  pid_ = ::fork();
  if (pid_ == 0) become(words, environment, out_, err_);
}

Process::~Process() {
  if (exit_ < 0) stop();
}

int Process::wait() {
  if (exit_ >= 0) return exit_;
  int status = 0;
  ::waitpid(pid_, &status, 0);
  exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_;
}

int Process::stop() {
  if (exit_ >= 0) return exit_;
  ::kill(pid_, SIGTERM);
  const bool ended = eventually(
      [&] {
        siginfo_t info{};
        ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid == pid_;
      },
      30);
  if (!ended) ::kill(pid_, SIGKILL);
  return wait();
}

std::string Process::out() const { return content_of(out_); }
std::string Process::err() const { return content_of(err_); }

Finished run(const std::vector<std::string>& words, const Environment& environment,
             const fs::path& folder) {
  Process process(words, environment, folder, fs::path(words.front()).filename().string());
  const int exit = process.wait();
  return {exit, process.out(), process.err()};
}

bool eventually(const std::function<bool()>& holds, double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

pid_t child_of(pid_t parent, const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const auto number = entry.path().filename().string();
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    std::istringstream stat(content_of(entry.path() / "stat"));
    std::string pid, program, state;
    pid_t its_parent = 0;
    stat >> pid >> program >> state >> its_parent;
    if (its_parent == parent && program == "(" + name + ")" && state != "Z")
      return static_cast<pid_t>(std::stol(number));
  }
  return -1;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace chiaro::end_to_end
