#!/bin/bash
# Standard streams that are closed, names that are no UTF-8, and too little memory or stack: a run goes well, or says
# what it wants.
#   check_surroundings.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"
write_cube >"$inputs/cube.off"
coarse=(--size 0.5 --subdomains 2 --workers 2 --quiet)
place=$sandbox/place

# Any of the three closed, as daemons start programs: the same mesh.
rm -rf "$place" && mkdir "$place" && cd "$place" || exit 1
mesh=(mesh "$inputs/cube.off" "${coarse[@]}" --format vtu,msh)
"$driver" "${mesh[@]}" --out whole --report whole.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "no mesh"
hash=$(grep mesh_hash whole.json)
for closed in "<&-" ">&-" "2>&-" "<&- >&-" "<&- 2>&-" ">&- 2>&-" "<&- >&- 2>&-"; do
  what="dovetail mesh, with $closed"
  : >"$sandbox/stdout" && : >"$sandbox/stderr"
  rm -rf out report.json
  eval "\"\$driver\" \"\${mesh[@]}\" --out out --report report.json --trace trace.json $closed"
  status=$?
  ((status == 0)) || fault "exit code is $status"
  [[ $(grep mesh_hash report.json) == "$hash" ]] || fault "not the same mesh"
  "$driver" check --report report.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "not the files of the report"
done

# Bytes that are no UTF-8, in all names.
odd=$'f\xfc\xff\n'
what="names that are no UTF-8"
cp "$inputs/cube.off" "$odd.off"
is_json() { python3 -c 'import json, sys; json.load(open(sys.argv[1].encode("utf-8", "surrogateescape"), encoding="utf-8"))' "$1" || fault "no JSON"; }
"$driver" mesh "$odd.off" "${coarse[@]}" --out "$odd" --report "$odd.json" --trace "$odd.trace" \
  >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "no mesh"
is_json "$odd.json"
is_json "$odd.trace"
"$driver" check --report "$odd.json" >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "its files are not found by the report"
mkdir inner && "$driver" mesh "$odd.off" "${coarse[@]}" --out "$odd" --report inner/report.json \
  >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "no mesh"
is_json inner/report.json
"$driver" check --report inner/report.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "its files are not found by the report"
"$driver" plan "$odd.off" --size 0.5 --report plan.json >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "no plan"
is_json plan.json
"$driver" compare "$odd.off" --size 0.5 --workers 1 --quiet --out compared >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "no comparison"
python3 -c 'open("compared/compare.html", encoding="utf-8").read()' || fault "the page is no UTF-8"

# Under a limit to memory or stack nobody else is blamed. Whether a run needs more depends on the machine.
{
  printf '%s\n' "ISO-10303-21;" "HEADER;" "FILE_DESCRIPTION((''),'2;1');" "FILE_NAME('','',(''),(''),'','','');" \
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));" "ENDSEC;" "DATA;"
  seq 300000 | sed "s/.*/#&=CARTESIAN_POINT('',(0.,0.,0.));/"
  printf '%s\n' "ENDSEC;" "END-ISO-10303-21;"
} >large.step
# The least that the program starts with, and more in steps.
least=100000
until (ulimit -v $least && "$driver" models) >/dev/null 2>&1; do least=$((least + 5000)); done
told=0
for more in 1000 10000 20000 40000 60000; do
  what="dovetail mesh large.step, ulimit -v $((least + more))"
  (ulimit -v $((least + more)) && "$driver" mesh large.step --size 1 --out o --quiet) >"$sandbox/stdout" 2>"$sandbox/stderr"
  grep -E "damaged|truncated|export it again|crashed" "$sandbox/stderr" | grep -qv "want of memory" && fault "the file is blamed"
  grep -qiE "memory" "$sandbox/stderr" && told=$((told + 1))
done
((told >= 3)) || fault "that memory is short is not said"
what="dovetail mesh, ulimit -s"
told=0
for kilobytes in 64 80 100 150 200; do
  (ulimit -s $kilobytes && "$driver" mesh "$inputs/cube.off" --size 0.05 --subdomains 4 --out o --quiet) >"$sandbox/stdout" 2>"$sandbox/stderr"
  status=$?
  grep -qE "damaged|crashed|signal 11|give another size" "$sandbox/stderr" && fault "with $kilobytes KB another is blamed"
  ((status == 0)) || ! grep -q "ulimit -s" "$sandbox/stderr" || told=$((told + 1))
done
((told >= 1)) || fault "that stack is short is not said"
cd / && finish
