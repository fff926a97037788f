/// @file
/// Where the workers of one rank get tasks from while they run.
#pragma once

#include <cstddef>
#include <vector>

namespace dovetail::detail {

/// Tasks are named by their places in the order of the run.
class task_feed {
public:
  virtual ~task_feed() = default;

  /// Places that are this rank's from now on, each higher than those before. Looks for news; may throw what
  /// a communicator throws.
  virtual std::vector<std::size_t> granted() = 0;
  /// A task of this rank is done, whatever became of it.
  virtual void finished(std::size_t place) = 0;
  /// Whether nothing more will be granted here, nor is to be done for others.
  virtual bool ended() const = 0;
  /// How many are done, of all that is known here.
  virtual std::size_t done() const = 0;
  /// To be watched for news, or -1.
  virtual int descriptor() const = 0;
};

} // namespace dovetail::detail
