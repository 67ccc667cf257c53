# What `scripts/test --all` does behind the tests; scripts/test sources this.

# ---------------------------------------------------------------- the build without AVX2 and FFTW: the core, its programs, the half-space's tests
portable_folder=$repository/build/portable
buildPortable() {
  local build_folder=$portable_folder build_log=$portable_folder/build.log
  local build_name='the portable core' build_targets=(core_programs half_space_test)
  buildAll -DMEMS_STICTION_WITH_ROS=OFF -DMEMS_STICTION_PORTABLE=ON -DMEMS_STICTION_WITH_FFTW=OFF \
    -DMEMS_STICTION_WERROR="$warnings_are_errors" -DMEMS_STICTION_BUILD_TESTS=ON
}

halfSpaceWithoutFftw() {
  "$portable_folder/test/half_space_test" --gtest_filter='StiffnessOperator.*:*StiffnessOfFrame*:CoarseAnswer.*:*CoarseAnswerOfFrame*:ContactWindows.*:*WindowsOfFrame*:HalfSpaceSolver.*'
}

# A program of its own, on the installed library and each of its headers alone.
installedCoreServes() {
  local prefix=$portable_folder/prefix consumer=$portable_folder/consumer
  rm -rf "$prefix" "$consumer"
  cmake --install "$portable_folder" --prefix "$prefix" &&
    cmake -S "$repository/test/consumer" -B "$consumer" -DCMAKE_PREFIX_PATH="$prefix" &&
    cmake --build "$consumer" && LD_LIBRARY_PATH=$prefix/lib "$consumer/consumer"
}

# pip builds the module beside that core, into an environment that sees the system's packages; nothing comes over the network.
pipInstallationPredicts() {
  local environment=$portable_folder/environment
  rm -rf "$environment"
  python3 -m venv --system-site-packages "$environment" &&
    MEMS_STICTION_BUILD_FOLDER=$portable_folder CMAKE_BUILD_PARALLEL_LEVEL=$(buildJobs) \
      "$environment/bin/pip" install --no-build-isolation --no-index --no-deps "$repository" &&
    (cd / && env -u PYTHONPATH -u LD_LIBRARY_PATH "$environment/bin/python" -c '
import mems_stiction, numpy, sys
assert mems_stiction.__file__.startswith(sys.prefix), mems_stiction.__file__
print(mems_stiction.predict(1e-9 * numpy.random.RandomState(1).standard_normal((64, 64)), 20e-9))')
}

if timed 'portable build' buildPortable; then
  check 'the portable build predicts the same' \
    python3 "$repository/scripts/lib/compare_builds.py" "$(builtProgram predict_scan)" "$portable_folder/predict_scan"
  check 'the half-space passes its tests with OpenCV in place of FFTW' halfSpaceWithoutFftw
  check 'a program of its own builds on the installed core, whose headers stand on their own' installedCoreServes
  check 'the Python module is installed by pip, and predicts' pipInstallationPredicts
else
  record failed 'the portable build' ''
fi

# ---------------------------------------------------------------- clang-tidy of all sources, a minute of fuzzing for each reader
. "$repository/scripts/lib/tidy.sh"
if hasClangTidy; then
  check 'clang-tidy (scripts/tidy)' "$repository/scripts/tidy"
else
  skip 'clang-tidy (scripts/tidy)' 'scripts/setup --developer installs clang-tidy'
fi
if command -v clang++ >/dev/null; then
  check 'fuzzing of each reader for a minute (scripts/fuzz)' "$repository/scripts/fuzz"
else
  skip 'fuzzing (scripts/fuzz)' 'scripts/setup --developer installs clang'
fi
