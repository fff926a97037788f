#!/bin/bash
# Compiles each header of one folder of the library alone.
#   check_headers.sh <include directory> <folder under dovetail/> <file with flags> <compiler> <more flags...>
# With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
set -uo pipefail
include_directory=$1
folder=$2
mapfile -t flags < <(grep . "$3")
shift 3

failed=0
cd "$include_directory" || exit 1
for header in dovetail/"$folder"/*.hpp; do
  [[ -f $header ]] || continue
  messages=$(printf '#include "%s"\n#include "%s"\n' "$header" "$header" | "$@" "${flags[@]}" -x c++ -fsyntax-only - 2>&1) && continue
  if [[ -n ${DOVETAIL_ALLOW_MISSING_LIBRARIES:-} ]] &&
    grep -E "fatal error: .*([Nn]o such file|file not found)" <<<"$messages" | grep -qv "fatal error: '\?dovetail/"; then
    echo "$header: passed over, a library is missing"
    continue
  fi
  echo "$header does not compile alone:"
  head -n 40 <<<"$messages"
  failed=1
done
exit $failed
