# Runs what was built, by ctest, and keeps the results; source after common.sh, processes.sh and build.sh. Callers set
# $results, the folder of the results, and $checks, the list of those that are no files of a test program.

count_results=$repository/scripts/lib/count_results.py
test_log=$results/logs/ctest.txt

# record VERDICT NAME OUTPUT-FILE
record() { printf '%s\t%s\t%s\n' "$1" "$2" "$3" >>"$checks"; }

hasRapidCheck() { grep -qx 'MEMS_STICTION_HAS_RAPIDCHECK:INTERNAL=ON' "$build_folder/CMakeCache.txt"; }

# Each step of a run with its duration, for the end: timed NAME COMMAND...
step_times=()
timed() {
  local name=$1 started=$SECONDS status=0
  shift
  "$@" || status=$?
  step_times+=("$(printf '%7s  %s' "$(clock $((SECONDS - started)))" "$name")")
  return "$status"
}
showTimes() { printf '%s\n' ${step_times[@]+"${step_times[@]}"}; }

# runTests [CTEST_ARGUMENT...]: all tests of ctest that these choose, side by side. Those that compute take two slots, those that
# wait one. Three slots a processor left it idle for an eighth of the time, so it has four. What took longest in the last run
# begins first.
runTests() {
  cd "$build_folder" || return 1
  rm -rf test_results
  ctest -j $((4 * $(nproc))) --output-on-failure --output-junit "$results/ctest.xml" "$@" >"$test_log" 2>&1 || true
  [ -d test_results ] && mv test_results "$results/cases"
}

testsDone() { grep -oE '^ *[0-9]+/[0-9]+ Test' "$test_log" | tail -n 1 | grep -oE '[0-9]+/[0-9]+' | sed 's|/| of |'; }
