#!/bin/bash
# scripts/setup: installs exactly what is missing; installs nothing when all is there; without the right to install,
# prints the apt line and fails. Run against stand-ins of dpkg-query, apt-get, sudo and id in a private PATH.
#   check_setup_script.sh <scripts/setup>
set -uo pipefail
setup=$1
sandbox=$(mktemp -d)
trap 'rm -rf "$sandbox"' EXIT
mkdir "$sandbox/bin"
log=$sandbox/apt.log

stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" >"$sandbox/bin/$1"
  chmod +x "$sandbox/bin/$1"
}
# Everything is installed but the packages named in $MISSING.
stand_in dpkg-query 'package=${!#}; [[ " $MISSING " == *" $package "* ]] || printf installed'
stand_in apt-get 'echo "$@" >>"'"$log"'"'

run_setup() { # missing packages, then arguments
  : >"$log"
  MISSING=$1 PATH="$sandbox/bin:$PATH" bash "$setup" "${@:2}" 2>"$sandbox/stderr"
}
problems=0
expect() {
  if ! eval "$2"; then
    echo "not so: $1"
    cat "$sandbox/stderr" "$log"
    problems=1
  fi
}

# Root is recognised by EUID, which cannot be replaced; so the stand-in of sudo decides unless this test runs as root.
stand_in sudo '[[ -n ${SUDO_ALLOWED:-} ]] || exit 1; shift; "$@"'

run_setup ""; status=$?
expect "nothing missing: succeeds" '((status == 0))'
expect "nothing missing: apt-get is not called" '[[ ! -s $log ]]'

run_setup "clang-tidy"; status=$?
expect "a package that only the tests need is left alone" '((status == 0)) && [[ ! -s $log ]]'

SUDO_ALLOWED=1 run_setup "libmetis-dev g++" tests; status=$?
expect "two missing: succeeds" '((status == 0))'
expect "two missing: exactly these are installed" 'grep -q "install .* g++ libmetis-dev$" "$log"'

run_setup "chromium" tests; status=$?
expect "a package that only consumers need is left alone" '((status == 0)) && [[ ! -s $log ]]'

SUDO_ALLOWED=1 run_setup "python3-dolfinx chromium clang-tidy" consumers; status=$?
expect "consumers: their packages are installed, those of the tests are not" \
  '((status == 0)) && grep -q "install .* python3-dolfinx chromium$" "$log"'

if ((EUID == 0)) && command -v setpriv >/dev/null; then
  chmod -R a+rwX "$sandbox"
  cp "$setup" "$sandbox/setup"
  : >"$log"
  MISSING="libmetis-dev" PATH="$sandbox/bin:$PATH" \
    setpriv --reuid=65534 --regid=65534 --clear-groups bash "$sandbox/setup" 2>"$sandbox/stderr"
  status=$?
else
  run_setup "libmetis-dev"; status=$?
fi
expect "may not install: fails" '((status != 0))'
expect "may not install: apt-get is not called" '[[ ! -s $log ]]'
expect "may not install: the line to run is printed" \
  'grep -q "sudo apt-get install --no-install-recommends libmetis-dev$" "$sandbox/stderr"'

exit $problems
