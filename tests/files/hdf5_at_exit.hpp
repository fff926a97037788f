/// @file
/// Lets HDF5 close nothing when the program of a test ends.
#pragma once

#include "dovetail/files/hdf5_file.hpp"

namespace dovetail::testing {

inline const bool hdf5_closes_nothing_at_exit = (io::let_hdf5_close_nothing_at_exit(), true);

} // namespace dovetail::testing
