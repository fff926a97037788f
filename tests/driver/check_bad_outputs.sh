#!/bin/bash
# Places that cannot be written.
#   check_bad_outputs.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
coarse=(mesh --model combustor --size 12 --subdomains 2 --workers 1)

: >"$inputs/file"
expect_error "file" "${coarse[@]}" --out "$inputs/file"
expect_error "file/out" "${coarse[@]}" --out "$inputs/file/out"
expect_error "--out" "${coarse[@]}" --out ""
expect_error "/proc/out" "${coarse[@]}" --out /proc/out
expect_error "/proc/report.json" "${coarse[@]}" --report /proc/report.json
expect_error "no_such_folder" "${coarse[@]}" --report "$inputs/file/no_such_folder/report.json"
expect_error "/: cannot write" "${coarse[@]}" --report /
if ((EUID != 0)); then
  mkdir -m 555 "$inputs/read_only"
  expect_error "read_only" "${coarse[@]}" --out "$inputs/read_only/out"
fi

# A size that predicts more elements than the disk holds.
expect_error "--force" mesh --model combustor --size 0.04
finish
