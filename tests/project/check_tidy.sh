#!/bin/bash
# Runs clang-tidy (the names, above all) over headers, all in one translation unit: what they share is read once.
#   check_tidy.sh <source directory> <adapters, or others> <file with flags> <clang-tidy>
set -euo pipefail
source_directory=$1
which=$2
mapfile -t flags < <(grep . "$3")
tidy=$4

cd "$source_directory/include"
if [[ $which == adapters ]]; then
  filter='include/dovetail/adapters/'
  headers=$(find dovetail/adapters -name '*.hpp' | sort)
else
  filter='include/dovetail/'
  headers=$(find dovetail -name '*.hpp' -not -path 'dovetail/adapters/*' | sort)
fi
unit=$OLDPWD/tidy_$which.cpp
printf '#include "%s"\n' $headers >"$unit"
"$tidy" --quiet --config-file="$source_directory/.clang-tidy" --header-filter="$filter" "$unit" -- "${flags[@]}" 2>/dev/null
