#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A real olad hears our sACN (multicast) and our Art-Net (it answers our polls and gets unicast), each
# in a network namespace of its own with one cable between them, and our OLA client beside it; its
# levels are read back over HTTP.
# Usage: olad.sh PATH/TO/peer_sender. 77: not root, so no namespaces can be made.
set -u
sender=$1
[ "$(id -u)" = 0 ] || exit 77
command -v olad >/dev/null || { echo "olad is missing: apt-get install ola"; exit 1; }
if [ "${CHIARO_INSIDE:-}" = "" ]; then CHIARO_INSIDE=1 exec unshare -n "$0" "$sender"; fi

folder=$(mktemp -d)
trap 'kill $ola $far 2>/dev/null; wait 2>/dev/null; rm -rf "$folder"' EXIT
unshare -n sleep 90 & far=$!
sleep 0.5
ip link set lo up
ip link add near type veth peer name far
ip link set far netns $far
ip addr add 10.9.9.1/24 brd 10.9.9.255 dev near
ip link set near up
ip route add 224.0.0.0/4 dev near
there() { nsenter -t $far -n "$@"; }
there ip link set lo up
there ip addr add 10.9.9.2/24 brd 10.9.9.255 dev far
there ip link set far up
there ip route add 224.0.0.0/4 dev far

for plugin in dummy ftdidmx gpio espnet karate kinet milinst nanoleaf opendmx openpixelcontrol osc \
  pathport renard sandnet shownet spi spidmx stageprofi uartdmx usbdmx usbserial usbpro dmx4linux; do
  echo "enabled = false" > "$folder/ola-$plugin.conf"
done
echo "ip = 10.9.9.1" | tee "$folder/ola-e131.conf" > "$folder/ola-artnet.conf"
chmod -R a+rwX "$folder"
setpriv --reuid=65534 --clear-groups olad -c "$folder" -l 1 --interface near 2>/dev/null & ola=$!
device() { ola_dev_info 2>/dev/null | sed -n "s/^Device \([0-9]*\): $1.*/\1/p"; }
for _ in $(seq 60); do [ -n "$(device E1.31)" ] && [ -n "$(device 'Art.\?Net')" ] && break; sleep 0.5; done
# olad's Art-Net universe 2 is port-address 2: our universe 3.
ola_patch -d "$(device E1.31)" -p 0 -i -u 11
ola_patch -d "$(device 'Art.\?Net')" -p 0 -i -u 2

ola_patch -d "$(device E1.31)" -p 0 -u 5  # a universe lives while a port has it

expected=$(seq 0 511 | awk '{printf "%s%d", (NR > 1 ? "," : ""), (7 * $1 + 3) % 256}')
fault=0
hears() {
  "${@:4}" "$sender" "$2" "$3" far 20 >/dev/null & local sending=$!
  for _ in $(seq 36); do
    sleep 0.5
    levels=$(curl -s "http://127.0.0.1:9090/get_dmx?u=$1" | tr -d '\n ' | sed -n 's/.*"dmx":\[\([0-9,]*\)\].*/\1/p')
    [ "$levels" = "$expected" ] && break
  done
  kill $sending 2>/dev/null
  wait $sending 2>/dev/null
  if [ "$levels" = "$expected" ]; then echo "olad hears our $2"; else echo "olad does not hear our $2: '$levels'"; fault=1; fi
}
hears 11 sacn 11 there
hears 2 artnet 3 there
hears 5 ola 5 env
exit $fault
