/// Writes a small CAD file, a block with a round hole, for the examples to mesh: make_block FILE.brep
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <gp_Ax2.hxx>

int main(int argc, char** argv) {
  if (argc != 2)
    return 2;
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(30, 20, 10).Shape();
  const gp_Ax2 axis(gp_Pnt(12, 10, -1), gp_Dir(0, 0, 1));
  const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(axis, 4, 12).Shape();
  return BRepTools::Write(BRepAlgoAPI_Cut(block, hole).Shape(), argv[1]) ? 0 : 1;
}
