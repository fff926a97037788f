#!/bin/bash
# Programs of the same tests, made by other compilers or with other flags, make the same meshes.
#   check_same_mesh.sh <source file of the tests> <program> <program>...
set -euo pipefail
source_file=$1
shift
first=
for program in "$@"; do
  said=$("$program" "--source-file=$source_file") || { echo "$said"; exit 1; }
  meshes=$(grep '^mesh of ' <<<"$said") || { echo "$program says nothing of meshes"; exit 1; }
  echo "$program:"
  echo "$meshes"
  [[ ${first:=$meshes} == "$meshes" ]] || { echo "these are other meshes"; exit 1; }
done
