/// @file
/// Ranks of one machine that compute as one: the first of them has the workers of all, so that what each rank
/// would repeat, reading the model or joining the skeleton, is done once on a machine.
#pragma once

#include "stop_request.hpp"

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// What a rank tells of itself before anything is computed.
struct rank_introduction {
  std::string machine;                  ///< the same for processes that know each other by number
  std::vector<std::int32_t> processors; ///< that it is bound to, growing
  std::vector<std::int32_t> allowed;    ///< that it could be bound to, growing

  using fields =
      field_list<&rank_introduction::machine, &rank_introduction::processors, &rank_introduction::allowed>;
};

/// Of the calling process, whose binding is wider for a moment.
rank_introduction introduction();

/// Who computes, and what.
struct rank_groups {
  std::vector<std::int32_t> leader_of_rank;          ///< by rank; a leader is its own
  std::vector<std::vector<std::int32_t>> processors; ///< by rank: of a leader those of its group; else none
  std::string command_line;                          ///< that rank 0 was started with

  using fields =
      field_list<&rank_groups::leader_of_rank, &rank_groups::processors, &rank_groups::command_line>;

  /// The ranks of this one's group, growing.
  std::vector<int> group_of(int rank) const;
  /// The ranks that compute, growing.
  std::vector<int> leaders() const;
};

/// Groups of up to so many ranks of a machine, in their order; 0: all of it. Two ranks of which one may not
/// use the processors of the other are in different groups.
rank_groups groups_of(const std::vector<rank_introduction>& ranks, int at_most);

/// What ranks say to each other before the leaders begin, and when the command of a group is over.
namespace group_tags {
inline constexpr std::int32_t introduction = 0;
inline constexpr std::int32_t groups = 1;
inline constexpr std::int32_t over = 2;
} // namespace group_tags

/// The next message. Throws `cancelled` where this process is asked to stop meanwhile.
template <communicator C>
rank_message awaited(C& network) {
  for (;;) {
    if (auto next = network.receive())
      return *std::move(next);
    if (stop_was_requested())
      throw cancelled();
    network.wait(std::chrono::milliseconds(100));
  }
}

/// What ranks know of each other when they have met.
struct met_ranks {
  rank_groups groups;
  std::deque<rank_message> early; ///< of leaders that knew before this rank did
};

/// Collective: rank 0 forms the groups, of up to `at_most`, and tells all. Throws `usage_error` where a rank
/// was started with another command line than rank 0.
template <communicator C>
met_ranks meet(C& network, const rank_introduction& own, int at_most, const std::string& command_line) {
  met_ranks met;
  if (network.rank() == 0) {
    std::vector<rank_introduction> ranks(static_cast<std::size_t>(network.size()));
    ranks.front() = own;
    for (int others = network.size() - 1; others > 0; --others) {
      const rank_message next = awaited(network);
      ranks[static_cast<std::size_t>(next.peer)] = decoded<rank_introduction>(next.bytes);
    }
    met.groups = groups_of(ranks, at_most);
    met.groups.command_line = command_line;
    for (int r = 1; r < network.size(); ++r)
      network.send(r, group_tags::groups, encoded(met.groups));
    return met;
  }
  network.send(0, group_tags::introduction, encoded(own));
  rank_message next = awaited(network);
  for (; next.peer != 0; next = awaited(network))
    met.early.push_back(std::move(next));
  met.groups = decoded<rank_groups>(next.bytes);
  if (met.groups.command_line != command_line)
    throw usage_error("this rank starts from '" + command_line + "', and rank 0 from '" +
                      met.groups.command_line + "'");
  return met;
}

/// A model of `communicator` between the leaders alone, who are its ranks.
template <communicator C>
class network_of_leaders {
public:
  /// The network must outlive this. `early`: messages of other leaders that came before this one knew the
  /// groups.
  network_of_leaders(C& network, const rank_groups& groups, std::deque<rank_message> early)
      : network_(&network), leaders_(groups.leaders()), early_(std::move(early)) {}

  int rank() const { return number_of(network_->rank()); }
  int size() const { return static_cast<int>(leaders_.size()); }
  void send(int to, std::int32_t tag, byte_buffer bytes) {
    network_->send(leaders_[static_cast<std::size_t>(to)], tag, std::move(bytes));
  }
  std::optional<rank_message> receive() {
    std::optional<rank_message> next;
    if (early_.empty()) {
      next = network_->receive();
    } else {
      next = std::move(early_.front());
      early_.pop_front();
    }
    if (next)
      next->peer = number_of(next->peer);
    return next;
  }
  void wait(std::chrono::milliseconds at_most) {
    if (early_.empty())
      network_->wait(at_most);
  }
  int descriptor() const { return network_->descriptor(); }
  bool shares_process() const { return network_->shares_process(); }
  void abandon(const std::string& reason) { network_->abandon(reason); }

private:
  int number_of(int rank) const {
    return static_cast<int>(std::lower_bound(leaders_.begin(), leaders_.end(), rank) - leaders_.begin());
  }

  C* network_;
  std::vector<int> leaders_;
  std::deque<rank_message> early_;
};

} // namespace dovetail::app
