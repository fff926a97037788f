"""write_vtk_variants.py IN.vtu FOLDER: writes the mesh with VTK in every encoding that its XML writer knows."""
import sys

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(reader.GetOutputPort())
for mode in ("Ascii", "Binary", "Appended"):
    for encoded in (0, 1) if mode == "Appended" else (1,):
        for compressor in ("None", "ZLib") if mode != "Ascii" else ("None",):
            for order in ("Little", "Big") if mode != "Ascii" else ("Little",):
                for header in ("32", "64"):
                    getattr(writer, f"SetDataModeTo{mode}")()
                    writer.SetEncodeAppendedData(encoded)
                    getattr(writer, f"SetCompressorTypeTo{compressor}")()
                    getattr(writer, f"SetByteOrderTo{order}Endian")()
                    getattr(writer, f"SetHeaderTypeToUInt{header}")()
                    writer.SetBlockSize(4096)  # so that arrays have several blocks
                    writer.SetFileName(f"{sys.argv[2]}/{mode}_{encoded}_{compressor}_{order}_{header}.vtu")
                    if writer.Write() != 1:
                        sys.exit(1)
writer.SetCompressorTypeToLZ4()
writer.SetFileName(f"{sys.argv[2]}/lz4")
writer.Write()
