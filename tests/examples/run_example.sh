#!/bin/bash
# Meshes a file by example 1 and has the result checked by an independent reader where there is one:
# run_example.sh EXAMPLE FILE CHECK_MESH
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A size that makes several subdomains.
"$1" "$2" "$folder/out" 1.0
for file in mesh.pvtu mesh_0000.vtu surface.vtp; do
  [[ -s $folder/out/$file ]] || { echo "no $file was written"; exit 1; }
done
if "$1" "$folder/no_such_file.step" "$folder/none" 2>"$folder/message"; then
  echo "a missing file was not noticed"
  exit 1
fi
grep -q no_such_file.step "$folder/message" || { echo "the error does not name the file"; exit 1; }

if /usr/bin/python3 -c 'import vtkmodules.vtkIOXML, numpy' 2>/dev/null; then
  /usr/bin/python3 "$3" "$folder/out"
else
  echo "the mesh is not checked: python3 has no VTK"
fi
