# Sourced by the tests of the driver. $driver is the binary; every run happens in a fresh, empty folder.

problems=0
sandbox=$(mktemp -d)
trap 'chmod -R u+w "$sandbox"; rm -rf "$sandbox"' EXIT
inputs=$sandbox/inputs
mkdir "$inputs"

# The unit cube as triangles, OFF.
write_cube() {
  echo "OFF"
  echo "8 12 0"
  printf '%s\n' "0 0 0" "1 0 0" "1 1 0" "0 1 0" "0 0 1" "1 0 1" "1 1 1" "0 1 1"
  printf '3 %s\n' "0 2 1" "0 3 2" "4 5 6" "4 6 7" "0 1 5" "0 5 4" "2 3 7" "2 7 6" "1 2 6" "1 6 5" "0 4 7" "0 7 3"
}

fault() {
  echo "FAULT in '$what': $1"
  sed 's/^/  stdout: /' "$sandbox/stdout" | head -n 20
  sed 's/^/  stderr: /' "$sandbox/stderr" | head -n 20
  problems=$((problems + 1))
}

# run_driver <arguments...>: sets $status; output in $sandbox/stdout and $sandbox/stderr.
run_driver() {
  what="dovetail $*"
  rm -rf "$sandbox/work"
  mkdir "$sandbox/work"
  (cd "$sandbox/work" && timeout 1000 "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
}

# expect_error <expression> <arguments...>: the driver refuses with one clear line that matches, and leaves nothing.
expect_error() {
  local expression=$1
  shift
  run_driver "$@"
  local lines
  lines=$(grep -c '^dovetail: ' "$sandbox/stderr")
  ((status == 1 || status == 2)) || fault "exit code is $status"
  ((lines == 1)) || fault "there are $lines lines that begin with 'dovetail: '"
  tail -n 1 "$sandbox/stderr" | grep -qiE -- "$expression" || fault "the last line does not match '$expression'"
  local left
  left=$(cd "$sandbox/work" && find . -type f)
  [[ -z $left ]] || fault "left behind: $left"
}

# expect_usage_error <expression> <arguments...>: the same for a command line that is wrong whatever the files hold.
expect_usage_error() {
  expect_error "$@"
  ((status == 2)) || fault "exit code is $status, not 2"
}

# children <process>: sets $found to those of all its threads, from several of which Open MPI 5 starts ranks. No program is
# started for it, since what is looked for may end soon.
children() {
  local of_thread list
  found=
  for list in /proc/"$1"/task/*/children; do
    of_thread=
    { read -r of_thread <"$list"; } 2>/dev/null
    found+=${of_thread:+${found:+ }$of_thread}
  done
}

# expect_success <arguments...>
expect_success() {
  run_driver "$@"
  ((status == 0)) || fault "exit code is $status"
}

# at_interfaces: what the report has of the elements at interfaces, on one line; nothing where it has nothing.
at_interfaces() {
  tr -d ' \n' <"$sandbox/work/report.json" |
    grep -o '"at_interfaces":{"touching":{[^}]*},"next_ring":{[^}]*},"rest":{[^}]*}}'
}
# without_angles: of such figures, those that do not depend on the order of elements and of their vertices.
without_angles() {
  sed -E 's/"(mean_)?min_dihedral_deg":[^,]*,//g'
}
# rows_at_interfaces: what the driver has printed of them.
rows_at_interfaces() {
  sed -n '/^Elements at interfaces/,/^  All others/p' "$sandbox/stdout"
}
# expect_at_interfaces <figures> <rows> <mesh>: check and stats say of a mesh what the run that wrote it said.
expect_at_interfaces() {
  [[ $1 == *'"touching":{"elements":'[1-9]* && $2 == *"Touching one"*"All others"* ]] || fault "the run has no figures at interfaces"
  expect_success check "$3"
  [[ $(rows_at_interfaces) == "$2" ]] || fault "other rows at interfaces than the run's"
  expect_success stats "$3" --report report.json
  [[ $(rows_at_interfaces) == "$2" ]] || fault "other rows at interfaces than the run's"
  [[ $(at_interfaces) == "$1" ]] || fault "other figures at interfaces than the run's: $(at_interfaces)"
}
# expect_no_interfaces <mesh>: so it is with a mesh of one piece.
expect_no_interfaces() {
  expect_success check "$1"
  grep -q "at interfaces" "$sandbox/stdout" && fault "interfaces in a mesh of one piece"
  expect_success stats "$1" --report report.json
  grep -q "at interfaces" "$sandbox/stdout" && fault "interfaces in a mesh of one piece"
  [[ -z $(at_interfaces) ]] || fault "interfaces in the report of a mesh of one piece"
}

# now: in milliseconds.
now() {
  local microseconds=${EPOCHREALTIME/./}
  echo $((microseconds / 1000))
}

# expect_soon <milliseconds> <limit>: what took so long took less than the limit, on a machine that starts the program within
# 400 ms; one that is slower, or busy, has more in proportion.
expect_soon() {
  (($1 < $2)) && return
  local begin start
  begin=$(now)
  "$driver" --version >/dev/null
  start=$(($(now) - begin))
  (($1 * 400 < $2 * start)) || fault "it took $1 ms, of a program that starts in $start ms"
}

# wait_for_process [<seconds>]: waits for the process $process, whose exit code is $status then, and which ends so soon.
wait_for_process() {
  local tenths begin
  begin=$(now)
  for ((tenths = 0; tenths < 10000; ++tenths)); do
    kill -0 $process 2>/dev/null || break
    sleep 0.1
  done
  kill -0 $process 2>/dev/null && fault "it has not ended within 1000 s" && kill -9 $process
  wait $process 2>/dev/null
  status=$?
  [[ -z ${1:-} ]] || expect_soon $(($(now) - begin)) $((1000 * $1))
}

finish() {
  ((problems == 0)) && echo "as expected"
  exit $((problems > 0))
}
