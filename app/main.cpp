#include "command_line.hpp"
#include "standard_streams.hpp"

int main(int argc, char** argv) {
  dovetail::app::open_closed_streams();
  dovetail::app::outlive_readers();
  return dovetail::app::run_command_line(argc, argv);
}
