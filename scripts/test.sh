#!/bin/bash
# Installs what is missing, builds, and runs every test. Arguments go to ctest (for example -R io).
# The last line counts all tests: N passed, N failed, N skipped. Ends with an error when any failed.
# With CI=true PETSc, DOLFINx and Chromium are installed too, and a test may be skipped only for want of the external models,
# not of anything that scripts/setup installs.
set -uo pipefail
source_directory=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$source_directory" || exit 1

scripts/setup tests || exit 1
if [[ ${CI:-} == true ]]; then
  scripts/setup consumers || exit 1
fi
echo "what the tests need is there after $SECONDS s"

require_all=OFF
[[ ${CI:-} == true ]] && require_all=ON
# A test that did not build is counted as failed below.
scripts/build tests -DDOVETAIL_REQUIRE_ALL_TESTS=$require_all
[[ -f build/CTestTestfile.cmake ]] || exit 1
echo "built after $SECONDS s"

results=build/test_results.xml
rm -f "$results"
# One more than there are processors: tests of ranks and of stopping wait for much of their time.
ctest --test-dir build --parallel "$(($(nproc) + 1))" --output-on-failure --output-junit "$source_directory/$results" "$@"
[[ -f $results ]] || { echo "no test was run" >&2; exit 1; }
echo "tested after $SECONDS s"

scripts/count_tests "$results"
