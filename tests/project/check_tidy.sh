#!/bin/bash
# Runs clang-tidy (the names, above all) over all headers of one folder.
#   check_tidy.sh <source directory> <folder under include/dovetail> <file with flags> <clang-tidy>
set -euo pipefail
source_directory=$1
folder=$2
mapfile -t flags < <(grep . "$3")
tidy=$4

unit=tidy_${folder//./umbrella}.cpp
unit=${unit//\//_}
(cd "$source_directory/include" && printf '#include "%s"\n' dovetail/"$folder"/*.hpp) >"$unit"
"$tidy" --quiet --config-file="$source_directory/.clang-tidy" \
  --header-filter="include/dovetail/${folder//./[^/]*hpp}" "$unit" -- "${flags[@]}" 2>/dev/null
