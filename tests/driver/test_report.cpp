#include "run_figures.hpp"

#include "file_checksums.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/version.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

run_figures example() {
  run_figures figures;
  figures.model = "a \"quoted\" name\n";
  figures.workers = 2;
  figures.elements = 3'000'000'000;
  figures.vertices = 500'000'000;
  figures.subdomains = 32;
  figures.seconds.total = 10;
  figures.seconds.meshing = 6;
  figures.quality.elements = figures.elements;
  figures.quality.min_dihedral_deg = 11.5;
  figures.quality.min_dihedrals.bins[11] = 6000;
  for (const double degrees : {11.5, 20.5, 40.0})
    figures.at_interfaces.touching.add(degrees);
  figures.at_interfaces.rest.add(50);
  figures.interfaces.min_face_angle_deg = 30.5;
  figures.interfaces.forced = 1;
  figures.interfaces.refused = 3;
  figures.interfaces.remeshing = 2;
  figures.interfaces.below = {{12.5, true, "forced", {1, 2, 3}, {"curve 7", "face 4 (wing)"}}};
  figures.deviation = {"deviation", 0, {{"points", 0.25}, {"centres", 0.125}}, {}, {}};
  figures.deviation.children.push_back({"face 3", 0, {{"points", 0.25}, {"centres", 0.0625}}, {}, {}});
  figures.coarse_interfaces.min_face_angle_deg = 31.5;
  figures.mesh_hash = 0x0123456789abcdef;
  report child;
  child.name = "part";
  child.set("cells", 5);
  figures.details.children.push_back(child);
  return figures;
}

TEST_CASE("names may be any bytes, and the files are found by a folder that is no UTF-8") {
  const testing::scratch_folder folder("report");
  const std::string odd = "f\xfc\xff";
  std::filesystem::create_directory(folder / odd);
  std::ofstream(folder / odd / "a.vtu") << "mesh";
  run_figures figures = example();
  figures.model = odd + ".off";
  figures.out = (folder / odd).string();
  figures.interfaces.below.front().cad = {"face 4 (" + odd + ")"};
  figures.warnings = {odd};
  figures.files = {{"a.vtu", 4, checksum_of_file(folder / odd / "a.vtu")}};
  write_report(figures, folder / "report.json");
  std::ifstream file(folder / "report.json");
  const auto document = nlohmann::json::parse(file);
  CHECK(document["model"] == "f\xef\xbf\xbd\xef\xbf\xbd.off");
  CHECK(document["folder_bytes"] == "66fcff");
  CHECK(faults_of(files_of_report(folder / "report.json")) == "");
  figures.out = folder / "plain";
  write_report(figures, folder / "report.json");
  std::ifstream again(folder / "report.json");
  CHECK_FALSE(nlohmann::json::parse(again).contains("folder_bytes"));
}

TEST_CASE("the report has all promised fields with the figures' values") {
  const testing::scratch_folder folder("report");
  write_report(example(), folder / "report.json");
  std::ifstream file(folder / "report.json");
  const auto document = nlohmann::json::parse(file);

  for (const char* key : {"elements", "vertices", "background_elements", "subdomains", "seconds", "quality",
                          "interfaces", "merges", "failed_subdomains", "peak_rss_bytes", "mesh_hash"})
    CHECK_MESSAGE(document.contains(key), key);
  for (const char* key :
       {"geometry", "scaling", "background", "simplification", "partition", "skeleton", "intersection",
        "meshing", "improvement", "output", "total", "bisection", "fine_partition", "redistribution",
        "first_pass", "between_passes", "second_pass", "writing_back"})
    CHECK_MESSAGE(document["seconds"].contains(key), key);
  for (const char* key :
       {"min_dihedral_deg", "max_dihedral_deg", "bad_per_million", "low_per_million", "histogram"})
    CHECK_MESSAGE(document["quality"].contains(key), key);
  for (const char* key : {"min_face_angle_deg", "min_dihedral_deg", "faces", "forced", "refused", "coarse"})
    CHECK_MESSAGE(document["interfaces"].contains(key), key);

  CHECK(document["model"] == "a \"quoted\" name\n");
  CHECK(document["elements"] == 3'000'000'000);
  CHECK(document["seconds"]["meshing"] == 6.0);
  CHECK(document["quality"]["min_dihedral_deg"] == 11.5);
  CHECK(document["quality"]["bad_per_million"].get<double>() == doctest::Approx(2.0));
  CHECK(document["quality"]["histogram"]["min_dihedral"][11] == 6000);
  const auto& at_interfaces = document["at_interfaces"];
  CHECK(at_interfaces["touching"]["elements"] == 3);
  CHECK(at_interfaces["touching"]["min_dihedral_deg"] == 11.5);
  CHECK(at_interfaces["touching"]["mean_min_dihedral_deg"] == 24.0);
  CHECK(at_interfaces["touching"]["bad"] == 1);
  CHECK(at_interfaces["touching"]["low"] == 2);
  CHECK(at_interfaces["next_ring"]["elements"] == 0);
  CHECK(at_interfaces["next_ring"]["min_dihedral_deg"].is_null()); // none to measure
  CHECK(at_interfaces["rest"]["low"] == 0);
  CHECK(document["interfaces"]["forced"] == 1);
  CHECK(document["interfaces"]["refused"] == 3);
  CHECK(document["interfaces"]["remeshing"] == 2);
  const auto& below = document["interfaces"]["below_threshold"];
  REQUIRE(below.size() == 1);
  CHECK(below[0]["angle_deg"] == 12.5);
  CHECK(below[0]["of"] == "dihedral");
  CHECK(below[0]["cause"] == "forced");
  CHECK(below[0]["at"] == std::array{1.0, 2.0, 3.0});
  CHECK(below[0]["cad"][1] == "face 4 (wing)");
  CHECK(document["deviation"]["points"] == 0.25);
  CHECK(document["deviation"]["centres"] == 0.125);
  REQUIRE(document["deviation"]["faces"].size() == 1);
  CHECK(document["deviation"]["faces"][0]["face"] == "face 3");
  CHECK(document["deviation"]["faces"][0]["centres"] == 0.0625);
  CHECK(document["interfaces"]["coarse"]["min_face_angle_deg"] == 31.5);
  CHECK(document["interfaces"]["coarse"]["min_dihedral_deg"].is_null()); // not measured
  CHECK(document["mesh_revision"] == mesh_revision);
  CHECK(document["mesh_hash"] == "0123456789abcdef");
  CHECK(document["repeatable"] == true);
  CHECK(document["details"]["children"][0]["counters"]["cells"] == 5.0);
}

TEST_CASE("a report that cannot be written throws an error naming the file, and leaves nothing") {
  const testing::scratch_folder folder("report");
  const auto file = folder / "no_such_folder" / "report.json";
  CHECK_THROWS_WITH_AS(write_report(example(), file), doctest::Contains(file.c_str()), io_error);
  CHECK(std::filesystem::is_empty(folder));
}

TEST_CASE("the summary shows the figures under the paper's headings") {
  const std::string text = summary_text(example());
  for (const char* expected :
       {"General data", "No. of tetrahedra", "3,000,000,000", "Timing (seconds)", "Domain decomposition",
        "Mesh generation", "Relative speed", "150 M", "Minimum dihedral angle", "11.50", "6,000",
        "Interfaces", "distance from the CAD", "0.25", "Elements at interfaces", "Touching one"})
    CHECK_MESSAGE(text.find(expected) != std::string::npos, expected);
  CHECK(text.find("Next ring") == std::string::npos); // without elements
}

TEST_CASE("figures of a mesh of several subdomains have those at its interfaces, others have not") {
  const testing::scratch_folder folder("quality_report");
  const run_figures figures = example();
  const auto written = [&](const std::optional<quality_at_interfaces>& at_interfaces) {
    write_quality_report(figures.quality, 3, 8, {}, folder / "stats.json", at_interfaces);
    return nlohmann::json::parse(std::ifstream(folder / "stats.json"));
  };
  const auto document = written(figures.at_interfaces);
  CHECK(document["at_interfaces"]["touching"]["elements"] == 3);
  CHECK(document["at_interfaces"]["rest"]["min_dihedral_deg"] == 50.0);
  CHECK_FALSE(written({}).contains("at_interfaces"));

  const std::string rows = at_interfaces_text(figures.at_interfaces, 3);
  CHECK(rows.starts_with("Elements at interfaces"));
  CHECK(summary_text(figures).find(rows) != std::string::npos);
  CHECK(at_interfaces_text({}, 3).empty());
}

TEST_CASE("the summary has the steps that not every run has only where they are") {
  run_figures figures = example();
  figures.seconds.skeleton = 3;
  const std::vector<std::string> labels = {"Bisection of the fine surface",
                                           "Partition of the fine mesh",
                                           "Redistribution of elements",
                                           "Improvement again, first pass",
                                           "Second pass",
                                           "Writing back"};
  const std::string usual = summary_text(figures);
  for (const std::string& label : labels)
    CHECK_MESSAGE(usual.find(label) == std::string::npos, label);
  figures.seconds.bisection = 4.5;
  figures.seconds.fine_partition = 2;
  figures.seconds.redistribution = figures.seconds.first_pass = figures.seconds.second_pass = 1;
  const std::string all = summary_text(figures);
  for (const std::string& label : labels)
    CHECK_MESSAGE(all.find(label) != std::string::npos, label);
  const std::size_t decomposition = all.find("Domain decomposition");
  CHECK(all.substr(decomposition, 80).find("7.50") != std::string::npos);
}

TEST_CASE("a mesh that the clock had a part in is called not repeatable") {
  const testing::scratch_folder folder("report");
  run_figures figures = example();
  CHECK(summary_text(figures).find("REPEATABLE") == std::string::npos);
  figures.repeatable = false;
  CHECK(summary_text(figures).find("NOT REPEATABLE") != std::string::npos);
  write_report(figures, folder / "report.json");
  std::ifstream file(folder / "report.json");
  CHECK(nlohmann::json::parse(file)["repeatable"] == false);
}

TEST_CASE("the summary of a mesh of triangles speaks of edges and angles") {
  run_figures figures = example();
  figures.dimension = 2;
  const std::string text = summary_text(figures);
  CHECK(text.find("No. of edges") != std::string::npos);
  CHECK(text.find("Minimum angle (degrees)") != std::string::npos);
  for (const char* of_solids : {"of faces", "face angle", "dihedral", "dihedral", "tetrahedra"})
    CHECK_MESSAGE(text.find(of_solids) == std::string::npos, of_solids);
}

TEST_CASE("the summary of a single subdomain has no interfaces") {
  run_figures figures = example();
  figures.subdomains = 1;
  CHECK(summary_text(figures).find("Interfaces") == std::string::npos);
}

} // namespace
} // namespace dovetail::app
