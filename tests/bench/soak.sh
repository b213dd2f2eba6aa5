#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The endurance run: how evenly universes leave the machine while a planner keeps every core busy,
# heard in another network namespace, beside olad on the same universes. Needs root, iproute2, and
# the packages ola and libola-dev for the comparison.
#
#   tests/bench/soak.sh [--seconds 60] [--universes "64 256 512"] [--build build/release] [--no-ola]
set -u
here=$(cd "$(dirname "$0")/../.." && pwd)
seconds=60 universes="64 256 512" build=$here/build/release ola=yes
while [ $# -gt 0 ]; do
  case $1 in
    --seconds) seconds=$2; shift 2 ;;
    --universes) universes=$2; shift 2 ;;
    --build) build=$2; shift 2 ;;
    --no-ola) ola=no; shift ;;
    *) sed -n '3,8p' "$0" | cut -c3-; exit 2 ;;
  esac
done
[ "$(id -u)" = 0 ] || { echo "soak.sh: needs root, for the network namespace" >&2; exit 3; }
ninja -C "$build" soak >/dev/null || exit 4
work=$(mktemp -d /tmp/soak.XXXXXX)
space=soak$$ near=soakA$$ far=soakB$$
started=()
finish() {
  for pid in "${started[@]}"; do kill "$pid" 2>/dev/null; done
  ip link del "$near" 2>/dev/null
  ip netns del "$space" 2>/dev/null
  rm -rf "$work"
}
trap finish EXIT
ip netns add "$space" && ip link add "$near" type veth peer name "$far" &&
  ip link set "$far" netns "$space" && ip addr add 10.213.7.1/24 dev "$near" &&
  ip link set "$near" up && ip netns exec "$space" ip addr add 10.213.7.2/24 dev "$far" &&
  ip netns exec "$space" ip link set "$far" up || exit 3

studio_of() {  # universes
  echo "studio: soak"
  echo "subject: {stand_in: person, eye_height: 1.55 m, at: [0, 0, 0]}"
  echo "cameras: {main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22 deg}}"
  echo "exposure: {grey_card: 800 lx, white_balance: 5600 K}"
  echo "fixtures:"
  for ((u = 1; u <= $1; u++)); do for ((n = 0; n < 4; n++)); do
    echo "  l$u-$n: {role: key, profile: generic/rgbw, mode: 8ch-16bit, mount: {fixed: {at: [-1.5, -1.5, 2.2], aim_at: [0, 0, 1.4]}}, patch: {universe: $u, address: $((1 + 8 * n))}}"
  done; done
  echo "outputs:"
  for ((u = 1; u <= $1; u++)); do echo "  universe $u: {sacn: {interface: $near, rate: 40 Hz}}"; done
}
ticks_of() {  # pid: clock ticks that all its threads have run
  awk '{sub(/.*\) /, ""); print $12 + $13}' "/proc/$1/stat" 2>/dev/null || echo 0
}
measure() {  # name universes pids...: listens and prints a line of the table
  local name=$1 count=$2; shift 2
  local before=0 after=0 pid
  for pid in "$@"; do before=$((before + $(ticks_of "$pid"))); done
  local heard; heard=$(ip netns exec "$space" chrt -f 30 "$build/bin/soak_listen" "$far" "$count" "$seconds")
  for pid in "$@"; do after=$((after + $(ticks_of "$pid"))); done
  local core; core=$(awk "BEGIN {printf \"%.1f\", ($after - $before) / $(getconf CLK_TCK) / $seconds * 100}")
  set -- $heard
  printf '%-34s %6s %9s %7s %7s %8s %8s %8s %8s %8s %7s%s\n' "$name" "$count" "${1:-0}" "${2:-0}" "${3:-0}" \
    "${4:-0}" "${5:-0}" "${6:-0}" "${7:-0}" "${8:-0}" "$core" "$([ "${9:-0}" = 0 ] || echo "  listener lost $9")"
}
begin() { "$@" >"$work/out" 2>&1 & started+=($!); last=$!; disown; }
end() { local pid; for pid in "$@"; do kill "$pid" 2>/dev/null; done; sleep 1; for pid in "$@"; do kill -9 "$pid" 2>/dev/null; done; }

run_hand() {  # name universes load options...
  local name=$1 count=$2 load=$3; shift 3
  rm -rf "$work/run" "$work/state"
  studio_of "$count" >"$work/studio.yaml"
  CHIARO_RUNTIME=$work/run begin "$build/bin/chiaro-output" "$work/studio.yaml" --state "$work/state" "$@"
  local hand=$last
  sleep 3
  begin "$build/bin/soak_brain" "$work/studio.yaml" "$work/run" "$here/config"; local brain=$last
  begin "$build/bin/soak_load" $load; local planner=$last
  sleep 2
  kill -0 "$hand" 2>/dev/null || { echo "$name: $(tail -1 "$work/out")"; }
  measure "$name" "$count" "$hand"
  end "$planner" "$brain" "$hand"
}
run_ola() {  # name universes load
  local name=$1 count=$2 load=$3 conf=$work/ola plugin
  rm -rf "$conf"; mkdir -p "$conf"
  for plugin in artnet dummy espnet ftdidmx gpio karate kinet milinst opendmx openpixelcontrol osc pathport \
      renard sandnet shownet spi spidmx stageprofi uartdmx usbdmx usbserial usbpro dmx4linux nanoleaf; do
    echo "enabled = false" >"$conf/ola-$plugin.conf"
  done
  printf 'enabled = true\nip = 10.213.7.1\ninput_ports = 0\noutput_ports = %d\n' "$count" >"$conf/ola-e131.conf"
  for ((u = 1; u <= count; u++)); do echo "11-1-O-$((u - 1)) = $u"; done >"$conf/ola-port.conf"
  chown -R olad "$conf" 2>/dev/null; chmod 755 "$work"
  begin runuser -u olad -- olad --no-http --config-dir "$conf" --log-level 1
  sleep 4
  local daemon; daemon=$(pgrep -n -x olad)
  begin "$build/bin/soak_ola" "$count" 40; local client=$last
  begin "$build/bin/soak_load" $load; local planner=$last
  sleep 2
  measure "$name" "$count" "$daemon" "$client"
  end "$planner" "$client" "$daemon"
}

echo "gaps between two packets of a universe, ms (25 is right); $seconds s each; $(nproc) cores, all busy; $(date -u +%F)"
printf '%-34s %6s %9s %7s %7s %8s %8s %8s %8s %8s %7s\n' "who" univ. packets missing late p50 p99 p99.9 max "off99.9" "core %"
for count in $universes; do
  run_hand "chiaro-output, SCHED_FIFO" "$count" "" --on-stop hold
  run_hand "chiaro-output, no real-time rights" "$count" idle --no-real-time --on-stop hold
  if [ $ola = yes ] && command -v olad >/dev/null && [ -x "$build/bin/soak_ola" ]; then
    run_ola "olad + streaming client" "$count" ""
  fi
done
echo "bars: off99.9 at most 0.5 with SCHED_FIFO and 5 without, missing 0, core at most 3 % at 256"
