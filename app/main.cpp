#include "command_line.hpp"

int main(int argc, char** argv) {
  return dovetail::app::run_command_line(argc, argv);
}
