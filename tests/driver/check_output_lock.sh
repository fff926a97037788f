#!/bin/bash
# Two runs in one folder, or for one file: the second is refused, and names the first.
#   check_output_lock.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
write_cube >"$inputs/cube.off"
place=$sandbox/place
coarse=("$inputs/cube.off" --size 0.5 --subdomains 2 --workers 1 --quiet)

# hold <arguments...>: a run that waits for its sizes, which nobody writes into the pipe before release.
hold() {
  rm -rf "$place" && mkdir "$place" && cd "$place" || exit 1
  [[ -p $sandbox/pipe ]] || mkfifo "$sandbox/pipe"
  "$driver" "$@" >"$sandbox/first" 2>&1 </dev/null &
  first=$!
  exec 9>"$sandbox/pipe" # comes back when it is read
}
release() {
  [[ $1 ]] && echo "$1" >&9
  exec 9>&-
  wait $first 2>/dev/null
  status=$?
}

# refused <expression> <arguments...>
refused() {
  local expression=$1
  shift
  what="dovetail $*, beside another run"
  timeout 1000 "$driver" "$@" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null
  status=$?
  ((status == 1)) || fault "exit code is $status"
  grep -qE -- "^dovetail: $expression: another process \($first\) is writing there" "$sandbox/stderr" || fault "not the line"
}

held=("$inputs/cube.off" --sizing "$sandbox/pipe" --subdomains 2 --workers 1 --quiet)
hold mesh "${held[@]}" --out o --report r.json --trace t.json
ln -s o other
before=$(find . | sort)
refused "--out o" mesh "${coarse[@]}" --out o
refused "--out $place/other" mesh "${coarse[@]}" --out "$place/other" --resume
refused "--report o/../r.json" mesh "${coarse[@]}" --out p --report o/../r.json
refused "--report t.json" plan "$inputs/cube.off" --size 0.5 --report t.json
refused "--out o" compare "$inputs/cube.off" --size 0.5 --out o
[[ $(find . | sort) == "$before" ]] || fault "something has changed: $(diff <(echo "$before") <(find . | sort))"
release '{"size": 0.5}'
what="the first run"
((status == 0)) || fault "exit code is $status: $(cat "$sandbox/first")"
[[ -s r.json && -s t.json && -s o/mesh.pvtu ]] || fault "its files are not there"
"$driver" check --report r.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "its files are not as it wrote them"
[[ -z $(find . -name '*.part') ]] || fault "parts are left"
what="a run after it"
"$driver" mesh "${coarse[@]}" --out o --report r.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "refused"

# A spool that two folders share.
hold mesh "${held[@]}" --out o --spool s
refused "--spool s/rank_0" mesh "${coarse[@]}" --out p --spool s
[[ ! -e p ]] || fault "a folder is left"
release '{"size": 0.5}'
((status == 0)) || fault "exit code is $status"

# Neither a run that was killed nor one that was stopped is in the way, however they left things.
for signal in KILL TERM; do
  hold mesh "${held[@]}" --out o --report r.json
  kill -$signal $first
  release
  what="a run after SIG$signal"
  "$driver" mesh "${coarse[@]}" --out o --report r.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "refused"
  [[ -s r.json && -z $(find . -name '*.part') ]] || fault "not the files of a run"
done

# Who is refused leaves what the other has begun, also when it is stopped at once.
hold mesh "${held[@]}" --out o --report r.json
mkdir -p o/unfinished/0 && echo begun >o/unfinished/0/mesh_0000.vtu.part && echo begun >o/mesh.msh.part
refused "--out o" mesh "${coarse[@]}" --out o --report r.json
[[ -s o/unfinished/0/mesh_0000.vtu.part && -s o/mesh.msh.part && -e r.json.part ]] || fault "parts of the other are gone"
rm -r o/unfinished o/mesh.msh.part
release '{"size": 0.5}'
((status == 0)) || fault "exit code is $status"
cd / && finish
