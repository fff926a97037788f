#!/bin/bash
# Fuzzes one of the readers, from small files that are valid, the native mesher or `fill`. Prints what it found, and fails when anything was.
#   run_fuzzer.sh <fuzzer> <reader> <seconds, or number of inputs as "60inputs"> [folder for what is found]
# Of a number of inputs, these are the same each time.
set -euo pipefail
fuzzer=$1 kind=$2 limit=(-max_total_time="$3")
[[ $3 != *inputs ]] || limit=(-seed=1 -runs="${3%inputs}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
found=${4:-$scratch/found}
mkdir -p "$scratch/corpus" "$scratch/new" "$found"
cd "$scratch/corpus"

points=("0 0 0" "1 0 0" "0 1 0" "0 0 1")
triangles=("0 2 1" "0 1 3" "1 2 3" "2 0 3")
bytes() { printf "$(printf '\\x%s' "$@")"; }
zeros() { head -c "$1" /dev/zero; }
stl() {
  echo "solid a"
  for triangle in "${triangles[@]}"; do
    printf 'facet normal 0 0 0\nouter loop\n'
    for v in $triangle; do echo "vertex ${points[v]}"; done
    printf 'endloop\nendfacet\n'
  done
  echo "endsolid a"
}
ply_header() { # format
  printf 'ply\nformat %s 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n' "$1"
  printf 'element face 4\nproperty list uchar int vertex_indices\nend_header\n'
}
msh_4() {
  printf '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 "solid"\n$EndPhysicalNames\n'
  printf '$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n'
  printf '$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n%s\n%s\n%s\n%s\n$EndNodes\n' "${points[@]}"
  printf '$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n'
}
msh_2() {
  printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 %s\n2 %s\n3 %s\n4 %s\n$EndNodes\n' "${points[@]}"
  printf '$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 2 2 1 1 1 3 2\n$EndElements\n'
  printf '$NodeData\n1\n"h"\n1\n0\n3\n0\n1\n2\n1 0.5\n2 0.25\n$EndNodeData\n'
}
vtu() { # attributes of the file, coordinates, a section behind the grid
  printf '<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"%s><UnstructuredGrid>' "$1"
  printf '<Piece NumberOfPoints="4" NumberOfCells="1"><PointData><DataArray type="Float32" Name="h">1 2 3 4</DataArray>'
  printf '</PointData><Points>%s</Points><Cells>' "$2"
  printf '<DataArray type="Int32" Name="connectivity">0 1 2 3</DataArray><DataArray type="Int32" Name="offsets">4'
  printf '</DataArray><DataArray type="UInt8" Name="types">10</DataArray></Cells></Piece></UnstructuredGrid>%s</VTKFile>' "$3"
}
array() { printf '<DataArray type="Float32" NumberOfComponents="3" format="%s"%s' "$1" "$2"; }

case $kind in
stl)
  stl >text
  { zeros 80; bytes 02 00 00 00; zeros 100; } >binary
  ;;
obj)
  { printf 'o a\n'; printf 'v %s\n' "${points[@]}"; printf 'f 1 3 2\ng b\nf 1/1 2//2 4/1/1\nf -3 -2 -1\n'; } >text
  ;;
off)
  { printf 'OFF\n4 4 0\n'; printf '%s\n' "${points[@]}"; printf '3 %s\n' "${triangles[@]}"; } >text
  ;;
ply)
  { ply_header ascii; printf '%s\n' "${points[@]}"; printf '3 %s\n' "${triangles[@]}"; } >text
  { ply_header binary_little_endian; zeros 48; for _ in 1 2 3 4; do bytes 03; zeros 12; done; } >binary
  { ply_header binary_big_endian; zeros 48; for _ in 1 2 3 4; do bytes 03; zeros 12; done; } >big
  ;;
msh)
  msh_4 >four
  msh_2 >two
  { printf '$MeshFormat\n4.1 1 8\n'; bytes 01 00 00 00; printf '\n$EndMeshFormat\n$Nodes\n'; zeros 32
    printf '\n$EndNodes\n$Elements\n'; zeros 32; printf '\n$EndElements\n'; } >binary
  ;;
vtu)
  vtu "" "$(array ascii '>')${points[*]}</DataArray>" "" >text
  vtu "" "$(array appended ' offset="0"/>')" '<AppendedData encoding="base64">_MAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPw==</AppendedData>' >appended
  vtu ' header_type="UInt32" compressor="vtkZLibDataCompressor"' \
    "$(array binary '>')AQAAAACAAAAwAAAAEAAAAA==eJxjYEAGDfYMBPgAJ70CPg==</DataArray>" "" >compressed
  ;;
json)
  printf '{"type": "uniform", "size": 0.1}' >uniform
  printf '{"type": "sources", "size": 1, "sources": [{"points": [[0, 0, 0], [1, 0, 0]], "spacing": 0.1}]}' >sources
  printf '{"type": "min", "fields": [{"type": "uniform", "size": 0.5}, {"type": "uniform", "size": 0.1}]}' >min
  ;;
svg)
  printf '<?xml version="1.0"?><svg><g><path id="a" d="M0 0 L9 0 h1 v9 C1 2 3 4 5 6 A5 5 0 0 1 0 9 Z m1 1 l2 0 q1 1 2 2 z"/></g></svg>' >text
  printf '<svg><path d="M0 0 L9 0 9 9Z"/><path fill="none" d="M1 1 L2 1"/></svg>' >line
  ;;
txt)
  printf '# c\npolygon a\n0 0\n9 0\n9 9\n\nline b\n1 1\n2 1\n' >text
  ;;
mesher)
  for shape in 00 01 02 03 80 81 82 83; do bytes "$shape" 01 10 20 30 >"$shape"; done
  { bytes 00; bytes fe 00 01 02; } >wall
  ;;
fill)
  for shape in 00 01 02 03 40 50 60 64 70 74; do bytes 00 "$shape" 01 10 20 30 >"$shape"; done
  for shape in 00 02 60; do bytes 10 "$shape" >"sized_$shape"; done
  { bytes 01 10 20 30 05; bytes 60; } >mark
  { bytes 00 00; bytes ff 00 01 02; } >wall
  { bytes 00 00; bytes fc 03 80 80 90; } >bump
  { bytes 00 41; bytes fe 02; } >turned
  bytes 00 01 00 32 ff 60 02 >spike # far longer than wide: once took minutes
  ;;
*)
  echo "there is no reader of $kind" >&2
  exit 2
  ;;
esac

reader=--reader=$kind
timeout=60
if [[ $kind == mesher || $kind == fill ]]; then
  reader=""
  timeout=600 # what is hopeless takes a few seconds, or ten times as long with sanitizers
fi

# Small inputs, a second each and half a gigabyte at most: what takes more has found a way to hang or to fill the memory.
if ! TMPDIR=$scratch "$fuzzer" ${reader:+"$reader"} "$scratch/new" "$scratch/corpus" "${limit[@]}" -timeout="$timeout" \
  -rss_limit_mb=1024 -malloc_limit_mb=512 -max_len=4096 -artifact_prefix="$found/" >"$scratch/log" 2>&1; then
  tail -n 60 "$scratch/log"
  echo "the input that does it: $(ls "$found")"
  exit 1
fi
grep -a "^Done" "$scratch/log"
