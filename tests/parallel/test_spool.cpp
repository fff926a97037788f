#include "dovetail/core/encoding.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/spool.hpp"
#include "dovetail/parallel/spool_exchange.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

using namespace dovetail;
namespace fs = std::filesystem;

namespace {

/// A folder that is not there yet.
struct scratch_folder {
  testing::scratch_folder around{"spool"};
  fs::path path = around / "folder";
};

const run_identity identity{{"input", "abc"}, {"size", "0.5"}};

byte_buffer some_bytes(std::size_t count) {
  byte_buffer bytes(count);
  for (std::size_t i = 0; i < count; ++i)
    bytes[i] = static_cast<std::byte>(i * 31);
  return bytes;
}

} // namespace

TEST_CASE("What was written is read back, by a resumed run too") {
  const scratch_folder scratch;
  const auto store = spool::start(scratch.path, identity);
  CHECK_FALSE(store.read("piece_0"));
  store.write("piece_0", some_bytes(1000));
  store.write("empty", {});
  CHECK(store.read("piece_0") == some_bytes(1000));
  const auto resumed = spool::resume(scratch.path, identity);
  CHECK(resumed.read("piece_0") == some_bytes(1000));
  REQUIRE(resumed.read("empty"));
  CHECK(resumed.read("empty")->empty());
  resumed.remove("piece_0");
  CHECK_FALSE(store.read("piece_0"));
}

TEST_CASE("A new start forgets what was there and leaves other files alone") {
  const scratch_folder scratch;
  spool::start(scratch.path, identity).write("piece_0", some_bytes(10));
  std::ofstream(scratch.path / "mine.txt") << "keep";
  std::ofstream(scratch.path / "mine.part") << "keep";
  std::ofstream(scratch.path / "piece_2.blob.part") << "of a writer that was killed";
  const auto store = spool::start(scratch.path, identity);
  CHECK_FALSE(store.read("piece_0"));
  CHECK(fs::exists(scratch.path / "mine.txt"));
  CHECK(fs::exists(scratch.path / "mine.part"));
  CHECK_FALSE(fs::exists(scratch.path / "piece_2.blob.part"));
  store.write("piece_1", some_bytes(10));
  store.clear();
  CHECK(fs::exists(scratch.path / "mine.txt"));
  CHECK_FALSE(fs::exists(store.path_of("piece_1")));
  fs::remove(scratch.path / "mine.txt");
  fs::remove(scratch.path / "mine.part");
  spool::start(scratch.path, identity).clear();
  CHECK_FALSE(fs::exists(scratch.path));
}

TEST_CASE("Another run is not resumed, and the message says what differs") {
  const scratch_folder scratch;
  CHECK_THROWS_AS(spool::resume(scratch.path, identity), usage_error);
  spool::start(scratch.path, identity);
  auto other = identity;
  other[1].second = "0.6";
  for (const char* size : {"size 0.5", "size 0.6"})
    CHECK_THROWS_WITH_AS(spool::resume(scratch.path, other), doctest::Contains(size), usage_error);
  other.pop_back();
  CHECK_THROWS_AS(spool::resume(scratch.path, other), usage_error);
  for (const char* damaged : {"", "dovetail", "dovetail 0.1.0\n\x1b[2J\n", "something else\n"}) {
    std::ofstream(scratch.path / "manifest.txt", std::ios::binary) << damaged;
    CHECK_THROWS_WITH_AS(spool::resume(scratch.path, identity), doctest::Contains("manifest.txt is damaged"),
                         usage_error);
  }
}

TEST_CASE("A truncated, altered, foreign or misnamed blob counts as absent") {
  const scratch_folder scratch;
  const auto store = spool::start(scratch.path, identity);
  const auto damaged = [&](auto&& damage) {
    store.write("piece_0", some_bytes(1000));
    REQUIRE(store.read("piece_0"));
    damage(store.path_of("piece_0"));
    return !store.read("piece_0");
  };
  for (const std::uintmax_t size : {0u, 5u, 24u, 500u, 1023u})
    CHECK(damaged([&](const fs::path& path) { fs::resize_file(path, size); }));
  CHECK(damaged([](const fs::path& path) { fs::resize_file(path, 2000); }));
  for (const int position : {3, 10, 20, 24, 700, 1023})
    CHECK(damaged([&](const fs::path& path) {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekg(position);
      const int old = file.get();
      file.seekp(position);
      file.put(static_cast<char>(old ^ 1));
    }));
  store.write("piece_0", some_bytes(1000));
  fs::copy_file(store.path_of("piece_0"), store.path_of("piece_1"));
  CHECK_FALSE(store.read("piece_1"));

  auto other = identity;
  other[0].second = "xyz";
  fs::rename(store.path_of("piece_0"), scratch.path / "saved");
  const auto foreign = spool::start(scratch.path, other);
  fs::rename(scratch.path / "saved", store.path_of("piece_0"));
  CHECK_FALSE(foreign.read("piece_0"));
}

TEST_CASE("A full disk gives an io_error and leaves nothing under the name") {
  const scratch_folder scratch;
  const auto store = spool::start(scratch.path, identity);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
  rlimit small = old;
  small.rlim_cur = 100000;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  CHECK_THROWS_AS(store.write("piece_0", some_bytes(1000000)), io_error);
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, previous);
  CHECK_FALSE(store.read("piece_0"));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch.path))
    ++files;
  CHECK(files == 1); // the manifest
}

TEST_CASE("A folder that cannot be made is an io_error") {
  const scratch_folder scratch;
  std::ofstream(scratch.path) << "in the way";
  CHECK_THROWS_AS(spool::start(scratch.path, identity), io_error);
}

TEST_CASE("Pieces and reports survive encoding") {
  mesh_piece piece;
  piece.subdomain = 4;
  piece.material = 2;
  piece.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  piece.mesh.elements = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  piece.skeleton_points = {9, 8, 7};
  for (const std::vector<local_id>& tags : {std::vector<local_id>{}, {2, 2}, {2, 3}}) {
    piece.mesh.tags = tags;
    const auto bytes = encoded(piece);
    byte_reader reader(bytes);
    const auto back = decode<mesh_piece>(reader);
    CHECK(reader.at_end());
    CHECK(back.subdomain == 4);
    CHECK(back.material == 2);
    CHECK(back.mesh.points == piece.mesh.points);
    CHECK(back.mesh.elements == piece.mesh.elements);
    CHECK(back.mesh.tags == tags);
    CHECK(back.skeleton_points == piece.skeleton_points);
  }
  report r;
  r.name = "outer";
  r.seconds = 1.5;
  r.set("count", 3);
  r.warnings = {"one", "two"};
  r.children.push_back(r);
  const auto bytes = encoded(r);
  byte_reader reader(bytes);
  const auto back = decode<report>(reader);
  CHECK(reader.at_end());
  CHECK(back.children.at(0).name == "outer");
  CHECK(back.children.at(0).warnings == r.warnings);
  CHECK(back.children.at(0).counters == r.counters);
  CHECK(back.seconds == 1.5);
}

TEST_CASE("ranks with spools of their own give each other what is missing") {
  const testing::scratch_folder folder("spools");
  const run_identity of_test{{"test", "1"}};
  const auto blob = [](int i) { return byte_buffer(static_cast<std::size_t>(10 + i), std::byte{7}); };
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    any_communicator network(mine);
    const auto own = spool::start(folder / std::to_string(network.rank()), of_test).of_one_rank();
    CHECK_FALSE(own.is_common());
    std::vector<std::string> names{"nobody"};
    for (int i = 0; i < 40; ++i) {
      names.push_back("b" + std::to_string(i));
      if (i % 4 == network.rank() || (i % 4 == 3 && network.rank() > 0))
        own.write(names.back(), blob(i));
    }
    if (network.rank() == 0)
      testing::write_content(own.path_of("b4"), "damaged");
    network.agree();
    exchange_blobs(own, network, names);
    for (int i = 0; i < 40; ++i)
      if (i != 4)
        CHECK(own.read("b" + std::to_string(i)) == blob(i));
    CHECK_FALSE(own.read("b4"));
    CHECK_FALSE(own.has("nobody"));
    own.write("of_" + std::to_string(network.rank()), blob(0));
    exchange_all_blobs(own, network);
    CHECK(own.read("of_2") == blob(0));
    CHECK(own.names().size() == 42);
  });
}

TEST_CASE("what a spool holds damaged when a run goes on it gets from a rank that has it whole") {
  const testing::scratch_folder folder("spools");
  const byte_buffer blob(10, std::byte{7});
  const std::vector<std::string> names{"first", "second", "third"};
  parallel::run_ranks(3, [&](parallel::in_process& mine) {
    any_communicator network(mine);
    const auto own = spool::start(folder / std::to_string(network.rank()), {}).of_one_rank();
    if (network.rank() > 0)
      for (const std::string& name : names)
        own.write(name, blob);
    if (network.rank() == 0)
      testing::write_content(own.path_of("first"), "damaged"); // others have it whole
    if (network.rank() == 1)
      testing::write_content(own.path_of("second"), "damaged"); // rank 0 has nothing, rank 2 has it whole
    testing::write_content(own.path_of("third"), "damaged");
    network.agree();
    exchange_all_blobs(own, network);
    CHECK(own.read("first") == blob);
    CHECK(own.read("second") == blob);
    CHECK_FALSE(own.has("third"));
  });
}
