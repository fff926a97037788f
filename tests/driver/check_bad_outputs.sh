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

# A run that is refused leaves the mesh of an earlier one with its record.
write_cube >"$inputs/cube.off"
run_driver mesh "$inputs/cube.off" --size 0.5 --format msh --out "$inputs/kept"
((status == 0)) || fault "exit code is $status"
for refused in "--size 1e-7" "--size 0.001"; do
  run_driver mesh "$inputs/cube.off" $refused --format msh --out "$inputs/kept"
  ((status == 1)) || fault "exit code is $status, not 1"
  [[ -s $inputs/kept/finished_run.txt && -s $inputs/kept/mesh.msh ]] || fault "the earlier mesh has lost its record"
done
run_driver mesh "$inputs/cube.off" --size 0.5 --format msh --out "$inputs/kept" --resume
grep -q "this run is finished" "$sandbox/stdout" || fault "the earlier run is not known to be finished"

# What an earlier run has left, in other formats, is not of the run that is recorded.
run_driver check "$inputs/kept"
((status == 0)) || fault "exit code is $status"
grep -q "not of the run" "$sandbox/stdout" && fault "the run's own mesh is said to be of another"
run_driver mesh "$inputs/cube.off" --size 0.4 --format vtu --out "$inputs/kept"
run_driver check "$inputs/kept"
((status == 0)) || fault "exit code is $status"
grep -q "kept: not of the run that finished_run.txt tells of: mesh.msh$" "$sandbox/stdout" || fault "it does not name the earlier mesh"
run_driver mesh "$inputs/cube.off" --size 0.5 --format msh --out "$inputs/kept"

# What a command says is lost on a full disk: an error.
for command in "models" "stats $inputs/kept" "--version" "mesh --help" "plan $inputs/cube.off"; do
  what="dovetail $command >/dev/full"
  "$driver" $command >/dev/full 2>"$sandbox/stderr" </dev/null
  status=$?
  ((status == 1)) || fault "exit code is $status, not 1"
  grep -q "^dovetail: the standard output: " "$sandbox/stderr" || fault "it does not say what could not be written"
done

# Nobody has to read on.
what="dovetail mesh, its progress read for one line"
{
  (cd "$inputs" && "$driver" mesh cube.off --size 0.1 --subdomains 4 --out unread --report unread.json 2>&1)
  echo $? >"$sandbox/code"
} | head -n 1 >/dev/null
[[ $(<"$sandbox/code") == 0 && -s $inputs/unread/finished_run.txt && ! -e $inputs/unread/spool ]] ||
  fault "the run ended with its reader, by $(<"$sandbox/code")"
finish
