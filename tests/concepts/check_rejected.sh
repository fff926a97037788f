#!/bin/bash
# A program of near misses, one concept's: with NEAR_MISS=0 it must compile; with 1, 2, ... each must be rejected with
# an error that matches the expression of its line "// error N: ...", so that a user sees which requirement failed;
# of "// first error N: ..." the first error does.
#   check_rejected.sh <compiler> <include directory> <program>
set -uo pipefail
program=$3
command=("$1" -std=c++20 -DDOVETAIL_COMPILED -I"$2")
# What the program includes is precompiled: all of its near misses begin with it.
precompiled=$(mktemp -d)
trap 'rm -rf "$precompiled"' EXIT
grep '^#include' "$program" >"$precompiled/includes.hpp"
"${command[@]}" -x c++-header "$precompiled/includes.hpp" -o "$precompiled/includes.hpp.gch" || exit
compile() {
  "${command[@]}" -include "$precompiled/includes.hpp" -fsyntax-only "-DNEAR_MISS=$1" "$program" 2>&1
}

if ! messages=$(compile 0); then
  echo "does not compile even when nothing is missed:"
  echo "$messages"
  exit 1
fi

failed=0
count=0
while IFS=: read -r which expected; do
  ((++count))
  expected=${expected# }
  number=${which##* }
  if messages=$(compile "$number"); then
    echo "near miss $number compiles, and should not"
    failed=1
    continue
  fi
  [[ $which == first* ]] && messages=$(grep -m 1 ' error: ' <<<"$messages")
  if ! grep -qE -- "$expected" <<<"$messages"; then
    echo "near miss $number: the error does not match '$expected':"
    echo "$messages"
    failed=1
  fi
done < <(sed -nE 's#^// ((first )?error [0-9]+:)#\1#p' "$program")

((count >= 3)) || { echo "$program: $count near misses; a concept has at least three"; exit 1; }
exit $failed
