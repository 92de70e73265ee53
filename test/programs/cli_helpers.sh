# SPDX-License-Identifier: MIT
# What the tests of calling contracts share; to be sourced by a script whose first argument is the program. Goes to a
# fresh folder; at the end call `finish`.
program=$(realpath "$1") || exit 2
folder=$(mktemp -d) || exit 2
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# run CODE ARGUMENTS...: runs the program, which must exit with this code; leaves the files `stdout` and `stderr`
run() {
  local code=$1
  shift
  timeout 60 "$program" "$@" >stdout 2>stderr </dev/null
  local got=$?
  [ $got -eq "$code" ] || fail "exit code $got instead of $code: $* ($(head -n 1 stderr))"
}

# expect_match CODE PATTERN ARGUMENTS...: the exit code, and what stdout (0 and 1) or the one line on stderr (2) must match
expect_match() {
  local code=$1 pattern=$2 stream=stdout
  shift 2
  run "$code" "$@"
  [ "$code" -eq 2 ] && stream=stderr
  grep -q -e "$pattern" $stream || fail "no '$pattern' on $stream: $* ($(cat $stream))"
  [ "$code" -eq 2 ] || [ ! -s stderr ] || fail "something on stderr: $*"
}

finish() {
  [ $failures -eq 0 ] && echo "all passed"
  exit $((failures > 0))
}
