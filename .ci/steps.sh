# Runs steps within a time budget and summarises them. .ci/run and .ci/nightly source this file.

source "$(dirname "$0")/../scripts/lib/common.sh"
trap - ERR
exec </dev/null
export LC_ALL=C.UTF-8

# begin NAME MINUTES: starts the budget; the logs go to build/logs/NAME.
begin() {
  deadline=$(($(date +%s) + $2 * 60))
  logs=build/logs/$1
  rm -rf "$logs"
  mkdir -p "$logs"
  passed=0 failed=0 skipped=0 summary=()
}
seconds_left() { echo $((deadline - $(date +%s))); }

# note NAME PASSED FAILED SKIPPED: adds the counts of a step to the summary.
note() {
  passed=$((passed + $2)) failed=$((failed + $3)) skipped=$((skipped + $4))
  summary+=("$(printf '%-14s %6d passed %4d failed %4d skipped %6d s' "$1" "$2" "$3" "$4" "$(($(date +%s) - began))")")
}

# step NAME COMMAND...: runs the command within the remaining time. A step that does not fit has failed, because its
# result is unknown. A last line `N passed, N failed, N skipped` gives the counts; otherwise the step counts as one.
# Exit code 77 means skipped.
step() {
  local name=$1 code=0 left counts
  shift
  began=$(date +%s)
  left=$(seconds_left)
  say "$name ($((left / 60)) minutes left)"
  if [ "$left" -lt 30 ]; then
    echo "no time left for $name"
    note "$name" 0 1 0
    return
  fi
  timeout --kill-after=20 "$left" "$@" 2>&1 | tee "$logs/$name.log" || code=$?
  counts=$(tail -n 1 "$logs/$name.log" | sed -nE 's/^([0-9]+) passed, ([0-9]+) failed, ([0-9]+) skipped$/\1 \2 \3/p')
  if [ -n "$counts" ]; then
    read -r p f s <<<"$counts"
    # A bad exit code counts as a failure, even if the counts have none.
    [ "$code" -eq 0 ] || [ "$f" -gt 0 ] || f=1
    note "$name" "$p" "$f" "$s"
  elif [ "$code" -eq 0 ]; then note "$name" 1 0 0
  elif [ "$code" -eq 77 ]; then note "$name" 0 0 1
  elif [ "$code" -eq 124 ]; then
    echo "$name: cut short, the time is up"
    note "$name" 0 1 0
  else
    echo "$name: failed with exit code $code"
    note "$name" 0 1 0
  fi
}

# keep FOLDER: copies a folder to the logs.
keep() { [ ! -d "$1" ] || cp -r "$1" "$logs"; }

# end: prints the summary with all failures and their reasons. The last line is `N passed, N failed, N skipped`. Returns
# false if something failed or nothing ran.
end() {
  say summary
  awk '/^failed: / { on = 1 } !/^(failed: |    )/ { on = 0 } on' "$logs"/*.log
  printf '%s\n' "${summary[@]}"
  echo "logs: $logs"
  echo "$passed passed, $failed failed, $skipped skipped"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}
