#!/bin/bash
# Files that are missing, empty, truncated, foreign or malformed.
#   check_bad_files.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

: >"$inputs/empty"
head -c 4000 /dev/urandom >"$inputs/noise"
printf 'this is a letter, not a mesh\n' >"$inputs/letter"
mkdir "$inputs/folder"

# Every kind of model and mesh file, broken in every way.
for extension in step stp igs brep stl obj off ply; do
  expect_error "missing.$extension" mesh "$inputs/missing.$extension"
  for kind in empty noise letter folder; do
    cp -r "$inputs/$kind" "$inputs/$kind.$extension"
    expect_error "$kind.$extension" mesh "$inputs/$kind.$extension"
  done
done
for extension in vtu pvtu msh; do
  for command in check stats; do
    expect_error "missing.$extension" $command "$inputs/missing.$extension"
    for kind in empty noise letter folder; do
      cp -r "$inputs/$kind" "$inputs/$kind.$extension"
      expect_error "$kind.$extension" $command "$inputs/$kind.$extension"
    done
  done
  expect_error "missing.$extension" improve "$inputs/missing.$extension" --out better.vtu
done
cp "$inputs/letter" "$inputs/letter.txt"
expect_error "letter.txt" check "$inputs/letter.txt"
expect_error "folder" check "$inputs/folder"
expect_error "better.png.*extension" improve "$inputs/letter" --out better.png

# CAD files that begin well.
cat >"$inputs/truncated.step" <<'STEP'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('part','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(0.,0.,0.));
#2=
STEP
expect_error "truncated.step" mesh "$inputs/truncated.step"
{ head -n 8 "$inputs/truncated.step"; printf 'ENDSEC;\nEND-ISO-10303-21;\n'; } >"$inputs/no_solid.step"
expect_error "no_solid.step" mesh "$inputs/no_solid.step"
printf 'DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 1\n' >"$inputs/truncated.brep"
expect_error "truncated.brep" mesh "$inputs/truncated.brep"
# Open CASCADE crashes on a surface whose control point is missing.
cat >"$inputs/dangling.step" <<'STEP'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(0.,0.,0.));
#2=CARTESIAN_POINT('',(1.,0.,0.));
#3=CARTESIAN_POINT('',(0.,1.,0.));
#5=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((#1,#2),(#3,#4)),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);
#6=VERTEX_POINT('',#1);
#7=VERTEX_LOOP('',#6);
#8=FACE_BOUND('',#7,.T.);
#9=ADVANCED_FACE('',(#8),#5,.T.);
#10=CLOSED_SHELL('',(#9));
#11=MANIFOLD_SOLID_BREP('',#10);
#12=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#11),#13);
#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3)REPRESENTATION_CONTEXT('',''));
#14=PRODUCT('p','p','',(#15));
#15=PRODUCT_CONTEXT('',#16,'mechanical');
#16=APPLICATION_CONTEXT('automotive');
#17=PRODUCT_DEFINITION_FORMATION('','',#14);
#18=PRODUCT_DEFINITION('design','',#17,#19);
#19=PRODUCT_DEFINITION_CONTEXT('',#16,'design');
#20=PRODUCT_DEFINITION_SHAPE('','',#18);
#21=SHAPE_DEFINITION_REPRESENTATION(#20,#12);
ENDSEC;
END-ISO-10303-21;
STEP
for dimension in 2 3; do
  expect_error "dangling.step" mesh "$inputs/dangling.step" --dimension $dimension
done

# Surfaces of triangles.
facet() { printf 'facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n' "$@"; }
tetrahedron() { # its four facets, with a shift along x
  local a="$1 0 0" b="$(($1 + 1)) 0 0" c="$1 1 0" d="$1 0 1"
  facet "$a" "$c" "$b"
  facet "$a" "$b" "$d"
  facet "$b" "$c" "$d"
  facet "$c" "$a" "$d"
}
{ echo "solid open"; tetrahedron 0 | head -n 21; echo "endsolid"; } >"$inputs/open.stl"
expect_error "open.stl: the surface is open: 3 edges" mesh "$inputs/open.stl"
{ echo "solid cut"; tetrahedron 0 | head -n 17; } >"$inputs/truncated.stl"
expect_error "truncated.stl:18: .*truncated" mesh "$inputs/truncated.stl"
{ echo "solid words"; tetrahedron 0 | sed 's/1/one/'; echo "endsolid"; } >"$inputs/words.stl"
expect_error 'words.stl:5: .*instead of "one"' mesh "$inputs/words.stl"
{ echo "solid nan"; tetrahedron 0 | sed 's/1/nan/'; echo "endsolid"; } >"$inputs/nan.stl"
expect_error 'nan.stl:5: .*instead of "nan"' mesh "$inputs/nan.stl"
printf '%080d\377\377\377\177' 0 >"$inputs/promise.stl" # a binary file that promises 2^31 triangles and has none
expect_error "promise.stl: .*announces 2147483647 triangles" mesh "$inputs/promise.stl"

# Plane domains.
svg() { printf '<svg><path d="%s"/></svg>\n' "$2" >"$inputs/$1.svg"; }
svg square 'M0 0 L9 0 L9 9 L0 9 Z'
expect_error "square.svg.*--dimension 2" mesh "$inputs/square.svg"
expect_error "square.svg.*--dimension 2" compare "$inputs/square.svg"
svg bow 'M0 0 L9 9 L9 0 L0 9 Z'
svg words 'M0 0 L nan 0 L9 9 Z'
svg open 'M0 0 L9 0 L9 9'
svg two_points 'M0 0 L9 0 Z'
svg nothing ''
svg far 'M0 0 L1e300 0 L1e300 1e300 Z'
printf '<svg><path d="M0 0 L9 0 L9' >"$inputs/cut.svg"
printf 'polygon a\n0 0\n9 0\n9 9\n0 9\nline c\n-5 4\n5 4\n' >"$inputs/line_leaves.txt"
printf 'polygon a\n0 0\nnan 0\n9 9\n' >"$inputs/nan.txt"
printf '0 0\n9 0\n9 9\n' >"$inputs/no_heading.txt"
while IFS='|' read -r name reason; do
  expect_error "$name.*$reason" mesh "$inputs/$name" --dimension 2
done <<'REASONS'
bow.svg|crosses itself: segments 2 and 0
words.svg|a number is expected at character 7
open.svg|path is open
two_points.svg|has 2 points
nothing.svg|no closed path
far.svg|too large
cut.svg|ends in an attribute
line_leaves.txt|'a' and line 0 'c' meet .* near \(0, 4\)
nan.txt|point 1 is not a number
no_heading.txt|points come after a line
REASONS
cp "$inputs/square.svg" "$inputs/UPPER.SVG"
expect_success mesh "$inputs/UPPER.SVG" --dimension 2 --format none

# Sizing files.
expect_error "missing.json" mesh --model combustor --sizing "$inputs/missing.json"
bad_sizing() { # name, reason, text
  printf '%s' "$3" >"$inputs/$1.json"
  expect_error "$1.json:1: .*$2" mesh --model combustor --sizing "$inputs/$1.json"
}
bad_sizing broken 'not valid JSON' '{ "size": 1, '
bad_sizing unknown_key 'unknown key "colour"' '{ "size": 1, "colour": "red" }'
bad_sizing unknown_type 'unknown source type "nonsense"' '{ "size": 1, "sources": [{ "type": "nonsense" }] }'
bad_sizing negative '"size" is -1' '{ "size": -1 }'
bad_sizing wrong_type '"size" must be a finite number' '{ "size": "one" }'
bad_sizing list 'must be an object' '[ 1, 2, 3 ]'
cp "$inputs/noise" "$inputs/noise.json"
expect_error "noise.json" mesh --model combustor --sizing "$inputs/noise.json"

# Meshes that begin well.
cat >"$inputs/truncated.vtu" <<'VTU'
<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points>
VTU
expect_error "truncated.vtu: .*ends early" check "$inputs/truncated.vtu"
printf '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n' >"$inputs/truncated.msh"
expect_error "truncated.msh: .*ends where a number is expected" check "$inputs/truncated.msh"
finish
