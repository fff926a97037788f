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
    return reader.GetOutput()
