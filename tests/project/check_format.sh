#!/bin/bash
# Every source file is as clang-format leaves it.
#   check_format.sh <clang-format>
set -euo pipefail
find include app tests examples benchmarks -name '*.[hi]pp' -o -name '*.cpp' | sort |
  xargs "$1" --dry-run -Werror
