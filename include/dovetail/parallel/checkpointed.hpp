/// @file
/// A run that another one goes on with: its results lie in a spool.
#pragma once

#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/spool.hpp"
#include "dovetail/parallel/spool_exchange.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// A spool as a place for blobs.
class spool_place final : public blob_place {
public:
  explicit spool_place(spool disk) : disk_(std::move(disk)) {}

  std::optional<byte_buffer> read(const std::string& name) const override { return disk_.read(name); }
  void write(const std::string& name, const byte_buffer& blob) const override { disk_.write(name, blob); }
  void remove(const std::string& name) const override { disk_.remove(name); }
  std::filesystem::path path_of(const std::string& name) const override { return disk_.path_of(name); }
  bool is_common() const override { return disk_.is_common(); }
  void exchange(const any_communicator& network, const std::vector<std::string>& names) const override {
    exchange_blobs(disk_, network, names);
  }

private:
  spool disk_;
};

} // namespace detail

/// A spool as a place for blobs.
inline std::shared_ptr<const blob_place> place_in(spool disk) {
  return std::make_shared<const detail::spool_place>(std::move(disk));
}

namespace parallel {

/// An executor that keeps what stages have made through it in a spool: `generate` goes on where a run that
/// was stopped has left off. All that the mesh depends on must be in the identity of the spool.
/// Constant time. Throws nothing but for a lack of memory.
/// \param run any executor
/// \param disk of this run, or of the one that it goes on with
template <executor E>
remembering<E> checkpointed(E run, spool disk) {
  return remembering<E>(std::move(run), place_in(std::move(disk)));
}

} // namespace parallel
} // namespace dovetail
