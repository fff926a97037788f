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

# On the model: of --model, or of the run that made the mesh, as long as its file is what it was.
write_cube >"$inputs/cube.off"
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
