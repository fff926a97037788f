#!/bin/bash
# Adaptation: a mesh file made anew in other sizes, on its model or its boundary; groups and materials stay; wrong
# sizes are refused.
#   check_adapt.sh <driver>
driver=$1
source "$(dirname "$0")/expectations.sh"

# Two tetrahedra of two materials, with a group on one side. Values at points as named on the command line.
mesh_file() { # array, values of its five points
  cat <<MSH
\$MeshFormat
2.2 0 8
\$EndMeshFormat
\$PhysicalNames
3
2 9 "wall"
3 4 "steel"
3 6 "air"
\$EndPhysicalNames
\$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
\$EndNodes
\$Elements
3
1 2 2 9 1 1 2 3
2 4 2 4 1 1 2 3 4
3 4 2 6 2 2 3 4 5
\$EndElements
\$NodeData
1
"$1"
1
0.0
3
0
1
5
1 $2
2 $3
3 $4
4 $5
5 $6
\$EndNodeData
MSH
}
mesh_file h 0.1 0.2 0.2 0.2 0.2 >"$inputs/mesh.msh"

expect_success adapt "$inputs/mesh.msh" --sizes h -o next.msh --subdomains 2 --report report.json
cp "$sandbox/work/next.msh" "$inputs"
elements=$(sed -n 's/^ *"elements": \([0-9]*\),*$/\1/p' "$sandbox/work/report.json" | head -n 1)
((elements > 500 && elements < 5000)) || fault "$elements elements"
for name in '2 9 "wall"' '3 4 "steel"' '3 6 "air"'; do
  grep -qa "^$name" "$inputs/next.msh" || fault "the group $name is not what it was"
done
expect_success check "$inputs/next.msh"
grep -q "valid mesh of $elements tetrahedra" "$sandbox/stdout" || fault "the checker counts otherwise"

# Again, to a VTU file, by one size; the mesh does not depend on the workers.
for workers in 1 2; do
  expect_success adapt "$inputs/next.msh" --size 0.25 -o next.vtu --subdomains 2 --workers $workers
  cp "$sandbox/work/next.vtu" "$inputs/by_$workers.vtu"
done
cmp "$inputs/by_1.vtu" "$inputs/by_2.vtu" || fault "another mesh by two workers"
grep -qa 'Name="region_names"' "$inputs/by_1.vtu" || fault "the names of the materials are lost"
expect_success check "$inputs/by_1.vtu"

# Fields go with the mesh when that is asked for: linear ones at points stay linear, in elements the integral stays.
field_file() { # file, then sed expressions that change it
  sed -e "" "${@:2}" >"$1" <<'VTU'
<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>
<PointData><DataArray type="Float64" Name="u" format="ascii">1 2 1 1 2</DataArray>
<DataArray type="Float64" Name="v" NumberOfComponents="3" format="ascii">0 0 5 2 0 5 0 3 5 0 0 4 2 3 4</DataArray></PointData>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
<CellData><DataArray type="Int32" Name="region" format="ascii">0 1</DataArray>
<DataArray type="Float32" Name="load" format="ascii">3 7</DataArray>
<DataArray type="Float64" Name="flux" NumberOfComponents="2" format="ascii">1 2 3 5</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
VTU
}
# carried_as_it_was <old> <new>: of the mesh above, or one made of it; VTK finds the volumes.
carried_as_it_was() {
  /usr/bin/python3 - "$@" <<'PYTHON' >"$sandbox/stdout" 2>"$sandbox/stderr" || fault "the fields of $2 are not what they were"
import sys
import numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.util.numpy_support import vtk_to_numpy

def read(path):
    reader, sizes = vtkXMLUnstructuredGridReader(), vtkCellSizeFilter()
    reader.SetFileName(path)
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    grid = sizes.GetOutput()
    of = lambda data: {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    cells = of(grid.GetCellData())
    size = cells["Volume"] if cells["Volume"].any() else cells["Area"]
    return vtk_to_numpy(grid.GetPoints().GetData()), of(grid.GetPointData()), cells, size

points, at_points, in_cells, size = read(sys.argv[2])
assert len(size) > 30, len(size)
linear = {"u": 1 + points[:, 0], "v": points * (2, 3, -1) + (0, 0, 5)}
for name, expected in linear.items():
    if name in at_points:
        assert abs(at_points[name] - expected).max() < 1e-12, name
old_cells, old_size = read(sys.argv[1])[2:]
for name in ("load", "flux"):
    whole, before = (numpy.tensordot(s, c[name], 1) for s, c in ((size, in_cells), (old_size, old_cells)))
    assert abs(whole - before).max() < 1e-6 * abs(before).max(), (name, whole, before)  # VTK may have sizes of 32 bits
    for region in (0, 1):  # the material keeps its own
        inside = in_cells["region"] == region
        assert abs(in_cells[name][inside] - old_cells[name][old_cells["region"] == region].mean(axis=0)).max() < 1e-12, name
PYTHON
}
has_vtk=$(/usr/bin/python3 -c 'import numpy, vtkmodules.vtkFiltersVerdict, vtkmodules.vtkIOXML' 2>/dev/null && echo yes)
field_file "$inputs/fields.vtu"
# Triangles in the plane z = 0, without "v".
field_file "$inputs/flat.vtu" -e 's/>0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</>0 0 0 1 0 0 0 1 0 1 1 0 5 5 0</' -e 's/>1 2 1 1 2</>1 2 1 2 6</' \
  -e '/Name="v"/s/.*/<\/PointData>/' -e 's/>0 1 2 3 1 2 3 4</>0 1 2 1 3 2</' -e 's/>4 8</>3 6</' -e 's/>10 10</>5 5</'
for kind in fields flat; do
  expect_success adapt "$inputs/$kind.vtu" --size 0.25 -o next.vtu --fields
  cp "$sandbox/work/next.vtu" "$inputs/carried.vtu"
  grep -q "^Carried over: 'u'.* at points, 'load', 'flux' in elements$" "$sandbox/stdout" || fault "the summary does not name the fields"
  for array in u load flux region; do
    grep -qa "Name=\"$array\"" "$inputs/carried.vtu" || fault "the values '$array' are lost"
  done
  [[ -z $has_vtk ]] || carried_as_it_was "$inputs/$kind.vtu" "$inputs/carried.vtu"
  expect_success adapt "$inputs/carried.vtu" --sizes u -o next.vtu --fields --quiet # from 1 to 2; those of adapted files too
  grep -qa 'Name="flux" NumberOfComponents="2"' "$sandbox/work/next.vtu" || fault "the values 'flux' are lost"
done
expect_success adapt "$inputs/fields.vtu" --size 0.5 -o next.vtu
grep -qa 'Name="u"' "$sandbox/work/next.vtu" && fault "values are carried over that nobody asked for"
expect_success adapt "$inputs/mesh.msh" --size 0.5 -o next.vtu --fields
grep -qa 'Name="h"' "$sandbox/work/next.vtu" || fault "node data of MSH are lost"
! grep -q warning "$sandbox/stderr" || fault "there is a warning"
{ cat "$inputs/mesh.msh"; printf '%s\n' '$ElementData' '$EndElementData'; } >"$inputs/more.msh"
expect_success adapt "$inputs/more.msh" --size 0.5 -o next.vtu --fields
grep -q 'warning: .*more.msh: not carried over: the section \$ElementData' "$sandbox/stderr" || fault "no word of data of elements"

expect_usage_error "--fields: values are written to files with the extension .vtu" \
  adapt "$inputs/fields.vtu" --size 0.25 -o next.msh --fields
expect_error "by_1.vtu: --fields: there are no values at points or in elements" adapt "$inputs/by_1.vtu" --size 1 -o next.vtu --fields
write_cube >"$inputs/cube.off"
expect_success mesh "$inputs/cube.off" --size 0.6 --subdomains 2 --ranks 2 --quiet
cp -r "$sandbox/work/out" "$inputs/ranks"
expect_error "--fields: there are no values" adapt "$inputs/ranks" --size 1 -o next.vtu --fields # but numbers
refused_fields() { # sed expression, what is said
  field_file "$inputs/refused.vtu" -e "$1"
  expect_error "refused.vtu: $2" adapt "$inputs/refused.vtu" --size 0.25 -o next.vtu --fields
}
refused_fields 's/>1 2 1 1 2</>1 2 nan 1 2</' "--fields: the values 'u' cannot be carried over: point 2 has none that is finite"
refused_fields 's/>1 2 3 5</>1 2 3 inf</' "--fields: the values 'flux' cannot be carried over: element 1 has none"
refused_fields 's/Name="v"/Name="u"/' 'array "u": there are two of this name'
refused_fields 's/>1 2 3 5</>1 2 3</' 'array "flux": 4 values are expected, but there are 3'
refused_fields 's/>1 2 1 1 2</>1 2 1 1 2 3</' 'array "u": 5 values are expected, but there are 6'

# On the model: of --model, or of the run that made the mesh, as long as its file is what it was.
expect_success mesh "$inputs/cube.off" --workers 1 --size 0.3 --subdomains 2
cp -r "$sandbox/work/out" "$inputs"
again() { # what is said, options...
  local said=$1
  shift
  expect_success adapt "$inputs/out/mesh.pvtu" --size 0.25 -o next.vtu --subdomains 2 "$@"
  grep -q "^Meshed again $said" "$sandbox/stdout" || fault "it does not say '$said'"
  grep -q "^Volume before 1, after 1$" "$sandbox/stdout" || fault "another volume"
}
again "on the model $inputs/cube.off, which the run that made"
expect_success adapt "$inputs/out" --size 0.25 -o next.vtu # a folder has its own record
grep -q "^Meshed again on the model $inputs/cube.off, which the run" "$sandbox/stdout" || fault "no model of the folder's run"
again "on the model $inputs/cube.off$" --model "$inputs/cube.off"
again "on the boundary of the mesh$" --model none
sed 's/^1 1 1$/1 1 2/' "$inputs/cube.off" >"$inputs/other.off"
expect_error "pvtu: the mesh is not one of the model: .*--model none" \
  adapt "$inputs/out/mesh.pvtu" --size 0.25 -o next.vtu --model "$inputs/other.off"
expect_error "no_such.step: there is no such file, and no built-in model" \
  adapt "$inputs/out/mesh.pvtu" --size 0.25 -o next.vtu --model no_such.step
mv "$inputs/other.off" "$inputs/cube.off"
again "on the boundary of the mesh; --model FILE"
grep -q "cube.off.* is not there or has changed since" "$sandbox/stderr" || fault "no warning of a changed model"
write_cube >"$inputs/cube.off"
sed -i 's/^input .*/input ..\/cube.off/' "$inputs/out/finished_run.txt"
again "on the model $inputs/cube.off, which the run that made"

# Wrong sizes, and meshes that are none.
expect_error "mesh.msh: there are no values 'size' at points in this mesh; there are 'h'$" \
  adapt "$inputs/mesh.msh" --sizes size -o next.msh
expect_error "there are no values at all" adapt "$inputs/by_1.vtu" --sizes h -o next.msh
for wrong in 0 -1 nan inf; do
  mesh_file h 0.1 0.2 $wrong 0.2 0.2 >"$inputs/wrong.msh"
  expect_error "wrong.msh" adapt "$inputs/wrong.msh" --sizes h -o next.msh
done
mesh_file h 1e-9 1e-9 1e-9 1e-9 1e-9 >"$inputs/tiny.msh"
expect_error "tiny.msh.*sizes down to 1e-09" adapt "$inputs/tiny.msh" --sizes h -o next.msh
expect_error "larger than the model" adapt "$inputs/mesh.msh" --size 100 -o next.msh
expect_error "nonsense.*tetgen" adapt "$inputs/mesh.msh" --sizes h -o next.msh --mesher nonsense
printf '%s\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$Nodes' 1 '1 0 0 0' '$EndNodes' '$Elements' 0 '$EndElements' \
  >"$inputs/empty.msh"
expect_error "empty.msh: the mesh has no tetrahedron" adapt "$inputs/empty.msh" --size 0.1 -o next.msh
finish
