#include "failure.hpp"

#include "dovetail/core/error.hpp"

#include <atomic>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

std::atomic<bool> own_complaint = false;
std::atomic<bool>* complaint = &own_complaint;

std::string on_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.pop_back();
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != '\r')
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  return line;
}

/// Whether the standard output has all that was said, or its reader has gone.
bool is_delivered() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good())
    return true;
  pollfd reader{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) != 0;
}

} // namespace

void complain(const std::string& text) {
  std::fflush(stdout);
  std::fprintf(stderr, "dovetail: %s\n", on_one_line(text).c_str());
  *complaint = true;
}

bool has_complained() {
  return *complaint;
}

void share_complaints() {
  void* const memory =
      ::mmap(nullptr, sizeof(*complaint), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory != MAP_FAILED)
    complaint = new (memory) std::atomic<bool>(false);
}

int run_guarded(const std::function<int()>& command, const std::string& help) {
  try {
    const int code = command();
    if (is_delivered())
      return code;
    complain("the standard output: not all could be written; make room where it goes");
  } catch (const command_line_error& problem) {
    complain(problem.what() + (" (" + help + ")"));
    return exit_usage;
  } catch (const cancelled&) {
    complain(stopped_line(false));
    return exit_stopped;
  } catch (const error& problem) {
    complain(problem.what());
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& problem) {
    complain(std::string("unexpected error: ") + problem.what());
  } catch (...) {
    complain("unexpected error of unknown kind");
  }
  return exit_failure;
}

} // namespace dovetail::app
