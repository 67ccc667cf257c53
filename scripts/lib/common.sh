# Shared by the programs in scripts/; source it, do not run it. Callers set -euo pipefail.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build_folder=$repository/build

# ROS's tools want the system's python3. Another one first on the PATH (pyenv, conda) lacks their modules.
export PATH=/usr/sbin:/usr/bin:/sbin:/bin:$PATH
unset PYTHONHOME VIRTUAL_ENV
if [ -f /opt/ros/noetic/setup.bash ]; then
  set +u
  . /opt/ros/noetic/setup.bash
  set -u
fi

# Sets $program for messages: the name as the user knows it.
program=$(basename "$(dirname "$(realpath "$0")")")/$(basename "$0")

say() { printf '%s\n' "$*"; }

# Whichever script it is that sources this.
if [ "${1:-}" = --version ]; then
  say "$(basename "$0") of mems_stiction $(sed -n 's|.*<version>\(.*\)</version>.*|\1|p' "$repository/package.xml")"
  exit 0
fi

# fail MESSAGE [ADVICE...]: one line with the cause, then what to do, then exit 1.
fail() {
  printf '%s: %s\n' "$program" "$1" >&2
  shift
  [ $# -eq 0 ] || printf '  %s\n' "$@" >&2
  exit 1
}

# 75 -> 1:15
clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# A port that nobody listens on, so that a running roscore is left alone.
freePort() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# One master on this machine's loopback; logs stay inside the build folder.
useOwnMaster() {
  ros_port=$(freePort)
  export ROS_MASTER_URI=http://localhost:$ros_port ROS_HOSTNAME=localhost
  unset ROS_IP ROS_NAMESPACE
  export ROS_HOME=$build_folder/ros_home
  mkdir -p "$ROS_HOME"
}
