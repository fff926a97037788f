/// @file
/// What ranks with spools of their own, on disks that the others do not see, give each other.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/spool.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Gives each rank the blobs of these names that its spool has not and another one's has, from the lowest
/// such rank; one that is damaged there counts as absent. Collective, with the same names; throws `io_error`
/// of a full disk on all ranks. A few blobs are under way at a time.
inline void exchange_blobs(const spool& mine, any_communicator network,
                           const std::vector<std::string>& names) {
  constexpr std::size_t at_once = 16;
  byte_writer listing;
  std::vector<std::uint8_t> here;
  for (const std::string& name : names)
    here.push_back(mine.has(name) ? 1 : 0);
  listing.array(here);
  std::vector<std::vector<std::uint8_t>> of_rank;
  for (const byte_buffer& theirs : network.all_gather(listing.take()))
    of_rank.push_back(byte_reader(theirs).array<std::uint8_t>());
  const auto owner_of = [&](std::size_t i) {
    return std::find_if(of_rank.begin(), of_rank.end(), [&](const auto& has) { return has[i] != 0; }) -
           of_rank.begin();
  };
  const std::int32_t tag = network.next_tag();
  for (std::size_t begin = 0; begin < names.size(); begin += at_once) {
    std::exception_ptr failure;
    std::size_t coming = 0;
    for (std::size_t i = begin; i < std::min(begin + at_once, names.size()); ++i) {
      const auto owner = owner_of(i);
      if (owner == static_cast<std::ptrdiff_t>(of_rank.size()))
        continue;
      if (owner != network.rank()) {
        coming += here[i] != 0 ? 0 : 1;
        continue;
      }
      std::optional<byte_buffer> message; // read once, if anybody wants it
      for (std::size_t r = 0; r < of_rank.size(); ++r)
        if (of_rank[r][i] == 0) {
          if (!message) {
            byte_writer to;
            to.value<std::uint64_t>(i);
            if (const auto blob = mine.read(names[i]))
              to.array(*blob);
            message = to.take();
          }
          network.send(static_cast<int>(r), tag, *message);
        }
    }
    for (; coming > 0; --coming) {
      const byte_buffer message = network.await(tag).bytes;
      byte_reader from(message);
      const auto i = static_cast<std::size_t>(from.value<std::uint64_t>());
      if (from.at_end())
        continue;
      try {
        mine.write(names[i], from.array<std::byte>());
      } catch (...) {
        failure = std::current_exception();
      }
    }
    network.agree(failure);
  }
}

/// The same of all blobs that any of the ranks has whole; damaged ones are removed first. For a run that goes
/// on, maybe with other ranks. Reads all blobs.
inline void exchange_all_blobs(const spool& mine, any_communicator network) {
  byte_writer listing;
  for (const std::string& name : mine.names())
    if (mine.read(name))
      listing.text(name);
    else
      mine.remove(name);
  std::vector<std::string> names;
  for (const byte_buffer& theirs : network.all_gather(listing.take()))
    for (byte_reader from(theirs); !from.at_end();)
      names.push_back(from.text());
  sort_unique(names);
  exchange_blobs(mine, std::move(network), names);
}

} // namespace dovetail
