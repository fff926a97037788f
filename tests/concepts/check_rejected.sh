#!/bin/bash
# A program that must not compile: it fails, and the error matches the expression on the program's first line.
# With -DCORRECT the same program must compile, so that it fails for the one reason it is about.
#   check_rejected.sh <compiler> <include directory> <program>
set -uo pipefail
compile=("$1" -std=c++20 -I"$2" -fsyntax-only)
program=$3
expected=$(sed -n '1s|^// error: ||p' "$program")
[[ -n $expected ]] || { echo "$program: no '// error: ' on the first line"; exit 1; }

if ! messages=$("${compile[@]}" -DCORRECT "$program" 2>&1); then
  echo "does not compile even when correct:"
  echo "$messages"
  exit 1
fi
if messages=$("${compile[@]}" "$program" 2>&1); then
  echo "compiles, and should not"
  exit 1
fi
if ! grep -qE -- "$expected" <<<"$messages"; then
  echo "the error does not match '$expected':"
  echo "$messages"
  exit 1
fi
