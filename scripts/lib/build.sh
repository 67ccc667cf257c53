# Configure and build quietly; source after common.sh and processes.sh. The log keeps everything, the terminal gets progress and causes.

build_log=$build_folder/build.log

# As many jobs as processors, but no more than memory allows: a compiler here needs up to 1.2 GB.
buildJobs() {
  local processors memory_jobs
  processors=$(nproc)
  memory_jobs=$(awk '/^MemAvailable/ { print int($2 / 1200000) }' /proc/meminfo 2>/dev/null || echo 1)
  [ "${memory_jobs:-0}" -ge 1 ] || memory_jobs=1
  if [ "$memory_jobs" -lt "$processors" ]; then echo "$memory_jobs"; else echo "$processors"; fi
}

buildPercentage() { grep -oE '^\[ *[0-9]+%\]' "$build_log" | tail -n 1 | tr -d '[] '; }

# The first causes, not the last lines: with several jobs those are often somebody else's.
showBuildFailure() {
  local causes
  causes=$(grep -nE -A 12 '(^CMake Error|: (fatal )?error[: ]|undefined reference|No rule to make target|Killed|cannot find -l)' \
    "$build_log" | head -n 40 || true)
  {
    printf -- '----- %s failed; the first causes:\n' "$1"
    if [ -n "$causes" ]; then printf '%s\n' "$causes"; else tail -n 30 "$build_log"; fi
    printf -- '----- everything: %s\n' "$build_log"
  } >&2
}

# A build without ROS lies in a folder of its own, beside the one with it.
useCoreBuild() {
  build_folder=$build_folder/core
  build_log=$build_folder/build.log
}

# configure [CMAKE_ARGUMENT...]: returns 1 and shows the causes if it fails.
configure() {
  mkdir -p "$build_folder"
  # A cache that was made for another folder (a copied tree) cannot be used.
  if [ -f "$build_folder/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$repository" "$build_folder/CMakeCache.txt"; then
    rm -rf "$build_folder"
    mkdir -p "$build_folder"
  fi
  if ! cmake -S "$repository" -B "$build_folder" "$@" >"$build_log" 2>&1; then
    showBuildFailure "configuring with cmake"
    return 1
  fi
}

# buildAll [CMAKE_ARGUMENT...]: configures with these and builds; only what build_targets=(NAME...) names, if it is set.
# Returns 1 and shows the causes if it fails. $build_name goes into the lines that people read.
build_targets=()
build_name=''
buildAll() {
  local started=$SECONDS status=0
  configure "$@" || return 1
  startGroup cmake --build "$build_folder" ${build_targets[@]+--target "${build_targets[@]}"} -- -j "$(buildJobs)" >>"$build_log" 2>&1
  watchGroup "building${build_name:+ $build_name}" buildPercentage || status=$?
  if [ "$status" -ne 0 ]; then
    showBuildFailure "the build${build_name:+ of $build_name}"
    return 1
  fi
  say "${build_name:+$build_name: }built in $(clock $((SECONDS - started)))"
}

# builtProgram NAME: the file of a program of this build. Those without ROS, the portable one, the fuzzing programs and those
# with sanitizers lie in folders of their own inside build's.
builtProgram() {
  find "$build_folder" \( -path "$build_folder/core" -o -path "$build_folder/portable" -o -path "$build_folder/fuzz" \
    -o -path "$build_folder/sanitize" \) -prune -o -name "$1" -type f -perm -u+x -print -quit
}

# The Python module of a build without ROS.
usePythonModule() { export PYTHONPATH=$repository/python:$build_folder/python${PYTHONPATH:+:$PYTHONPATH}; }

# What a shell needs to run what was built: devel space, messages for Python, library path. The programs come on the PATH,
# since rosrun looks into no folder called build below a package.
useBuild() {
  if [ ! -f "$build_folder/devel/setup.bash" ]; then
    fail "$build_folder holds no ROS build" "run scripts/setup and try again"
  fi
  set +u
  . "$build_folder/devel/setup.bash"
  set -u
  export PATH=$build_folder/devel/lib/mems_stiction:$PATH
}
