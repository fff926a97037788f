/// @file
/// What a relay does while its rank's process computes.
#pragma once

#include "failure.hpp"
#include "supervision.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/distributed/relay.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace dovetail::app {

/// How the computing process of a rank has ended.
struct rank_end {
  int code = exit_ok;
  bool by_itself = false; ///< and was not killed because another one had ended
  std::string cause;      ///< one line, where it did not end well
  bool was_told = false;  ///< that another rank goes no further, before

  using fields = field_list<&rank_end::code, &rank_end::by_itself, &rank_end::cause, &rank_end::was_told>;
};

/// What a relay has to do besides passing messages.
struct relay_duties {
  std::function<bool()> all_live;    ///< the relays
  std::function<std::string()> said; ///< by the computing process, on its error stream
  std::function<void(const std::function<void()>& pass_messages)> serve; ///< what it asks of this one
};

/// Passes messages until the computing process has ended. Where that is asked to stop the others are told at
/// once, and end meanwhile. Throws what `network` and the duties throw, but for `communication_error`, after
/// which this rank ends too.
template <communicator C>
class relay_loop {
public:
  /// The socket, of messages to the computing process, stays its owner's.
  relay_loop(supervisor& computing, C& network, int socket, relay_duties duties)
      : computing_(computing), network_(network), relay_(network, socket), duties_(std::move(duties)) {}

  rank_end run() {
    // When a relay is killed, mpirun asks the others to stop: not what the user did.
    while (!computing_.has_ended(pause(), duties_.all_live)) {
      ++looks_;
      if (others_go_on_)
        look_for_messages();
    }
    computing_.await_workers();
    pass_last_messages();
    return end();
  }

private:
  /// Between two looks, which is how long a message may wait: short after a message, as an answer often
  /// follows (2 ms), longer for 55 ms more, and longest when none comes.
  std::chrono::microseconds pause() const {
    constexpr std::chrono::microseconds first{50}, next{500}, last{4000};
    return looks_ < 40 ? first : looks_ < 150 ? next : last;
  }

  void look_for_messages() {
    const auto pass_messages = [&] {
      for (require_not_stopped(); relay_.step(); require_not_stopped())
        looks_ = 0;
    };
    try {
      pass_messages();
      duties_.serve(pass_messages);
    } catch (const communication_error& problem) {
      go_no_further(problem.what());
    }
  }

  void require_not_stopped() {
    computing_.has_ended({}, duties_.all_live);
    stopped_ = computing_.is_asked_to_stop();
    if (!stopped_)
      return;
    network_.abandon(stopped_line(false));
    throw communication_error(stopped_line(false));
  }

  /// A request to stop that another rank has told of is one to this rank too: it says what it leaves.
  void go_no_further(const std::string& reason) {
    others_go_on_ = false;
    if (reason.ends_with(stopped_line(false)))
      computing_.ask_to_stop();
    else
      computing_.end_soon();
    relay_.tell_abandoned(reason);
  }

  /// What the computing process said last.
  void pass_last_messages() {
    try {
      while (others_go_on_ && relay_.step()) {
      }
    } catch (const communication_error&) {
      others_go_on_ = false;
    }
  }

  rank_end end() {
    rank_end found{computing_.code(),
                   others_go_on_ || stopped_ || !computing_.was_killed(),
                   {},
                   !others_go_on_ && !stopped_};
    const bool stopped_at_its_end = stopped_ && found.code == exit_ok; // at that of the others, perhaps not
    if (stopped_at_its_end)
      found.code = exit_stopped;
    if (found.code == exit_ok || !found.by_itself)
      return found;
    found.cause = computing_.ended() || stopped_at_its_end ? stopped_line(false)
                  : computing_.was_killed()                ? computing_.killed_line()
                                                           : duties_.said();
    if (others_go_on_)
      network_.abandon(found.cause);
    return found;
  }

  supervisor& computing_;
  C& network_;
  parallel::relay<C> relay_;
  relay_duties duties_;
  bool others_go_on_ = true;
  bool stopped_ = false; ///< on request to this rank
  int looks_ = 0;        ///< since a message was there
};

} // namespace dovetail::app
