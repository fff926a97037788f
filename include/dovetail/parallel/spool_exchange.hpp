/// @file
/// What ranks with spools of their own, on disks that the others do not see, give each other.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/spool.hpp"

#include <string>
#include <vector>

namespace dovetail {

/// Gives each rank the blobs of these names that its spool has not and another one's has, from the lowest
/// such rank; one that is damaged there counts as absent. Collective, with the same names; throws `io_error`
/// of a full disk on all ranks. A few blobs are under way at a time.
void exchange_blobs(const spool& mine, any_communicator network, const std::vector<std::string>& names);

/// The same of all blobs that any of the ranks has whole; damaged ones are removed first. For a run that goes
/// on, maybe with other ranks. Reads all blobs.
void exchange_all_blobs(const spool& mine, any_communicator network);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/spool_exchange.ipp"
#endif
