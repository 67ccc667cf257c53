# Processes in groups of their own, so that nothing is left behind; source after common.sh.

groups=()

# startGroup COMMAND...: in the background, in its own process group; its id is in $group.
startGroup() {
  set -m
  "$@" </dev/null &
  group=$!
  set +m
  groups+=("$group")
}

# Every process below PID, whatever its group or session: roslaunch gives each node its own. Without ps, which a minimal
# system lacks.
descendants() {
  awk -v root="$1" '
    /^Pid:/ { pid = $2 } /^PPid:/ { parent[pid] = $2 }
    END { do { found = 0
              for (p in parent) if (!(p in below) && (parent[p] == root || parent[p] in below)) { below[p] = 1; found = 1 }
            } while (found)
          for (p in below) print p }' /proc/[0-9]*/status 2>/dev/null || true
}

anyAlive() {
  local pid
  for pid in "$@"; do
    # A zombie has ended.
    if kill -0 "$pid" 2>/dev/null && ! grep -q '^State:.Z' "/proc/$pid/status" 2>/dev/null; then return 0; fi
  done
  return 1
}

# stopGroup ID: asks (as Ctrl-C does), waits for it and everything below it, insists after 20 s. What it starts before it
# has heard (roscore its master) is waited for, too.
stopGroup() {
  local id=$1 everyone=("$1") below tries
  for ((tries = 0; tries < 200; ++tries)); do
    mapfile -t below < <(descendants "$id")
    everyone+=(${below[@]+"${below[@]}"})
    [ "$tries" -gt 0 ] || kill -INT -- "-$id" 2>/dev/null || true
    anyAlive "${everyone[@]}" || break
    sleep 0.1
  done
  if anyAlive "${everyone[@]}"; then kill -KILL "${everyone[@]}" 2>/dev/null || true; fi
  wait "$id" 2>/dev/null || true
}

# In the reverse order of their start, so that a master goes last.
stopAllGroups() {
  local i
  for ((i = ${#groups[@]} - 1; i >= 0; --i)); do stopGroup "${groups[i]}"; done
  groups=()
}

# watchGroup LABEL STATE-COMMAND: waits for the group that $group names, which is the last started one unless the caller has
# set it back to an earlier one, and returns its status. Meanwhile prints what STATE-COMMAND says: in place on a terminal,
# every half minute elsewhere.
watchGroup() {
  local label=$1 state_command=$2 pid=$group started=$SECONDS last_line=$SECONDS status=0 text other others=()
  while anyAlive "$pid"; do
    sleep 0.3
    text="$label $($state_command 2>/dev/null || true) ($(clock $((SECONDS - started))))"
    if [ -t 1 ]; then
      printf '\r\033[K%s' "$text"
    elif [ $((SECONDS - last_line)) -ge 30 ]; then
      say "$text"
      last_line=$SECONDS
    fi
  done
  if [ -t 1 ]; then printf '\r\033[K'; fi
  wait "$pid" || status=$?
  for other in "${groups[@]}"; do [ "$other" = "$pid" ] || others+=("$other"); done
  groups=(${others[@]+"${others[@]}"})
  return "$status"
}

trap stopAllGroups EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
