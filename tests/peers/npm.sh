#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Programs from npm beside ours, each in a network namespace of its own with one cable between them:
# no port is anybody else's. Usage: npm.sh NODE PEER_SENDER PEER_RECEIVER. 77: not root, so no
# namespaces can be made.
set -u
[ "$(id -u)" = 0 ] || exit 77
here=$(cd "$(dirname "$0")" && pwd)
[ -d "$here/node_modules/dmxnet" ] || { echo "run: npm --prefix tests/peers ci"; exit 1; }
if [ "${CHIARO_INSIDE:-}" = "" ]; then CHIARO_INSIDE=1 exec unshare -n "$0" "$@"; fi

unshare -n sleep 110 & far=$!
trap 'kill $far 2>/dev/null; wait 2>/dev/null' EXIT
# The new namespace is there once it is another than ours.
for _ in $(seq 100); do
  [ "$(readlink /proc/$far/ns/net)" != "$(readlink /proc/$$/ns/net)" ] && break
  sleep 0.05
done
ip link set lo up
ip link add near type veth peer name far
ip link set far netns $far
ip addr add 10.9.8.1/24 brd 10.9.8.255 dev near
ip link set near up
ip route add 224.0.0.0/4 dev near
there="nsenter -t $far -n"
$there ip link set lo up
$there ip addr add 10.9.8.2/24 brd 10.9.8.255 dev far
$there ip link set far up
$there ip route add 224.0.0.0/4 dev far
CHIARO_THERE="$there" CHIARO_SENDER=$2 CHIARO_RECEIVER=$3 "$1" --test "$here/npm_test.mjs"
