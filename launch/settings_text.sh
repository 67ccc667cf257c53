#!/usr/bin/env bash
# For launch files: prints a file of settings. roslaunch alone says that the launch file cannot be loaded where this one is missing.
#
#   settings_text.sh ARGUMENT FILE.yaml    ARGUMENT: of the launch file, for what is wrong
argument=$1 file=$2
if [ ! -e "$file" ]; then
  echo "$argument:=$file: there is no such file$(case "$file" in /*) ;; *) printf ' in %s; give its full path, or start roslaunch in its folder' "$PWD" ;; esac)" >&2
  exit 1
fi
if [ ! -f "$file" ] || ! cat -- "$file"; then
  echo "$argument:=$file: is no file of settings that can be read" >&2
  exit 1
fi
