#!/bin/bash
# Meshes a CAD file, or the built-in aircraft, from nothing but a clone: installs what is missing, builds the driver,
# and runs `dovetail mesh` with all arguments given. The mesh is written to out/ in the current folder.
set -euo pipefail
source_directory=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$source_directory/scripts/setup"
"$source_directory/scripts/build" dovetail_driver
exec "$source_directory/build/app/dovetail" mesh "$@"
