/// @file
/// The output files of core, under this folder's namespace.
#pragma once

#include "dovetail/core/output_file.hpp"

namespace dovetail::io {

using dovetail::make_folder;
using dovetail::output_batch;
using dovetail::output_file;

} // namespace dovetail::io
