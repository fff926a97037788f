/// @file
/// What `spool_exchange.hpp` declares.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/spool.hpp"
#include "dovetail/parallel/spool_exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

/// One of the named blobs on its way to a rank.
struct sent_blob {
  std::size_t name = 0;
  std::optional<byte_buffer> blob; ///< none where it was damaged

  using fields = field_list<&sent_blob::name, &sent_blob::blob>;
};

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE void exchange_blobs(const spool& mine, any_communicator network,
                                    const std::vector<std::string>& names) {
  constexpr std::size_t at_once = 16;
  std::vector<std::uint8_t> here;
  for (const std::string& name : names)
    here.push_back(mine.has(name) ? 1 : 0);
  const std::vector<std::vector<std::uint8_t>> of_rank = network.all_gather(here);
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
      std::optional<byte_buffer> message; // a `sent_blob`, read once, if anybody wants it
      for (std::size_t r = 0; r < of_rank.size(); ++r)
        if (of_rank[r][i] == 0) {
          if (!message)
            message = encoded(detail::sent_blob{i, mine.read(names[i])});
          network.send(static_cast<int>(r), tag, *message);
        }
    }
    for (; coming > 0; --coming) {
      const auto sent = decoded<detail::sent_blob>(network.await(tag).bytes);
      if (!sent.blob)
        continue;
      try {
        mine.write(names[sent.name], *sent.blob);
      } catch (...) {
        failure = std::current_exception();
      }
    }
    network.agree(failure);
  }
}

DOVETAIL_INLINE void exchange_all_blobs(const spool& mine, any_communicator network) {
  std::vector<std::string> whole, names;
  for (const std::string& name : mine.names())
    if (mine.read(name))
      whole.push_back(name);
    else
      mine.remove(name);
  for (const auto& theirs : network.all_gather(whole))
    append(names, theirs);
  sort_unique(names);
  exchange_blobs(mine, std::move(network), names);
}

} // namespace dovetail
