# clang-tidy over the sources of a build, whose generated headers must be there; source after common.sh and build.sh.

hasClangTidy() { python3 -c 'import clang_tidy' 2>/dev/null; }

# What tidy.py finds goes to standard output, its progress to a file. It gives way to whatever else runs. pip puts clang-tidy
# into a folder that few have on their PATH.
tidySources() {
  mkdir -p "$build_folder/tidy"
  PATH=$(python3 -m site --user-base)/bin:$PATH nice -n 19 \
    python3 "$repository/scripts/lib/tidy.py" --progress "$build_folder/tidy/progress.txt" "$build_folder"
}

sourcesTidied() { tail -n 1 "$build_folder/tidy/progress.txt"; }
