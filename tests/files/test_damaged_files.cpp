// Truncated and mutated files: every one is either read to a mesh that can be indexed, or an input_error that
// names the file. Run under the address and undefined-behaviour sanitizers this shows that no reader crashes.
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/files/write_vtu.hpp"
#include "dovetail/files/zlib.hpp"
#include "files/msh_kinds.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

const testing::stacked_cubes few_cubes{.cells = 2, .cuts = 2, .solids = 2};

/// A VTU file of one tetrahedron with its coordinates compressed by zlib, as VTK writes it.
const std::string compressed_vtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float32" NumberOfComponents="3" format="binary">AQAAAACAAAAwAAAAEAAAAA==eJxjYEAGDfYMBPgAJ70CPg==</DataArray></Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
)";

/// Valid files of all kinds, by name.
std::vector<std::pair<std::string, std::string>> valid_files() {
  const testing::scratch_folder folder("damaged_sources");
  std::vector<std::pair<std::string, std::string>> files;
  const auto mesh = few_cubes.distributed();
  for (const bool partitioned : {false, true})
    for (const bool binary : {false, true}) {
      testing::write_kind_of_msh(mesh, folder, partitioned, true, binary);
      files.emplace_back("a.msh", testing::file_content(folder / "mesh.msh"));
    }
  io::vtu_writer{}(mesh, folder);
  files.emplace_back("mesh_0000.vtu", testing::file_content(folder / "mesh_0000.vtu"));
  files.emplace_back("mesh.pvtu", testing::file_content(folder / "mesh.pvtu"));
  io::loaded_mesh with_fields;
  with_fields.mesh = few_cubes.whole();
  with_fields.point_fields = {{"v", std::vector<double>(3 * with_fields.mesh.points.size(), 1), 3}};
  with_fields.element_fields = {{"w", std::vector<double>(with_fields.mesh.elements.size(), 1)}};
  io::write_vtu(with_fields, folder / "fields.vtu");
  files.emplace_back("fields.vtu", testing::file_content(folder / "fields.vtu"));
  files.emplace_back("zlib.vtu", compressed_vtu);
  return files;
}

/// Reads a file; a mesh must be consistent, and an error must be the right one.
void read_or_refuse(const std::filesystem::path& path, std::size_t& read, std::size_t& refused) {
  try {
    const auto mesh = io::read_mesh(path, io::zlib_expand, true);
    ++read;
    const auto points = static_cast<local_id>(mesh.mesh.points.size());
    const auto in_range = [&](local_id v) { return v >= 0 && v < points; };
    bool consistent =
        mesh.mesh.tags.size() == mesh.mesh.elements.size() &&
        mesh.triangle_tags.size() == mesh.triangles.size() &&
        (mesh.subdomains.empty() || mesh.subdomains.size() == mesh.mesh.elements.size()) &&
        (mesh.triangle_subdomains.empty() || mesh.triangle_subdomains.size() == mesh.triangles.size()) &&
        (mesh.node_ids.empty() || mesh.node_ids.size() == mesh.mesh.points.size());
    for (const auto& element : mesh.mesh.elements)
      consistent = consistent && std::all_of(element.begin(), element.end(), in_range);
    for (const auto& triangle : mesh.triangles)
      consistent = consistent && std::all_of(triangle.begin(), triangle.end(), in_range);
    for (const auto& array : mesh.point_scalars)
      consistent = consistent && array.values.size() == mesh.mesh.points.size();
    const auto cells = mesh.mesh.elements.empty() ? mesh.triangles.size() : mesh.mesh.elements.size();
    const auto check_fields = [&](const std::vector<io::mesh_field>& fields, std::size_t count) {
      for (const auto& field : fields)
        consistent = consistent && field.values.size() == count * static_cast<std::size_t>(field.components);
    };
    check_fields(mesh.point_fields, mesh.mesh.points.size());
    check_fields(mesh.element_fields, cells);
    if (!consistent)
      FAIL("an inconsistent mesh was read from " << path.string());
  } catch (const input_error& problem) {
    ++refused;
    if (std::string(problem.what()).find(path.parent_path().string()) != 0)
      FAIL("the error does not name the file: " << problem.what());
  }
}

} // namespace

namespace {

/// The compressed file with one text replaced, read.
io::loaded_mesh read_compressed(const std::string& old_text, const std::string& new_text,
                                io::vtk_expander expand = io::zlib_expand) {
  const testing::scratch_folder folder("compressed");
  auto content = compressed_vtu;
  content.replace(content.find(old_text), old_text.size(), new_text);
  testing::write_content(folder / "a.vtu", content);
  return io::read_mesh(folder / "a.vtu", expand);
}

} // namespace

TEST_CASE("the compressed file is valid to begin with, and refused without what expands it") {
  CHECK(read_compressed("", "").mesh.points == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK_THROWS_WITH_AS(read_compressed("", "", nullptr),
                       doctest::Contains("a.vtu: array \"\": it is compressed"), input_error);
}

TEST_CASE("sizes that compressed data cannot have are refused, before they are allocated") {
  // One block of 2^31 - 1 bytes, for four points.
  CHECK_THROWS_WITH_AS(read_compressed("AQAAAACAAAAwAAAA", "AQAAAACAAAD///9/"),
                       doctest::Contains("a.vtu: array \"\": its compressed data announce more"),
                       input_error);
  // The same for so many points that they would need it.
  CHECK_THROWS_WITH_AS(
      read_compressed(
          "\"4\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
          "format=\"binary\">AQAAAACAAAAwAAAA",
          "\"200000000\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float32\" "
          "NumberOfComponents=\"3\" format=\"binary\">AQAAAACAAAD///9/"),
      doctest::Contains("a.vtu: array \"\": its compressed data end early"), input_error);
  // Another size than the stream gives, and a damaged stream.
  CHECK_THROWS_WITH_AS(read_compressed("AQAAAACAAAAwAAAA", "AQAAAACAAAAkAAAA"),
                       doctest::Contains("a.vtu: array \"\": compressed data are damaged"), input_error);
  CHECK_THROWS_WITH_AS(read_compressed("eJxjYEAGDfYM", "eJxjYEAGDfYN"),
                       doctest::Contains("a.vtu: array \"\": compressed data are damaged"), input_error);
}

TEST_CASE("data that would expand without end are refused") {
  const testing::scratch_folder folder("expanding");
  const auto refusal = [&](const std::string& name, const std::string& content) -> std::string {
    testing::write_content(folder / name, content);
    try {
      io::read_mesh(folder / name);
    } catch (const input_error& problem) {
      return problem.what();
    }
    return "no error";
  };
  // Arrays of one offset: an offset of 96 bytes and a header of 4 are the whole section.
  const auto appended = [](const char* name, int offset) {
    return std::string("<DataArray type=\"Float64\" Name=\"") + name +
           "\" NumberOfComponents=\"3\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>";
  };
  const std::string piece = "<Piece NumberOfPoints=\"4\" NumberOfCells=\"0\"><Points>" + appended("p", 0) +
                            "</Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\"/><DataArray "
                            "type=\"Int32\" Name=\"offsets\"/><DataArray type=\"Int32\" Name=\"types\"/>"
                            "</Cells></Piece>";
  const auto file_of = [&](const std::string& pieces) {
    return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>" + pieces +
           "</UnstructuredGrid><AppendedData encoding=\"raw\">_" + std::string{96, 0, 0, 0} +
           std::string(96, '\0') + "</AppendedData></VTKFile>";
  };
  CHECK(refusal("one.vtu", file_of(piece)) == "no error");
  CHECK(refusal("shared.vtu", file_of(piece + piece + piece)).find("those of other arrays") !=
        std::string::npos);
  // A piece named twice.
  const std::string named = "<Piece Source=\"one.vtu\"/>";
  const auto parallel = [](const std::string& pieces) {
    return "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>" + pieces +
           "</PUnstructuredGrid></VTKFile>";
  };
  CHECK(refusal("once.pvtu", parallel(named)) == "no error");
  CHECK(refusal("twice.pvtu", parallel(named + named)).find("one.vtu twice") != std::string::npos);
  // Arrays as long as the mesh that take a few bytes in the file.
  const auto with_data = [](int sections) {
    std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n0\n"
                      "$EndElements\n";
    for (int section = 0; section < sections; ++section)
      msh += "$NodeData\n1\n\"a" + std::to_string(section) + "\"\n0\n3\n0\n1\n0\n$EndNodeData\n";
    return msh;
  };
  CHECK(refusal("few.msh", with_data(256)) == "no error");
  CHECK(refusal("many.msh", with_data(257)).find("more than 256 sections") != std::string::npos);
  const auto with_arrays = [&](int arrays) {
    std::string vtu = piece.substr(0, piece.find("<Points>")) + "<PointData>";
    for (int array = 0; array < arrays; ++array)
      vtu += "<DataArray type=\"Int8\" Name=\"a" + std::to_string(array) + "\">1 2 3 4</DataArray>";
    return file_of(vtu + "</PointData>" + piece.substr(piece.find("<Points>")));
  };
  CHECK(refusal("few.vtu", with_arrays(256)) == "no error");
  CHECK(refusal("many.vtu", with_arrays(257)).find("more than 256 arrays") != std::string::npos);
}

TEST_CASE("a file that is cut off anywhere is refused") {
  const testing::scratch_folder folder("truncated");
  io::vtu_writer{}(few_cubes.distributed(), folder); // the pieces that the PVTU names
  for (const auto& file : valid_files()) {
    const auto& name = file.first;
    const auto& content = file.second;
    // What may be missing at the end: white space and the last closing tag's end.
    const auto enough = content.find_last_of(name.ends_with("msh") ? "s" : ">");
    const auto step = std::max<std::size_t>(1, content.size() / 400);
    for (std::size_t length = 0; length < enough; length += length < 2000 ? 7 : step) {
      testing::write_content(folder / name, content.substr(0, length));
      std::size_t read = 0, refused = 0;
      read_or_refuse(folder / name, read, refused);
      // A text MSH file may end after a complete section.
      const bool complete_section =
          name.ends_with("msh") && content.substr(0, length).find("$EndElements") != std::string::npos;
      CAPTURE(name);
      CAPTURE(length);
      CHECK((refused == 1 || complete_section));
    }
  }
}

TEST_CASE("files with random damage are read or refused, never worse") {
  const testing::scratch_folder folder("mutated");
  io::vtu_writer{}(few_cubes.distributed(), folder);
  std::mt19937 random(20240607);
  std::size_t read = 0, refused = 0;
  for (const auto& [name, original] : valid_files())
    for (int trial = 0; trial < 400; ++trial) {
      auto content = original;
      const auto place = [&] { return random() % content.size(); };
      for (auto changes = 1 + random() % 4; changes > 0 && !content.empty(); --changes)
        switch (random() % 6) {
        case 0: // another byte
          content[place()] = static_cast<char>(random());
          break;
        case 1: // another digit
          for (auto tries = 0; tries < 50; ++tries)
            if (auto& c = content[place()]; c >= '0' && c <= '9') {
              c = static_cast<char>('0' + random() % 10);
              break;
            }
          break;
        case 2: // something missing
          content.erase(place(), 1 + random() % 20);
          break;
        case 3: // something twice
          content.insert(place(), content.substr(place(), random() % 200));
          break;
        case 4: { // an extreme number in binary
          const auto at = place();
          for (std::size_t i = at; i < std::min(at + 8, content.size()); ++i)
            content[i] = trial % 2 == 0 ? '\xff' : '\x7f';
          break;
        }
        default: // a large number in text
          content.insert(place(), "99999999999");
        }
      testing::write_content(folder / name, content);
      if (!content.empty())
        read_or_refuse(folder / name, read, refused);
    }
  MESSAGE(read << " read, " << refused << " refused");
  CHECK(refused > 500);
  CHECK(read > 100);
}
