#!/bin/bash
# Compiles headers of the library together, those of the adapters or all others, with the compiled library and header-only: what
# they share is read once. What they define is inline, so that two translation units can include it. The last header comes first, since
# the compiled library has the first one first.
#   check_together.sh <include directory> <adapters, or others> <file with flags> <compiler> <more flags...>
# The compiler may have a launcher in front (ccache: then nothing that has not changed costs anything). Works in the current
# folder.
# With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
set -uo pipefail
include_directory=$1
which=$2
mapfile -t flags < <(grep . "$3")
shift 3
compiler=("$@" "${flags[@]}")

unit=together_$which
trap 'rm -f "$unit".cpp "$unit".o' EXIT
with_library=(-DDOVETAIL_COMPILED -DDOVETAIL_COMPILED_OCCT -DDOVETAIL_COMPILED_CGAL)
compile() { # Prints what the compiler says and what the headers define that is not inline; fails when it does either.
  "${compiler[@]}" "$@" -c "$unit.cpp" -o "$unit.o" 2>&1 &&
    ! nm --demangle --extern-only --defined-only "$unit.o" | grep -v ' [VWu] '
}
compile_together() { # headers
  printf '#include "%s"\n' "$@" | tac >"$unit.cpp"
  compile "${with_library[@]}" && compile
}
names_missing_file() {
  grep -E "fatal error: .*([Nn]o such file|file not found)" | grep -qv "fatal error: '\?dovetail/"
}

adapters=(-path "$include_directory/dovetail/adapters/*")
[[ $which == adapters ]] || adapters=(-not "${adapters[@]}")
mapfile -t headers < <(find "$include_directory/dovetail" -name '*.hpp' "${adapters[@]}" -printf 'dovetail/%P\n' | sort)
((${#headers[@]})) || { echo "there are no headers"; exit 1; }
messages=$(compile_together "${headers[@]}") && exit

if [[ -n ${DOVETAIL_ALLOW_MISSING_LIBRARIES:-} ]] && names_missing_file <<<"$messages"; then
  complete=()
  for header in "${headers[@]}"; do
    printf '#include "%s"\n' "$header" >"$unit.cpp"
    said=$("${compiler[@]}" -E "$unit.cpp" -o /dev/null 2>&1)
    if names_missing_file <<<"$said"; then
      echo "$header: passed over, a library is missing"
    else
      complete+=("$header")
    fi
  done
  messages=$(compile_together "${complete[@]}") && exit
fi
echo "the headers do not compile together, or define what is not inline:"
head -n 60 <<<"$messages"
exit 1
