/// @file
/// Who divides the graph of redistribution by elements among the ranks of a run. Libraries that do so on all
/// ranks speak MPI, which the computing processes do not: they ask their relays.
#pragma once

#include "dovetail/distributed/socket_frames.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/partition/any_distributed_partitioner.hpp"
#include "dovetail/partition/any_partitioner.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dovetail::app {

/// The first is the default: rank 0 has the whole graph, and calls the partitioner of the run.
std::vector<std::string> rank_partitioner_names();

/// The policy of that name, the default for an empty one. `relay`: a socket to this rank's `partition_desk`;
/// -1: there is none. Throws `command_line_error` listing the names when there is none such, and for one that
/// needs a relay where there is none.
any_distributed_partitioner make_rank_partitioner(const std::string& name, const any_partitioner& of_run,
                                                  int relay);

/// Where a relay is asked to partition.
class partition_desk {
public:
  /// The socket stays its owner's; `relays`: a network that no one else uses.
  partition_desk(int socket, any_communicator relays);

  /// Where this rank's computing process asks: waits until those of all ranks do, partitions with the other
  /// relays, and answers. Until all ask, `pass_messages()` is called, so that those which do not yet go on;
  /// it throws when one of them never will. Who has asked goes no further alone, so once all have none is
  /// missing.
  void serve(const std::function<void()>& pass_messages);

private:
  void await_others(const std::function<void()>& pass_messages);

  detail::socket_frames frames_;
  any_communicator relays_;
};

} // namespace dovetail::app
