# Functions of the scripts, in Bash. The scripts source this file.

set -euo pipefail
script=$(realpath "$0")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"

# A failed command prints the script and the line.
trap 'echo "$(basename "$0"): failed at line $LINENO" >&2' ERR

say() { printf '\n== %s\n' "$*"; }
die() { trap - ERR; printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

refuse() { die "unknown argument: $1 (see --help)"; }

# architecture NAME: checks the argument of --arch and prints it; prints nothing for the architecture of this machine.
architecture() {
  case $1 in
    "$(dpkg --print-architecture)") ;;
    arm64) echo arm64 ;;
    *) die "no programs for the architecture '$1': arm64 is to be had, and this machine's own (see --help)" ;;
  esac
}

# Prints the comment at the top of the script.
usage() { sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$script"; }

# --help has priority over all other arguments. A file that is sourced without arguments sees those of the script.
for argument in "$@"; do
  case $argument in -h | --help) usage; exit 0 ;; esac
done

jobs=$(nproc)

# Uses ccache if it is installed. CMake reads these variables when it configures a tree for the first time.
if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER-ccache}
  export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
fi

# configure_and_build PRESET [TARGET...]: builds the targets, or everything.
configure_and_build() {
  local preset=$1
  shift
  say "configure ($preset)"
  cmake --preset "$preset" "${configure_options[@]}" >"$(log_file configure-"$preset")" 2>&1 ||
    { cat "$(log_file configure-"$preset")" >&2; die "cmake --preset $preset failed"; }
  say "build ($preset)"
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}" || die "the build failed: the first error is above"
}
configure_options=()

log_file() {
  mkdir -p build/logs
  echo "build/logs/$1.log"
}

# Prints the C++ files of this project: tracked and new ones, without ignored ones. Without git it searches the folders.
our_sources() {
  local found
  if found=$(git ls-files --cached --others --exclude-standard -- '*.cpp' '*.hpp' 2>/dev/null) && [ -n "$found" ]; then
    echo "$found" | while read -r file; do if [ -f "$file" ]; then echo "$file"; fi; done
  else
    find base slam drivers settings daemon sim tools tests -name '*.cpp' -o -name '*.hpp'
  fi | sort -u
}

# run_tests PRESET FOLDER [CTEST ARGUMENT...]: runs the tests below a folder of the tree and prints a count at the end.
# Fails if a test fails or none ran.
run_tests() {
  local preset=$1 folder=$2 results
  shift 2
  results="$root/build/$preset/test-results.xml"
  rm -f "$results"
  say "test ($preset)"
  # count_tests.py gives the exit code, because ctest succeeds with an empty list of tests.
  "${test_runner[@]}" ctest --test-dir "build/$preset/$folder" --output-on-failure --parallel "$jobs" \
    --output-junit "$results" "$@" || true
  [ -f "$results" ] || die "ctest wrote no results for $preset"
  trap - ERR
  python3 -B scripts/lib/count_tests.py ${before_count:+--say "$before_count"} "$results"
}
test_runner=()
before_count= # line to print before the count
