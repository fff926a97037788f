"""Files as VTK reads them."""

import sys


def read_by_vtk(reader, path):
    """What a reader makes of a file; ends the script when it complains."""
    problems = []

    def note(_, __, message):
        problems.append(message)

    note.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, note)
    reader.SetFileName(path)
    reader.Update()
    if problems:
        sys.exit(f"VTK cannot read {path}: {problems}")
    made = reader.GetOutput()
    return made if made.IsA("vtkDataSet") else joined_parts(made)


def joined_parts(parts):
    """The parts of a file as one grid, which is what older versions of VTK make of it."""
    from vtkmodules.vtkFiltersCore import vtkAppendFilter

    joiner = vtkAppendFilter()
    for k in range(parts.GetNumberOfPartitions()):
        joiner.AddInputData(parts.GetPartition(k))
    joiner.Update()
    return joiner.GetOutput()
