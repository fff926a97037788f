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
expect_error "open.stl|open" mesh "$inputs/open.stl"
{ echo "solid cut"; tetrahedron 0 | head -n 17; } >"$inputs/truncated.stl"
expect_error "truncated.stl" mesh "$inputs/truncated.stl"
{ echo "solid words"; tetrahedron 0 | sed 's/1/one/'; echo "endsolid"; } >"$inputs/words.stl"
expect_error "words.stl" mesh "$inputs/words.stl"
{ echo "solid nan"; tetrahedron 0 | sed 's/1/nan/'; echo "endsolid"; } >"$inputs/nan.stl"
expect_error "nan.stl" mesh "$inputs/nan.stl"
printf '%080d\377\377\377\177' 0 >"$inputs/promise.stl" # a binary file that promises 2^31 triangles and has none
expect_error "promise.stl" mesh "$inputs/promise.stl"

# Sizing files.
json() { printf '%s' "$2" >"$inputs/$1.json"; }
json broken '{ "type": "uniform", '
json unknown_key '{ "type": "uniform", "size": 1, "colour": "red" }'
json unknown_type '{ "type": "nonsense" }'
json negative '{ "type": "uniform", "size": -1 }'
json wrong_type '{ "type": "uniform", "size": "one" }'
json list '[ 1, 2, 3 ]'
for name in missing broken unknown_key unknown_type negative wrong_type list; do
  expect_error "$name.json" mesh --model combustor --sizing "$inputs/$name.json"
done
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
expect_error "truncated.vtu" check "$inputs/truncated.vtu"
printf '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n' >"$inputs/truncated.msh"
expect_error "truncated.msh" check "$inputs/truncated.msh"
finish
