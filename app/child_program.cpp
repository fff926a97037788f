#include "child_program.hpp"

#include "failure.hpp"
#include "stop_request.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dovetail::app {

int run_program(const std::vector<std::string>& words, const std::string& errors) {
  std::vector<std::string> kept = words;
  std::vector<char*> arguments;
  for (std::string& word : kept)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (!errors.empty())
      ::dup2(::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), STDERR_FILENO);
    ::execvp(arguments.front(), arguments.data());
    ::_exit(exit_failure);
  }
  int status = 0;
  bool told = false;
  for (pid_t found = 0; child > 0; found = ::waitpid(child, &status, WNOHANG)) {
    if (found == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : exit_failure;
    if (found < 0 && errno != EINTR)
      break;
    if (stop_was_requested() && !told) {
      told = true;
      ::kill(child, SIGTERM);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return exit_failure;
}

} // namespace dovetail::app
