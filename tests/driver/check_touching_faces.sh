#!/bin/bash
# CAD models that touch themselves, or nearly do: joined where their surfaces cross, or on demand.
#   check_touching_faces.sh <driver> <write_rings>
driver=$1
source "$(dirname "$0")/expectations.sh"
"$2" "$inputs" || exit 1

figure() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}
# mesh <file> <options...>: a run whose mesh is valid; leaves $hash.
mesh() {
  expect_success mesh "$inputs/$1" -s 0.4 --report report.json "${@:2}"
  "$driver" check "$sandbox/work/out" >"$sandbox/checked" 2>&1 || fault "$(cat "$sandbox/checked")"
  awk -v least="$(figure min_dihedral_deg)" 'BEGIN { exit !(least > 12) }' ||
    fault "the least angle is $(figure min_dihedral_deg)"
  hash=$(figure mesh_hash)
}
warned() { # expression
  grep -qE -- "$1" "$sandbox/work/report.json"
}

mesh touching.brep
warned "surfaces cross where they touch, so faces that do were made one there: see --join" ||
  fault "no warning says that faces were joined"
joined=$hash
(cd "$sandbox/work" && "$driver" mesh "$inputs/touching.brep" -s 0.4 --resume) >"$sandbox/stdout" 2>"$sandbox/stderr" ||
  fault "a finished run is not resumed"
grep -q "nothing is left to do" "$sandbox/stdout" || fault "a finished run is made again"

mesh touching.brep --workers 1 --subdomains 1
[[ $hash == "$joined" ]] || fault "the mesh depends on the number of workers"
mesh touching.brep --join 0
[[ $hash == "$joined" ]] || fault "the mesh depends on who asks for the joining"
warned "surfaces cross" && fault "a warning tells of what was asked for"
"$driver" adapt "$sandbox/work/out" -s 0.5 -o "$sandbox/work/next.vtu" >"$sandbox/stdout" 2>"$sandbox/stderr" ||
  fault "the mesh of a joined model cannot be adapted"
grep -q "on the model .*touching.brep" "$sandbox/stdout" || fault "it is not adapted on its model"
mesh touching.brep --subdomains 4
mesh touching.brep --dimension 2 --subdomains 1
expect_success plan "$inputs/touching.brep"

mesh slit.brep
open=$hash
mesh slit.brep --join 1e-5
[[ $hash == "$open" ]] || fault "a slit wider than the length is closed"
mesh slit.brep --join 1e-3
[[ $hash != "$open" ]] || fault "a slit narrower than the length stays"

mesh pin.brep
grep -q '"what": "narrow face"' "$sandbox/work/report.json" || fault "the bottom of the gap is not left out"
warned "surfaces cross" && fault "the walls of the gap cross"
mesh pin.brep --keep-all
warned "surfaces cross, so faces nearer than [0-9.e-]+ to each other were made one there: see --join" ||
  fault "no warning says that the gap was closed"

expect_error "the surfaces of face [0-9]+ and face [0-9]+ cross, also when refined" mesh "$inputs/crossing.brep" -s 0.4
mesh pin.brep --join 1e-3
warned "changes nothing" && fault "a warning says that nothing was joined"
mesh slit.brep --join 1e-6
warned "--join 1e-06 changes nothing" || fault "no warning says that nothing was joined"
write_cube >"$inputs/cube.off"
expect_usage_error "--join: .*cube.off is no CAD file" mesh "$inputs/cube.off" --join 1
expect_usage_error "--join: a built-in model has no faces to join" mesh --join 1
expect_usage_error "--join: -1 is not a length; give a positive number or 0" mesh "$inputs/slit.brep" --join -1

((problems == 0)) || exit 1
