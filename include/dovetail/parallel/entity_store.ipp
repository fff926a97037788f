/// @file
/// What `entity_store.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/entity_store.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void entity_store::exchange(const any_communicator& network,
                                            std::span<const content_key> keys) const {
  if (!disk_ || disk_->is_common() || network.size() == 1)
    return;
  std::vector<std::string> names;
  for (const content_key key : keys)
    names.push_back(name_of(key));
  disk_->exchange(network, names);
}

DOVETAIL_INLINE kept_value entity_store::keep_in_task(content_key key, byte_buffer bytes) {
  if (!is_shared())
    return {key, std::move(bytes)};
  keep(key, std::move(bytes));
  return {key, {}};
}

DOVETAIL_INLINE content_key entity_store::take(kept_value said) {
  if (said.bytes)
    keep(said.key, *std::move(said.bytes));
  return said.key;
}

DOVETAIL_INLINE std::optional<byte_buffer> entity_store::find(content_key key) const {
  if (disk_)
    return disk_->read(name_of(key));
  const auto found = memory_.find(key);
  return found != memory_.end() ? std::optional(found->second) : std::nullopt;
}

DOVETAIL_INLINE byte_buffer entity_store::get(content_key key) const {
  if (auto found = find(key))
    return *std::move(found);
  throw io_error((disk_ ? disk_->path_of(name_of(key)).string() : "the " + kind_ + " " + to_string(key)) +
                 " is missing or damaged; resume the run to make it again");
}

DOVETAIL_INLINE void entity_store::keep(content_key key, byte_buffer bytes) {
  if (disk_)
    disk_->write(name_of(key), bytes);
  else
    memory_.insert_or_assign(key, std::move(bytes));
}

DOVETAIL_INLINE void entity_store::release(content_key key) {
  if (disk_)
    disk_->remove(name_of(key));
  else
    memory_.erase(key);
}

} // namespace dovetail
