#!/bin/bash
# scripts/render.py: without a display it is one line that says what to do, and no crash of VTK. Skipped (exit code 77) without VTK.
#   check_render_script.sh <scripts/render.py>
render=$1
/usr/bin/python3 -c "import numpy, vtkmodules.vtkRenderingOpenGL2" 2>/dev/null || {
  echo "skipped: there is no VTK for Python"
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '%s' '<?xml version="1.0"?><VTKFile type="PolyData"><PolyData><FieldData/><Piece NumberOfPoints="3" NumberOfPolys="1"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
</Polys><CellData><DataArray type="Int32" Name="patch" format="ascii">0</DataArray></CellData></Piece></PolyData></VTKFile>' >"$folder/surface.vtp"
said=$(env -u DISPLAY "$render" "$folder" --only surface 2>&1)
status=$?
[[ $status == 0 && -s $folder/surface.png ]] && exit 0 # where VTK draws without one
[[ $status == 1 && $said == "render: VTK needs a display; "* && $said != *$'\n'* ]] && exit 0
echo "exit code $status: $said"
exit 1
