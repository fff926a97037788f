#!/bin/bash
# The process that reads a CAD file is killed: it is read again, once; killed then too, one line tells it.
#   check_killed_reading.sh <driver> [mpirun]
driver=$1
source "$(dirname "$0")/expectations.sh"
cd "$sandbox" || exit 1
file=$inputs/cube.step
mesh=(mesh "$file" --size 0.5 --subdomains 2 --report report.json --rank-group 1) # each rank reads it

# The unit cube, and many points of no use, with which reading takes a while.
write_step() {
  awk 'BEGIN {
    print "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((~~),~2;1~);\nFILE_NAME(~~,~~,(~~),(~~),~~,~~,~~);"
    print "FILE_SCHEMA((~AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }~));\nENDSEC;\nDATA;"
    for (v = 0; v < 8; ++v) {
      at[v] = v % 2 ".," int(v / 2) % 2 ".," int(v / 4) "."
      print "#" 100 + v "=CARTESIAN_POINT(~~,(" at[v] "));"
      print "#" 110 + v "=VERTEX_POINT(~~,#" 100 + v ");"
    }
    split("1.,0.,0. 0.,1.,0. 0.,0.,1. -1.,0.,0. 0.,-1.,0. 0.,0.,-1.", direction, " ")
    for (d = 1; d <= 6; ++d)
      print "#" 120 + d "=DIRECTION(~~,(" direction[d] "));"
    for (d = 1; d <= 3; ++d)
      print "#" 130 + d "=VECTOR(~~,#" 120 + d ",1.);"
    for (v = 0; v < 8; ++v)
      for (d = 1; d <= 3; ++d)
        if (int(v / 2 ^ (d - 1)) % 2 == 0) {
          e = 200 + 10 * v + d
          print "#" 100 + e "=LINE(~~,#" 100 + v ",#" 130 + d ");"
          print "#" e "=EDGE_CURVE(~~,#" 110 + v ",#" 110 + v + 2 ^ (d - 1) ",#" 100 + e ",.T.);"
          edge[v, v + 2 ^ (d - 1)] = e
        }
    faces = split("1,3,7,5,1 2,6,7,3,2 4,5,7,6,3 0,4,6,2,4 0,1,5,4,5 0,2,3,1,6", corners, " ")
    for (f = 1; f <= faces; ++f) {
      split(corners[f], corner, ",")
      for (k = 1; k <= 4; ++k) {
        a = corner[k]; b = corner[k % 4 + 1]
        forward = (a, b) in edge
        print "#" 400 + 10 * f + k "=ORIENTED_EDGE(~~,*,*,#" (forward ? edge[a, b] : edge[b, a]) "," (forward ? ".T." : ".F.") ");"
      }
      loop = loop (f > 1 ? "," : "") "#" 500 + f
      print "#" 520 + f "=EDGE_LOOP(~~,(#" 401 + 10 * f ",#" 402 + 10 * f ",#" 403 + 10 * f ",#" 404 + 10 * f "));"
      print "#" 530 + f "=FACE_OUTER_BOUND(~~,#" 520 + f ",.T.);"
      print "#" 540 + f "=AXIS2_PLACEMENT_3D(~~,#" 100 + corner[1] ",#" 120 + corner[5] ",#" 121 + corner[5] % 3 ");"
      print "#" 550 + f "=PLANE(~~,#" 540 + f ");"
      print "#" 500 + f "=ADVANCED_FACE(~~,(#" 530 + f "),#" 550 + f ",.T.);"
    }
    print "#10=CLOSED_SHELL(~~,(" loop "));\n#11=MANIFOLD_SOLID_BREP(~~,#10);"
    print "#12=ADVANCED_BREP_SHAPE_REPRESENTATION(~~,(#11),#13);"
    print "#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3)REPRESENTATION_CONTEXT(~~,~~));"
    print "#14=PRODUCT(~p~,~p~,~~,(#15));\n#15=PRODUCT_CONTEXT(~~,#16,~mechanical~);"
    print "#16=APPLICATION_CONTEXT(~automotive~);\n#17=PRODUCT_DEFINITION_FORMATION(~~,~~,#14);"
    print "#18=PRODUCT_DEFINITION(~design~,~~,#17,#19);\n#19=PRODUCT_DEFINITION_CONTEXT(~~,#16,~design~);"
    print "#20=PRODUCT_DEFINITION_SHAPE(~~,~~,#18);\n#21=SHAPE_DEFINITION_REPRESENTATION(#20,#12);"
    for (k = 1000; k < 400000; ++k)
      print "#" k "=CARTESIAN_POINT(~~,(0.,0.,0.));"
    print "ENDSEC;\nEND-ISO-10303-21;"
  }' | tr '~' "'"
}

# How the driver is started: by itself, then on two ranks.
starters=("")
[[ ${2:-} ]] && starters+=("$2 -n 2")
hash_of() {
  sed -n 's/^ *"mesh_hash": "\([^"]*\).*/\1/p' "$1/report.json"
}
first_child() { # sets $child
  children "$1"
  child=${found%% *}
}
# The process that supervises one: that of the command, or a relay, which is mpirun's child.
find_supervisor() {
  supervisor=$process
  [[ $starter ]] || return
  children "$process"
  supervisor=${found##* }
}
# Whether it has the file open while another process waits to take its place.
is_reading() {
  first_child "$1"
  spare=$child
  [[ $spare && $(readlink "/proc/$1/fd/"* 2>/dev/null) == *"$file"* ]]
}
# Starts a run and stops it while the file is read: sets $process, $supervisor, $reader and $spare.
stop_in_reading() {
  local tries
  for ((tries = 0; tries < 20; ++tries)); do
    rm -rf several && mkdir several
    (cd several && exec $starter "$driver" "${mesh[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null) &
    process=$!
    while kill -0 $process 2>/dev/null; do
      find_supervisor
      [[ $supervisor ]] || continue
      first_child "$supervisor"
      reader=$child
      [[ $reader ]] && is_reading "$reader" || continue
      kill -STOP "$reader" 2>/dev/null
      is_reading "$reader" && return
      kill -CONT "$reader" 2>/dev/null # it was faster
    done
    wait $process 2>/dev/null
  done
  fault "nobody waits to read the file again"
  finish
}

write_step >"$file"
for starter in "${starters[@]}"; do
  what="${starter:-one process}: undisturbed"
  rm -rf whole && mkdir whole
  (cd whole && $starter "$driver" "${mesh[@]}" >"$sandbox/stdout" 2>"$sandbox/stderr" </dev/null)
  status=$?
  ((status == 0)) || fault "exit code is $status"

  what="${starter:-one process}: killed while it reads"
  stop_in_reading
  kill -KILL "$reader"
  wait_for_process
  ((status == 0)) || fault "exit code is $status"
  grep -q '^dovetail: ' "$sandbox/stderr" && fault "a line of complaint"
  [[ $(hash_of several) && $(hash_of several) == "$(hash_of whole)" ]] || fault "another mesh"

  what="${starter:-one process}: killed while it reads, and so is the next one"
  stop_in_reading
  kill -STOP "$spare"
  kill -KILL "$reader"
  until [[ $(ps -o ppid= -p "$spare") -eq $supervisor ]]; do
    sleep 0.01
  done
  kill -KILL "$spare"
  wait_for_process
  ((status == 1)) || fault "exit code is $status, not 1"
  [[ $(grep -c '^dovetail: ' "$sandbox/stderr") == 1 ]] || fault "not one line of complaint"
  grep -qE "^dovetail: (rank [01]: )?$file: reading and healing with Open CASCADE was killed, perhaps for want of memory" "$sandbox/stderr" ||
    fault "the line does not say what was killed"
  [[ -z $(find several -type f) ]] || fault "left behind: $(find several -type f)"
done
finish
