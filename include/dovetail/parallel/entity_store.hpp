/// @file
/// Where finished entities lie under their content keys.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/parallel/any_communicator.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dovetail {

/// What a task says of something that it has made for a store.
struct kept_value {
  content_key key = {};                  ///< what it is kept under
  std::optional<byte_buffer> bytes = {}; ///< where the task cannot reach the store

  using fields = field_list<&kept_value::key, &kept_value::bytes>;
};

/// Where named blobs outlast a process, and workers put them themselves: a `spool`, for example.
class blob_place {
public:
  virtual ~blob_place() = default;
  /// The blob, if it is there and whole.
  virtual std::optional<byte_buffer> read(const std::string& name) const = 0;
  /// Throws `io_error`, for example when the disk is full.
  virtual void write(const std::string& name, const byte_buffer& blob) const = 0;
  /// Forgets a blob.
  virtual void remove(const std::string& name) const = 0;
  /// The file of a blob, there or not.
  virtual std::filesystem::path path_of(const std::string& name) const = 0;
  /// Whether all ranks of a run have this place.
  virtual bool is_common() const = 0;
  /// Gives each rank those of the blobs that others have and it has not. Collective.
  virtual void exchange(const any_communicator& network, const std::vector<std::string>& names) const = 0;
};

/// Holds the bytes of finished entities: in a place on a disk, where workers put them themselves and a later
/// run finds them, or in the memory of the process that started the workers. A forked worker sees what was
/// there at its fork; one that shares the process must not look while another one keeps. Same key, same
/// bytes.
class entity_store {
public:
  entity_store() = default;
  /// `kind` is what its blobs are called.
  explicit entity_store(std::shared_ptr<const blob_place> disk, std::string kind = "result")
      : disk_(std::move(disk)), kind_(std::move(kind)) {}

  /// Whether a worker can keep what it makes; otherwise it sends the bytes to the process that started it.
  bool is_shared() const { return disk_ != nullptr; }

  /// Whether all ranks have what one has kept. Otherwise each rank releases its own.
  bool is_common() const { return disk_ && disk_->is_common(); }
  /// A place on the disk for a file that lasts as long as the run at most; nothing without a disk.
  std::optional<std::filesystem::path> place_of_file(const std::string& name) const {
    return disk_ ? std::optional(disk_->path_of(kind_ + "_" + name) += ".part") : std::nullopt;
  }
  /// Gives each rank those of the entities that others have and its disk has not. Collective.
  void exchange(const any_communicator& network, std::span<const content_key> keys) const;

  /// A value that was kept; nothing when it is not there, or its file is damaged.
  template <encodable T>
  std::optional<T> find_value(content_key key) const {
    const auto bytes = find(key);
    return bytes ? std::optional(decoded<T>(*bytes)) : std::nullopt;
  }
  /// Throws `io_error` when it is missing or damaged.
  template <encodable T>
  T value(content_key key) const {
    return decoded<T>(get(key));
  }
  /// Throws `io_error` when it cannot be written.
  template <encodable T>
  void keep_value(content_key key, const T& value) {
    keep(key, encoded(value));
  }

  /// In a task: keeps it, or says it to `take`, which is called in the process that has started the task.
  kept_value keep_in_task(content_key key, byte_buffer bytes);
  content_key take(kept_value said);

  /// Nothing when the entity is not there, or its file is damaged.
  std::optional<byte_buffer> find(content_key key) const;
  /// Throws `io_error` when the entity is missing or damaged.
  byte_buffer get(content_key key) const;
  /// Throws `io_error` when it cannot be written.
  void keep(content_key key, byte_buffer bytes);
  /// Gives up what is kept under a key.
  void release(content_key key);

private:
  std::string name_of(content_key key) const { return kind_ + "_" + to_string(key); }

  std::shared_ptr<const blob_place> disk_;
  std::string kind_ = "result";
  std::unordered_map<content_key, byte_buffer, content_key_hash> memory_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/entity_store.ipp"
#endif
