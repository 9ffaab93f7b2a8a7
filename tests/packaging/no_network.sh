#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# no_network.sh PROGRAM: nothing in the program can ask for an address, open a connection or listen, and no library
# of its own that is there for networks is linked.
set -eu
imports=$(readelf --wide --dyn-syms "$1" | awk '$7 == "UND" { print $8 }' | sed 's/@.*//')
echo "$imports" | grep -q '^malloc$' || { echo "readelf found no imports"; exit 1; }
found=$(echo "$imports" | grep -Ex \
  'socket|connect|bind|listen|accept4?|send(to|msg)?|recv(from|msg)?|getaddrinfo|gethostby.*|avformat_network_init|_ZN?K?[0-9]*Q(Tcp|Udp|Ssl|Network|LocalS).*' || true)
[ -z "$found" ] || { echo "the program can use networks: $found"; exit 1; }
linked=$(readelf --wide --dynamic "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
  grep -Ei 'network|curl|websocket|ssl|libssh' || true)
[ -z "$linked" ] || { echo "the program links libraries for networks: $linked"; exit 1; }
