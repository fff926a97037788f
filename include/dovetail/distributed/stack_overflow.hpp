/// @file
/// Tells a stack that is used up from other invalid accesses to memory. Linux.
#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>

#include <pthread.h>
#include <sys/mman.h>

namespace dovetail::detail {

/// Where the stack of a thread ends, below which nothing may be written.
struct stack_end {
  std::uintptr_t lowest = 0; ///< 0: not known

  /// Whether an invalid access is one of a stack that would grow: a large frame may pass over its end.
  bool is_passed_by(const void* address) const {
    constexpr std::uintptr_t largest_frame = std::uintptr_t{64} << 20, page = 4096;
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    return lowest != 0 && at < lowest + page && at + largest_frame >= lowest;
  }
};

/// These are what a signal handler can see; it has no other way.
inline stack_end& end_of_this_stack() {
  static thread_local stack_end end;
  return end;
}
using stack_overflow_action = void (*)();
inline stack_overflow_action& action_on_overflow() {
  static stack_overflow_action action = nullptr;
  return action;
}

inline void handle_invalid_access(int signal, siginfo_t* info, void*) {
  const bool is_fault = info->si_code > 0; // and was not sent
  if (is_fault && end_of_this_stack().is_passed_by(info->si_addr))
    action_on_overflow()();
  std::signal(signal, SIG_DFL); // the same access ends the process
  if (!is_fault)
    std::raise(signal);
}

/// Gives the calling thread a stack on which to handle that its own is used up. To be called in each thread
/// that is to be watched.
inline void watch_stack_of_thread() {
  pthread_attr_t attributes;
  void* lowest = nullptr;
  std::size_t size = 0;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0)
    return;
  if (::pthread_attr_getstack(&attributes, &lowest, &size) == 0)
    end_of_this_stack() = {reinterpret_cast<std::uintptr_t>(lowest)};
  ::pthread_attr_destroy(&attributes);
  constexpr std::size_t enough = 64 << 10;
  void* const memory =
      ::mmap(nullptr, enough, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0); // for good
  if (memory == MAP_FAILED)
    return;
  stack_t other{};
  other.ss_sp = memory;
  other.ss_size = enough;
  ::sigaltstack(&other, nullptr);
}

/// From now on `action` is called when a thread that is watched has used up its stack, as the calling one
/// is; it may do what signal handlers may. The process ends then as it would without. With a sanitizer, which
/// has a handler of its own, nothing happens.
inline void on_stack_overflow(stack_overflow_action action) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static_cast<void>(action);
#else
  action_on_overflow() = action;
  watch_stack_of_thread();
  struct sigaction handled {};
  handled.sa_sigaction = handle_invalid_access;
  handled.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigemptyset(&handled.sa_mask);
  ::sigaction(SIGSEGV, &handled, nullptr);
#endif
}

} // namespace dovetail::detail
