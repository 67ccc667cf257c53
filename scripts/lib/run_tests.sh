# Runs what was built and keeps the results; source after common.sh, processes.sh and build.sh. Callers set $results, the
# folder of the results, and $checks, the list of those that are no files of a test program.

count_results=$repository/scripts/lib/count_results.py

# record VERDICT NAME OUTPUT-FILE
record() { printf '%s\t%s\t%s\n' "$1" "$2" "$3" >>"$checks"; }

hasRapidCheck() { grep -qx 'MEMS_STICTION_HAS_RAPIDCHECK:INTERNAL=ON' "$build_folder/CMakeCache.txt"; }

# google_tests=(SOURCE...): those of this build, with ROS if with_ros=ON.
listGoogleTests() {
  local name
  google_tests=("$repository"/test/core/*/*_test.cpp "$repository"/test/verification/*_test.cpp)
  for name in configuration gwy prediction resume sidecar text; do google_tests+=("$repository/test/fuzz/${name}_fuzz.cpp"); done
  if hasRapidCheck; then google_tests+=("$repository"/test/property/*_test.cpp); fi
  if [ "$with_ros" = ON ]; then
    google_tests+=("$repository"/test/ros/*_test.cpp "$repository"/test/fuzz/{bag,image}_fuzz.cpp)
  fi
}

# listRosTests KIND|KIND: ros_tests=(NAME...), as ctest knows them in this folder.
listRosTests() {
  mapfile -t ros_tests < <(ctest -N -R "^_ctest_.*_($1)_" | awk '/Test +#/ { print $NF }')
}

runGoogleTest() {
  local name=$1 status=0 log=$results/logs/$1.txt program_file
  program_file=$(builtProgram "$name")
  timeout -k 10 "${google_test_timeout:-900}" "${program_file:-$name}" --gtest_output="xml:$results/google/$name.xml" >"$log" 2>&1 || status=$?
  # Without a result file the executable is missing, crashed or ran out of time; with one in which nothing failed it
  # crashed at its end.
  if [ "$status" -ne 0 ] && ! grep -qs '<failure' "$results/google/$name.xml"; then
    { tail -n 20 "$log"; echo "exit status $status, no failed case"; } >"$log.end"
    record failed "$name" "$log.end"
  fi
}

# All of google_tests=(SOURCE...), as many at once as there are processors.
runGoogleTests() {
  local source running=0
  for source in "${google_tests[@]}"; do
    [ -f "$source" ] || continue
    runGoogleTest "$(basename "$source" .cpp)" &
    if [ $((++running)) -ge "$(nproc)" ]; then
      wait -n || true
      running=$((running - 1))
    fi
  done
  wait
}

googleTestsDone() { echo "$(find "$results/google" -name '*.xml' | wc -l) of ${#google_tests[@]} programs"; }

# All of ros_tests=(NAME...), which are files of Python's tests, as many at once as there are processors. Their cases are named
# as they begin, so the output of one that hangs ends with its name.
runPythonTests() {
  local name result log=$results/logs/python.txt failed=Testing/Temporary/LastTestsFailed.log
  rm -rf "$build_folder/test_results" "$failed"
  NOSE_VERBOSE=2 ctest -j "$(nproc)" --output-on-failure --timeout "${ros_test_timeout:-900}" -R '^_ctest_.*_nosetests_' >"$log" 2>&1 || true
  for name in "${ros_tests[@]}"; do
    # It ended before its results, or failed without a failed case.
    result=$build_folder/test_results/mems_stiction/${name/#_ctest_mems_stiction_nosetests_/nosetests-}.xml
    if [ ! -f "$result" ] || { grep -qs ":$name\$" "$failed" && ! grep -qE '<(failure|error)' "$result"; }; then
      grep -F -A 40 "$name" "$log" | tail -n 40 >"$results/logs/$name.txt.end" || true
      record failed "$name" "$results/logs/$name.txt.end"
    fi
  done
  mv "$build_folder/test_results" "$results/python"
}

pythonTestsDone() { echo "$(find "$build_folder/test_results" -name 'nosetests-*.xml' | wc -l) of ${#ros_tests[@]} programs"; }

# runRosTest NAME: its results go to a folder of their own, since the variants of a rostest write to the same files.
runRosTest() {
  local name=$1 status=0 counted
  local log=$results/logs/$name.txt folder=$results/ros/$name
  rm -rf "$build_folder/test_results"
  ctest --output-on-failure --timeout "${ros_test_timeout:-900}" -R "^$name\$" >"$log" 2>&1 || status=$?
  mkdir -p "$folder"
  if [ -d "$build_folder/test_results" ]; then mv "$build_folder/test_results" "$folder"; fi
  counted=$(python3 "$count_results" "$folder")
  # It failed without a failed case (before the first one began, say), or left no case at all.
  case "$status $counted" in
    *' 0 passed, 0 failed, 0 skipped' | [1-9]*', 0 failed,'*)
      tail -n 40 "$log" >"$log.end"
      record failed "$name" "$log.end"
      ;;
  esac
}

# All of ros_tests=(NAME...), each with a master of its own on a free port.
runRosTests() {
  local name
  for name in "${ros_tests[@]}"; do runRosTest "$name"; done
}

rosTestsDone() { echo "$(find "$results/ros" -mindepth 1 -maxdepth 1 | wc -l) of ${#ros_tests[@]} programs"; }
