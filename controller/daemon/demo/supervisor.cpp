// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/demo/supervisor.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 200ms;  ///< before a restart
constexpr auto kManyWithin = 10s;
constexpr std::size_t kMany = 5;
constexpr auto kPatience = 5s;
constexpr std::size_t kLastLines = 8;

/// All that the child needs, made before fork: between fork and exec nothing may allocate.
struct Call {
  std::vector<std::string> words, variables;
  std::vector<char*> argv, envp;

  explicit Call(const Program& program) {
    words.push_back(program.file.string());
    words.insert(words.end(), program.arguments.begin(), program.arguments.end());
    for (char** one = environ; *one != nullptr; ++one) {
      const std::string variable = *one;
      if (program.environment.count(variable.substr(0, variable.find('='))) == 0)
        variables.push_back(variable);
    }
    for (const auto& [name, value] : program.environment) variables.push_back(name + "=" + value);
    for (auto& word : words) argv.push_back(word.data());
    for (auto& variable : variables) envp.push_back(variable.data());
    argv.push_back(nullptr);
    envp.push_back(nullptr);
  }
};

[[noreturn]] void become(const Call& call, int log, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(0);  // it died before the line above
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execve(call.argv[0], call.argv.data(), call.envp.data());
  ::_exit(127);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return std::string("was ended by ") + ::strsignal(WTERMSIG(status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

/// 1 to 3 mean the file, the words or the machine: trying again would give the same answer.
bool is_hopeless(int status) {
  return WIFEXITED(status) && WEXITSTATUS(status) >= 1 && WEXITSTATUS(status) <= 3;
}

}  // namespace

Supervisor::Supervisor(std::filesystem::path logs) : logs_(std::move(logs)) {}

Supervisor::~Supervisor() { end(); }

std::filesystem::path Supervisor::log_of(const Child& child) const {
  return logs_ / (child.program.name + ".log");
}

core::Result<core::Done> Supervisor::launch(Child& child, bool afresh) const {
  const auto& file = child.program.file;
  if (::access(file.c_str(), X_OK) != 0)
    return core::Problem{{file.string()},
                         "cannot run " + child.program.name + ": " + std::strerror(errno),
                         "build it, or install Chiaro again"};
  const int log = ::open(log_of(child).c_str(),
                         O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (afresh ? O_TRUNC : 0), 0644);
  if (log < 0)
    return core::Problem{{log_of(child).string()},
                         std::string("cannot write the log: ") + std::strerror(errno),
                         "make the folder writable, or set CHIARO_STATE to another"};
  const Call call(child.program);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(call, log, parent);
  const int error = errno;
  ::close(log);
  if (pid < 0)
    return core::Problem{{},
                         std::string("cannot start a process: ") + std::strerror(error),
                         "close some programs and try again"};
  child.pid = pid;
  return core::Done{};
}

core::Result<core::Done> Supervisor::start(const Program& program, ports::TimePoint now) {
  std::error_code ignored;  // opening the log says it better
  std::filesystem::create_directories(logs_, ignored);
  Child child{program, -1, 0, now, {}};
  auto started = launch(child, true);
  if (started) children_.push_back(std::move(child));
  return started;
}

core::Result<core::Done> Supervisor::tend(ports::TimePoint now) {
  for (auto& child : children_) {
    int status = 0;
    if (child.pid >= 0 && ::waitpid(child.pid, &status, WNOHANG) == child.pid) {
      child.pid = -1;
      if (auto verdict = after_death(child, status, now); !verdict) return verdict;
    }
    if (child.pid < 0 && now >= child.due) {
      ++child.restarts;
      if (auto again = launch(child, false); !again) return again;
    }
  }
  return core::Done{};
}

core::Result<core::Done> Supervisor::after_death(Child& child, int status,
                                                 ports::TimePoint now) const {
  child.due = now + kPause;
  child.deaths.push_back(now);
  std::erase_if(child.deaths, [&](ports::TimePoint at) { return now - at > kManyWithin; });
  if (!is_hopeless(status) && child.deaths.size() < kMany) return core::Done{};
  return core::Problem{{},
                       child.program.name + " " + how_it_ended(status) + ":\n" + last_words(child),
                       "its whole log is " + log_of(child).string()};
}

std::string Supervisor::last_words(const Child& child) const {
  std::ifstream log(log_of(child));
  std::vector<std::string> lines;
  for (std::string line; std::getline(log, line);) {
    lines.push_back("    " + line);
    if (lines.size() > kLastLines) lines.erase(lines.begin());
  }
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text.empty() ? "    (it said nothing)" : text.substr(0, text.size() - 1);
}

void Supervisor::end() {
  for (auto child = children_.rbegin(); child != children_.rend(); ++child) {
    if (child->pid < 0) continue;
    ::kill(child->pid, SIGTERM);
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (::waitpid(child->pid, nullptr, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) ::kill(child->pid, SIGKILL);
      std::this_thread::sleep_for(5ms);
    }
    child->pid = -1;
  }
  children_.clear();
}

std::optional<pid_t> Supervisor::pid(const std::string& name) const {
  for (const auto& child : children_)
    if (child.program.name == name && child.pid >= 0) return child.pid;
  return std::nullopt;
}

int Supervisor::restarts(const std::string& name) const {
  for (const auto& child : children_)
    if (child.program.name == name) return child.restarts;
  return 0;
}

}  // namespace chiaro::daemon
