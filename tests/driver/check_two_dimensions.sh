#!/bin/bash
# Triangles: plane domains from every kind of file, sheets, and what is wrong with such files.
#   check_two_dimensions.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

figure() { # key of the report
  sed -n "s/^ *\"$1\": \"\\?\\([^\",]*\\)\"\\?,\\?\$/\\1/p" "$sandbox/work/report.json" | head -n 1
}
# mesh <file> <options...>: a run whose mesh is valid by our own checker.
mesh() {
  expect_success mesh "$inputs/$1" --dimension 2 --report report.json "${@:2}"
  elements=$(figure elements)
  hash=$(figure mesh_hash)
  boundary=$(figure boundary_triangles)
  [[ $(figure dimension) == 2 ]] || fault "the dimension is $(figure dimension)"
  if [[ -e $sandbox/work/out/mesh.pvtu ]]; then
    "$driver" check "$sandbox/work/out" >"$sandbox/checked" 2>&1
    grep -q "a valid mesh of $elements triangles" "$sandbox/checked" || fault "$(cat "$sandbox/checked")"
  fi
}
about() { # value, expected: within 5 percent
  ((100 * $1 >= 95 * $2 && 100 * $1 <= 105 * $2)) || fault "$1, not about $2"
}

# One domain, a square of 9 with a square hole of 3 and an inner line, in three kinds of files.
cat >"$inputs/domain.svg" <<'SVG'
<svg xmlns="http://www.w3.org/2000/svg">
<path d="M0 0 L9 0 L9 9 L0 9 Z M3 3 L6 3 L6 6 L3 6 Z"/>
<path fill="none" d="M1 1 L2 8"/>
</svg>
SVG
printf '%s\n' 'polygon outer' '0 0' '9 0' '9 9' '0 9' 'polygon hole' '3 3' '6 3' '6 6' '3 6' 'line crack' '1 1' '2 8' \
  >"$inputs/domain.txt"

# A plane face with a hole as CAD systems write it: a STEP file with an open shell.
entity=100
put() { # entity: its number is left in $entity
  ((++entity))
  echo "#$entity=$1;"
}
step_loop() { # corners "x,y", the face on their left: the loop's number is left in $entity
  local -a points=() vertices=() oriented=()
  local corner k next
  for corner in "$@"; do
    put "CARTESIAN_POINT('',(${corner%,*}.,${corner#*,}.,0.))"
    points+=("$entity")
    put "VERTEX_POINT('',#$entity)"
    vertices+=("$entity")
  done
  for ((k = 0; k < $#; ++k)); do
    next=$(((k + 1) % $#))
    local a=("${@:k+1:1}") b=("${@:next+1:1}")
    put "DIRECTION('',($((${b%,*} - ${a%,*})).,$((${b#*,} - ${a#*,})).,0.))"
    put "VECTOR('',#$entity,1.)"
    put "LINE('',#${points[k]},#$entity)"
    put "EDGE_CURVE('',#${vertices[k]},#${vertices[next]},#$entity,.T.)"
    put "ORIENTED_EDGE('',*,*,#$entity,.T.)"
    oriented+=("#$entity")
  done
  put "EDGE_LOOP('',($(IFS=,; echo "${oriented[*]}")))"
}
step_face() {
  cat <<'STEP'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(0.,0.,0.));
#2=DIRECTION('',(0.,0.,1.));
#3=DIRECTION('',(1.,0.,0.));
#4=AXIS2_PLACEMENT_3D('',#1,#2,#3);
#5=PLANE('',#4);
#11=(GEOMETRIC_REPRESENTATION_CONTEXT(3)REPRESENTATION_CONTEXT('',''));
#12=APPLICATION_CONTEXT('automotive');
#13=PRODUCT_CONTEXT('',#12,'mechanical');
#14=PRODUCT('plate','plate','',(#13));
#15=PRODUCT_DEFINITION_FORMATION('','',#14);
#16=PRODUCT_DEFINITION_CONTEXT('',#12,'design');
#17=PRODUCT_DEFINITION('design','',#15,#16);
#18=PRODUCT_DEFINITION_SHAPE('','',#17);
STEP
  step_loop 0,0 9,0 9,9 0,9
  put "FACE_OUTER_BOUND('',#$entity,.T.)"
  local outer=$entity
  step_loop 3,3 3,6 6,6 6,3
  put "FACE_BOUND('',#$entity,.T.)"
  put "ADVANCED_FACE('',(#$outer,#$entity),#5,.T.)"
  put "OPEN_SHELL('',(#$entity))"
  put "SHELL_BASED_SURFACE_MODEL('',(#$entity))"
  put "MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#$entity),#11)"
  put "SHAPE_DEFINITION_REPRESENTATION(#18,#$entity)"
  printf 'ENDSEC;\nEND-ISO-10303-21;\n'
}
step_face >"$inputs/plate.step"

# 72 of area, at triangles of 0.3: the same number from each file, on a boundary of 48 / 0.3 edges.
mesh domain.svg --size 0.3 --subdomains 4 --workers 2
drawn=$elements
((drawn > 1600 && drawn < 2300)) || fault "$drawn triangles"
about "$boundary" 160
[[ $(figure subdomains) == 4 ]] || fault "$(figure subdomains) subdomains"
(cd "$sandbox/work/out" && ls) >"$sandbox/listing"
diff "$sandbox/listing" - <<<$'finished_run.txt\nlines.vtp\nmesh.pvtu\nmesh_0000.vtu\nmesh_0001.vtu\nmesh_0002.vtu\nmesh_0003.vtu' ||
  fault "other files than expected"
drawing_hash=$hash
formats=vtu,pvtu
"$driver" mesh --help | grep -q "hdf5" && formats+=,hdf5,xdmf,vtkhdf
mesh domain.svg --size 0.3 --subdomains 4 --ranks 2 --format $formats
[[ $hash == "$drawing_hash" ]] || fault "another mesh for ranks"
of_run=$(at_interfaces)
rows_of_run=$(rows_at_interfaces)
mv "$sandbox/work/out" "$inputs/pieces"
for file in "$inputs"/pieces/{mesh.pvtu,mesh.xdmf,ranks.pvtu,ranks.xdmf,ranks.vtkhdf}; do
  [[ ! -e $file ]] || expect_at_interfaces "$of_run" "$rows_of_run" "$file"
done
mesh domain.svg --size 0.3 --subdomains 1
mv "$sandbox/work/out" "$inputs/one_piece"
expect_no_interfaces "$inputs/one_piece/mesh.pvtu"
mesh domain.svg --size 0.3 --subdomains 4 --executor serial --format none
[[ $hash == "$drawing_hash" ]] || fault "another mesh without workers"
mesh domain.svg --size 0.3 --subdomains 4 --executor threads --workers 2 --format msh
[[ $hash == "$drawing_hash" ]] || fault "another mesh by threads"
cp "$sandbox/work/out/mesh.msh" "$inputs"
expect_success check "$inputs/mesh.msh"
grep -q "a valid mesh of $drawn triangles" "$sandbox/stdout" || fault "mesh.msh has other counts"
expect_no_interfaces "$inputs/mesh.msh"
mesh domain.txt --size 0.3 --subdomains 4
[[ $hash == "$drawing_hash" ]] || fault "another mesh from the list of polygons than from the drawing"
mesh plate.step --size 0.3 --subdomains 4
about "$elements" "$drawn"
about "$boundary" 160

# Curves, sizes that vary, figures without a mesh.
printf '<svg><path d="M-5 0 A5 5 0 0 1 5 0 A5 5 0 0 1 -5 0 Z"/></svg>\n' >"$inputs/disc.svg"
mesh disc.svg --size 0.3
about "$boundary" 102
coarse=$elements
printf '%s' '{"size": 0.3, "sources": [{"type": "point", "at": [2, 0, 0], "inner_radius": 0.5, "outer_radius": 1,
  "spacing": 0.05}]}' >"$inputs/near.json"
mesh disc.svg --sizing "$inputs/near.json"
((elements > coarse + 400)) || fault "$elements triangles with a source, $coarse without"
expect_success plan "$inputs/domain.svg" --dimension 2 --size 0.3
grep -q "No. of triangles" "$sandbox/stdout" || fault "no prediction"

# Curved faces: how far triangles are from them, in units of the local size, per face and the largest of all.
expect_success mesh --model orbiter --dimension 2 --size 20 --format none --report report.json
deviations=$(sed -n '/^  "deviation"/,/^  }/s/.*"\(points\|centres\)": \([0-9.e+-]*\),\?$/\1 \2/p' "$sandbox/work/report.json")
awk '$2 > largest[$1] { largest[$1] = $2 } NR <= 2 { said[$1] = $2 }
  END { exit !(said["points"] > 0 && said["points"] < 1e-3 && said["centres"] > 0.05 && said["centres"] < 0.5 &&
               largest["points"] == said["points"] && largest["centres"] == said["centres"] && NR == 2 + 2 * 23) }' \
  <<<"$deviations" || fault "the deviations are $deviations"

# A sheet: the unit cube without its lid.
{
  printf '%s\n' OFF "8 10 0" "0 0 0" "1 0 0" "1 1 0" "0 1 0" "0 0 1" "1 0 1" "1 1 1" "0 1 1"
  printf '3 %s\n' "0 2 1" "0 3 2" "0 1 5" "0 5 4" "2 3 7" "2 7 6" "1 2 6" "1 6 5" "0 4 7" "0 7 3"
} >"$inputs/sheet.off"
mesh sheet.off --size 0.1 --subdomains 3
grep -q "sheet.off: the surface is open: 4 edges" "$sandbox/stdout" || fault "its boundary is not warned of"
about "$elements" 1450
expect_error "sheet.off: the surface is open: 4 edges" mesh "$inputs/sheet.off"
expect_error "plate.step.*no solid" mesh "$inputs/plate.step"

# Files with faults: the message names the file, and the path or polygon with the place.
svg() { printf '<svg><path d="%s"/></svg>\n' "$2" >"$inputs/$1.svg"; }
list() { printf '%s\n' "${@:2}" >"$inputs/$1.txt"; }
refused() { # file, expression
  expect_error "$1: $2" mesh "$inputs/$1" --dimension 2
}
svg open 'M0 0 L9 0 L9 9'
refused open.svg "path is open: it starts at \(0.* and ends at \(9"
svg bow 'M0 0 L9 9 L9 0 L0 9 Z'
refused bow.svg "polygon 0 crosses itself: segments .* near \(4.5"
list bow 'polygon wing' '0 0' '9 9' '9 0' '0 9'
refused bow.txt "polygon 0 'wing' crosses itself"
list crossing 'polygon outer' '0 0' '9 0' '9 9' '0 9' 'polygon hole' '3 3' '6 3' '6 12' '3 12'
refused crossing.txt "polygon 0 'outer' and polygon 1 'hole' meet at .* near \((3|6), 9\)"
list leaving 'polygon outer' '0 0' '9 0' '9 9' '0 9' 'line crack' '5 5' '12 5'
refused leaving.txt ".*'crack'"
list two 'polygon outer' '0 0' '9 0'
refused two.txt "polygon 0 'outer' has 2 points"
list only_line 'line crack' '0 0' '9 0'
refused only_line.txt "there is no polygon"
list number 'polygon outer' '0 0' '9 zero' '9 9'
expect_error "number.txt, line 3: two numbers" mesh "$inputs/number.txt" --dimension 2
: >"$inputs/empty.svg"
: >"$inputs/empty.txt"
refused empty.svg "the file is empty"
refused empty.txt "the file is empty"
refused missing.svg "there is no such file"
refused missing.txt "there is no such file"
sed 's/#5=PLANE.*//' "$inputs/plate.step" >"$inputs/no_surface.step"
expect_error "no_surface.step" mesh "$inputs/no_surface.step" --dimension 2

# Options that make no sense.
for size in 0 -1 nan inf 1e9 1e-12 nonsense; do
  expect_error "--size.*$size|--size.*1e\+09" mesh "$inputs/domain.svg" --dimension 2 --size $size
done
expect_error "--subdomains: 0" mesh "$inputs/domain.svg" --dimension 2 --subdomains 0
expect_error "--dimension" mesh "$inputs/domain.svg" --dimension 4
expect_error "--mesher .*there is no 'tetgen'; there are: native" mesh "$inputs/domain.svg" --dimension 2 --mesher tetgen
finish
