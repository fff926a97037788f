#include "dovetail/models/occt/triangulation.hpp"
#include "dovetail/models/occt_model.hpp"
#include "models/model_checks.hpp"
#include "models/triangulation_checks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace dovetail;

namespace {

/// The directory of shared models, or an empty path.
std::filesystem::path shared() {
  const char* directory = std::getenv("DOVETAIL_SHARED");
  return directory ? directory : "";
}

struct expected_model {
  const char* file;
  std::size_t solids;
  std::size_t faces;
  double volume;
};

std::vector<std::filesystem::path> corpus_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(shared() / "corpus"))
    if (entry.is_regular_file() && entry.path().extension() != ".md")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

TEST_CASE("the shared models are read whole, closed and with the volume known of them") {
  if (shared().empty()) {
    MESSAGE("DOVETAIL_SHARED is not set");
    return;
  }
  // wing_fuselage has 16 faces in its file; the two that touch become one.
  for (const expected_model& expected : {expected_model{"A319_in_a_box.brep", 1, 89, 1.99277e14},
                                         {"linkrods.step", 1, 37, 3.847},
                                         {"SampleCrankshaft4A.stp", 1, 137, 1.92463e6},
                                         {"U_Joint_2.stp", 1, 133, 51133.1},
                                         {"wing_fuselage.step", 2, 15, 1.59124e6}}) {
    CAPTURE(expected.file);
    const occt_model model = read_occt_model(shared() / "models" / expected.file).model;
    CHECK(model.topology().solids.size() == expected.solids);
    CHECK(model.topology().faces.size() == expected.faces);
    double volume = 0;
    for (const double part : occt_solid_volumes(model))
      volume += part;
    CHECK(volume == doctest::Approx(expected.volume).epsilon(1e-3));
    CHECK(testing::joined(testing::faults_of(model)) == "");
    const surface_mesh surface = occt_triangulation(model);
    CHECK(testing::open_edges(model.topology(), surface) == 0);
  }
}

TEST_CASE("the tank, whose ends are open, is refused with an open edge") {
  if (shared().empty())
    return;
  CHECK_THROWS_WITH_AS(read_occt_model(shared() / "models" / "tank.brep"),
                       doctest::Contains("8 edges belong to one face only"), geometry_error);
}

TEST_CASE("of sixty CAD solids at least 55 become sound models, the others errors that name an entity") {
  if (shared().empty())
    return;
  std::size_t sound = 0;
  const auto files = corpus_files();
  CHECK(files.size() == 60);
  for (const auto& file : files) {
    CAPTURE(file.filename().string());
    try {
      const occt_model model = read_occt_model(file).model;
      CHECK(testing::joined(testing::faults_of(model)) == "");
      sound += 1;
    } catch (const geometry_error& refusal) {
      const std::string text = refusal.what();
      CHECK(text.find(file.filename().string()) == 0);
      CHECK((text.find("edge") != std::string::npos || text.find("solid") != std::string::npos));
    }
  }
  CHECK(sound >= 55);
}
