#!/bin/bash
# Traces of runs, and what simulations make of them.
#   check_trace.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

write_cube >"$inputs/cube.off"
hash_of() { grep -o '"mesh_hash": "[0-9a-f]*"' "$sandbox/work/report.json"; }

expect_success mesh "$inputs/cube.off" --size 0.1 --subdomains 4 --format none --report report.json
plain=$(hash_of)
for size in 0.1 0.06; do
  expect_success mesh "$inputs/cube.off" --size $size --subdomains 4 --format none --report report.json \
    --trace trace.json
  cp "$sandbox/work/trace.json" "$inputs/$size.json"
  [[ $size != 0.1 || $(hash_of) == "$plain" ]] || fault "another mesh with a trace"
done
for stage in planning simplification partition skeleton meshing finishing; do
  grep -q "\"tid\": 0, \"name\": \"$stage\"" "$inputs/0.1.json" || fault "the trace has no stage $stage"
done
(($(grep -c '"name": "meshing".*"task"' "$inputs/0.1.json") == 5)) || fault "not a task for the background and each of 4 pieces"

expect_success simulate "$inputs/0.1.json" --workers 1,2
grep -q "Entire scheme" "$sandbox/stdout" || fault "no times"
grep -qE '^  meshing( +[0-9]+\.[0-9]{2}){2}$' "$sandbox/stdout" || fault "no seconds of a stage by one worker and by two"
grep -q "^With 2 workers [a-z ]* takes longest$" "$sandbox/stdout" || fault "no longest stage"
grep -q "Table 9" "$sandbox/stdout" && fault "the paper's table beside a small mesh"
expect_success simulate "$inputs/0.1.json" "$inputs/0.06.json" --elements 1e9 --workers 32,512
grep -qE '^    not spread( +[0-9]+\.[0-9]{2}){2}$' "$sandbox/stdout" || fault "not a word on what no worker shares"
grep -A2 "Table 9" "$sandbox/stdout" | grep -q "2648.7 *219.8" || fault "not the paper's columns"

grep -A4 "Table 9" "$sandbox/stdout" | grep -qE "^    Other steps +2555.1 +159.6$" || fault "not the paper's other steps"

# The entire scheme is without reading and finishing, and the speed is by that.
# made_of STAGES ELEMENTS: a trace of stages, each with its name, beginning and seconds
made_of() {
  local name begin seconds separator=
  echo '{"otherData": {"workers": 1, "elements": '"$2"', "seconds": 60},'
  echo '"traceEvents": ['
  while read -r name begin seconds; do
    echo "$separator"'{"ph": "X", "pid": 0, "tid": 0, "name": "'"${name/_/ }"'", "ts": '"${begin}e6, \"dur\": ${seconds}e6, \"args\": {}}"
    separator=,
  done <<<"${1//  /$'\n'}"
  echo ']}'
}
stages="geometry 0 10  planning 10 5  recursive_bisection 15 3  meshing 18 20  finishing 38 7  reading_back 45 15"
made_of "$stages" 280000 >"$inputs/stages.json"
expect_success simulate "$inputs/stages.json" --workers 1
for row in "Entire scheme \(s\) +28.00" "  Domain decomposition +8.00" "  Other steps +20.00" "Reading and finishing \(s\) +32.00" \
  "Relative speed \(elements/s/worker\) +10.0 k"; do
  grep -qE "^  $row$" "$sandbox/stdout" || fault "no row '$row'"
done

# The memory of a node, where the trace says what it goes with.
grep -q '"largest_piece": [1-9]' "$inputs/0.1.json" || fault "the trace does not say how large a piece is"
grep -q "Memory" "$sandbox/stdout" && fault "memory that was not asked for"
expect_success simulate "$inputs/0.1.json" --workers 1,4 --cores-per-node 4 --memory-per-node 0.09
memory_of() { sed -n "s/^ *$1 *\([0-9.]*\) *\([0-9.]*\)\$/\1 \2/p" "$sandbox/stdout"; }
[[ $(memory_of "ranks of one worker") == "0.03 0.10" ]] || fault "four ranks need '$(memory_of "ranks of one worker")' GB"
[[ $(memory_of "one rank") == "0.03 0.03" ]] || fault "one rank needs '$(memory_of "one rank")' GB"
[[ $(grep "more than its" "$sandbox/stdout") == "With 4 workers, ranks of one worker on a node, more than its 0.09 GB" ]] ||
  fault "not the one number of workers that is too much"
expect_success simulate "$inputs/0.1.json" "$inputs/0.06.json" --elements 1e9 --workers 64 --cores-per-node 32
grep -q "with up to 32 workers" "$sandbox/stdout" || fault "no memory for another size"
sed 's/, "background_elements.*}/}/' "$inputs/0.1.json" >"$inputs/older.json"
expect_success simulate "$inputs/older.json" --cores-per-node 4
grep -q "Memory of a node: not known" "$sandbox/stdout" || fault "memory from a trace without sizes"
expect_usage_error "cores-per-node" simulate "$inputs/0.1.json" --memory-per-node 4

made_of "geometry 0 10  finishing 10 5" 280000 >"$inputs/no_scheme.json"
made_of "$stages" 0 >"$inputs/no_elements.json"
sed 's/"subject": "[^"]*"/"subject": "another.step"/' "$inputs/0.06.json" >"$inputs/another.json"
expect_success simulate "$inputs/0.1.json" "$inputs/another.json" --elements 1e9
grep -q "^warning: the traces are of cube.off and of another.step" "$sandbox/stderr" || fault "not a word on traces of two models"
expect_success simulate "$inputs/0.1.json" "$inputs/0.06.json" --elements 1e9
grep -q "^warning" "$sandbox/stderr" && fault "a warning of traces of one model"
expect_usage_error "give --elements or one trace" simulate "$inputs/0.1.json" "$inputs/0.06.json"
expect_error "no stage of the entire scheme" simulate "$inputs/no_scheme.json"
expect_error "made no elements" simulate "$inputs/no_elements.json"
expect_usage_error "give a smaller and a larger one" simulate "$inputs/0.1.json" --elements 1e9
expect_error "at least 1.5 times" simulate "$inputs/0.1.json" "$inputs/0.1.json" --elements 1e9
expect_usage_error "workers" simulate "$inputs/0.1.json" --workers 0
echo '{}' >"$inputs/none.json"
expect_error 'none.json:1: there is no "otherData"' simulate "$inputs/none.json"
expect_error "nowhere.json: cannot be opened" simulate nowhere.json
expect_error "cannot create" mesh "$inputs/cube.off" --size 0.1 --trace "$inputs/cube.off/trace.json"

finish
